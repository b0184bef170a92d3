"""Variables at addresses: their initial values, and copies of those whose address is configured (LDEC-93)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tappet.core import assign, ir
from tappet.core.body import INITIALISERS, Body
from tappet.core.program import AREA_PREFIX, DATA_PREFIX, Program
from tappet.core.scalars import scalar_of
from tappet.iec.task import Task
from tappet.lang import ast
from tappet.lang.analysis.result import AGREED, ConfiguredAddress
from tappet.lang.symbols import Storage, VarSymbol

# -- initial values ---------------------------------------------------------------------------------


def initialise(b: Body) -> None:
    """Gives the variables AT an address the initial values that are declared for them."""
    for variable in _with_initial_value(b.program):
        type_, decl = variable.type, variable.decl
        assert type_ is not None
        assert decl is not None
        b.source = variable.source
        target = ast.Name(name=variable.name, span=decl.span)
        target.symbol, target.type = variable, type_
        if scalar_of(type_) is None:
            INITIALISERS[0](b, b.place(target), type_, decl.init)
        elif decl.init is not None:
            assign.store_scalar(b, target, b.value_as(decl.init, type_))


def _with_initial_value(program: Program) -> Iterator[VarSymbol]:
    seen: set[int] = set()
    tables = [gvl.members for gvl in program.analysis.gvls]
    tables += [pou.locals for pou in program.analysis.pous if pou.kind in ("PROGRAM", "FUNCTION_BLOCK")]
    for table in tables:
        for variable in table.values():
            direct = variable.storage is Storage.DIRECT and variable.type is not None
            if direct and variable.decl is not None and variable.decl.init is not None:
                if id(variable) not in seen:
                    yield variable
                seen.add(id(variable))


# -- configured addresses ---------------------------------------------------------------------------


def transfers(
    program: Program, task: Task, tasks: Sequence[Task], function: ir.Function
) -> tuple[list[ir.Stmt], list[ir.Stmt]]:
    """What is copied at the beginning of a task, from the inputs, and at its end, to the outputs; markers are
    made equal to their variables at both. `function` is that of the task."""
    before: list[ir.Stmt] = []
    after: list[ir.Stmt] = []
    for item in program.analysis.configured:
        end = item.address + max(item.type.size, 1)
        program.area_use[item.area] = max(program.area_use.get(item.area, 0), end)
        if _task_of(item, tasks) is task:
            if item.area == "M":
                before += _agree(item, function)
                after += _agree(item, function)
                continue
            inwards = item.area == "I"
            (before if inwards else after).append(_transfer(item, to_area=not inwards))
    return before, after


def _task_of(item: ConfiguredAddress, tasks: Sequence[Task]) -> Task:
    """The task that runs the program a configured variable is in; the first one for lists."""
    for task in tasks:
        if item.owner.upper() in (p.upper() for p in task.programs):
            return task
    return tasks[0]


def _transfer(item: ConfiguredAddress, to_area: bool) -> ir.Stmt:
    """Copy a VAR_CONFIG variable from or to its address (LDEC-93)."""
    variable, area = _places(item)
    if item.bit is None:
        return ir.Copy(area, variable, item.type.size) if to_area else ir.Copy(variable, area, item.type.size)
    if not to_area:
        return ir.Store(variable, ir.Convert(ir.BOOL, _bit(area, item.bit)))
    cleared = ir.Binary(ir.U8, "and", ir.Load(ir.U8, area), ir.Const(ir.U8, ~(1 << item.bit)))
    value = ir.Convert(ir.U8, ir.Load(ir.BOOL, variable))
    placed = ir.Binary(ir.U8, "shl", value, ir.Const(ir.U32, item.bit))
    return ir.Store(area, ir.Binary(ir.U8, "or", cleared, placed))


def _places(item: ConfiguredAddress) -> tuple[ir.Place, ir.Place]:
    """The variable and what lies at its address."""
    variable = ir.Place(ir.Data(DATA_PREFIX + item.owner.upper()), item.offset)
    return variable, ir.Place(ir.Data(AREA_PREFIX + item.area), item.address)


def _bit(area: ir.Place, bit: int) -> ir.Expr:
    """A bit of a byte of an area, 0 or 1."""
    shifted = ir.Binary(ir.U8, "shr", ir.Load(ir.U8, area), ir.Const(ir.U32, bit))
    return ir.Binary(ir.U8, "and", shifted, ir.Const(ir.U8, 1))


def _agree(item: ConfiguredAddress, function: ir.Function) -> list[ir.Stmt]:
    """Make a marker and its variable equal: what has changed since they were is the value of both (LDEC-58);
    the variable goes before the marker when both have."""
    variable, area = _places(item)
    agreed = ir.Place(ir.Data(DATA_PREFIX + AGREED), item.agreed)
    size = max(item.type.size, 1)
    out = [_transfer(item, to_area=True), ir.Copy(agreed, variable, size)]
    inwards = [_transfer(item, to_area=False), ir.Copy(agreed, variable, size)]
    if item.bit is not None or size == 1:
        known = ir.Load(ir.U8, agreed)
        there = ir.Load(ir.U8, area) if item.bit is None else _bit(area, item.bit)
        changed = ir.Compare(ir.BOOL, "ne", ir.Load(ir.U8, variable), known)
        other = ir.Compare(ir.BOOL, "ne", there, ir.Load(ir.U8, agreed))
        return [ir.If(changed, out, [ir.If(other, inwards, [])])]
    differs = ir.Local(f"differs{len(function.locals)}", 1, 1, ir.BOOL)
    number = ir.Local(f"byte{len(function.locals)}", 4, 4, ir.U32)
    function.locals += [differs, number]
    found = ir.Load(ir.BOOL, ir.Place(differs))
    return [
        *_compare(variable, agreed, size, differs, number),
        ir.If(
            found,
            out,
            [
                *_compare(area, agreed, size, differs, number),
                ir.If(ir.Load(ir.BOOL, ir.Place(differs)), inwards, []),
            ],
        ),
    ]


def _compare(one: ir.Place, two: ir.Place, size: int, differs: ir.Local, number: ir.Local) -> list[ir.Stmt]:
    """Set `differs` when the bytes of two places are not the same."""

    def byte(place: ir.Place) -> ir.Expr:
        index = ir.Subscript(ir.Load(ir.U32, ir.Place(number)), 0, size - 1, 1, checked=False)
        return ir.Load(ir.U8, ir.Place(place.base, place.offset, (index,)))

    unequal = ir.Compare(ir.BOOL, "ne", byte(one), byte(two))
    last = ir.Const(ir.U32, size - 1)
    note: list[ir.Stmt] = [ir.If(unequal, [ir.Store(ir.Place(differs), ir.Const(ir.BOOL, 1))], [])]
    return [
        ir.Store(ir.Place(differs), ir.Const(ir.BOOL, 0)),
        ir.For(ir.Place(number), ir.U32, ir.Const(ir.U32, 0), last, 1, note),
    ]
