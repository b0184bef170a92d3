"""Arguments of calls: values, addresses of VAR_IN_OUT, and descriptors of ANY and ARRAY[*]."""

from __future__ import annotations

from tappet.core import assign, ir, places
from tappet.core.body import INITIALISERS, Body
from tappet.core.scalars import NULL, require_scalar, scalar_of
from tappet.lang import any_type, ast, walk
from tappet.lang import types as t
from tappet.lang.any_type import is_any
from tappet.lang.symbols import PouSymbol, PropertySymbol, VarSymbol


def by_address(type_: t.Type | None) -> bool:
    """Whether values of the type are passed by address."""
    return scalar_of(type_) is None


def has_effects(value: ast.Expr | None) -> bool:
    """Whether evaluating an argument may write to variables of the caller.

    Functions of libraries change only what they are handed as VAR_IN_OUT.
    """
    for e in walk.expressions(value):
        symbol = getattr(e, "symbol", None)
        if isinstance(e, ast.AssignExpr) or isinstance(symbol, PropertySymbol):
            return True
        if isinstance(e, ast.Call) and isinstance(e.target, PouSymbol):
            pou = e.target
            if pou.kind != "FUNCTION" or pou.source is None or pou.source.library is None:
                return True
            if any(p.section == "VAR_IN_OUT" for p in pou.parameters):
                return True
    return False


def argument_value(
    b: Body, after: list[ir.Stmt], parameter: VarSymbol, given: ast.Argument | None, disturbed: bool
) -> ir.Expr:
    """The value handed over; arguments are evaluated from left to right, outputs fetched in `after`.

    `disturbed`: a later one may change the variables that this one is read from.
    """
    value = given.value if given is not None else None
    if parameter.section == "VAR_IN_OUT":
        fill: list[ir.Stmt] = []
        address = NULL if value is None else in_out_address(b, fill, parameter, value)
        return ir.Sequence(ir.PTR, fill, address) if fill else address
    type_ = parameter.type
    assert type_ is not None
    if parameter.section == "VAR_OUTPUT":
        place = ir.Place(b.local(f"{parameter.name}.out", type_))
        if value is not None:
            with b.block_of() as fetch:
                assign.assign_from_place(b, value, place, type_)
            after += fetch
        return ir.Address(ir.PTR, place)
    if value is None:
        decl = parameter.decl
        value = decl.init if decl is not None else None
    if isinstance(type_, t.Reference):
        return NULL if value is None else assign.reference_value(b, value)
    if not by_address(type_):
        if value is None:
            return ir.Const(require_scalar(type_), default_number(type_))
        return assign.range_checked(b, b.value_as(value, type_), type_)
    if value is not None and is_any(type_) and not is_any(value.type):
        return _any_argument(b, value)
    return _aggregate_argument(b, type_, value, disturbed)


def default_number(type_: t.Type) -> int:
    """What a simple variable without initial value starts with."""
    return type_.default if isinstance(type_, t.Enum) else 0


def _aggregate_argument(b: Body, type_: t.Type, value: ast.Expr | None, disturbed: bool) -> ir.Expr:
    """An input of string or aggregate type: the variable itself where it fits, else a copy."""
    if value is not None and value.type is not None and places.is_place(value):
        fits = value.type == type_
        if isinstance(type_, t.String) and isinstance(value.type, t.String):
            fits = value.type.length == type_.length
        if (fits and not disturbed) or isinstance(type_, t.FunctionBlock):
            return places.address_of(b.place(value))
    local = b.space(type_.size, type_.align)
    with b.block_of() as before:
        if value is None:
            INITIALISERS[0](b, ir.Place(local), type_, None)
        else:
            assign.copy_value(b, ir.Place(local), type_, value)
    return ir.Sequence(ir.PTR, before, ir.Address(ir.PTR, ir.Place(local)))


def _any_argument(b: Body, value: ast.Expr) -> ir.Expr:
    """The structure that describes a value of any type: class, address, size."""
    type_ = value.type
    assert type_ is not None
    fill: list[ir.Stmt] = []
    if places.is_place(value) and not _is_bit(value):
        place = b.place(value)
        b.program.expose(b.function, place, type_)
        b.touch(place)
    else:
        place = ir.Place(b.space(type_.size, type_.align))
        with b.block_of() as fill:
            assign.copy_value(b, place, type_, value)
    record = b.space(any_type.ANY_TYPES["ANY"].size, 8)
    kind = ir.Const(ir.I32, any_type.class_of(type_))
    fill += [
        ir.Store(ir.Place(record, any_type.CLASS_OFFSET), kind),
        ir.Store(ir.Place(record, any_type.VALUE_OFFSET), places.address_of(place)),
        ir.Store(ir.Place(record, any_type.SIZE_OFFSET), ir.Const(ir.I32, type_.size)),
    ]
    return ir.Sequence(ir.PTR, fill, ir.Address(ir.PTR, ir.Place(record)))


def _is_bit(e: ast.Expr) -> bool:
    return isinstance(e, ast.Member) and isinstance(e.symbol, VarSymbol) and e.symbol.bit is not None


def in_out_address(b: Body, before: list[ir.Stmt], parameter: VarSymbol, value: ast.Expr) -> ir.Expr:
    """Address of the variable handed to a VAR_IN_OUT; a descriptor for ARRAY[*]."""
    if not places.is_place(value) or _is_shorter(value, parameter.type):
        # constants, computed strings and shorter ones for VAR_IN_OUT CONSTANT
        if isinstance(value.constant, str | bytes) and not _is_shorter(value, parameter.type):
            assert isinstance(value.type, t.String)
            return places.address_of(assign.constant_string(b, value.constant, value.type.wide))
        type_ = parameter.type
        assert type_ is not None
        local = b.local(f"{parameter.name}.in", type_)
        with b.block_of() as fill:
            assign.copy_value(b, ir.Place(local), type_, value)
        before += fill
        return ir.Address(ir.PTR, ir.Place(local))
    place = b.place(value)
    b.program.expose(b.function, place, value.type)
    b.touch(place)
    address = places.address_of(place)
    wanted = parameter.type
    if isinstance(wanted, t.Array) and wanted.open_dims and isinstance(value.type, t.Array):
        if value.type.open_dims:
            return address
        return _descriptor(b, before, address, value.type)
    return address


def _is_shorter(value: ast.Expr, wanted: t.Type | None) -> bool:
    """Whether a string has less memory than the parameter: who reads as much would read beyond its end."""
    own = value.type
    return isinstance(own, t.String) and isinstance(wanted, t.String) and own.length < wanted.length


def _descriptor(b: Body, before: list[ir.Stmt], address: ir.Expr, type_: t.Array) -> ir.Expr:
    local = b.space(8 + 16 * len(type_.bounds), 8)
    before.append(ir.Store(ir.Place(local), address))
    for number, (low, high) in enumerate(type_.bounds):
        before.append(ir.Store(ir.Place(local, 8 + 16 * number), ir.Const(ir.I64, low)))
        before.append(ir.Store(ir.Place(local, 16 + 16 * number), ir.Const(ir.I64, high)))
    return ir.Address(ir.PTR, ir.Place(local))
