"""An instance of a function block is called.

Without a call its inputs are not evaluated and its outputs keep their initial values. Blocks with methods
may work without a call of their body and are left out.

Source: spec LST-22.

Passes:
    FUNCTION_BLOCK FB_Delay
    VAR_INPUT bIn : BOOL; END_VAR
    VAR_OUTPUT bOut : BOOL; END_VAR
    bOut := bIn;
    END_FUNCTION_BLOCK
    PROGRAM P
    VAR fbDelay : FB_Delay; b : BOOL; END_VAR
    fbDelay(bIn := TRUE);
    b := fbDelay.bOut;
    END_PROGRAM
Fails:
    FUNCTION_BLOCK FB_Delay
    VAR_INPUT bIn : BOOL; END_VAR
    VAR_OUTPUT bOut : BOOL; END_VAR
    bOut := bIn;
    END_FUNCTION_BLOCK
    PROGRAM P
    VAR fbDelay : FB_Delay; b : BOOL; END_VAR   (* W1121: fbDelay is never called *)
    b := fbDelay.bOut;
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.parts import innermost
from tappet.lang.symbols import PouSymbol, VarSymbol
from tappet.lang.types import FunctionBlock

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1121",)


def check_variables(session: Session, pou: PouSymbol) -> None:
    """Reports instances of blocks with a body that nothing calls, passes on or takes the address of."""
    assert pou.pou is not None
    assert pou.source is not None
    if not pou.pou.body:
        return
    for block in pou.pou.blocks:
        if block.section != "VAR":
            continue
        for decl in block.variables:
            variable = decl.symbol
            if not isinstance(variable, VarSymbol) or id(variable) in session.written or decl.attributes:
                continue
            type_ = None if variable.type is None else innermost(variable.type)
            if isinstance(type_, FunctionBlock) and _works_by_call(type_):
                session.report("W1121", pou.source.uri, decl.name_span, name=decl.name, type=type_)


def _works_by_call(type_: FunctionBlock | None) -> bool:
    body = False
    while type_ is not None:
        pou = type_.pou.symbol if type_.pou is not None else None
        if not isinstance(pou, PouSymbol) or pou.methods or pou.properties or pou.actions or pou.interfaces:
            return False
        body = body or bool(pou.pou is not None and pou.pou.body)
        type_ = type_.base
    return body
