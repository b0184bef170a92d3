"""A variable used in an initial value is declared above it.

Variables are initialised in the order of their declaration; one that comes later still is zero.

Source: spec LDEC-42.

Passes:
    VAR a : INT := 5; b : INT := a + 1; END_VAR
    a := b;
Fails:
    VAR b : INT := a + 1; a : INT := 5; END_VAR   (* W1205: a is initialised after b *)
    a := b;
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import VarSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1205",)


def check_pou(b: Body) -> None:
    """Reports names of own variables that are initialised later."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    decls = [decl for block in pou.pou.blocks for decl in block.variables]
    later = {id(decl.symbol) for decl in decls if decl.symbol is not None}
    for decl in decls:
        if decl.initial is not None and decl.initial.__class__ is not ast.Literal:
            for name in _names(decl.initial):
                symbol = name.symbol
                if isinstance(symbol, VarSymbol) and id(symbol) in later and not symbol.is_constant:
                    b.report("W1205", name.span, name=name.name)
        later.discard(id(decl.symbol))


def _names(e: ast.Expr) -> Iterator[ast.Name]:
    """Names whose value is read; the operand of ADR is not."""
    if isinstance(e, ast.Name):
        yield e
    elif isinstance(e, ast.Binary):
        yield from _names(e.left)
        yield from _names(e.right)
    elif isinstance(e, ast.Unary):
        yield from _names(e.operand)
    elif isinstance(e, (ast.Member, ast.Index)):
        yield from _names(e.base)
    elif isinstance(e, ast.Call):
        if isinstance(e.callee, ast.Name) and e.callee.name.upper() in ("ADR", "SIZEOF"):
            return
        for arg in e.args:
            if arg.value is not None:
                yield from _names(arg.value)
