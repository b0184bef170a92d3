"""Which memory the statements of one function write to, as far as its callers can see.

Addresses are followed through the scalar locals of the function, whatever the order of its statements: a
pointer that holds nothing but addresses of the function's own memory writes to nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from tappet.core import ir
from tappet.core.walk import visit

_OTHER = ir.Local("", 0, 1)
"""Denotes memory that is not the function's own."""
_OWN = ir.Local("", 0, 1)
"""Denotes the space for the result."""
_THREADED = {"setjmp", "longjmp", "load_acquire", "store_release", "fetch_add", "compare_swap", "fence"}


@dataclass(slots=True)
class Written:
    """What a function writes to, its callees apart."""

    foreign: bool = False
    """Memory that others reach: data, instances, whatever pointers and VAR_IN_OUT lead to."""
    locals: set[ir.Local] = field(default_factory=set)
    """Its own locals, also those whose address gets out of sight."""
    calls: set[str] = field(default_factory=set)
    """Functions and virtual methods that it calls."""


def written_memory(module: ir.Module, function: ir.Function) -> Written:
    """What the body of `function` writes to."""
    return _Survey(module, function).result


class _Survey:
    def __init__(self, module: ir.Module, function: ir.Function) -> None:
        self.module = module
        self.function = function
        self.result = Written()
        self.sources: dict[ir.Local, list[ir.Expr]] = {}
        """What is stored in scalar locals."""
        self.addressed: set[ir.Local] = set()
        nodes: list[ir.Expr | ir.Stmt] = []
        visit(function.body, nodes.append)
        for node in nodes:
            self._collect(node)
        for node in nodes:
            self._note(node)

    def _collect(self, node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Store) and isinstance(node.place.base, ir.Local):
            self.sources.setdefault(node.place.base, []).append(node.value)
        elif isinstance(node, ir.For) and isinstance(node.counter.base, ir.Local):
            steps = [node.start, node.step] if isinstance(node.step, ir.Expr) else [node.start]
            self.sources.setdefault(node.counter.base, []).extend(steps)
        elif isinstance(node, ir.Address) and isinstance(node.place.base, ir.Local):
            self.addressed.add(node.place.base)

    # -- addresses -----------------------------------------------------------------------------------

    def roots(self, pointer: ir.Expr) -> set[ir.Local]:
        """The locals that an address may be of, `_OWN` and `_OTHER` among them."""
        found: set[ir.Local] = set()
        seen: set[ir.Local] = set()
        todo = [pointer]
        while todo:
            e = todo.pop()
            if isinstance(e, ir.Address):
                self._base(e.place.base, found, todo)
            elif isinstance(e, ir.Load):
                local = e.place.base
                if not isinstance(local, ir.Local) or local.type is None or local in self.addressed:
                    found.add(_OTHER)
                elif local not in seen:
                    seen.add(local)
                    todo += self.sources.get(local, ())
            elif isinstance(e, ir.Argument) and self.function.parameters[e.number].alone:
                found.add(_OWN)
            elif isinstance(e, ir.Binary):
                todo += [e.left, e.right]
            elif isinstance(e, ir.Unary | ir.Convert | ir.Reinterpret):
                todo.append(e.operand)
            elif isinstance(e, ir.Select):
                todo += [e.then, e.otherwise]
            elif isinstance(e, ir.Sequence):
                todo.append(e.value)
            elif not isinstance(e, ir.Const | ir.Compare | ir.ShortCircuit):
                found.add(_OTHER)
        return found

    def _base(self, base: ir.Base, found: set[ir.Local], todo: list[ir.Expr]) -> None:
        if isinstance(base, ir.Local):
            found.add(base)
        elif isinstance(base, ir.Indirect):
            if base.own:
                found.add(_OWN)
            else:
                todo.append(base.pointer)
        else:
            found.add(_OTHER)

    def _write_to(self, roots: set[ir.Local]) -> None:
        # no root at all: an absolute address
        self.result.foreign |= not roots or _OTHER in roots
        self.result.locals |= roots - {_OTHER, _OWN}

    def _write(self, place: ir.Place) -> None:
        base = place.base
        if isinstance(base, ir.Indirect):
            self._write_to({_OWN} if base.own else self.roots(base.pointer))
        elif isinstance(base, ir.Local):
            self.result.locals.add(base)
        else:
            self.result.foreign = True

    def _lose(self, value: ir.Expr) -> None:
        """An address goes where it cannot be followed: the memory may be written to from there."""
        if value.type.pointer or (value.type.bits >= 32 and not value.type.floating):
            self.result.locals |= self.roots(value) - {_OTHER, _OWN}

    # -- nodes ---------------------------------------------------------------------------------------

    def _note(self, node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Store):
            self._write(node.place)
            base = node.place.base
            kept = isinstance(base, ir.Local) and base.type is not None
            if not kept or base is self.function.result_local:
                self._lose(node.value)
        elif isinstance(node, ir.Copy | ir.Fill):
            self._write(node.target)
        elif isinstance(node, ir.CopyBytes | ir.FillBytes):
            self._write_to(self.roots(node.target))
        elif isinstance(node, ir.For):
            self._write(node.counter)
        elif isinstance(node, ir.Promoted):
            for home, _, _, written in node.variables:
                if written:
                    self._write(home)
        elif isinstance(node, ir.Call):
            self._call(node)
        elif isinstance(node, ir.CallVirtual):
            self.result.calls.add(node.method.key)
            self._lose_all(node.args)
        elif isinstance(node, ir.CallPointer) or (isinstance(node, ir.Intrinsic) and node.op in _THREADED):
            self.result.foreign = True
            self._lose_all(node.args)

    def _call(self, node: ir.Call) -> None:
        callee = self.module.functions.get(node.function)
        if callee is None:
            external = self.module.externals.get(node.function)
            self.result.foreign |= external is None or not external.pure
            self._lose_all(node.args)
            return
        self.result.calls.add(node.function)
        for parameter, value in zip(callee.parameters, node.args, strict=True):
            if parameter.writable:
                self._lose(value)

    def _lose_all(self, values: Iterable[ir.Expr]) -> None:
        for value in values:
            self._lose(value)
