"""IL: modifier CN at the name of a function (IL-52): it is called only if the accumulator is FALSE.

The accumulator is the condition then and no operand: `LD ready / CheckCN a, b` leaves TRUE in it, or puts
Check(a, b) there. A function whose own name ends with CN is called as it is.
"""

from __future__ import annotations

from tappet.iec.languages.il import LANGUAGE
from tappet.lang import ast
from tappet.lang.analysis import calls
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import Handler, value
from tappet.lang.analysis.result import carried_type
from tappet.lang.analysis.type_conversions import find_operator
from tappet.lang.symbols import BuiltinSymbol, PouSymbol

_MODIFIER = LANGUAGE.call_modifier


def _call(b: Body, e: ast.Call) -> None:
    if e.accumulator is not None and _has_modifier(b, e.callee):
        _conditional(b, e, e.accumulator)
    else:
        calls.call(b, e)


def _has_modifier(b: Body, callee: ast.Expr) -> bool:
    if not isinstance(callee, ast.Name) or not callee.name.upper().endswith(_MODIFIER):
        return False
    if b.lookup(callee.name) is not None or find_operator(callee.name.upper()) is not None:
        return False
    base = callee.name[: -len(_MODIFIER)]
    return isinstance(b.lookup(base), PouSymbol) or find_operator(base.upper()) is not None


def _conditional(b: Body, e: ast.Call, accumulator: ast.Argument) -> None:
    """SEL does not evaluate what it does not choose (LOPR-40)."""
    condition = accumulator.value
    assert condition is not None
    assert isinstance(e.callee, ast.Name)
    base = ast.Name(name=e.callee.name[: -len(_MODIFIER)], span=e.callee.span)
    operands = [arg for arg in e.args if arg is not accumulator]
    inner = ast.Call(callee=base, args=operands, span=e.span)
    kept = (
        ast.Held(slot=condition.slot, span=condition.span) if isinstance(condition, ast.Held) else condition
    )
    args = [ast.Argument(name=None, value=part, span=e.span) for part in (condition, inner, kept)]
    selection = ast.Call(callee=ast.Name(name="SEL", span=e.span), args=args, span=e.span)
    value(b, selection)
    e.expansion = selection
    e.type, e.constant, e.is_constant = selection.type, None, False
    e.untyped = False
    e.target = BuiltinSymbol("SEL", return_type=carried_type(selection))


HANDLERS: dict[type, Handler] = {ast.Call: _call}
