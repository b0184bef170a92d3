"""A text passed to a function is not longer than its parameter.

The string functions of the Standard library take 255 characters; the rest of a longer text is lost.

Source: spec LTYP-16.

Passes:
    FUNCTION F_Len : INT
    VAR_INPUT s : STRING(255); END_VAR
    F_Len := SIZEOF(s);
    END_FUNCTION
    PROGRAM P
    VAR sName : STRING; n : INT; END_VAR
    n := F_Len(sName);
    END_PROGRAM
Fails:
    FUNCTION F_Len : INT
    VAR_INPUT s : STRING(255); END_VAR
    F_Len := SIZEOF(s);
    END_FUNCTION
    PROGRAM P
    VAR sName : STRING(300); n : INT; END_VAR
    n := F_Len(sName);             (* W1006: cut to STRING(255) *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import PouSymbol, VarSymbol
from tappet.lang.types import String

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1006",)
NODES = (ast.Call,)


def check_expression(b: Body, e: ast.Call) -> None:
    """Reports variables of a longer STRING than the input they are passed to."""
    target = e.target
    if not isinstance(target, PouSymbol) or target.kind != "FUNCTION":
        return
    for arg in e.args:
        parameter, content = arg.parameter, arg.value
        if content is None or content.is_constant or not isinstance(parameter, VarSymbol):
            continue
        given, wanted = content.type, parameter.type
        if parameter.section != "VAR_INPUT" or not isinstance(wanted, String):
            continue
        if isinstance(given, String) and given.length > wanted.length:
            b.report("W1006", content.span, source=given, target=wanted, name=parameter.name)
