"""Assignments: scalars, bits, strings, aggregates, references, properties, subranges."""

from __future__ import annotations

from tappet.core import ir, places
from tappet.core.body import INITIALISERS, PLACES, TARGETS, VALUES, Body
from tappet.core.scalars import NULL, convert, require_scalar, scalar_of
from tappet.core.values import bit_value
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import yields_reference
from tappet.lang.symbols import PropertySymbol, VarSymbol


def assign(b: Body, op: str, target: ast.Expr, value: ast.Expr) -> None:
    """`target op value` as statements."""
    if op == "REF=":
        bind_reference(b, target, value)
        return
    if op in ("S=", "R="):
        with b.block_of() as then:
            assign(b, ":=", target, _flag(op == "S=", target))
        b.emit(ir.If(b.value(value), then, []))
        return
    symbol = getattr(target, "symbol", None)
    special = TARGETS.get(symbol.__class__)
    if special is not None and not (isinstance(target, ast.Member) and target.bit is not None):
        special(b, target, symbol, value)
        return
    assign_memory(b, target, value)


def _flag(value: bool, at: ast.Expr) -> ast.Expr:
    """TRUE or FALSE as if it stood in the text."""
    found = ast.Literal(text=str(value).upper(), kind="bool", value=value, span=at.span)
    found.type, found.constant, found.is_constant = t.BOOL, value, True
    return found


def assign_memory(b: Body, target: ast.Expr, value: ast.Expr) -> None:
    """`target := value` for a target that is memory."""
    type_ = target.type
    assert type_ is not None
    if scalar_of(type_) is None:
        listed = isinstance(value, ast.ArrayInit | ast.StructInit)
        # the value first: a call in it may change the indices of the target
        source = None if listed else places.freeze(b, value_place(b, value, type_), b.out)
        place = places.freeze(b, b.target(target), b.out)
        b.touch(place)
        if source is None:
            copy_value(b, place, type_, value)
        else:
            copy_place(b, place, type_, source, value.type)
        return
    store_scalar(b, target, b.value_as(value, declared_type(target)))


def declared_type(target: ast.Expr) -> t.Type | None:
    """Type of a target, below a reference."""
    type_ = target.type
    return type_.base if isinstance(type_, t.Reference) else type_


def store_scalar(b: Body, target: ast.Expr, value: ir.Expr) -> None:
    """Store a value already in the type of the target; bits and subranges are seen to."""
    if isinstance(target, ast.Member) and target.bit is not None:
        store_bit(b, target.base, target.bit, value)
        return
    symbol = getattr(target, "symbol", None)
    bit = symbol.bit if isinstance(symbol, VarSymbol) else None
    if bit is not None:
        value = _evaluated(b, value)
    place = b.target(target)
    b.touch(place)
    if bit is not None:
        frozen = places.freeze(b, place, b.out)
        b.emit(ir.Store(frozen, merge_bit(ir.Load(ir.U8, frozen), bit, value)))
        return
    b.emit(ir.Store(place, range_checked(b, value, declared_type(target))))


def store_bit(b: Body, base: ast.Expr, bit: int, value: ir.Expr) -> None:
    """`base.bit := value`."""
    scalar = require_scalar(base.type)
    symbol = getattr(base, "symbol", None)
    if isinstance(symbol, PropertySymbol) and not yields_reference(base):
        raise b.error("a bit of a property cannot be assigned", base)
    value = _evaluated(b, value)
    frozen = places.freeze(b, b.target(base), b.out)
    b.touch(frozen)
    b.emit(ir.Store(frozen, merge_bit(ir.Load(scalar, frozen), bit, value)))


def _evaluated(b: Body, value: ir.Expr) -> ir.Expr:
    """A value that is known before the bits around its target are read: computing it may change them."""
    if isinstance(value, ir.Const):
        return value
    local = ir.Place(b.temp(value.type))
    b.emit(ir.Store(local, value))
    return ir.Load(value.type, local)


def merge_bit(old: ir.Expr, bit: int, value: ir.Expr) -> ir.Expr:
    """`old` with one bit replaced."""
    scalar = old.type
    mask = 1 << bit
    if isinstance(value, ir.Const):
        if value.value:
            return ir.Binary(scalar, "or", old, ir.Const(scalar, mask))
        return ir.Binary(scalar, "and", old, ir.Const(scalar, ~mask))
    cleared = ir.Binary(scalar, "and", old, ir.Const(scalar, ~mask))
    shifted = convert(value, scalar)
    if bit:
        shifted = ir.Binary(scalar, "shl", shifted, ir.Const(ir.U32, bit))
    return ir.Binary(scalar, "or", cleared, shifted)


