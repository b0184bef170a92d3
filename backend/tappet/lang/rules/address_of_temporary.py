"""The address of a temporary variable is not kept where it outlives the call.

Variables of functions and methods, and VAR_TEMP, are new in each call; the pointer then points to something
else.

Source: spec LDEC-24, LTYP-70.

Passes:
    FUNCTION_BLOCK FB
    VAR n : INT; pn : POINTER TO INT; END_VAR
    pn := ADR(n);
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    VAR_TEMP n : INT; END_VAR
    VAR pn : POINTER TO INT; END_VAR
    pn := ADR(n);                  (* W1127: n is gone after the call *)
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol, Storage, VarSymbol
from tappet.lang.types import Reference
from tappet.lang.walk import root

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1127",)
VALUES = (ast.Call, ast.Name, ast.Member, ast.Index)


def check_statement(b: Body, s: ast.Assign) -> None:
    """Reports `kept := ADR(temporary)` and `kept REF= temporary`."""
    value: ast.Expr | None = s.value
    if s.op == ":=":
        if not isinstance(value, ast.Call) or not isinstance(value.target, BuiltinSymbol):
            return
        if value.target.name != "ADR" or not value.args:
            return
        value = value.args[0].value
    elif s.op != "REF=":
        return
    source, target = (None if value is None else root(value)), root(s.target)
    if not isinstance(source, ast.Name) or not isinstance(source.symbol, VarSymbol):
        return
    temporary = source.symbol.home is Storage.LOCAL and not isinstance(source.symbol.type, Reference)
    if not temporary or not isinstance(target, ast.Name) or not isinstance(target.symbol, VarSymbol):
        return
    if target.symbol.home in (Storage.GLOBAL, Storage.INSTANCE, Storage.PROGRAM):
        b.report("W1127", s.value.span, name=source.name, target=target.name)
