"""A checked program to a core module: bodies reached from the tasks, initialisers, task entries.

Only what the tasks reach is lowered; libraries may be large. Tasks put programs on the work list, bodies put
what they call there, and virtual calls add the methods of every block that has instances.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from tappet.core import (
    addressed,
    arguments,
    assign,
    builtins,
    calls,
    conversions,
    initial,
    ir,
    monitored,
    places,
    properties,
    templates,
    variable_info,
    watched_properties,
)
from tappet.core.body import Body
from tappet.core.internal_error import At, function_at, working_on
from tappet.core.method_tables import number_methods
from tappet.core.program import AREA_PREFIX, OBJECT_ALIGN, Program, attribute_value, data_symbol, export_name
from tappet.core.relations import relate
from tappet.core.scalars import scalar_of
from tappet.core.statements import lower_statements
from tappet.iec.memory import STACK_SIZE, check_image_size
from tappet.iec.task import Task
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis
from tappet.lang.source import Scope
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage, VarSymbol
from tappet.lang.walk import statements as every_statement

INIT = "tappet.init"
EXIT = "tappet.exit"
COPY_EXIT_PREFIX = "tappet.copy_exit."
TASK_PREFIX = "tappet.task."
LARGEST_STEP = 4096
"""Data objects are taken for this much larger than they are at most, see `extent`."""


def task_symbol(name: str) -> str:
    """Exported function that runs one cycle of a task."""
    return TASK_PREFIX + name


@dataclass(slots=True)
class DataObject:
    """A program or list with its initial bytes."""

    symbol: str
    size: int
    template: templates.Template
    owner: GvlSymbol | PouSymbol
    init: str = ""
    """The function that runs its dynamic initial values, if it has had any."""


@dataclass(slots=True)
class Lowered:
    """Result: code, data objects in order of initialisation, numbers of block types."""

    module: ir.Module
    data: list[DataObject] = field(default_factory=list)
    type_ids: dict[str, int] = field(default_factory=dict)
    program: Program | None = None
    tasks: Sequence[Task] = ()


def lower(analysis: Analysis, tasks: Sequence[Task] = (), type_ids: dict[str, int] | None = None) -> Lowered:
    """Lower an application; raises LoweringError for what has no code."""
    program = Program(analysis, type_ids=dict(type_ids or {}))
    program.lower_pou = lambda pou: lower_pou(program, pou)
    data = data_objects(program)
    _export_functions(program)
    lower_frame(program, data, tasks)
    complete(program, data)
    return Lowered(program.module, data, program.type_ids, program, tasks)


def lower_frame(program: Program, data: list[DataObject], tasks: Sequence[Task]) -> None:
    """Task entries, and what runs at start and end."""
    for task in tasks:
        _task_function(program, task, tasks)
    if tasks:
        _init_function(program, data)
        _exit_function(program, data)


def complete(program: Program, data: list[DataObject]) -> None:
    """Lower what is waiting, then number the virtual methods; may be called again after adding code."""
    complete_bodies(program)
    relate(program, [(item.symbol, item.owner) for item in data])


def complete_bodies(program: Program) -> None:
    """The same where types and data have not changed."""
    work_off(program)
    number_methods(program)


def work_off(program: Program) -> None:
    """Lower everything on the work list, and methods that virtual calls of instantiated blocks can reach."""
    seen: set[tuple[str, str]] = set()
    while True:
        while program.queue:
            program.queue.pop()()
        for name in list(program.dispatched):
            for block_name, block in list(program.blocks.items()):
                if (block_name, name) in seen:
                    continue
                seen.add((block_name, name))
                symbol = block.pou.symbol if block.pou is not None else None
                method = symbol.vtable.get(name) if isinstance(symbol, PouSymbol) else None
                if method is not None:
                    program.function(method)
        if not program.queue:
            return


# -- data -------------------------------------------------------------------------------------------


def data_objects(program: Program) -> list[DataObject]:
    """All lists and programs: lists first (LDEC-43). Raises ImageTooLargeError."""
    found: list[DataObject] = []
    owners = data_owners(program.analysis)
    check_image_size(sum(size_of(owner) for owner in owners))
    for owner in owners:
        item = DataObject(data_symbol(owner), 0, templates.Template(bytearray()), owner)
        fill_data_object(program, item)
        found.append(item)
    for area, size in program.analysis.options.area_limits.items():
        program.module.data[AREA_PREFIX + area] = (size, OBJECT_ALIGN)
    return found


def data_owners(analysis: Analysis) -> list[GvlSymbol | PouSymbol]:
    """All that has a data object."""
    programs = [pou for pou in analysis.pous if pou.kind == "PROGRAM" and pou.instance is not None]
    return [*analysis.gvls, *programs]


def size_of(owner: GvlSymbol | PouSymbol) -> int:
    """Bytes of a data object."""
    if isinstance(owner, GvlSymbol):
        return owner.size
    assert owner.instance is not None
    return owner.instance.size


def fill_data_object(program: Program, item: DataObject) -> None:
    """Size and initial values of a data object. Raises ImageTooLargeError, and takes no memory then."""
    check_image_size(size_of(item.owner))
    with working_on("initial values", lambda: _owner_at(item.owner)):
        _fill(program, item)


def _owner_at(owner: GvlSymbol | PouSymbol) -> At:
    return At(
        owner.name,
        owner.source.uri if owner.source is not None else "",
        (owner.span[0] if owner.span else 0) + 1,
    )


def _fill(program: Program, item: DataObject) -> None:
    initialiser, owner = templates.initialiser_of(program), item.owner
    item.size = size_of(owner)
    if isinstance(owner, PouSymbol):
        assert owner.instance is not None
        item.template = initialiser.of_type(owner.instance)
    else:
        item.template = templates.Template(bytearray(item.size))
        for member in owner.members.values():
            _variable(initialiser, item.template, member)
    program.module.data[item.symbol] = (extent(item.size), OBJECT_ALIGN)


def extent(size: int) -> int:
    """Bytes that code may take a data object for: somewhat more than it has, so that the code of those who
    use it stays as it is when it grows a little."""
    step = min(max(OBJECT_ALIGN, (1 << size.bit_length()) // 16), LARGEST_STEP)
    return (max(size, 1) + step - 1) // step * step


def _variable(initialiser: templates.Initialiser, template: templates.Template, member: VarSymbol) -> None:
    storage = member.home if member.storage is Storage.CONSTANT else member.storage
    if storage is Storage.GLOBAL and member.type is not None:
        initialiser.variable(template, member.offset, member.type, member.decl, member.bit)


def _init_function(program: Program, data: list[DataObject]) -> None:
    """`tappet.init`: dynamic initial values of every data object, then methods marked call_after_init."""
    entry = ir.Function(INIT, exported=True, uri="", cold=True)
    program.taken.add(INIT)
    program.module.functions[INIT] = entry
    for item in data:
        if not item.template.steps:
            program.module.functions.pop(item.init, None)
            continue
        name = item.init = item.init or program.unique(f"{item.owner.name}.__INIT")
        source = item.owner.source
        function = ir.Function(name, uri=source.uri if source else "", cold=True)
        b = Body(program, function, source)
        base = ir.Place(ir.Data(item.symbol))
        if isinstance(item.owner, PouSymbol):
            b.pou, b.own_data = item.owner, base
        with working_on("initial values", lambda item=item: _owner_at(item.owner)):  # type: ignore[misc]
            initial.run_steps(b, base, item.template.steps)
        function.body = [*b.entry, *b.out]
        program.module.functions[name] = function
        entry.body.append(ir.Evaluate(ir.Call(ir.VOID, name, [])))
    b = Body(program, entry, None)
    addressed.initialise(b)
    entry.body += [*b.entry, *b.out]


def _exit_function(program: Program, data: list[DataObject]) -> None:
    """`tappet.exit`: FB_Exit of every instance; only there when some block has one."""
    function = ir.Function(EXIT, exported=True, uri="", cold=True)
    program.module.functions.pop(EXIT, None)
    b = Body(program, function, None)
    for item in data:
        base = ir.Place(ir.Data(item.symbol))
        for member in instances(item.owner, leaving=True):
            initial.destruct_all(b, places.at(base, member[0]), member[1])
    if b.out:
        function.body = [*b.entry, *b.out]
        program.module.functions[EXIT] = function
    for item in data:
        _copy_exit_function(program, item)


def _copy_exit_function(program: Program, item: DataObject) -> None:
    """FB_Exit of the instances of one data object, for an online change that moves it (LDEC-106)."""
    function = ir.Function(COPY_EXIT_PREFIX + item.symbol, exported=True, uri="", cold=True)
    program.module.functions.pop(function.name, None)
    b = Body(program, function, None)
    base = ir.Place(ir.Data(item.symbol))
    for offset, type_ in instances(item.owner, leaving=True):
        initial.destruct_all(b, places.at(base, offset), type_, in_copy=True)
    if b.out:
        function.body = [*b.entry, *b.out]
        program.module.functions[function.name] = function


def instances(owner: GvlSymbol | PouSymbol, leaving: bool = False) -> list[tuple[int, t.Type]]:
    """Offsets and types of the variables of a list or program; `leaving`: without those that have no FB_Exit
    by their attribute (LPRG-36)."""
    found = (
        [m for m in owner.members.values() if m.storage is Storage.GLOBAL]
        if isinstance(owner, GvlSymbol)
        else []
    )
    members = owner.instance.members.values() if isinstance(owner, PouSymbol) and owner.instance else found
    return [
        (m.offset, m.type)
        for m in members
        if m.type is not None and m.section != "VAR_IN_OUT" and not (leaving and initial.without_exit(m.decl))
    ]


# -- tasks ------------------------------------------------------------------------------------------


def _task_function(program: Program, task: Task, tasks: Sequence[Task]) -> None:
    function = ir.Function(task_symbol(task.name), exported=True, uri="", inline="never")
    program.taken.add(task_symbol(task.name))
    before, after = addressed.transfers(program, task, tasks, function)
    function.body += before
    for symbol in program.cycle_starts:
        function.body.append(ir.Evaluate(ir.Call(ir.VOID, symbol, [])))
    for name in task.programs:
        pou = program.analysis.programs.get(name.upper())
        if pou is not None:
            function.body.append(ir.Evaluate(ir.Call(ir.VOID, program.function(pou), [])))
    function.body += after
    function.body += watched_properties.refresh(program, *_served(program, task, tasks))
    program.module.functions[task_symbol(task.name)] = function


def _served(program: Program, task: Task, tasks: Sequence[Task]) -> tuple[list[PouSymbol], list[GvlSymbol]]:
    """Programs and lists whose watched properties a task serves: each program the first task that calls it,
    the lists the first task of all."""
    earlier = {n.upper() for other in tasks[: tasks.index(task)] for n in other.programs}
    names = [n.upper() for n in task.programs if n.upper() not in earlier]
    found = [program.analysis.programs[n] for n in dict.fromkeys(names) if n in program.analysis.programs]
    return found, program.analysis.gvls if task == tasks[0] else []


def _export_functions(program: Program) -> None:
    """Functions with attribute tappet_export are roots, too, and every object with linkalways (LPRG-30).

    A function of a library with attribute tappet_cycle_start runs in every task before its programs.
    """
    for pou in program.analysis.pous:
        pragmas = pou.pou.attributes if pou.pou is not None else []
        always = attribute_value(pragmas, "linkalways") is not None
        if always or (pou.kind == "FUNCTION" and export_name(pou) is not None):
            program.function(pou)
        in_library = pou.source is not None and pou.source.scope is Scope.LIBRARY
        if in_library and attribute_value(pragmas, "tappet_cycle_start") is not None:
            program.cycle_starts.append(program.function(pou))


# -- bodies -----------------------------------------------------------------------------------------


def lower_pou(program: Program, pou: PouSymbol) -> None:
    """Lower the body of a POU, method, action or accessor."""
    name = program.functions[id(pou)]
    source = pou.source
    exported = pou.kind == "FUNCTION" and export_name(pou) is not None
    function = ir.Function(
        name,
        uri=source.uri if source else "",
        line=(pou.span[0] if pou.span else 0) + 1,
        exported=exported,
    )
    b = Body(program, function, source)
    b.pou = pou
    b.checks = b.checks and not unchecked(pou)
    with working_on("lowering", lambda: function_at(function, b.last_line)):
        _own_instance(b, pou)
        _result(b, pou)
        _parameters(b, pou)
        _locals(b, pou)
        assert pou.pou is not None
        b.leave = monitored.keeper(b, pou)
        b.halt_points = pou.pou.language != "ST" and any(
            isinstance(s, ast.HaltPoint) for s in every_statement(pou.pou.body)
        )
        lower_statements(b, pou.pou.body)
        if b.leave is not None:
            b.leave()
        copies = _input_copies(b)
    function.body = [*copies, *b.entry, *b.out]
    program.module.functions[function.name] = function
    program.bodies[function.name] = pou
    program.places[function.name] = b.places


def unchecked(pou: PouSymbol) -> bool:
    """Whether a body, or the POU it belongs to, has attribute no_check."""
    walk: PouSymbol | None = pou
    while walk is not None:
        if walk.pou is not None and attribute_value(walk.pou.attributes, "no_check") is not None:
            return True
        walk = walk.owner
    return False


def _own_instance(b: Body, pou: PouSymbol) -> None:
    if calls.has_self(pou):
        block = pou.instance
        if block is None and pou.owner is not None:
            block = pou.owner.instance
        assert block is not None
        b.block = block
        b.function.self_type = b.program.block_name(block)
        b.function.parameters.append(ir.Parameter("self", ir.PTR))
        b.own_data = ir.Place(ir.Self(b.function.self_type))
    elif pou.kind == "PROGRAM":
        b.own_data = ir.Place(ir.Data(data_symbol(pou)))
    elif pou.owner is not None and pou.owner.kind == "PROGRAM":
        b.own_data = ir.Place(ir.Data(data_symbol(pou.owner)))


def _result(b: Body, pou: PouSymbol) -> None:
    type_ = pou.return_type
    if type_ is None:
        return
    scalar = scalar_of(type_)
    if scalar is None:
        number = len(b.function.parameters)
        b.function.parameters.append(ir.Parameter("result", ir.PTR, alone=True))
        place = ir.Place(ir.Indirect(ir.Argument(ir.PTR, number), own=True))
        if pou.result is not None:
            b.places[id(pou.result)] = place
        if isinstance(type_, t.String):
            b.emit(ir.Store(place, ir.Const(ir.U16 if type_.wide else ir.U8, 0)))
        else:
            initial.initialise_place(b, place, type_, None)
        return
    b.function.result = scalar
    local = b.function.result_local = b.local(pou.name, type_)
    if pou.result is not None:
        b.places[id(pou.result)] = ir.Place(local)
    start = arguments.default_number(type_)
    if pou.result is not None and pou.result.decl is not None and pou.result.decl.init is not None:
        b.emit(ir.Store(ir.Place(local), b.value_as(pou.result.decl.init, type_)))
    else:
        b.emit(ir.Store(ir.Place(local), ir.Const(scalar, start)))


def _parameters(b: Body, pou: PouSymbol) -> None:
    if pou.kind in ("PROGRAM", "FUNCTION_BLOCK", "ACTION"):
        return
    for parameter in pou.parameters:
        type_ = parameter.type
        assert type_ is not None
        number = len(b.function.parameters)
        scalar = scalar_of(type_)
        if parameter.section in ("VAR_IN_OUT", "VAR_OUTPUT"):
            b.function.parameters.append(ir.Parameter(parameter.name, ir.PTR))
            place = ir.Place(ir.Indirect(ir.Argument(ir.PTR, number)))
            b.places[id(parameter)] = place
            if parameter.section == "VAR_OUTPUT":
                init = parameter.decl.init if parameter.decl is not None else None
                _initialise(b, place, type_, init)
        elif scalar is not None:
            b.function.parameters.append(ir.Parameter(parameter.name, scalar))
            local = b.local(parameter.name, type_)
            b.places[id(parameter)] = ir.Place(local)
            b.emit(ir.Store(ir.Place(local), ir.Argument(scalar, number)))
        else:
            b.function.parameters.append(ir.Parameter(parameter.name, ir.PTR, writable=False))
            local = b.local(parameter.name, type_)
            b.places[id(parameter)] = ir.Place(local)
            b.aggregate_inputs.append((local, number, type_.size))


def _input_copies(b: Body) -> list[ir.Stmt]:
    """Aggregates passed by address are copied, unless nothing can change them while the body runs."""
    copies: list[ir.Stmt] = []
    for local, number, size in b.aggregate_inputs:
        source = ir.Argument(ir.PTR, number)
        if local in b.changed or b.foreign_writes:
            copy = ir.Copy(ir.Place(local), ir.Place(ir.Indirect(source)), size, local.align)
            copies.append(copy)
            b.function.input_copies.append((copy, local, number))
        else:
            b.function.aliases[local] = number
    return copies


def _locals(b: Body, pou: PouSymbol) -> None:
    """Variables on the stack: all of functions and methods, VAR_TEMP of the others."""
    assert pou.pou is not None
    size = 0
    for block in pou.pou.blocks:
        for decl in block.variables:
            variable = decl.symbol
            if not isinstance(variable, VarSymbol) or id(variable) in b.places:
                continue
            storage = variable.home if variable.storage is Storage.CONSTANT else variable.storage
            if storage is not Storage.LOCAL or variable.type is None:
                continue
            size += variable.type.size
            if size > STACK_SIZE:
                need = f"the local variables of '{pou.name}' need {size} bytes"
                raise b.error(f"{need}; the stack holds {STACK_SIZE}", decl)
            local = b.local(variable.name, variable.type)
            b.places[id(variable)] = ir.Place(local)
            b.line(decl)
            if decl.initial_ref and decl.init is not None:
                b.emit(ir.Store(ir.Place(local), assign.reference_value(b, decl.init)))
            else:
                _initialise(b, ir.Place(local), variable.type, decl.init, decl)


def _initialise(
    b: Body, place: ir.Place, type_: t.Type, init: ast.Expr | None, decl: ast.VarDecl | None = None
) -> None:
    scalar = scalar_of(type_)
    if scalar is not None:
        if init is not None:
            b.emit(ir.Store(place, b.value_as(init, type_)))
        else:
            b.emit(ir.Store(place, ir.Const(scalar, arguments.default_number(type_))))
        return
    if isinstance(type_, t.String) and (init is None or init.is_constant):
        text = init.constant if init is not None else b""
        if not text:
            b.emit(ir.Store(place, ir.Const(ir.U16 if type_.wide else ir.U8, 0)))
            return
    template = templates.Template(bytearray(type_.size))
    initialiser = templates.initialiser_of(b.program)
    if decl is not None:
        initialiser.variable(template, 0, type_, decl)
    else:
        initialiser.fill(template, 0, type_, init)
    initial.write_template(b, place, template, type_.align)


OPERATORS = (builtins, conversions, properties, variable_info)
"""Modules that register the lowering of operators when they are imported."""
