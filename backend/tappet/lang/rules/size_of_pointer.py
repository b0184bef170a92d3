"""Sizes are those of data, not of the pointer to them.

Where pointers and REAL both have 4 bytes, as in CoDeSys 2.3, counting with SIZEOF(pointer) goes unnoticed;
with 8 bytes half of the data is left out.

Source: spec LOPR-16, LTYP-70.

Passes:
    VAR p : POINTER TO REAL; count, room : UDINT; END_VAR
    count := room / SIZEOF(p^);
Fails:
    VAR p : POINTER TO REAL; count, room : UDINT; END_VAR
    count := room / SIZEOF(p);     (* W1145: 8 bytes *)
Fails:
    FUNCTION Clear : BOOL
    VAR_INPUT p : POINTER TO BYTE; size : UDINT; END_VAR
    END_FUNCTION
    PROGRAM Main
    VAR text : POINTER TO STRING; done : BOOL; END_VAR
    done := Clear(text, SIZEOF(text));  (* W1145: the text is larger *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Pointer
from tappet.lang.walk import same

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1145",)
NODES = (ast.Call,)
OPERATORS = ("/", "MOD")


def check_expression(b: Body, e: ast.Call | ast.Binary) -> None:
    """Reports divisions by the size of a pointer, and a pointer handed over together with its own size."""
    if isinstance(e, ast.Binary):
        found = [_measured(e.right)]
    else:
        values = [arg.value for arg in e.args if arg.value is not None]
        found = [
            pointer
            for pointer in map(_measured, values)
            if pointer is not None and any(same(pointer, other) for other in values)
        ]
    for pointer in found:
        if pointer is not None and isinstance(pointer.type, Pointer):
            b.report("W1145", pointer.span, name=pointer.name, size=pointer.type.size)


def _measured(e: ast.Expr) -> ast.Name | ast.Member | None:
    """`p` of SIZEOF(p) when it is a pointer."""
    if not isinstance(e, ast.Call) or not isinstance(e.target, BuiltinSymbol) or len(e.args) != 1:
        return None
    operand = e.args[0].value
    if e.target.name not in ("SIZEOF", "XSIZEOF") or not isinstance(operand, (ast.Name, ast.Member)):
        return None
    return operand if isinstance(operand.type, Pointer) else None
