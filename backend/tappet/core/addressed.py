"""Variables at addresses: their initial values, and copies of those whose address is configured (LDEC-93)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol

from tappet.core import assign, ir
from tappet.core.body import INITIALISERS, Body
from tappet.core.program import AREA_PREFIX, Program
from tappet.core.scalars import scalar_of
from tappet.lang import ast
from tappet.lang.analysis.result import ConfiguredAddress
from tappet.lang.symbols import Storage, VarSymbol


class Task(Protocol):
    """What is asked of a task."""

    @property
    def programs(self) -> Sequence[str]:
        """Programs it calls."""


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


def transfers(program: Program, task: Task, tasks: Sequence[Task]) -> tuple[list[ir.Stmt], list[ir.Stmt]]:
    """The copies at the beginning of a task, from the inputs, and at its end, to outputs and markers."""
    before: list[ir.Stmt] = []
    after: list[ir.Stmt] = []
    for item in program.analysis.configured:
        end = item.address + max(item.type.size, 1)
        program.area_use[item.area] = max(program.area_use.get(item.area, 0), end)
        if _task_of(item, tasks) is task:
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
    variable = ir.Place(ir.Data("tappet.data." + item.owner.upper()), item.offset)
    area = ir.Place(ir.Data(AREA_PREFIX + item.area), item.address)
    if item.bit is None:
        return ir.Copy(area, variable, item.type.size) if to_area else ir.Copy(variable, area, item.type.size)
    shift = ir.Const(ir.U32, item.bit)
    byte = ir.Load(ir.U8, area)
    if not to_area:
        return ir.Store(variable, ir.Convert(ir.BOOL, ir.Binary(ir.U8, "shr", byte, shift)))
    cleared = ir.Binary(ir.U8, "and", byte, ir.Const(ir.U8, ~(1 << item.bit)))
    value = ir.Binary(ir.U8, "shl", ir.Convert(ir.U8, ir.Load(ir.BOOL, variable)), shift)
    return ir.Store(area, ir.Binary(ir.U8, "or", cleared, value))
