"""Calls of functions, methods, actions, programs and function block instances."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core import assign, ir, places
from tappet.core.arguments import argument_value, by_address, has_effects, in_out_address
from tappet.core.body import (
    BUILTIN_PLACES,
    BUILTIN_STATEMENTS,
    BUILTIN_VALUES,
    INITIALISERS,
    PLACES,
    VALUES,
    Body,
)
from tappet.core.program import attribute_value
from tappet.core.scalars import require_scalar, scalar_of
from tappet.core.virtual_calls import BODY, Static, call_virtual, is_fixed
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import yields_reference
from tappet.lang.symbols import BuiltinSymbol, PouSymbol, VarSymbol


@dataclass(slots=True)
class Prepared:
    """A call ready to be placed: what happens before it, the call, what happens after."""

    before: list[ir.Stmt] = field(default_factory=list)
    call: ir.Expr | None = None
    after: list[ir.Stmt] = field(default_factory=list)
    result: ir.Place | None = None
    """Where an aggregate result is put."""

    def statements(self) -> list[ir.Stmt]:
        """The call for its effects."""
        middle: list[ir.Stmt] = [] if self.call is None else [ir.Evaluate(self.call)]
        return [*self.before, *middle, *self.after]


def has_self(pou: PouSymbol) -> bool:
    """Whether the body works on an instance given as hidden first parameter."""
    if pou.kind == "FUNCTION_BLOCK":
        return True
    if pou.kind in ("METHOD", "ACTION", "TRANSITION"):
        return pou.owner is None or pou.owner.kind != "PROGRAM"
    return False


# -- entry points -----------------------------------------------------------------------------------


def call_value(b: Body, e: ast.Call) -> ir.Expr:
    """Value of a call with a simple result."""
    if e.expansion is not None:
        return b.value(e.expansion)
    target = e.target
    if isinstance(target, BuiltinSymbol):
        return BUILTIN_VALUES[target.name](b, e, target)
    assert isinstance(target, PouSymbol)
    if isinstance(target.return_type, t.Reference):
        assert e.type is not None
        return ir.Load(require_scalar(e.type), call_place(b, e))
    if target.return_type is None:
        zero = require_scalar(e.type)
        return ir.Sequence(zero, prepare(b, e).statements(), ir.Const(zero, 0))
    return as_value(b, prepare(b, e))


def as_value(b: Body, prepared: Prepared) -> ir.Expr:
    """The prepared call as one expression."""
    call = prepared.call
    assert call is not None
    if not prepared.before and not prepared.after:
        return call
    if not prepared.after:
        return ir.Sequence(call.type, prepared.before, call)
    local = b.temp(call.type)
    body = [*prepared.before, ir.Store(ir.Place(local), call), *prepared.after]
    return ir.Sequence(call.type, body, ir.Load(call.type, ir.Place(local)))


def call_place(b: Body, e: ast.Call) -> ir.Place:
    """Memory with the result of a call: a reference's target, or a temporary with the aggregate."""
    if e.expansion is not None:
        return b.place(e.expansion)
    target = e.target
    if isinstance(target, BuiltinSymbol):
        return BUILTIN_PLACES[target.name](b, e, target)
    assert isinstance(target, PouSymbol)
    prepared = prepare(b, e)
    if isinstance(target.return_type, t.Reference):
        return ir.Place(ir.Indirect(as_value(b, prepared)))
    return as_place(b, prepared)


def as_place(b: Body, prepared: Prepared) -> ir.Place:
    """Memory with the result of a prepared call."""
    if prepared.result is None:
        value = as_value(b, prepared)
        local = b.temp(value.type)
        place = ir.Place(local)
        fill: list[ir.Stmt] = [ir.Store(place, value)]
    else:
        place, fill = prepared.result, prepared.statements()
    return ir.Place(ir.Indirect(ir.Sequence(ir.PTR, fill, ir.Address(ir.PTR, place))))


def call_statement(b: Body, e: ast.Call) -> None:
    """A call for its effects."""
    if e.expansion is not None:
        if scalar_of(e.expansion.type) is not None:
            b.emit(ir.Evaluate(b.value(e.expansion)))
        elif not e.expansion.is_constant:
            b.emit(ir.Evaluate(places.address_of(b.place(e.expansion))))
        return
    target = e.target
    if isinstance(target, BuiltinSymbol):
        statement = BUILTIN_STATEMENTS.get(target.name)
        if statement is not None:
            statement(b, e, target)
        elif scalar_of(target.return_type) is None:
            b.emit(ir.Evaluate(places.address_of(b.place(e))))
        else:
            b.emit(ir.Evaluate(b.value(e)))
        return
    if e.gate is None:
        b.out.extend(prepare(b, e).statements())
        return
    test = b.value(e.gate)
    with b.block_of() as then:
        b.out.extend(prepare(b, e).statements())
    b.emit(ir.If(test, then, []))


