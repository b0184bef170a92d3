"""A text is not taken apart by bytes where a character may have several of them.

A STRING holds bytes; characters beyond Latin-1, and every character beyond ASCII of a text that comes as
UTF-8 from a file, a bus or a web page, take two to four of them. This rule finds the places to look at.

Source: spec LTYP-60; CODESYS Static Analysis SA0175.

Passes:
    @static
    @references Standard
    PROGRAM Main
    VAR sA, sB : STRING; wsA : WSTRING; nA : INT; END_VAR
    sA := CONCAT(sB, 'ok');
    nA := LEN(sA);
    wsA := "äöü";
    END_PROGRAM
Fails:
    @static
    @references Standard
    PROGRAM Main
    VAR sA, sB : STRING; nA : BYTE; pA : POINTER TO BYTE; END_VAR
    sA := LEFT(sB, 3);             (* S1248: the first three bytes *)
    nA := sA[2];                   (* S1248: the third byte *)
    pA := ADR(sA);                 (* S1248: its bytes *)
    sB := 'Grün';                  (* S1248: not ASCII *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol, PouSymbol
from tappet.lang.types import String, value_type
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1248",)
_BY_PLACE = frozenset({"LEFT", "RIGHT", "MID", "INSERT", "DELETE", "REPLACE", "FIND"})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the places of a body that count bytes of a text."""
    if b.pou is None or b.pou.pou is None:
        return
    for e in all_expressions(b.pou.pou.body):
        what = _suspicious(e)
        if what:
            b.report("S1248", e.span, what=what)


def _suspicious(e: ast.Expr) -> str:
    if isinstance(e, ast.Index) and _is_bytes(e.base):
        return f"{getattr(e.base, 'name', '')}[...]"
    if isinstance(e, ast.Literal) and e.kind == "string" and not e.text.isascii():
        return e.text
    if not isinstance(e, ast.Call):
        return ""
    target = e.target
    if isinstance(target, BuiltinSymbol):
        operand = e.args[0].value if e.args else None
        return "ADR" if target.name == "ADR" and operand is not None and _is_bytes(operand) else ""
    if isinstance(target, PouSymbol) and target.name.upper() in _BY_PLACE:
        library = target.source.library if target.source is not None else None
        return target.name if library == "Standard" else ""
    return ""


def _is_bytes(e: ast.Expr) -> bool:
    type_ = value_type(e.type) if e.type is not None else None
    return isinstance(type_, String) and not type_.wide
