"""A value meets the type its context needs: literals adapt, everything else converts by the table or is
reported."""

from __future__ import annotations

import math
from copy import copy

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, folding
from tappet.lang.analysis.context import Body
from tappet.lang.source import Span
from tappet.lang.symbols import BuiltinSymbol, PouSymbol
from tappet.lang.types import Elementary, Kind, Type

_DURATION_TO_LONG = {
    "TIME": (t.LTIME, 1_000_000),
    "DATE": (t.LDATE, 1_000_000_000),
    "DATE_AND_TIME": (t.LDT, 1_000_000_000),
    "TIME_OF_DAY": (t.LTOD, 1_000_000),
}
"""Long form of a duration or date literal and its nanoseconds per unit."""
_EXAMPLES = {"TIME": "T#500ms", "LTIME": "LTIME#500us"}


def require(b: Body, e: ast.Expr, target: Type) -> bool:
    """Checks that the analysed `e` may be assigned to `target`; False after an error."""
    source = e.type
    if source is None:
        return False
    if e.untyped:
        return _adapt(b, e, target)
    if e.__class__ is ast.Call and as_zero(e, target):
        return True
    if source is target:
        return True
    if target.__class__ is t.Reference:
        target = target.base
        if source is target:
            return True
    code = conversion.verdict(source, target)
    if code and e.__class__ is ast.Call and adapt_choice(e, t.value_type(target)):
        return True
    if e.is_constant:
        value = e.constant
        if target.__class__ is t.Subrange and isinstance(value, int):
            return _constant_in_subrange(b, e, target, value)
        if code and isinstance(value, (int, float)) and not isinstance(value, bool):
            base = t.value_type(target)
            if isinstance(base, Elementary) and _constant_fits(value, source, base):
                return True
        if isinstance(value, (bytes, str)) and isinstance(target, t.String):
            _check_string_length(b, e, target, value)
    if not code:
        return True
    complain(b, e.span, source, target, code)
    return code[0] == "W"


def as_zero(e: ast.Expr, target: Type) -> bool:
    """A call without result is the 0 of the type that its context asks for, if there is one."""
    base = t.value_type(target)
    if not (isinstance(e, ast.Call) and isinstance(e.target, PouSymbol) and isinstance(base, Elementary)):
        return False
    if e.target.return_type is not None or e.type is None:
        return False
    e.type = base
    return True


def complain(b: Body, span: Span, source: Type, target: Type, code: str) -> None:
    """Reports the verdict of a conversion."""
    function = conversion_function(source, target)
    if code == conversion.ERROR:
        hint = conversion_hint(source, target)
        b.report(code, span, source=source, target=target, hint=hint, function=function)
    elif code == conversion.POINTER_IN_INTEGER:
        b.report(code, span, type=target)
    else:
        b.report(code, span, source=source, target=target, call=f"{function}(...)", function=function)


def conversion_function(source: Type, target: Type) -> str:
    """`INT_TO_BYTE`, or '' when no function converts."""
    from_, to = t.value_type(source), t.value_type(target)
    convertible = isinstance(from_, (Elementary, t.String)) and isinstance(to, (Elementary, t.String))
    return f"{_plain(source)}_TO_{_plain(target)}" if convertible and from_ != to else ""


def conversion_hint(source: Type, target: Type) -> str:
    """Advice for an impossible implicit conversion."""
    from_, to = t.value_type(source), t.value_type(target)
    if from_ == to:
        return ""
    function = conversion_function(source, target)
    if function:
        return f"Use {function}(...)."
    if isinstance(from_, t.Pointer):
        return "Read the target of the pointer with '^'."
    if isinstance(to, t.Pointer):
        if to.ref_to:
            return f"Write REF(...) of a variable of type '{to.base}', or NULL."
        return "Take the address with ADR(...)."
    if isinstance(to, t.Interface) and isinstance(from_, t.FunctionBlock):
        return f"'{from_}' does not implement '{to}'."
    return "Both sides must have the same type."


