"""Code of initial values: bytes that are copied, dynamic steps, FB_Init, and FB_Exit at the end."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tappet.core import assign, calls, ir, places
from tappet.core.body import INITIALISERS, Body
from tappet.core.life_cycle import (
    after_init_methods,
    holding,
    init_methods,
    life_cycle_methods,
)
from tappet.core.program import Program
from tappet.core.templates import Step, Template, initialiser_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.parts import stored
from tappet.lang.symbols import PouSymbol, VarSymbol

_UNROLL = 4
"""Arrays of more elements are initialised by a loop."""


def initialise_place(b: Body, place: ir.Place, type_: t.Type, init: ast.Expr | None) -> None:
    """Code that gives memory its initial value; a call `FB(...)` is what FB_Init gets."""
    template = Template(bytearray(type_.size))
    if isinstance(init, ast.Call) and isinstance(type_, t.FunctionBlock):
        initialiser_of(b.program).fill(template, 0, type_, None, [init.args])
    else:
        initialiser_of(b.program).fill(template, 0, type_, init)
    write_template(b, place, template, type_.align)


def write_template(b: Body, place: ir.Place, template: Template, align: int) -> None:
    """Store the bytes of a template, then run its steps."""
    place = places.freeze(b, place, b.out)
    size = len(template.data)
    if not any(template.data):
        b.emit(ir.Fill(place, size, 0, align))
    else:
        const = b.program.string_constant(bytes(template.data), max(align, 1))
        b.emit(ir.Copy(place, ir.Place(ir.Data(const.symbol)), size, align))
    run_steps(b, place, template.steps)


def run_steps(b: Body, base: ir.Place, steps: list[Step]) -> None:
    """Code of dynamic steps on the object at `base`."""
    for step in steps:
        if step.inner:
            _run_elements(b, base, step)
            continue
        place = _step_place(base, step.offset)
        if step.after:
            assert isinstance(step.type, t.FunctionBlock)
            _call_all(b, place, after_init_methods(step.type))
        elif step.value is None:
            assert isinstance(step.type, t.FunctionBlock)
            construct(b, place, step.type, step.args)
        elif step.reference or isinstance(step.type, t.Reference):
            b.emit(ir.Store(place, assign.reference_value(b, step.value)))
        else:
            assign.copy_value(b, place, step.type, step.value)


def _step_place(base: ir.Place, offset: int) -> ir.Place:
    whole = base.root < 0 and not base.subscripts and not base.offset and not isinstance(base.base, ir.Local)
    return places.at(base, offset, offset if whole else None)


def _run_elements(b: Body, base: ir.Place, step: Step) -> None:
    if step.count <= _UNROLL:
        for number in range(step.count):
            run_steps(b, _step_place(base, step.offset + number * step.stride), step.inner)
        return
    with each_element(b, _step_place(base, step.offset), step.count, step.stride) as element:
        run_steps(b, element, step.inner)


@contextmanager
def each_element(b: Body, start: ir.Place, count: int, stride: int) -> Iterator[ir.Place]:
    """What is emitted inside is done for each of `count` elements, which are `stride` bytes apart."""
    counter = b.temp(ir.I64, once=False)
    sub = ir.Subscript(ir.Load(ir.I64, ir.Place(counter)), 0, count - 1, stride, checked=False)
    with b.block_of() as body:
        yield b.subscripted(ir.Place(start.base, start.offset, (*start.subscripts, sub), start.root))
    last = ir.Const(ir.I64, count - 1)
    b.emit(ir.For(ir.Place(counter), ir.I64, ir.Const(ir.I64, 0), last, 1, body, fixed=True))


def construct(b: Body, place: ir.Place, type_: t.FunctionBlock, args: list[ast.Argument]) -> None:
    """Run the initialisers of an instance whose constant part is in place, then its FB_Init methods."""
    frozen = places.freeze(b, place, b.out)
    address = places.address_of(frozen)
    if initialiser_of(b.program).of_type(type_).steps:
        b.emit(ir.Evaluate(ir.Call(ir.VOID, initial_function(b.program, type_), [address])))
    b.foreign_writes = True
    for method in init_methods(type_):
        prepared = calls.Prepared()
        calls.finish(b, prepared, method, _init_call_arguments(method, args), address, None)
        b.out.extend(prepared.statements())


def _init_call_arguments(
    method: PouSymbol, args: list[ast.Argument], in_copy: bool = False
) -> list[ast.Argument]:
    """bInitRetains := TRUE, bInCopyCode := FALSE, the contrary when an instance is moved, and the user's
    arguments by name (LDEC-106, LDEC-110)."""
    by_name = {}
    for arg in args:
        name = getattr(arg.parameter, "name", None) or arg.name
        if name:
            by_name[name.upper()] = arg
    result = []
    for parameter in method.parameters:
        name = parameter.name.upper()
        if name == "BINITRETAINS" or name == "BINCOPYCODE":
            result.append(_flag(parameter, (name == "BINCOPYCODE") is in_copy))
        elif name in by_name:
            given = by_name[name]
            result.append(ast.Argument(name=parameter.name, value=given.value, parameter=parameter))
    return result


def _flag(parameter: VarSymbol, value: bool) -> ast.Argument:
    constant = ast.Literal(text="", kind="bool", type=t.BOOL, is_constant=True)
    constant.constant = value
    return ast.Argument(name=parameter.name, value=constant, parameter=parameter)


def construct_moved(b: Body, place: ir.Place, type_: t.FunctionBlock, args: list[ast.Argument]) -> None:
    """Call the FB_Init methods of an instance that an online change moves: bInCopyCode is TRUE."""
    b.foreign_writes = True
    frozen = places.freeze(b, place, b.out)
    for method in init_methods(type_):
        prepared = calls.Prepared()
        given = _init_call_arguments(method, args, in_copy=True)
        calls.finish(b, prepared, method, given, places.address_of(frozen), None)
        b.out.extend(prepared.statements())


def destruct(b: Body, place: ir.Place, type_: t.FunctionBlock, in_copy: bool = False) -> None:
    """Call FB_Exit of an instance, most derived first (LDEC-107); `in_copy`: an online change moves it."""
    _call_all(b, place, life_cycle_methods(type_, "FB_EXIT")[::-1], in_copy)


def _call_all(b: Body, place: ir.Place, methods: list[PouSymbol], in_copy: bool = False) -> None:
    frozen = places.freeze(b, place, b.out)
    for method in methods:
        prepared = calls.Prepared()
        given = [_flag(p, True) for p in method.parameters if p.name.upper() == "BINCOPYCODE" and in_copy]
        calls.finish(b, prepared, method, given, places.address_of(frozen), None)
        b.out.extend(prepared.statements())


def destruct_all(b: Body, place: ir.Place, type_: t.Type, in_copy: bool = False) -> None:
    """Call FB_Exit of all instances inside an object of any type."""
    if not holding(b.program, "FB_EXIT").holds(type_):
        return
    if isinstance(type_, t.FunctionBlock):
        destruct(b, place, type_, in_copy)
    for inner, part, decl in each_part(b, place, type_):
        if not without_exit(decl):
            destruct_all(b, inner, part, in_copy)


def each_part(
    b: Body, place: ir.Place, type_: t.Type
) -> Iterator[tuple[ir.Place, t.Type, ast.VarDecl | None]]:
    """The members or elements of an object; what is emitted for the one element is done for all."""
    for member in stored(type_):
        yield places.at(place, member.offset), member.type, member.decl
    if isinstance(type_, t.Array):
        with each_element(b, place, type_.count, type_.element.size) as element:
            yield element, type_.element, None


def without_exit(decl: ast.VarDecl | None) -> bool:
    """Whether FB_Exit is not called for an instance: {attribute 'symbol' := 'no-exit'} (LPRG-36)."""
    pragmas = decl.attributes if decl is not None else []
    return any(
        p.attribute == "no-exit" or (p.attribute == "symbol" and (p.value or "").lower() == "no-exit")
        for p in pragmas
    )


def initial_function(program: Program, type_: t.FunctionBlock) -> str:
    """Name of the function that runs the dynamic steps of a block's members."""
    name = program.initial_functions.get(id(type_))
    if name is None:
        name = unique = program.unique(f"{program.block_name(type_)}.__INIT")
        program.initial_functions[id(type_)] = name
        program.make_for(type_, name, lambda: _lower_initial_function(program, unique, type_))
    return name


def _lower_initial_function(program: Program, name: str, type_: t.FunctionBlock) -> None:
    """Lower the function that runs the dynamic steps of a block's members."""
    pou = type_.pou.symbol if type_.pou is not None else None
    source = pou.source if isinstance(pou, PouSymbol) else None
    function = ir.Function(
        name,
        [ir.Parameter("self", ir.PTR)],
        uri=source.uri if source else "",
        self_type=program.block_name(type_),
        cold=True,
    )
    b = Body(program, function, source)
    b.block = type_
    b.own_data = ir.Place(ir.Self(function.self_type))
    b.pou = pou if isinstance(pou, PouSymbol) else None
    run_steps(b, b.own_data, initialiser_of(program).of_type(type_).steps)
    function.body = [*b.entry, *b.out]
    program.module.functions[name] = function


INITIALISERS.append(initialise_place)