# -- preparation ------------------------------------------------------------------------------------


def prepare(b: Body, e: ast.Call) -> Prepared:
    """Arguments, hidden parameters and the call."""
    target = e.target
    assert isinstance(target, PouSymbol)
    b.foreign_writes = True
    if target.kind == "FUNCTION_BLOCK":
        return _block_call(b, e, target)
    if target.kind == "PROGRAM":
        return _instance_call(b, e, target, places.program_data(target), [])
    prepared = Prepared()
    own, static = instance_of(b, e.callee, target)
    if target.kind == "ACTION" and e.args:
        own = _arguments_of_action(b, prepared, e.args, target, own)
    finish(b, prepared, target, [] if target.kind == "ACTION" else e.args, own, static)
    return prepared


def _arguments_of_action(
    b: Body, prepared: Prepared, args: list[ast.Argument], target: PouSymbol, own: ir.Expr | None
) -> ir.Expr | None:
    """`inst.Act(in := a, q => x)`: inputs and outputs are those of the owner of the action (LST-23)."""
    if own is None:
        assert target.owner is not None
        _pass(b, prepared, args, places.program_data(target.owner))
        return None
    local = b.temp(ir.PTR)
    prepared.before.append(ir.Store(ir.Place(local), own))
    address = ir.Load(ir.PTR, ir.Place(local))
    _pass(b, prepared, args, ir.Place(ir.Indirect(address)))
    return address


def instance_of(b: Body, callee: ast.Expr, target: PouSymbol) -> tuple[ir.Expr | None, Static | None]:
    """Address of the instance a method is called on, and its type where that may be a derived one."""
    if not has_self(target):
        return None, None
    if not isinstance(callee, ast.Member):
        assert b.own_data is not None
        return places.address_of(b.own_data), b.block
    base = callee.base
    if isinstance(base.type, t.Interface):
        return b.value(base), base.type
    if isinstance(base, ast.Deref) and isinstance(base.base, ast.Super):
        assert b.own_data is not None
        return places.address_of(b.own_data), None
    if base.type is None:
        # FB_Base.Method inside a derived block: static
        assert b.own_data is not None
        return places.address_of(b.own_data), None
    address = places.address_of(b.place(base))
    exact = not isinstance(base, ast.Deref) and not _through_reference(base)
    return address, None if exact else _block_of(base)


def _block_of(e: ast.Expr) -> t.FunctionBlock | None:
    """The function block type that an expression has or refers to."""
    type_ = e.type
    while isinstance(type_, t.Reference):
        type_ = type_.base
    return type_ if isinstance(type_, t.FunctionBlock) else None


def _through_reference(e: ast.Expr) -> bool:
    """Whether the static type of an instance may be a base of the real one."""
    symbol = getattr(e, "symbol", None)
    if isinstance(symbol, VarSymbol):
        return symbol.section == "VAR_IN_OUT" or isinstance(symbol.type, t.Reference)
    return (
        isinstance(e, ast.Call)
        or yields_reference(e)
        or (isinstance(e, ast.Index) and isinstance(e.base.type, t.Pointer))
    )


def finish(
    b: Body,
    prepared: Prepared,
    target: PouSymbol,
    args: list[ast.Argument],
    own: ir.Expr | None,
    static: Static | None,
) -> None:
    """Complete a call of a function or method: result space, arguments, outputs.

    `static` is the type of the instance `own` where its real type may be a derived one.
    """
    values: list[ir.Expr] = [] if own is None else [own]
    if own is not None and static is not None and not isinstance(own, ir.Argument):
        local = b.temp(ir.PTR)
        prepared.before.append(ir.Store(ir.Place(local), own))
        values = [ir.Load(ir.PTR, ir.Place(local))]
    result = target.return_type
    scalar = ir.VOID
    if result is not None:
        if by_address(result):
            space = b.space(result.size, result.align)
            prepared.result = ir.Place(space)
            values.append(ir.Address(ir.PTR, prepared.result))
        else:
            scalar = require_scalar(result)
    given = {id(a.parameter): a for a in args if a.parameter is not None}
    ordered = [given.get(id(parameter)) for parameter in target.parameters]
    last = max((n for n, a in enumerate(ordered) if a is not None and has_effects(a.value)), default=-1)
    for number, (parameter, argument) in enumerate(zip(target.parameters, ordered, strict=True)):
        values.append(argument_value(b, prepared.after, parameter, argument, number < last))
    prepared.call = _call(b, target, scalar, values, static)


