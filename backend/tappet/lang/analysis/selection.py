"""SEL, MUX, MAX, MIN, LIMIT: the type all values meet in, and folding (LOPR-40..LOPR-44)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, folding
from tappet.lang.analysis.adaptation import require, retype
from tappet.lang.analysis.builtins import MANY, Resolve, finish, operands
from tappet.lang.analysis.context import Body
from tappet.lang.types import Elementary, Kind, Type


def common_type(b: Body, found: Sequence[ast.Expr]) -> tuple[Type, Type] | None:
    """The type all operands meet in, and the static type; literals adapt. None (reported) without one.

    The two differ for integers of both signs, as in arithmetic (LOPR-03): MIN of INT and UINT is an INT for
    the checks, and chosen in DINT, which holds both.
    """
    static = _static(found)
    carried = _carried(b, found)
    if carried is None:
        return None
    if static is None or static == t.value_type(carried):
        return carried, carried
    fit = all(isinstance(x.constant, int) and folding.fits(x.constant, static) for x in found if x.untyped)
    return carried, static if fit else carried


def _static(found: Sequence[ast.Expr]) -> Elementary | None:
    """The static type of integers: the larger one, of equal size the signed one."""
    result: Elementary | None = None
    for operand in found:
        if operand.untyped:
            continue
        base = t.value_type(operand.type) if operand.type is not None else None
        if not isinstance(base, Elementary) or not base.is_integer:
            return None
        result = base if result is None else conversion.OPERANDS[(result.name, base.name)].type
    return result


def _carried(b: Body, found: Sequence[ast.Expr]) -> Type | None:
    result: Type | None = None
    for operand in found:
        if not operand.untyped:
            result = operand.type if result is None else _pair(result, operand.type)
            if result is None:
                b.report(
                    "E0304", operand.span, op="selection", left=found[0].type, right=operand.type, hint=_SAME
                )
                return None
    if result is None:
        return _common_of_literals(b, found)
    for operand in found:
        if operand.untyped:
            base = t.value_type(result)
            if isinstance(base, Elementary) and retype(operand, base):
                continue
            wider = _pair(result, operand.type)
            if wider is None:
                b.report("E0304", operand.span, op="selection", left=result, right=operand.type, hint=_SAME)
                return None
            result = wider
    return result


_SAME = "All values must have the same type."


def _pair(left: Type, right: Type | None) -> Type | None:
    if right is None:
        return None
    if left == right:
        return left
    lb, rb = t.value_type(left), t.value_type(right)
    if isinstance(lb, Elementary) and isinstance(rb, Elementary):
        if lb == rb:
            return lb
        meeting = conversion.OPERANDS.get((lb.name, rb.name))
        if meeting is None:
            return None
        if (lb.kind is Kind.SIGNED) != (rb.kind is Kind.SIGNED) and meeting.type.kind is not Kind.REAL:
            # both sides keep their value: 32 bit for the narrow ones
            return meeting.computed if meeting.computed.size >= meeting.type.size else meeting.type
        return meeting.type
    if isinstance(lb, t.String) and isinstance(rb, t.String) and lb.wide == rb.wide:
        return lb if lb.length >= rb.length else rb
    if isinstance(lb, t.Pointer) and isinstance(rb, t.Pointer):
        return lb
    return None


def _common_of_literals(b: Body, found: Sequence[ast.Expr]) -> Type | None:
    first = found[0]
    whole = [x.constant for x in found if x.constant.__class__ is int]
    if len(whole) == len(found) and all(_is_integer(x.type) for x in found):
        smallest = conversion.smallest_of(whole)
        if smallest is None:
            left, right = (found[whole.index(pick(whole))].type for pick in (min, max))
            b.report("E0304", found[-1].span, op="selection", left=left, right=right, hint=_SAME)
        return smallest
    result = first.type
    for operand in found[1:]:
        wider = _pair(result, operand.type) if result is not None else None
        if wider is None:
            b.report("E0304", operand.span, op="selection", left=first.type, right=operand.type, hint=_SAME)
            return None
        result = wider
    return result


def _is_integer(type_: Type | None) -> bool:
    return isinstance(type_, Elementary) and type_.is_integer


def _choose(
    e: ast.Call, name: str, lead: Sequence[Type | None], found: list[ast.Expr], types: tuple[Type, Type]
) -> None:
    """Finishes SEL, MUX, MAX, MIN, LIMIT; folds when every operand is constant."""
    type_, static = types
    finish(e, name, [*lead, *([type_] * (len(found) - len(lead)))], type_)
    e.type = static
    if not all(x.is_constant and x.constant is not None for x in found):
        return
    values = [x.constant for x in found]
    untyped = all(x.untyped for x in found[len(lead) :])
    if not untyped and isinstance(type_, Elementary):  # handed over in their common type
        values = values[: len(lead)] + [folding.wrap(v, type_) for v in values[len(lead) :]]
    chosen: ast.Constant = None
    if name == "SEL":
        chosen = values[2] if values[0] else values[1]
    elif name == "MUX":
        number = values[0]
        assert isinstance(number, int)
        chosen = values[1 + number] if 0 <= number < len(values) - 1 else values[-1]
    elif name == "LIMIT":
        chosen = _smaller(_larger(values[1], values[0]), values[2])
    else:
        pick = _larger if name == "MAX" else _smaller
        chosen = values[0]
        for other in values[1:]:
            chosen = pick(chosen, other)
    e.is_constant = True
    e.constant = chosen
    e.untyped = untyped


def _larger(left: ast.Constant, right: ast.Constant) -> ast.Constant:
    return right if folding.compare(">", right, left) else left


def _smaller(left: ast.Constant, right: ast.Constant) -> ast.Constant:
    return right if folding.compare("<", right, left) else left


def _sel(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 3, 3)
    if found is None or not require(b, found[0], t.BOOL):
        return
    types = common_type(b, found[1:])
    if types is not None:
        _choose(e, name, [t.BOOL], found, types)


def _mux(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 2, MANY)
    if found is None:
        return
    number = t.value_type(found[0].type)  # type: ignore[arg-type]
    if not isinstance(number, Elementary) or not number.is_integer:
        b.report("E0303", found[0].span, op=name, type=found[0].type, hint="The number must be an integer.")
        return
    types = common_type(b, found[1:])
    if types is not None:
        _choose(e, name, [number], found, types)


def _extreme(b: Body, e: ast.Call, name: str) -> None:
    low, high = (3, 3) if name == "LIMIT" else (2, MANY)
    found = operands(b, e, name, low, high)
    if found is None:
        return
    types = common_type(b, found)
    if types is None:
        return
    if not isinstance(t.value_type(types[0]), (Elementary, t.String)):
        b.report("E0303", e.span, op=name, type=types[0], hint="Values of this type have no order.")
        return
    _choose(e, name, [], found, types)


OPERATIONS: dict[str, Resolve] = {
    "SEL": _sel,
    "MUX": _mux,
    "MAX": _extreme,
    "MIN": _extreme,
    "LIMIT": _extreme,
}