def _plain(type_: Type) -> str:
    base = t.value_type(type_)
    if isinstance(base, t.String):
        return "WSTRING" if base.wide else "STRING"
    return {"TIME_OF_DAY": "TOD", "DATE_AND_TIME": "DT"}.get(str(base), str(base))


def _constant_fits(value: int | float, source: Type, target: Elementary) -> bool:
    """Whether a constant of a number type keeps its value in `target`."""
    base = t.value_type(source)
    if not isinstance(base, Elementary) or not (base.is_integer or base.kind is Kind.REAL):
        return False
    if target.is_integer and isinstance(value, int):
        return folding.fits(value, target)
    if target.kind is Kind.REAL and isinstance(value, int):
        return folding.wrap(value, target) == value
    return False


def _constant_in_subrange(b: Body, e: ast.Expr, target: t.Subrange, value: int) -> bool:
    source = e.type
    assert source is not None
    if target.low <= value <= target.high:
        return True
    b.report("E0324", e.span, source=source, target=target, value=value, low=target.low, high=target.high)
    return False


def _check_string_length(b: Body, e: ast.Expr, target: t.String, value: bytes | str) -> None:
    if len(value) > target.length:
        text = value.decode("latin-1") if isinstance(value, bytes) else value
        b.report("W1004", e.span, text=text if len(text) < 40 else text[:37] + "...", type=target)


def _adapt(b: Body, e: ast.Expr, target: Type) -> bool:
    """An untyped constant takes the type of its context, or is reported."""
    source = e.type
    assert source is not None
    if target.__class__ is Elementary:
        base: Type = target
    elif target.__class__ is t.Subrange:
        base = target.base
        number = e.constant
        if number.__class__ is int and not _constant_in_subrange(b, e, target, int(number)):
            return False
    else:
        base = t.value_type(target)
        if isinstance(target, t.Enum) and target.strict:
            complain(b, e.span, source, target, conversion.ERROR)
            return False
    if isinstance(base, Elementary):
        if retype(e, base):
            return True
        if isinstance(e.constant, float) and base is t.REAL and math.isfinite(e.constant):
            b.report(
                "E0302", e.span, text=repr(e.constant), type=base, low="-3.402823E+38", high="3.402823E+38"
            )
            return False
        if base.name in _EXAMPLES:
            hint = f"Write a time such as {_EXAMPLES[base.name]}."
            b.report(conversion.ERROR, e.span, source=source, target=target, hint=hint)
            return False
        complain(b, e.span, source, target, conversion.ERROR)
        return False
    zero_only = isinstance(base, t.Interface) or (isinstance(base, t.Pointer) and base.ref_to)
    addressed = isinstance(base, (t.Interface, t.Pointer)) and (e.constant == 0 or not zero_only)
    if e.constant.__class__ is int and addressed:
        e.type = t.LWORD
        e.constant = folding.wrap(e.constant, t.LWORD)
        return True
    if isinstance(base, t.String) and isinstance(source, t.String) and base.wide == source.wide:
        if isinstance(e.constant, (bytes, str)):
            _check_string_length(b, e, base, e.constant)
        return True
    if isinstance(base, t.String) and narrow(b, e):
        return _adapt(b, e, target)
    complain(b, e.span, source, target, conversion.ERROR)
    return False


def narrow(b: Body, e: ast.Expr) -> bool:
    """Makes a STRING of a literal in double quotes, which some systems take for one; others are left."""
    if not isinstance(e, ast.Literal) or not isinstance(e.constant, str) or not e.untyped:
        return False
    b.report("W1152", e.span, text=e.text if len(e.text) < 40 else f"{e.text[:37]}...")
    e.constant = e.constant.encode(
        "latin-1" if e.constant <= "\xff" or e.constant.isascii() else "utf-8", "replace"
    )
    e.type = t.String(max(1, len(e.constant)))
    return True


