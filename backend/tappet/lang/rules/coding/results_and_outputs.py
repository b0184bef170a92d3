"""A function assigns its result on every way out, and the caller takes the outputs it offers.

A function whose result no way assigns is W1209. FB_Init, FB_Exit, FB_Reinit and what else the system calls,
as its attribute says, need none. Ways end at RETURN and at the end of the body; bodies with jumps are left
out.

Source: coding guidelines of PLCopen, CP3, CP13; spec LDEC-33; CODESYS Static Analysis SA0022, SA0169.

Passes:
    @static
    FUNCTION F_Half : INT
    VAR_INPUT nValue : INT; END_VAR
    VAR_OUTPUT bCut : BOOL; END_VAR
    bCut := nValue MOD 2 <> 0;
    IF bCut THEN F_Half := (nValue - 1) / 2; RETURN; END_IF
    F_Half := nValue / 2;
    END_FUNCTION
    PROGRAM Main
    VAR nHalf : INT; bCut : BOOL; END_VAR
    nHalf := F_Half(nValue := 3, bCut => bCut);
    END_PROGRAM
Fails:
    @static
    FUNCTION F_Half : INT          (* S1421: not assigned when nValue is odd *)
    VAR_INPUT nValue : INT; END_VAR
    VAR_OUTPUT bCut : BOOL; END_VAR
    bCut := nValue MOD 2 <> 0;
    IF bCut THEN RETURN; END_IF
    F_Half := nValue / 2;
    END_FUNCTION
    PROGRAM Main
    VAR nHalf : INT; END_VAR
    nHalf := F_Half(nValue := 3);  (* S1422: bCut is not looked at *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.flow import Reaching
from tappet.lang.symbols import PouSymbol
from tappet.lang.walk import all_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1421", "S1422")
_LIFE_CYCLE = frozenset({"FB_INIT", "FB_EXIT", "FB_REINIT"})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports a result that some way out leaves alone, and calls that leave outputs out."""
    pou = b.pou
    if pou is None or pou.pou is None or not pou.pou.body:
        return
    if "S1421" in chosen and pou.kind in ("FUNCTION", "METHOD") and pou.result is not None:
        _result(b, pou, pou.pou)
    if "S1422" in chosen:
        for e in all_expressions(pou.pou.body):
            if isinstance(e, ast.Call) and isinstance(e.target, PouSymbol):
                _outputs(b, e, e.target)


def _result(b: Body, pou: PouSymbol, node: ast.Pou) -> None:
    if pou.return_type is None or pou.result is None or pou.name.upper() in _LIFE_CYCLE or node.attributes:
        return
    if any(s.label for s in statements(node.body)):
        return
    key = id(pou.result)
    reaching = Reaching([key])
    reaching.run(node.body)
    missing = [way for way in reaching.ends if key not in way.every]
    never = all(key not in way.some for way in reaching.ends)
    if missing and not (never and pou.kind == "FUNCTION"):
        b.report("S1421", node.name_span, name=pou.name.removeprefix("__get"))


def _outputs(b: Body, e: ast.Call, target: PouSymbol) -> None:
    if target.kind not in ("FUNCTION", "METHOD"):
        return
    given = {id(a.parameter) for a in e.args}
    missing = [p.name for p in target.parameters if p.section == "VAR_OUTPUT" and id(p) not in given]
    if missing:
        b.report("S1422", e.span, name=target.name, outputs=", ".join(missing))
