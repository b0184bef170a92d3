"""Properties: reading calls Get, assigning calls Set (LDEC-121).

A property that returns a REFERENCE yields what it refers to: a place behind a call of Get.
"""

from __future__ import annotations

from tappet.core import ir, places
from tappet.core.assign import assign_memory
from tappet.core.body import PLACES, TARGETS, VALUES, Body
from tappet.core.calls import Prepared, as_place, as_value, finish, instance_of
from tappet.core.scalars import require_scalar
from tappet.core.values import member_value, variable_value
from tappet.lang import ast
from tappet.lang.analysis.result import yields_reference
from tappet.lang.symbols import PropertySymbol


def _read(b: Body, e: ast.Name | ast.Member, symbol: PropertySymbol) -> Prepared:
    """Call of the getter."""
    if symbol.getter is None:
        raise b.error(f"property '{symbol.name}' has no Get", e)
    prepared = Prepared()
    own, static = instance_of(b, e, symbol.getter)
    b.foreign_writes = True
    finish(b, prepared, symbol.getter, [], own, static)
    return prepared


def _value(b: Body, e: ast.Name | ast.Member, symbol: PropertySymbol) -> ir.Expr:
    if yields_reference(e):
        assert e.type is not None
        return ir.Load(require_scalar(e.type), _place(b, e, symbol))
    return as_value(b, _read(b, e, symbol))


def _place(b: Body, e: ast.Name | ast.Member, symbol: PropertySymbol) -> ir.Place:
    prepared = _read(b, e, symbol)
    if yields_reference(e):
        return ir.Place(ir.Indirect(as_value(b, prepared)))
    return as_place(b, prepared)


def write_property(b: Body, e: ast.Name | ast.Member, symbol: PropertySymbol, value: ast.Expr) -> None:
    """Call of the setter with `value`; without one, the reference that Get returns is written through."""
    if symbol.setter is None:
        if not yields_reference(e):
            raise b.error(f"property '{symbol.name}' has no Set", e)
        assign_memory(b, e, value)
        return
    prepared = Prepared()
    own, static = instance_of(b, e, symbol.setter)
    b.foreign_writes = True
    argument = ast.Argument(name=None, value=value, span=value.span)
    if symbol.setter.parameters:
        argument.parameter = symbol.setter.parameters[0]
    finish(b, prepared, symbol.setter, [argument], own, static)
    b.out.extend(prepared.statements())


def _named_value(b: Body, e: ast.Name) -> ir.Expr:
    if isinstance(e.symbol, PropertySymbol):
        return _value(b, e, e.symbol)
    return variable_value(b, e)


def _member_value(b: Body, e: ast.Member) -> ir.Expr:
    if isinstance(e.symbol, PropertySymbol) and e.bit is None:
        return _value(b, e, e.symbol)
    return member_value(b, e)


def _named_place(b: Body, e: ast.Name) -> ir.Place:
    if isinstance(e.symbol, PropertySymbol):
        return _place(b, e, e.symbol)
    return places.place_of_name(b, e)


def _member_place(b: Body, e: ast.Member) -> ir.Place:
    if isinstance(e.symbol, PropertySymbol):
        return _place(b, e, e.symbol)
    return places.place_of_member(b, e)


VALUES.update({ast.Name: _named_value, ast.Member: _member_value})
TARGETS[PropertySymbol] = write_property
PLACES.update({ast.Name: _named_place, ast.Member: _member_place})
