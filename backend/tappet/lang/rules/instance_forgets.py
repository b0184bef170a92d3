"""An instance of a function block lives longer than one call.

Variables of functions and methods are new in each call: a timer or an edge detection declared there never
works.

Source: spec LDEC-24, LST-22.

Passes:
    FUNCTION_BLOCK FB_Delay
    VAR_INPUT bIn : BOOL; END_VAR
    VAR bLast : BOOL; END_VAR
    bLast := bIn;
    END_FUNCTION_BLOCK
    FUNCTION F : BOOL
    VAR_STAT fbDelay : FB_Delay; END_VAR
    fbDelay(bIn := TRUE);
    F := TRUE;
    END_FUNCTION
Fails:
    FUNCTION_BLOCK FB_Delay
    VAR_INPUT bIn : BOOL; END_VAR
    VAR bLast : BOOL; END_VAR
    bLast := bIn;
    END_FUNCTION_BLOCK
    FUNCTION F : BOOL
    VAR fbDelay : FB_Delay; END_VAR   (* W1221: forgets everything *)
    fbDelay(bIn := TRUE);
    F := TRUE;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.types import FunctionBlock

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1221",)
OWN_CODE_ONLY = True


def check_pou(b: Body) -> None:
    """Reports instances of blocks with a body in VAR of functions and methods, and in VAR_TEMP."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    short = pou.kind in ("FUNCTION", "METHOD")
    for block in pou.pou.blocks:
        if block.section != "VAR_TEMP" and not (short and block.section == "VAR"):
            continue
        for decl in block.variables:
            type_ = getattr(decl.symbol, "type", None)
            if isinstance(type_, FunctionBlock) and type_.pou is not None and type_.pou.body:
                b.report("W1221", decl.name_span, name=decl.name, type=type_)
