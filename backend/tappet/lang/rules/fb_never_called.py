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
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, VarSymbol
from tappet.lang.types import FunctionBlock

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1121",)


def check_program(session: Session) -> None:
    """Reports instances of blocks with a body that nothing calls, passes on or takes the address of."""
    written = session.written
    for pou in session.analysis.pous:
        source = pou.source
        if source is None or source.scope is Scope.LIBRARY or pou.pou is None or not pou.pou.body:
            continue
        for block in pou.pou.blocks:
            if block.section != "VAR":
                continue
            for decl in block.variables:
                variable = decl.symbol
                if not isinstance(variable, VarSymbol) or id(variable) in written or decl.attributes:
                    continue
                type_ = None if variable.type is None else innermost(variable.type)
                if isinstance(type_, FunctionBlock) and _works_by_call(type_):
                    session.report("W1121", source.uri, decl.name_span, name=decl.name, type=type_)


def _works_by_call(type_: FunctionBlock | None) -> bool:
    body = False
    while type_ is not None:
        pou = type_.pou.symbol if type_.pou is not None else None
        if not isinstance(pou, PouSymbol) or pou.methods or pou.properties or pou.actions or pou.interfaces:
            return False
        body = body or bool(pou.pou is not None and pou.pou.body)
        type_ = type_.base
    return body
