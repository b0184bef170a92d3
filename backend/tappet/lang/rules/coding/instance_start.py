"""FB_Init sets up its own instance only; results are small and structures without gaps.

FB_Init runs before other instances and lists have their values, and before a derived block has been set up.

Source: coding guidelines of PLCopen, CP3; CODESYS Static Analysis SA0015, SA0016, SA0023, SA0106.

Passes:
    @static
    TYPE ST_Pair : STRUCT nA, nB : INT; END_STRUCT END_TYPE
    FUNCTION_BLOCK FB_Motor
    VAR nNumber : INT; stPair : ST_Pair; END_VAR
    METHOD FB_Init : BOOL
    VAR_INPUT bInitRetains, bInCopyCode : BOOL; nGiven : INT; END_VAR
    nNumber := nGiven;
    END_METHOD
    stPair.nA := nNumber;
    END_FUNCTION_BLOCK
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL gCount : INT; END_VAR
    @source FB_Motor
    FUNCTION_BLOCK FB_Motor
    VAR nNumber : INT; END_VAR
    METHOD FB_Init : BOOL
    VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
    nNumber := gCount;             (* S1419: a global variable *)
    Prepare();                     (* S1420: a derived block may replace it *)
    END_METHOD
    METHOD Prepare
    nNumber := 1;
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    @static
    TYPE ST_Mixed : STRUCT bA : BOOL; nB : LINT; END_STRUCT END_TYPE   (* S1116: 7 bytes between them *)
Fails:
    @static
    TYPE ST_Large : STRUCT aA : ARRAY[1..100] OF INT; END_STRUCT END_TYPE
    FUNCTION F_Large : ST_Large    (* S1117: 200 bytes are copied *)
    F_Large.aA[1] := 1;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol
from tappet.lang.types import Struct
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1116", "S1117", "S1419", "S1420")
_LARGE = 64
"""Bytes of a result from which a VAR_IN_OUT is better."""


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports what FB_Init reaches outside its instance, and large results."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    result = pou.return_type
    if "S1117" in chosen and result is not None and result.size > _LARGE and not pou.name.startswith("__"):
        b.report("S1117", pou.pou.name_span, name=pou.name, size=result.size)
    if pou.name.upper() != "FB_INIT" or pou.owner is None:
        return
    for e in all_expressions(pou.pou.body):
        if isinstance(e, (ast.Name, ast.Member)) and isinstance(e.symbol, VarSymbol):
            outside = e.symbol.home is Storage.GLOBAL and e.symbol.section == "VAR_GLOBAL"
            if outside and not e.symbol.is_constant and "S1419" in chosen:
                b.report("S1419", e.span, name=e.name)
        elif isinstance(e, ast.Call) and "S1420" in chosen and _may_be_replaced(e, pou.owner):
            b.report("S1420", e.span, name=getattr(e.target, "name", ""))


def _may_be_replaced(e: ast.Call, owner: PouSymbol) -> bool:
    """Whether a call of an own method can reach that of a derived block."""
    method = e.target
    base = e.callee.base if isinstance(e.callee, ast.Member) else None
    if not isinstance(method, PouSymbol) or method.kind != "METHOD" or method.owner is not owner:
        return False
    if isinstance(base, ast.Deref) and isinstance(base.base, ast.Super):
        return False
    return method.pou is not None and "FINAL" not in method.pou.modifiers and method.pou.access != "PRIVATE"


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports structures with unused bytes between their members."""
    if "S1116" not in session.options.static.codes:
        return
    for decl in unit.declarations:
        type_ = decl.type if isinstance(decl, ast.TypeDecl) else None
        if not isinstance(type_, Struct) or type_.union:
            continue
        end = 0
        for member in type_.members.values():
            if member.offset > end:
                session.report(
                    "S1116",
                    unit.source.uri,
                    decl.name_span,
                    name=type_.name,
                    gap=member.offset - end,
                    member=member.name,
                )
                break
            end = member.offset + (1 if member.bit is not None else member.type.size)