def range_checked(b: Body, value: ir.Expr, type_: t.Type | None) -> ir.Expr:
    """Route what is stored in a subrange through CheckRange functions, if there are any (LTYP-122).

    A constant may lie outside where it is the start of a loop: elsewhere it has been refused.
    """
    if not isinstance(type_, t.Subrange):
        return value
    if isinstance(value, ir.Const) and type_.low <= value.value <= type_.high:
        return value
    scalar = value.type
    name = "CheckLRange" if scalar.bits == 64 else "CheckRange"
    check = b.check_function(name + ("Signed" if scalar.signed else "Unsigned"))
    if check is None:
        return value
    wide = (ir.SIGNED if scalar.signed else ir.UNSIGNED)[max(scalar.bits, 32)]
    args = [value, ir.Const(wide, type_.low), ir.Const(wide, type_.high)]
    return convert(places.check_call(b, check, args), scalar)


def bind_reference(b: Body, target: ast.Expr, value: ast.Expr) -> None:
    """`ref REF= variable`, or 0."""
    slot = reference_slot(b, target)
    b.touch(slot)
    b.emit(ir.Store(slot, reference_value(b, value)))


def reference_value(b: Body, value: ast.Expr) -> ir.Expr:
    """Address that a REFERENCE is bound to; 0 for the constant 0."""
    if value.is_constant and not places.is_place(value):
        return NULL
    place = b.place(value)
    b.program.expose(b.function, place, value.type)
    return places.address_of(place)


def reference_slot(b: Body, target: ast.Expr) -> ir.Place:
    """Where a reference keeps its address."""
    symbol = getattr(target, "symbol", None)
    assert isinstance(symbol, VarSymbol)
    if isinstance(target, ast.Member) and target.base.type is not None:
        base = target.base
        own = isinstance(base, ast.Deref) and isinstance(base.base, ast.This | ast.Super)
        if not own:
            return places.at(b.place(base), symbol.offset)
    return places.slot_of(b, symbol)


# -- aggregates -------------------------------------------------------------------------------------


def copy_value(b: Body, target: ir.Place, type_: t.Type, value: ast.Expr) -> None:
    """Store a value of any type at `target`."""
    if scalar_of(type_) is not None:
        b.emit(ir.Store(target, b.value_as(value, type_)))
        return
    if isinstance(value, ast.ArrayInit | ast.StructInit):
        INITIALISERS[0](b, target, type_, value)
        return
    copy_place(b, target, type_, value_place(b, value, type_), value.type)


def value_place(b: Body, value: ast.Expr, wanted: t.Type) -> ir.Place:
    """Memory with the value of an expression that is no scalar."""
    return string_place(b, value, wanted) if isinstance(wanted, t.String) else b.place(value)


def string_place(b: Body, value: ast.Expr, wanted: t.String) -> ir.Place:
    """Memory with the text of a string expression."""
    if value.is_constant and isinstance(value.constant, str | bytes):
        return constant_string(b, value.constant, wanted.wide)
    return b.place(value)


def constant_string(b: Body, text: str | bytes, wide: bool) -> ir.Place:
    """A string literal with its terminator."""
    raw = text.encode("latin-1", "replace") if isinstance(text, str) and not wide else text
    if isinstance(raw, str):
        raw = raw.encode("utf-16-le", "surrogatepass")
    const = b.program.string_constant(raw + (b"\0\0" if wide else b"\0"), 2 if wide else 1)
    return ir.Place(ir.Data(const.symbol))


def copy_place(
    b: Body, target: ir.Place, type_: t.Type, source: ir.Place, source_type: t.Type | None
) -> None:
    """Copy memory to memory; strings are cut to the length of the target."""
    overlap = isinstance(target.base, ir.Indirect) or isinstance(source.base, ir.Indirect)
    if not isinstance(type_, t.String) or not isinstance(source_type, t.String):
        size = min(type_.size, source_type.size) if source_type is not None else type_.size
        b.emit(ir.Copy(target, source, size, overlap=overlap))
        return
    unit = 2 if type_.wide else 1
    if isinstance(source.base, ir.Data) and source.base.symbol in b.program.module.constants:
        data = b.program.module.constants[source.base.symbol].data
        if len(data) <= type_.size:
            b.emit(ir.Copy(target, source, len(data)))
            return
        b.emit(ir.Copy(target, source, type_.length * unit))
    elif source_type.length <= type_.length:
        b.emit(ir.Copy(target, source, source_type.size, overlap=overlap))
        return
    else:
        frozen = places.freeze(b, target, b.out)
        b.emit(ir.Copy(frozen, source, type_.length * unit, overlap=overlap))
        target = frozen
    terminator = ir.Const(ir.U16 if type_.wide else ir.U8, 0)
    b.emit(ir.Store(places.at(target, type_.length * unit), terminator))


