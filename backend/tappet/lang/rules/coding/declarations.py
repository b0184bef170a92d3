"""Declarations say what is needed, and in the right place.

Source: coding guidelines of PLCopen, CP3 (initial values), CP22 (no absolute addresses), CP24 (no global
variables beyond need), E1..E3 (extensions).

Passes:
    @static
    @source GVL_Data
    VAR_GLOBAL bLamp AT %QX0.0 : BOOL; END_VAR
Fails:
    @static
    VAR bLamp AT %MX0.0 : BOOL; END_VAR   (* S1103: marker memory *)
    bLamp := TRUE;
Fails:
    @static
    VAR bLamp AT %QX0.0 : BOOL; END_VAR   (* S1104: an address in a program *)
    bLamp := TRUE;
Fails:
    @static
    FUNCTION_BLOCK FB_Text
    VAR_INPUT sText : STRING(200); END_VAR   (* S1105: copied in each call *)
    VAR nLength : INT; END_VAR
    nLength := SIZEOF(sText);
    END_FUNCTION_BLOCK
Fails:
    @static
    VAR pData : POINTER TO INT; n1 : INT; END_VAR   (* S1106: a pointer *)
    pData := ADR(n1);
Fails:
    @static
    VAR nA, nB : INT; END_VAR      (* S1108: two variables in one declaration *)
    nA := nB;
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Array, Pointer, String, Struct

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1103", "S1104", "S1105", "S1106", "S1108")
_LARGE = 64
"""Bytes of an input from which a VAR_IN_OUT CONSTANT is better."""


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the declarations of a POU."""
    if b.pou is None or b.pou.pou is None:
        return
    for block in b.pou.pou.blocks:
        last: ast.TypeRef | None = None
        for decl in block.variables:
            type_ = getattr(decl.symbol, "type", None)
            address = decl.address or ""
            codes: list[str] = []
            if address.startswith("%M"):
                codes.append("S1103")
            elif address and "*" not in address:
                codes.append("S1104")
            if (
                block.section == "VAR_INPUT"
                and isinstance(type_, (String, Struct, Array))
                and type_.size > _LARGE
            ):
                codes.append("S1105")
            if isinstance(type_, Pointer):
                codes.append("S1106")
            if decl.type_ref is last or (last is not None and decl.type_ref.span == last.span):
                codes.append("S1108")
            last = decl.type_ref
            for code in codes:
                if code in chosen:
                    b.report(code, decl.name_span, name=decl.name, address=address, type=type_)
