"""FB_Init begins with its two fixed inputs, FB_Exit has one, FB_Reinit none.

Source: spec LDEC-100..LDEC-105.

Passes:
    FUNCTION_BLOCK FB
    METHOD FB_Init : BOOL
    VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; END_VAR
    FB_Init := TRUE;
    END_METHOD
    METHOD FB_Exit : BOOL
    VAR_INPUT bInCopyCode : BOOL; END_VAR
    FB_Exit := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    METHOD FB_Init : BOOL          (* E0434: the fixed inputs are missing *)
    VAR_INPUT nStart : INT; END_VAR
    FB_Init := TRUE;
    END_METHOD
    METHOD FB_Reinit : BOOL        (* E0445: nobody passes it anything *)
    VAR_INPUT nStart : INT; END_VAR
    FB_Reinit := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.types import BOOL

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("E0434", "E0445")
_HEADS = {
    "FB_INIT": "bInitRetains : BOOL; bInCopyCode : BOOL",
    "FB_EXIT": "bInCopyCode : BOOL",
}


def check_program(session: Session) -> None:
    """Checks the first inputs of FB_Init and FB_Exit, whose names are free, and that FB_Reinit has none."""
    for pou in session.analysis.pous:
        reinit = pou.methods.get("FB_REINIT")
        if reinit is not None and reinit.parameters and reinit.source is not None and reinit.span is not None:
            session.report("E0445", reinit.source.uri, reinit.span, name=reinit.name)
        for key, head in _HEADS.items():
            method = pou.methods.get(key)
            if method is None or method.source is None or method.span is None:
                continue
            count = head.count(":")
            inputs = [p for p in method.parameters if p.section == "VAR_INPUT"]
            if len(inputs) < count or any(p.type is not None and p.type != BOOL for p in inputs[:count]):
                session.report("E0434", method.source.uri, method.span, name=method.name, head=head)