def adapt_choice(e: ast.Call, target: Type) -> bool:
    """`SEL(a, 0, 255)`: a choice among literals takes the type of its context when each of them fits."""
    alternatives = _literal_choice(e)
    if not alternatives or not isinstance(target, Elementary) or not _all_fit(alternatives, target):
        return False
    for x in alternatives:
        if isinstance(x, ast.Call):
            adapt_choice(x, target)
        else:
            retype(x, target)
    symbol = e.target
    assert isinstance(symbol, BuiltinSymbol)
    types = (symbol.parameter_types[0], *(target for _ in alternatives))
    e.target, e.type = BuiltinSymbol(symbol.name, parameter_types=types, return_type=target), target
    return True


def _all_fit(alternatives: list[ast.Expr], target: Elementary) -> bool:
    return all(
        _all_fit(_literal_choice(x), target) if isinstance(x, ast.Call) else retype(copy(x), target)
        for x in alternatives
    )


def _literal_choice(e: ast.Call) -> list[ast.Expr]:
    """The alternatives of a SEL or MUX that are all literals or such choices themselves; else none."""
    if not isinstance(e.target, BuiltinSymbol) or e.target.name not in ("SEL", "MUX"):
        return []
    found = [arg.value for arg in e.args[1:] if arg.value is not None]
    fine = all(x.untyped or (isinstance(x, ast.Call) and _literal_choice(x)) for x in found)
    return found if fine else []


def retype(e: ast.Expr, target: Elementary) -> bool:
    """Gives an untyped number constant the elementary type `target` if its value fits; False otherwise."""
    value = e.constant
    if isinstance(value, (bytes, str)):
        return False
    if e.type.__class__ is Elementary and e.type.kind in (Kind.TIME, Kind.DATE):
        return _retype_duration(e, target)
    if value.__class__ is float:
        if target.kind is not Kind.REAL:
            return False
        rounded = folding.wrap(value, target)
        if math.isinf(rounded) and math.isfinite(value):  # type: ignore[arg-type]
            return False
        e.constant = rounded
    elif value.__class__ is bool:
        if target is not t.BOOL:
            return False
    elif isinstance(value, int):
        if target.kind is Kind.REAL:
            e.constant = folding.wrap(value, target)
        elif target is t.BOOL:
            if value not in (0, 1):
                return False
            e.constant = bool(value)
        elif not target.is_integer:
            return False
        elif _complemented(e):
            folded = _fold_complement(e, target)
            if folded is None:
                return False
            e.constant = folded
        elif not folding.fits(value, target):
            return False
    else:
        return False
    e.type = target
    e.untyped = False
    if isinstance(e, (ast.Unary, ast.Binary)):
        e.operand_type = target
    return True


def _retype_duration(e: ast.Expr, target: Elementary) -> bool:
    source = e.type
    if source is target:
        e.untyped = False
        return True
    longer = _DURATION_TO_LONG.get(str(source))
    if longer is None or longer[0] is not target or not isinstance(e.constant, int):
        return False
    e.constant *= longer[1]
    e.type = target
    e.untyped = False
    return True


def _complemented(e: ast.Expr) -> bool:
    """Whether a NOT inside makes the value depend on the width."""
    if isinstance(e, ast.Unary):
        return e.op == "NOT" or _complemented(e.operand)
    if isinstance(e, ast.Binary):
        return e.op in ("AND", "OR", "XOR") and (_complemented(e.left) or _complemented(e.right))
    return False


def _fold_complement(e: ast.Expr, target: Elementary) -> int | None:
    """Value of a constant with NOT in the width of `target`; None when an operand does not fit."""
    if isinstance(e, ast.Unary) and e.op == "NOT":
        inner = _fold_complement(e.operand, target)
        if inner is None:
            return None
        return folding.wrap_integer(~inner, target.size, target.kind is Kind.SIGNED)
    if isinstance(e, ast.Binary) and e.op in ("AND", "OR", "XOR"):
        left, right = _fold_complement(e.left, target), _fold_complement(e.right, target)
        if left is None or right is None:
            return None
        value = folding.arithmetic(e.op, left, right, target)
        return value if isinstance(value, int) else None
    value = e.constant
    if not isinstance(value, int) or not folding.fits(value, target):
        return None
    return int(value)
