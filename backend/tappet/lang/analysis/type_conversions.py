"""`<T1>_TO_<T2>`, `TO_<T>`, `ANY_TO_<T>` (LOPR-70..LOPR-79)."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import folding
from tappet.lang.analysis.adaptation import require, retype
from tappet.lang.analysis.builtins import OPERATORS, Resolve, finish, operands
from tappet.lang.analysis.context import Body
from tappet.lang.types import Elementary, Kind, Type

_DEFAULT_STRING = t.String(80)
_DEFAULT_WSTRING = t.String(80, wide=True)
_LONGEST = 255
"""Characters that conversions between STRING and WSTRING take."""
_GENERIC = frozenset(
    {
        "ANY",
        "ANY_NUM",
        "ANY_INT",
        "ANY_REAL",
        "ANY_BIT",
        "ANY_DATE",
        "ANY_STRING",
        "ANY_MAGNITUDE",
        "ANY_ELEMENTARY",
    }
)


def _conversion_type(name: str) -> Type | None:
    if name == "STRING":
        return _DEFAULT_STRING
    if name == "WSTRING":
        return _DEFAULT_WSTRING
    return t.ELEMENTARY.get(name)


def find_operator(name: str) -> Resolve | None:
    """What resolves a call of the operator `name` (upper case), None if it is none."""
    resolve = OPERATORS.get(name)
    if resolve is not None:
        return resolve
    source, found, target = name.rpartition("_TO_")
    if not found:
        if not name.startswith("TO_"):
            return None
        source, target = "ANY", name[3:]
    result = _conversion_type(target)
    if result is None or (source not in _GENERIC and _conversion_type(source) is None):
        return None
    resolve = _convert(None if source in _GENERIC else _conversion_type(source), result)
    OPERATORS[name] = resolve
    return resolve


def is_conversion(name: str) -> bool:
    """Whether `name` (upper case) is that of a conversion, which nothing else may have (LDEC-10)."""
    return "TO_" in name and find_operator(name) is not None


def _convert(source: Type | None, target: Type) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        found = operands(b, e, name, 1, 1)
        if found is None:
            e.type = target
            return
        operand = found[0]
        own = t.value_type(operand.type)  # type: ignore[arg-type]
        if source is None:
            if not isinstance(own, (Elementary, t.String, t.Pointer)):
                b.report(
                    "E0303",
                    operand.span,
                    op=name,
                    type=operand.type,
                    hint="Only simple types can be converted.",
                )
                return
            from_: Type = own
            if operand.untyped and isinstance(own, Elementary):
                retype(operand, own)
        elif isinstance(source, t.String):
            if not isinstance(own, t.String) or own.wide != source.wide:
                if not require(b, operand, source):
                    e.type = target
                    return
                own = t.value_type(operand.type)  # type: ignore[arg-type]
            from_ = own if isinstance(own, t.String) else source
        else:
            if isinstance(own, t.Pointer) and isinstance(source, Elementary) and source.is_integer:
                from_ = own
            elif not require(b, operand, source):
                e.type = target
                return
            else:
                from_ = source
        finish(e, "CONVERT", [from_], _result(from_, target))
        if operand.is_constant and isinstance(from_, Elementary) and isinstance(target, Elementary):
            _fold_conversion(e, operand.constant, from_, target)

    return resolve


def _result(source: Type, target: Type) -> Type:
    """Type of the result: a text keeps the length of its source, so that nothing is cut or read behind it."""
    if not isinstance(source, t.String) or not isinstance(target, t.String):
        return target
    if source.wide == target.wide:
        return source
    return t.String(min(source.length, _LONGEST), target.wide)


def _fold_conversion(e: ast.Call, content: ast.Constant, source: Elementary, target: Elementary) -> None:
    clock = (Kind.TIME, Kind.DATE)
    if source.kind in clock and target.kind in clock and source is not target:
        return  # units differ: lowering computes it
    if not isinstance(content, (int, float)):
        return
    content = folding.wrap(content, source)
    e.is_constant = True
    e.constant = folding.wrap(content, target)
