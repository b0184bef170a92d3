"""Places: variables, members, elements and targets of pointers as memory locations."""

from __future__ import annotations

from tappet.core import ir
from tappet.core.body import PLACES, Body
from tappet.core.program import AREA_PREFIX, data_symbol
from tappet.core.scalars import convert, require_scalar
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import yields_reference
from tappet.lang.parts import composed
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol

FAULT_BOUNDS = 2
"""Fault code ARRAY_BOUNDS of codegen.faults, which core must not import."""


def at(place: ir.Place, offset: int, root: int | None = None) -> ir.Place:
    """The place `offset` bytes behind another."""
    return ir.Place(place.base, place.offset + offset, place.subscripts, place.root if root is None else root)


def is_place(e: ast.Expr) -> bool:
    """Whether `e` is memory rather than a computed value."""
    kind = e.__class__
    if kind is ast.Name:
        return isinstance(e.symbol, VarSymbol) or yields_reference(e)  # type: ignore[attr-defined]
    if kind is ast.Member:
        assert isinstance(e, ast.Member)
        return e.bit is None and (isinstance(e.symbol, VarSymbol) or yields_reference(e))
    if kind is ast.Index or kind is ast.Deref:
        return True
    return yields_reference(e)


# -- variables --------------------------------------------------------------------------------------


def slot_of(b: Body, variable: VarSymbol) -> ir.Place:
    """Where a variable itself is stored, for references and VAR_IN_OUT members the hidden address."""
    found = b.places.get(id(variable))
    if found is not None:
        return found
    storage = variable.home if variable.storage is Storage.CONSTANT else variable.storage
    if storage is Storage.INSTANCE:
        if b.own_data is not None:
            whole = not b.own_data.offset and not b.own_data.subscripts
            return at(b.own_data, variable.offset, variable.offset if whole else None)
    elif storage in (Storage.GLOBAL, Storage.PROGRAM):
        return ir.Place(ir.Data(b.program.home(variable)), variable.offset, root=variable.offset)
    elif storage is Storage.DIRECT:
        b.program.use_area(variable, b.function)
        return ir.Place(ir.Data(AREA_PREFIX + (variable.area or "M")), variable.offset)
    raise b.error(f"'{variable.name}' has no place here", ast.Node(span=variable.span or ast.Node().span))


def place_of_variable(b: Body, variable: VarSymbol) -> ir.Place:
    """Where the object lies that a variable denotes."""
    slot = slot_of(b, variable)
    if variable.section == "VAR_IN_OUT" and id(variable) not in b.places:
        pointer = b.in_out_pointer(variable, slot)
        return ir.Place(ir.Indirect(ir.Load(ir.PTR, ir.Place(pointer))))
    if isinstance(variable.type, t.Reference):
        return ir.Place(ir.Indirect(ir.Load(ir.PTR, slot)))
    return slot


def place_of_name(b: Body, e: ast.Name) -> ir.Place:
    """Place of a variable, or of the data of a program."""
    symbol = e.symbol
    if isinstance(symbol, VarSymbol):
        return place_of_variable(b, symbol)
    if isinstance(symbol, PouSymbol) and symbol.kind == "PROGRAM":
        return program_data(symbol)
    raise b.error(f"'{e.name}' is no variable", e)


def program_data(pou: PouSymbol) -> ir.Place:
    """The data of a program."""
    return ir.Place(ir.Data(data_symbol(pou)))


def place_of_member(b: Body, e: ast.Member) -> ir.Place:
    """Place of a member of a value, or of what a qualified name denotes."""
    symbol = e.symbol
    if not isinstance(symbol, VarSymbol):
        if isinstance(symbol, PouSymbol) and symbol.kind == "PROGRAM":
            return program_data(symbol)
        raise b.error(f"'{e.name}' is no variable", e)
    if e.base.type is None:
        return place_of_variable(b, symbol)
    if symbol.storage is Storage.DIRECT or (
        symbol.storage is Storage.CONSTANT and symbol.home not in (Storage.INSTANCE, Storage.LOCAL)
    ):
        return place_of_variable(b, symbol)
    base = e.base
    own = isinstance(base, ast.Deref) and isinstance(base.base, ast.This | ast.Super)
    if own:
        return place_of_variable(b, symbol)
    slot = at(b.place(base), symbol.offset)
    if isinstance(symbol.type, t.Reference):
        return ir.Place(ir.Indirect(ir.Load(ir.PTR, slot)))
    return slot


