"""A number assigned to an enumeration, or a CASE label of one, is one of its values.

Source: spec LTYP-110..LTYP-115.

Passes:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; END_VAR
    eMode := 1;
Fails:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; END_VAR
    eMode := 17;                   (* W1139: no value of E_Mode *)
Fails:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; n : INT; END_VAR
    CASE eMode OF
        Off: n := 1;
        On: n := 2;
        17: n := 3;                (* W1139: no value of E_Mode *)
    END_CASE
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Enum

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1139",)
NODES = (ast.Case,)
VALUES = (ast.Literal, ast.Unary)


def check_statement(b: Body, s: ast.Assign | ast.Case) -> None:
    """Reports constants that the enumeration does not name."""
    if isinstance(s, ast.Assign):
        if s.value.is_constant:
            _check(b, s.target.type, s.value)
    elif isinstance(s.selector.type, Enum):
        for branch in s.branches:
            for selector in branch.selectors:
                if selector.high is None:
                    _check(b, s.selector.type, selector.low)


def _check(b: Body, enum: object, e: ast.Expr) -> None:
    if not isinstance(enum, Enum) or isinstance(e.type, Enum) or e.untyped or not enum.values:
        return
    number = e.constant
    if isinstance(number, int) and number not in enum.values.values():
        known = ", ".join(f"{name} = {value}" for name, value in list(enum.values.items())[:_SHOWN])
        b.report("W1139", e.span, value=number, type=enum, known=known)


_SHOWN = 4