def assign_from_place(
    b: Body, target: ast.Expr, source: ir.Place, type_: t.Type, bit: int | None = None
) -> None:
    """Assign an output that lies at `source` to the expression after `=>`."""
    scalar = scalar_of(type_)
    symbol = getattr(target, "symbol", None)
    if isinstance(symbol, PropertySymbol) and not yields_reference(target):
        raise b.error("an output cannot be assigned to a property; use a variable", target)
    if scalar is None:
        place = b.target(target)
        b.touch(place)
        assert target.type is not None
        copy_place(b, place, target.type, source, type_)
        return
    value: ir.Expr = ir.Load(scalar, source)
    if bit is not None:
        value = bit_value(ir.Load(ir.U8, source), bit)
    store_scalar(b, target, convert(value, require_scalar(target.type)))


def store_member(b: Body, slot: ir.Place, member: VarSymbol, value: ast.Expr) -> None:
    """Store an input of an instance."""
    type_ = member.type
    assert type_ is not None
    b.touch(slot)
    if isinstance(type_, t.Reference):
        b.emit(ir.Store(slot, reference_value(b, value)))
    elif scalar_of(type_) is None:
        copy_value(b, slot, type_, value)
    elif member.bit is not None:
        flag = _evaluated(b, b.value(value))
        b.emit(ir.Store(slot, merge_bit(ir.Load(ir.U8, slot), member.bit, flag)))
    else:
        b.emit(ir.Store(slot, range_checked(b, b.value_as(value, type_), type_)))


def assign_value(b: Body, e: ast.AssignExpr) -> ir.Expr:
    """Assignment inside an expression: its value is that of the target afterwards.

    The indices of the target are evaluated once; a property has the value that its Set was given.
    """
    scalar = require_scalar(e.type)
    target = e.target
    with b.block_of() as statements:
        if e.op == ":=" and _calls_setter(target):
            type_ = declared_type(target)
            local = ir.Place(b.temp(scalar, once=False))
            b.emit(ir.Store(local, b.value_as(e.value, type_)))
            assign(b, ":=", target, held(b, local, target))
            return ir.Sequence(scalar, statements, ir.Load(scalar, local))
        if e.op == ":=" and not _is_bit(target):
            local = ir.Place(b.temp(scalar))
            b.emit(ir.Store(local, b.value_as(e.value, declared_type(target))))
            place = places.freeze(b, b.target(target), b.out)
            b.touch(place)
            b.emit(ir.Store(place, range_checked(b, ir.Load(scalar, local), declared_type(target))))
            return ir.Sequence(scalar, statements, ir.Load(scalar, place))
        assign(b, e.op, target, e.value)
    return ir.Sequence(scalar, statements, convert(b.value(target), scalar))


def assign_place(b: Body, e: ast.AssignExpr) -> ir.Place:
    """Assignment of an aggregate inside an expression."""
    with b.block_of() as statements:
        if _calls_setter(e.target):
            type_ = declared_type(e.target)
            assert type_ is not None
            local = ir.Place(b.space(type_.size, type_.align))
            copy_value(b, local, type_, e.value)
            assign(b, e.op, e.target, held(b, local, e.target))
            address = places.address_of(local)
        else:
            assign(b, e.op, e.target, e.value)
            address = places.address_of(b.place(e.target))
    return ir.Place(ir.Indirect(ir.Sequence(ir.PTR, statements, address)))


def _is_bit(target: ast.Expr) -> bool:
    symbol = getattr(target, "symbol", None)
    if isinstance(target, ast.Member) and target.bit is not None:
        return True
    return isinstance(symbol, VarSymbol) and symbol.bit is not None


def _calls_setter(target: ast.Expr) -> bool:
    return (
        not _is_bit(target)
        and isinstance(getattr(target, "symbol", None), PropertySymbol)
        and not yields_reference(target)
    )


def held(b: Body, local: ir.Place, target: ast.Expr) -> ast.Expr:
    """What lies at `local`, of the type of a target."""
    slot = -1 - len(b.held)  # those of the text count from 1
    b.held[slot] = local
    found = ast.Held(slot=slot, span=target.span)
    found.type = found.carried = declared_type(target)
    return found


def _literal_place(b: Body, e: ast.Literal) -> ir.Place:
    text = e.constant if e.constant is not None else e.value
    if isinstance(text, str | bytes):
        return constant_string(b, text, isinstance(e.type, t.String) and e.type.wide)
    raise b.error("a number has no address", e)


VALUES[ast.AssignExpr] = assign_value
PLACES[ast.AssignExpr] = assign_place
PLACES[ast.Literal] = _literal_place