# -- elements ---------------------------------------------------------------------------------------


def _index(b: Body, e: ast.Index) -> ir.Place:
    type_ = e.base.type
    if isinstance(type_, t.Array):
        if type_.open_dims:
            return _open_element(b, e, type_)
        return _element(b, e, type_)
    if isinstance(type_, t.Pointer):
        assert type_.base is not None
        return dereference(b, e.base, type_.base, e.indices[0])
    if isinstance(type_, t.String):
        unit = 2 if type_.wide else 1
        return subscript(b, b.place(e.base), e.indices[0], 0, type_.length, unit)
    raise b.error("this has no elements", e)


def _element(b: Body, e: ast.Index, type_: t.Array) -> ir.Place:
    place = b.place(e.base)
    stride = type_.size // max(type_.count, 1)
    strides = []
    for low, high in reversed(type_.bounds):
        strides.append(stride)
        stride *= high - low + 1
    for index, (low, high), step in zip(e.indices, type_.bounds, reversed(strides), strict=True):
        place = subscript(b, place, index, low, high, step)
    return place


def subscript(b: Body, place: ir.Place, index: ast.Expr, low: int, high: int, stride: int) -> ir.Place:
    """One index applied to a place; constant ones become part of the offset."""
    if index.is_constant and isinstance(index.constant, int) and low <= index.constant <= high:
        return at(place, (index.constant - low) * stride)
    number = b.value(index)
    check = b.check_function("CheckBounds")
    if check is not None:
        limits = [ir.Const(ir.I32, low), ir.Const(ir.I32, high)]
        number = _call_check(b, check, [convert(number, ir.I32), *limits])
    sub = ir.Subscript(number, low, high, stride)
    return b.subscripted(ir.Place(place.base, place.offset, (*place.subscripts, sub), place.root))


def _call_check(b: Body, check: PouSymbol, args: list[ir.Expr]) -> ir.Expr:
    parameters = [p for p in check.parameters if p.section == "VAR_INPUT"]
    values = [convert(arg, require_scalar(p.type)) for arg, p in zip(args, parameters, strict=False)]
    return ir.Call(require_scalar(check.return_type), b.program.function(check), values)


def check_call(b: Body, check: PouSymbol, args: list[ir.Expr]) -> ir.Expr:
    """Call of an implicit check function with converted arguments."""
    b.foreign_writes = True
    return _call_check(b, check, args)


def _shifted(b: Body, place: ir.Place, index: ast.Expr, stride: int) -> ir.Place:
    """`pointer[i]`: not checked, the extent behind a pointer is unknown."""
    if index.is_constant and isinstance(index.constant, int):
        return at(place, index.constant * stride)
    sub = ir.Subscript(b.value(index), 0, (1 << 62) - 1, stride, checked=False)
    return ir.Place(place.base, place.offset, (*place.subscripts, sub))


def _open_element(b: Body, e: ast.Index, type_: t.Array) -> ir.Place:
    """Element of ARRAY[*]: the place holds a descriptor (address, then low and high per dimension)."""
    descriptor = b.place(e.base)
    flat: ir.Expr = ir.Const(ir.I64, 0)
    before: list[ir.Stmt] = []
    for number, index in enumerate(e.indices):
        low = ir.Load(ir.I64, at(descriptor, 8 + 16 * number))
        high = ir.Load(ir.I64, at(descriptor, 16 + 16 * number))
        local = b.temp(ir.I64)
        position = ir.Load(ir.I64, ir.Place(local))
        value = b.value(index)
        before.append(ir.Store(ir.Place(local), convert(value, ir.I64)))
        outside: ir.Expr = ir.ShortCircuit(
            ir.BOOL, "or", ir.Compare(ir.BOOL, "lt", position, low), ir.Compare(ir.BOOL, "gt", position, high)
        )
        if value.type == ir.U64:  # above the largest LINT, where a lower bound may be negative
            beyond = ir.Compare(ir.BOOL, "lt", position, ir.Const(ir.I64, 0))
            outside = ir.ShortCircuit(ir.BOOL, "or", beyond, outside)
        before.append(ir.FaultIf(outside, FAULT_BOUNDS, [position, low, high]))
        extent = ir.Binary(ir.I64, "add", ir.Binary(ir.I64, "sub", high, low), ir.Const(ir.I64, 1))
        flat = ir.Binary(
            ir.I64, "add", ir.Binary(ir.I64, "mul", flat, extent), ir.Binary(ir.I64, "sub", position, low)
        )
    scaled = ir.Binary(ir.I64, "mul", flat, ir.Const(ir.I64, type_.element.size))
    pointer = ir.Binary(ir.PTR, "offset", ir.Load(ir.PTR, descriptor), scaled)
    return ir.Place(ir.Indirect(ir.Sequence(ir.PTR, before, pointer)))


