"""A function block writes its outputs.

Source: spec LDEC-22.

Passes:
    FUNCTION_BLOCK FB_Sum
    VAR_INPUT a, b : INT; END_VAR
    VAR_OUTPUT s : INT; END_VAR
    s := a + b;
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB_Sum
    VAR_INPUT a, b : INT; END_VAR
    VAR_OUTPUT s : INT; END_VAR    (* W1116: never written *)
    VAR t : INT; END_VAR
    t := a + b;
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.symbols import PouSymbol
from tappet.lang.types import Elementary

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1116",)


def check_variables(session: Session, pou: PouSymbol) -> None:
    """Reports outputs of simple type without initial value that no code writes."""
    assert pou.pou is not None
    assert pou.source is not None
    if not pou.pou.body:
        return
    for variable in pou.parameters:
        if (
            variable.section == "VAR_OUTPUT"
            and variable.owner == pou.qualified_name
            and isinstance(variable.type, Elementary)
            and variable.decl is not None
            and variable.decl.initial is None
            and variable.span is not None
            and id(variable) not in session.written
        ):
            session.report("W1116", pou.source.uri, variable.span, name=variable.name)