def _call(
    b: Body, target: PouSymbol, scalar: ir.Scalar, values: list[ir.Expr], static: Static | None
) -> ir.Expr:
    external = external_name(target)
    if external is not None:
        declare_external(b, target, external)
        return ir.Call(scalar, external, values)
    if static is not None and not is_fixed(target):
        return call_virtual(b, target.name.upper(), static, scalar, values, target)
    return ir.Call(scalar, b.program.function(target), values)


def external_name(pou: PouSymbol) -> str | None:
    """C symbol of a FUNCTION with attribute tappet_external."""
    return attribute_value(pou.pou.attributes, "tappet_external") if pou.pou is not None else None


def declare_external(b: Body, pou: PouSymbol, name: str) -> None:
    """Import a C function with the VAR_INPUTs of `pou` as parameters."""
    if name in b.program.module.externals:
        return
    parameters = [scalar_of(p.type) or ir.PTR for p in pou.parameters]
    result = require_scalar(pou.return_type) if pou.return_type is not None else ir.VOID
    b.program.module.externals[name] = ir.External(name, parameters, result)


# -- instances --------------------------------------------------------------------------------------


def _block_call(b: Body, e: ast.Call, target: PouSymbol) -> Prepared:
    """`inst(in := a, q => x)`: inputs are stored in the instance, the body runs, outputs are read."""
    before: list[ir.Stmt] = []
    callee = e.callee
    if isinstance(callee, ast.Deref) and isinstance(callee.base, ast.Super):
        assert b.own_data is not None
        return _instance_call(b, e, target, b.own_data, before)
    place = places.freeze(b, b.place(callee), before)
    virtual = isinstance(callee, ast.Deref) or _through_reference(callee)
    return _instance_call(b, e, target, place, before, _block_of(callee) if virtual else None)


def _instance_call(
    b: Body,
    e: ast.Call,
    target: PouSymbol,
    instance: ir.Place,
    before: list[ir.Stmt],
    static: t.FunctionBlock | None = None,
) -> Prepared:
    prepared = Prepared(before)
    given = {id(a.parameter) for a in e.args if a.value is not None}
    for variable in target.parameters:
        if id(variable) not in given and initialised_on_call(variable):
            slot = places.at(instance, variable.offset, _root(instance, variable.offset))
            assert variable.type is not None
            with b.block_of() as reset:
                decl = variable.decl
                INITIALISERS[0](b, slot, variable.type, decl.init if decl is not None else None)
            before += reset
    _pass(b, prepared, e.args, instance)
    own = [places.address_of(instance)] if target.kind == "FUNCTION_BLOCK" else []
    if static is not None:
        prepared.call = call_virtual(b, BODY, static, ir.VOID, own, target)
    else:
        prepared.call = ir.Call(ir.VOID, b.program.function(target), own)
    return prepared


def _pass(b: Body, prepared: Prepared, args: list[ast.Argument], instance: ir.Place) -> None:
    """Store arguments in the inputs of an instance before the call, fetch its outputs after it."""
    before = prepared.before
    for arg in args:
        parameter, value = arg.parameter, arg.value
        if not isinstance(parameter, VarSymbol) or value is None:
            continue
        slot = places.at(instance, parameter.offset, _root(instance, parameter.offset))
        if parameter.section == "VAR_OUTPUT" or arg.output:
            with b.block_of() as after:
                assert parameter.type is not None
                assign.assign_from_place(b, value, slot, parameter.type, parameter.bit)
            prepared.after += after
        elif parameter.section == "VAR_IN_OUT":
            address = in_out_address(b, before, parameter, value)
            before.append(ir.Store(slot, address))
        else:
            with b.block_of() as store:
                assign.store_member(b, slot, parameter, value)
            before += store


def initialised_on_call(parameter: VarSymbol) -> bool:
    """Whether an input goes back to its initial value in calls that do not assign it."""
    decl = parameter.decl
    return decl is not None and attribute_value(decl.attributes, "initialize_on_call") is not None


def _root(instance: ir.Place, offset: int) -> int | None:
    """Members of the data of a program are variables of their own; parts of an instance belong to it."""
    return offset if instance.root < 0 and not instance.subscripts and not instance.offset else None


VALUES[ast.Call] = call_value
PLACES[ast.Call] = call_place
