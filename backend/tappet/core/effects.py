"""Which memory a function can touch, its callees included."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core import ir
from tappet.core.walk import visit
from tappet.core.written_memory import written_memory


@dataclass(slots=True)
class Effects:
    """Memory a function reads or writes."""

    data: set[str] = field(default_factory=set)
    """Data objects, by symbol."""
    pointers: bool = False
    """Anything whose address is known (pointers, VAR_IN_OUT, methods called through them)."""
    unknown: bool = False
    """Anything at all: code that is not part of the module."""
    stores: bool = False
    """Whether memory that callers reach is written, their own locals and space for results apart."""
    calls: set[str] = field(default_factory=set)


class Instances:
    """Whether functions are called on instances known only through a pointer or a reference."""

    def __init__(self, module: ir.Module) -> None:
        self.module = module
        self.addresses: dict[ir.Local, bool] = {}
        self.arguments: list[ir.Expr] = []

    def note(self, node: ir.Expr | ir.Stmt) -> None:
        """Take in one node."""
        if isinstance(node, ir.Call):
            function = self.module.functions.get(node.function)
            if function is not None and function.self_type and node.args:
                self.arguments.append(node.args[0])
        elif isinstance(node, ir.CallVirtual):
            self.arguments.append(node.args[0])
        elif (
            isinstance(node, ir.Store) and node.value.type is ir.PTR and isinstance(node.place.base, ir.Local)
        ):
            local = node.place.base
            self.addresses[local] = self.addresses.get(local, True) and _is_named(node.value)

    @property
    def unknown(self) -> bool:
        """Whether there is such a call among the nodes."""
        return not all(_is_named(e) or self._is_kept(e) for e in self.arguments)

    def _is_kept(self, e: ir.Expr) -> bool:
        base = e.place.base if isinstance(e, ir.Load) else None
        return isinstance(base, ir.Local) and self.addresses.get(base, False)


def _is_named(e: ir.Expr) -> bool:
    """Whether an address says which variable it is of."""
    return isinstance(e, ir.Address) and not isinstance(e.place.base, ir.Indirect)


class EffectsTable:
    """Effects of the functions of a module with their callees, found when somebody asks."""

    def __init__(self, module: ir.Module) -> None:
        self.module = module
        self.own: dict[str, Effects] = {}
        self.closed: dict[str, Effects] = {}

    def of(self, name: str) -> Effects:
        """Effects of a function, or of all that a virtual call reaches, and of everything called there.

        Unknown for functions outside the module.
        """
        found = self.closed.get(name)
        if found is None:
            found = self.closed[name] = self._close(name)
        return found

    def forget(self, names: set[str]) -> None:
        """The bodies of some functions are new."""
        for name in names:
            self.own.pop(name, None)
        if names:
            self.closed.clear()

    def _close(self, name: str) -> Effects:
        total = Effects()
        seen: set[str] = set()
        todo = [name]
        while todo:
            current = todo.pop()
            if current in seen:
                continue
            seen.add(current)
            function = self.module.functions.get(current)
            if function is None:
                virtual = self.module.virtual.get(current)
                total.unknown |= virtual is None
                total.stores |= virtual is None
                todo += virtual.targets.values() if virtual is not None else ()
                continue
            effects = self.own.get(current)
            if effects is None:
                effects = self.own[current] = _own(self.module, function)
            total.data |= effects.data
            total.pointers |= effects.pointers
            total.unknown |= effects.unknown
            total.stores |= effects.stores
            todo += effects.calls
        return total


def _own(module: ir.Module, function: ir.Function) -> Effects:
    effects = Effects()
    instances = Instances(module)
    fields = {
        ir.Load: ("place",), ir.Store: ("place",), ir.Copy: ("target", "source"), ir.Fill: ("target",),
        ir.For: ("counter",),
    }  # fmt: skip

    def note(node: ir.Expr | ir.Stmt) -> None:
        kind = type(node)
        instances.note(node)
        if kind in fields:
            for name in fields[kind]:
                base = getattr(node, name).base
                if isinstance(base, ir.Data):
                    effects.data.add(base.symbol)
                elif isinstance(base, ir.Indirect) and not base.own:
                    effects.pointers = True
        elif isinstance(node, ir.Promoted):
            for home, _, _, _ in node.variables:
                if isinstance(home.base, ir.Data):
                    effects.data.add(home.base.symbol)
        elif isinstance(node, ir.Call):
            if node.function in module.functions:
                effects.calls.add(node.function)
            else:
                effects.unknown = True
        elif isinstance(node, ir.CallVirtual):
            effects.calls.add(node.method.key)
        elif kind is ir.CallPointer:
            effects.unknown = True
        elif kind is ir.CopyBytes or kind is ir.FillBytes:
            effects.pointers = True
        elif isinstance(node, ir.Intrinsic) and node.op in _MACHINE:
            effects.unknown = True

    visit(function.body, note)
    effects.pointers |= instances.unknown
    effects.stores = written_memory(module, function).foreign
    return effects


_MACHINE = {"setjmp", "longjmp", "load_acquire", "store_release", "fetch_add", "compare_swap", "fence"}
"""Operations that other threads take part in."""