# -- pointers ---------------------------------------------------------------------------------------


def dereference(b: Body, pointer: ast.Expr, target: t.Type, index: ast.Expr | None = None) -> ir.Place:
    """What a pointer expression points to, or the element `index` from there (LTYP-72).

    CheckPointer sees the address of the access first, and whether it is written to (LTYP-80, LTYP-81).
    """
    address = b.value(pointer)
    check = b.check_function("CheckPointer")
    if check is None or isinstance(address, ir.Address):
        place = address.place if isinstance(address, ir.Address) else _behind(address)
        return place if index is None else _shifted(b, place, index, target.size)
    if index is not None:
        shift = ir.Binary(ir.I64, "mul", convert(b.value(index), ir.I64), ir.Const(ir.I64, target.size))
        address = ir.Binary(ir.PTR, "offset", convert(address, ir.PTR), shift)
    size, granularity = ir.Const(ir.I32, target.size), ir.Const(ir.I32, _granularity(target))
    return _behind(check_call(b, check, [address, size, granularity, ir.Const(ir.BOOL, int(b.writing))]))


def _behind(address: ir.Expr) -> ir.Place:
    return ir.Place(ir.Indirect(convert(address, ir.PTR)))


def _granularity(type_: t.Type) -> int:
    """Size of the largest simple type inside (LTYP-81)."""
    if isinstance(type_, t.Array | t.Struct | t.FunctionBlock):
        return max((_granularity(inner) for inner in composed(type_)), default=1)
    return type_.align if isinstance(type_, t.String) else type_.size


def _deref(b: Body, e: ast.Deref) -> ir.Place:
    if e.base.__class__ in (ast.This, ast.Super):
        if b.own_data is None:
            raise b.error("there is no own instance here", e)
        return b.own_data
    assert e.type is not None
    return dereference(b, e.base, e.type)


def address_of(place: ir.Place) -> ir.Expr:
    """Address of a place; of what a pointer points to it is the pointer itself."""
    if isinstance(place.base, ir.Indirect) and not place.offset and not place.subscripts:
        return place.base.pointer
    return ir.Address(ir.PTR, place)


def freeze(b: Body, place: ir.Place, out: list[ir.Stmt]) -> ir.Place:
    """A place to use several times: pointers and indices are evaluated and checked once, in `out`."""
    base = place.base
    if isinstance(base, ir.Indirect) and not _stable(base.pointer):
        local = b.temp(ir.PTR)
        out.append(ir.Store(ir.Place(local), base.pointer))
        base = ir.Indirect(ir.Load(ir.PTR, ir.Place(local)), base.align)
    subs = []
    for sub in place.subscripts:
        kind = ir.U64 if sub.index.type == ir.U64 else ir.I64
        local = b.temp(kind)
        out.append(ir.Store(ir.Place(local), convert(sub.index, kind)))
        index = ir.Load(kind, ir.Place(local))
        if sub.checked:
            out.append(ir.CheckIndex(ir.Subscript(index, sub.low, sub.high, sub.stride)))
        subs.append(
            ir.Subscript(ir.Load(kind, ir.Place(local)), sub.low, sub.high, sub.stride, checked=False)
        )
    if base is place.base and not subs:
        return place
    return ir.Place(base, place.offset, tuple(subs), place.root)


def _stable(pointer: ir.Expr) -> bool:
    return isinstance(pointer, ir.Argument | ir.Const)


PLACES.update(
    {
        ast.Name: place_of_name,
        ast.Member: place_of_member,
        ast.Index: _index,
        ast.Deref: _deref,
    }
)
