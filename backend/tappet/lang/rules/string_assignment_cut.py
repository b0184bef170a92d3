"""A text variable is assigned to one that can hold all of it.

Source: spec LTYP-16.

Passes:
    VAR sShort : STRING(10); sLong : STRING(80); END_VAR
    sLong := sShort;
Fails:
    VAR sShort : STRING(10); sLong : STRING(80); END_VAR
    sShort := sLong;               (* W1008: cut to 10 characters *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import String

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1008",)
VALUES = (ast.Name, ast.Member, ast.Index, ast.Deref)


def check_statement(b: Body, s: ast.Assign) -> None:
    """Reports a variable of a longer STRING or WSTRING on the right side."""
    target, value = s.target.type, s.value
    if target.__class__ is not String or value.is_constant:
        return
    source = value.type
    if isinstance(target, String) and isinstance(source, String) and source.length > target.length:
        b.report("W1008", value.span, source=source, target=target, length=target.length)
