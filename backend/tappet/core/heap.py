"""`__NEW` and `__DELETE`: memory, initial values, FB_Init and FB_Exit of all elements (LOPR-100, LOPR-103).

The runtime knows of memory of `tappet_allocate` how many elements it has and how long one is. Services that
take its address end in a fault when nothing of __NEW begins there, or its bounds were not kept.
"""

from __future__ import annotations

from tappet.core import initial, ir, places
from tappet.core.body import Body
from tappet.core.life_cycle import holding
from tappet.core.scalars import NULL, convert, scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.parts import innermost
from tappet.lang.symbols import BuiltinSymbol


def new(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> ir.Expr:
    """Zeroed memory with initial values; 0 when there is none left."""
    assert isinstance(symbol.return_type, t.Pointer)
    type_ = symbol.return_type.base
    assert type_ is not None
    operands = [a.value for a in e.args if a.value is not None]
    count: ir.Expr = ir.Const(ir.U64, 1)
    several = len(operands) > 1
    body: list[ir.Stmt] = []
    if several:
        length = b.temp(ir.U64)
        body.append(ir.Store(ir.Place(length), convert(b.value(operands[1]), ir.U64)))
        count = ir.Load(ir.U64, ir.Place(length))
    b.program.module.externals.setdefault(
        "tappet_allocate", ir.External("tappet_allocate", [ir.U64, ir.U64], ir.PTR)
    )
    pointer = b.temp(ir.PTR)
    read = ir.Load(ir.PTR, ir.Place(pointer))
    memory = ir.Call(ir.PTR, "tappet_allocate", [count, ir.Const(ir.U64, max(type_.size, 1))])
    body.append(ir.Store(ir.Place(pointer), memory))
    made_of = innermost(type_)
    if isinstance(made_of, t.FunctionBlock | t.Struct):
        b.program.created[str(made_of).upper()] = made_of
    if scalar_of(type_) is None:
        made = operands[0] if isinstance(operands[0], ast.Call) and not isinstance(type_, t.String) else None
        with b.block_of() as fill:
            if several:
                _initialise_elements(b, read, type_, count, made)
            else:
                initial.initialise_place(b, ir.Place(ir.Indirect(read)), type_, made)
        body.append(ir.If(ir.Compare(ir.BOOL, "ne", read, NULL), fill, []))
    b.program.expose(b.function, ir.Place(ir.Data("")), type_)
    return ir.Sequence(ir.PTR, body, read)


def _initialise_elements(
    b: Body, start: ir.Expr, type_: t.Type, count: ir.Expr, made: ast.Expr | None
) -> None:
    """Initial values of `count` elements that follow each other from an address."""
    counter = b.temp(ir.I64, once=False)
    number = ir.Load(ir.I64, ir.Place(counter))
    sub = ir.Subscript(number, 0, (1 << 62) - 1, type_.size, checked=False)
    with b.block_of() as body:
        initial.initialise_place(b, ir.Place(ir.Indirect(start), 0, (sub,)), type_, made)
    _for_each(b, counter, count, body)


def _for_each(b: Body, counter: ir.Local, count: ir.Expr, body: list[ir.Stmt]) -> None:
    last = ir.Binary(ir.I64, "sub", convert(count, ir.I64), ir.Const(ir.I64, 1))
    b.emit(ir.For(ir.Place(counter), ir.I64, ir.Const(ir.I64, 0), last, 1, body, fixed=True))


def delete(b: Body, e: ast.Call, symbol: BuiltinSymbol) -> None:
    """FB_Exit of all instances in the memory; then it is given back, and a variable is set to 0."""
    operand = e.args[0].value
    assert operand is not None
    assert isinstance(operand.type, t.Pointer)
    place = None
    pointer = b.temp(ir.PTR)
    read = ir.Load(ir.PTR, ir.Place(pointer))
    if isinstance(operand, ast.This):
        b.emit(ir.Store(ir.Place(pointer), b.value(operand)))
    else:
        place = places.freeze(b, b.place(operand), b.out)
        b.touch(place)
        b.emit(ir.Store(ir.Place(pointer), ir.Load(ir.PTR, place)))
    b.program.module.externals.setdefault("tappet_release", ir.External("tappet_release", [ir.PTR]))
    base = operand.type.base
    with b.block_of() as then:
        if base is not None and holding(b.program, "FB_EXIT").holds(base):
            _destruct_elements(b, read, base)
        b.emit(ir.Evaluate(ir.Call(ir.VOID, "tappet_release", [read])))
        if place is not None:
            b.emit(ir.Store(place, NULL))
    b.emit(ir.If(ir.Compare(ir.BOOL, "ne", read, NULL), then, []))


def _destruct_elements(b: Body, memory: ir.Expr, type_: t.Type) -> None:
    start, count, size = b.temp(ir.PTR), b.temp(ir.I64), b.temp(ir.I64)
    b.emit(ir.Store(ir.Place(start), memory))
    first = ir.Load(ir.PTR, ir.Place(start))
    for local, service in ((count, "tappet_elements"), (size, "tappet_element_size")):
        b.program.module.externals.setdefault(service, ir.External(service, [ir.PTR], ir.I64))
        b.emit(ir.Store(ir.Place(local), ir.Call(ir.I64, service, [first])))
    counter = b.temp(ir.I64, once=False)
    number = ir.Load(ir.I64, ir.Place(counter))
    element = b.temp(ir.PTR, once=False)
    with b.block_of() as body:
        offset = ir.Binary(ir.I64, "mul", number, ir.Load(ir.I64, ir.Place(size)))
        b.emit(ir.Store(ir.Place(element), ir.Binary(ir.PTR, "offset", first, offset)))
        initial.destruct_all(b, ir.Place(ir.Indirect(ir.Load(ir.PTR, ir.Place(element)))), type_)
    _for_each(b, counter, ir.Load(ir.I64, ir.Place(count)), body)
