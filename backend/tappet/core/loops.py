"""Scalar variables of programs and instances live in locals while a loop runs, like counters in C.

PLC variables are static memory, and a store through an array would force every counter to be read again. A
variable is taken when all accesses in the loop are plain loads and stores of it, and when nothing the loop
calls can reach it. The outermost loop that allows it is chosen.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core import ir
from tappet.core.effects import EffectsTable, Instances
from tappet.core.exposure import Exposure
from tappet.core.walk import blocks_of, places_of, visit

_LOOPS = (ir.For, ir.While, ir.Repeat)
_LIMIT = 32
"""Variables promoted by one loop at most."""

Key = tuple[ir.Base, int]
"""Base and offset of a variable."""


@dataclass(slots=True)
class _Use:
    """Accesses of one scalar in a loop."""

    type: ir.Scalar
    root: int
    holders: list[tuple[ir.Load | ir.Store | ir.For, str]] = field(default_factory=list)
    written: bool = False


@dataclass(slots=True)
class _Survey:
    """What a loop does with memory."""

    uses: dict[Key, _Use] = field(default_factory=dict)
    spoiled: set[tuple[ir.Base, int]] = field(default_factory=set)
    """(base, root) with accesses that are not plain."""
    wild: set[ir.Base] = field(default_factory=set)
    """Bases with accesses whose root is unknown."""
    data: set[str] = field(default_factory=set)
    pointers: bool = False
    dereferences: bool = False
    """Accesses of its own through pointers, which may lead nowhere."""
    calls: set[str] = field(default_factory=set)
    refused: bool = False
    """Jumps, foreign code or operations of several threads inside."""


class Promotion:
    """Promotes the variables of one module."""

    def __init__(self, module: ir.Module, effects: EffectsTable) -> None:
        self.module = module
        self.effects = effects
        self.exposure = Exposure(module)

    def run(self, function: ir.Function) -> None:
        """Promote in all loops of a function."""
        if not function.returns_twice:
            self._block(function, function.body)

    def _block(self, function: ir.Function, body: list[ir.Stmt]) -> None:
        for number, statement in enumerate(body):
            if isinstance(statement, _LOOPS):
                promoted = self._loop(function, statement)
                if promoted is not None:
                    body[number] = promoted
                    continue
            for inner in blocks_of(statement):
                self._block(function, inner)

    def _loop(self, function: ir.Function, loop: ir.For | ir.While | ir.Repeat) -> ir.Promoted | None:
        survey = _survey(self.module, loop)
        if survey.refused or not self._calls_are_known(survey):
            return None
        if survey.dereferences and self.module.catches_faults:
            return None
        chosen = [
            (key, use)
            for key, use in survey.uses.items()
            if (key[0], use.root) not in survey.spoiled and self._private(function, survey, key[0], use.root)
        ]
        if not chosen:
            return None
        variables = []
        for (base, offset), use in chosen[:_LIMIT]:
            local = ir.Local(f"r{offset}", use.type.size, use.type.size, use.type)
            variables.append((ir.Place(base, offset, root=use.root), local, use.type, use.written))
            for holder, name in use.holders:
                setattr(holder, name, ir.Place(local))
        for name in survey.calls:
            function.assumed[name] = self.effects.of(name)
        for (base, _), use in chosen:
            function.promoted_bases |= self.exposure.concerns(self._names(function, base), use.root)
        return ir.Promoted(variables, loop, frozenset(survey.calls))

    def _calls_are_known(self, survey: _Survey) -> bool:
        for name in survey.calls:
            effects = self.effects.of(name)
            if effects.unknown:
                return False
            survey.data |= effects.data
            survey.pointers |= effects.pointers
        return True

    def _private(self, function: ir.Function, survey: _Survey, base: ir.Base, root: int) -> bool:
        """Whether only the plain accesses of the loop reach a variable."""
        if base in survey.wild:
            return False
        family: frozenset[str] = frozenset()
        if function.self_type:
            family = self.module.families.get(function.self_type, frozenset({function.self_type}))
        holders = {symbol for name in family for symbol in self.module.containers.get(name, ())}
        if isinstance(base, ir.Self):
            if survey.data & holders:
                return False
        elif isinstance(base, ir.Data) and (
            base.symbol in self._called_data(survey) or base.symbol in holders
        ):
            return False
        return not survey.pointers or not self.exposure.reaches(self._names(function, base), root)

    def _names(self, function: ir.Function, base: ir.Base) -> frozenset[str]:
        """Data object of a variable, or the block types that have it."""
        if isinstance(base, ir.Data):
            return frozenset({base.symbol})
        return self.module.families.get(function.self_type, frozenset({function.self_type}))

    def _called_data(self, survey: _Survey) -> set[str]:
        """Data objects that called functions touch."""
        return {symbol for name in survey.calls for symbol in self.effects.of(name).data}


def _survey(module: ir.Module, loop: ir.Stmt) -> _Survey:
    found = _Survey()
    instances = Instances(module)

    def note(node: ir.Expr | ir.Stmt) -> None:
        kind = type(node)
        instances.note(node)
        if kind is ir.Goto or kind is ir.Label or kind is ir.CallPointer or kind is ir.Promoted:
            found.refused = True
        elif isinstance(node, ir.Call):
            found.calls.add(node.function)
            if node.function not in module.functions:
                found.refused = True
        elif isinstance(node, ir.CallVirtual):
            found.calls.add(node.method.key)
        elif isinstance(node, ir.Intrinsic):
            found.refused |= node.op in _THREADED
        elif kind is ir.CopyBytes or kind is ir.FillBytes:
            found.pointers = True
        for name, place in places_of(node):
            _note_place(found, node, name, place)

    visit([loop], note)
    found.pointers |= instances.unknown
    return found


_THREADED = {"setjmp", "longjmp", "load_acquire", "store_release", "fetch_add", "compare_swap", "fence"}


def _note_place(found: _Survey, node: ir.Expr | ir.Stmt, name: str, place: ir.Place) -> None:
    base = place.base
    if isinstance(base, ir.Indirect):
        found.pointers |= not base.own and not isinstance(node, ir.Address)
        found.dereferences |= not base.own
        return
    if isinstance(base, ir.Local):
        return
    if isinstance(base, ir.Data):
        if base.symbol.startswith("tappet.const."):
            return
        found.data.add(base.symbol)
    if place.root < 0:
        found.wild.add(base)
        return
    scalar: ir.Scalar | None = None
    if isinstance(node, ir.Load):
        scalar = node.type
    elif isinstance(node, ir.Store):
        scalar = node.value.type
    elif isinstance(node, ir.For):
        scalar = node.type
    if scalar is None or place.subscripts:
        found.spoiled.add((base, place.root))
        return
    key = (base, place.offset)
    use = found.uses.get(key)
    if use is None:
        use = found.uses[key] = _Use(scalar, place.root)
    elif use.type is not scalar or use.root != place.root:
        found.spoiled.add((base, place.root))
    assert isinstance(node, ir.Load | ir.Store | ir.For)
    use.holders.append((node, name))
    use.written |= not isinstance(node, ir.Load)


# -- counters ---------------------------------------------------------------------------------------


def mark_fixed_counters(function: ir.Function) -> None:
    """Set `For.fixed` where only the loop changes the counter and `stop` does not look at it.

    Only for counters in locals. A `stop` that reads the counter must be evaluated behind the step.
    """
    addressed: set[ir.Local] = set()
    loops: list[ir.For] = []

    def note(node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Address) and isinstance(node.place.base, ir.Local):
            addressed.add(node.place.base)
        elif isinstance(node, ir.Copy | ir.Fill):
            for _, place in places_of(node):
                if isinstance(place.base, ir.Local):
                    addressed.add(place.base)
        elif isinstance(node, ir.For):
            loops.append(node)

    visit(function.body, note)
    for loop in loops:
        base = loop.counter.base
        if isinstance(base, ir.Local) and base not in addressed:
            loop.fixed = not _writes(loop.body, base) and not _mentions(loop.stop, base)


def _writes(body: list[ir.Stmt], local: ir.Local) -> bool:
    found = False

    def note(node: ir.Expr | ir.Stmt) -> None:
        nonlocal found
        if isinstance(node, ir.Store):
            found |= node.place.base is local
        elif isinstance(node, ir.For):
            found |= node.counter.base is local

    visit(body, note)
    return found


def _mentions(e: ir.Expr, local: ir.Local) -> bool:
    """Whether an expression reads or writes a local."""
    found = False

    def note(node: ir.Expr | ir.Stmt) -> None:
        nonlocal found
        found |= any(place.base is local for _, place in places_of(node))

    visit([ir.Evaluate(e)], note)
    return found


def mark_pointer_walks(function: ir.Function) -> None:
    """Counters of `WHILE p[i] <> 0` loops do not overflow: memory ends before.

    The index of a pointer that is dereferenced in every pass and grows by a small constant passes an
    unmapped page long before 2^31, so the 32-bit addition may be treated as exact.
    """

    def note(node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.While):
            for local in _walked(node.condition):
                _mark_steps(node.body, local)

    visit(function.body, note)


def _walked(condition: ir.Expr) -> set[ir.Local]:
    """32-bit locals that index a pointer in a part of the condition that every pass evaluates."""
    found: set[ir.Local] = set()
    todo = [condition]
    while todo:
        e = todo.pop()
        if isinstance(e, ir.ShortCircuit):
            if e.op == "and":
                todo += [e.left, e.right]
        elif isinstance(e, ir.Compare | ir.Binary):
            todo += [e.left, e.right]
        elif isinstance(e, ir.Convert | ir.Unary):
            todo.append(e.operand)
        elif isinstance(e, ir.Load) and isinstance(e.place.base, ir.Indirect):
            for sub in e.place.subscripts:
                index = sub.index
                if isinstance(index, ir.Load) and index.type is ir.I32:
                    base = index.place.base
                    if isinstance(base, ir.Local):
                        found.add(base)
    return found


def _mark_steps(body: list[ir.Stmt], local: ir.Local) -> None:
    steps: list[ir.Binary] = []
    plain = True

    def note(node: ir.Expr | ir.Stmt) -> None:
        nonlocal plain
        if isinstance(node, ir.Address):
            plain &= node.place.base is not local
        elif isinstance(node, ir.For):
            plain &= node.counter.base is not local
        elif isinstance(node, ir.Store) and node.place.base is local:
            step = _small_step(node.value, local)
            if step is None:
                plain = False
            else:
                steps.append(step)

    visit(body, note)
    if plain:
        for step in steps:
            step.exact = True


def _small_step(value: ir.Expr, local: ir.Local) -> ir.Binary | None:
    if not isinstance(value, ir.Binary) or value.op != "add" or not isinstance(value.right, ir.Const):
        return None
    left = value.left
    if isinstance(left, ir.Load) and left.place.base is local and 0 < value.right.value <= 64:
        return value
    return None
