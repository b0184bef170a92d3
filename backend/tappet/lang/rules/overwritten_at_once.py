"""A value that is assigned is not overwritten by the next statement.

Source: spec LST-20.

Passes:
    VAR a : INT; END_VAR
    a := 1;
    a := a + 1;
Fails:
    VAR a, b : INT; END_VAR
    a := b;
    a := 2;                        (* W1140: the value before is lost *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.symbols import Storage, VarSymbol
from tappet.lang.types import Reference
from tappet.lang.walk import expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1140",)


def check_list(b: Body, body: list[ast.Stmt]) -> None:
    """Reports two assignments to one variable that follow each other."""
    last: object = None
    before: ast.Assign | None = None
    for s in body:
        if not isinstance(s, ast.Assign) or not isinstance(s.target, ast.Name):
            last = None
            continue
        symbol = s.target.symbol
        if symbol is last and before is not None and isinstance(symbol, VarSymbol) and s.label is None:
            _check(b, symbol, before, s)
        last, before = symbol, s


def _check(b: Body, symbol: VarSymbol, before: ast.Assign, s: ast.Assign) -> None:
    if s.op != ":=" or before.op != ":=":
        return
    if before.value.type is None or s.value.type is None:
        return  # what is wrong there has been reported
    if symbol.home in (Storage.DIRECT, Storage.GLOBAL) or isinstance(symbol.type, Reference):
        return
    for e in expressions(s.value):
        if isinstance(e, (ast.Call, ast.Deref)) or (isinstance(e, ast.Name) and e.symbol is symbol):
            return
    b.report("W1140", s.target.span, [Related("assigned here", b.uri, before.span)], name=symbol.name)
