"""Objects and their interfaces are explained.

Source: coding guidelines of PLCopen, C1 (comments describe the intent), C2 (all elements are commented).

Passes:
    @static
    // Adds two numbers.
    FUNCTION F_Add : INT
    VAR_INPUT
        nLeft : INT; // first number
        nRight : INT; // second number
    END_VAR
    F_Add := nLeft + nRight;
    END_FUNCTION
Fails:
    @static
    FUNCTION F_Add : INT           (* S1101: no comment above *)
    VAR_INPUT
        nLeft : INT;

        nRight : INT;
    END_VAR
    F_Add := nLeft + nRight;
    END_FUNCTION
Fails:
    @static
    // Adds two numbers.
    FUNCTION F_Add : INT
    VAR_INPUT nLeft : INT; nRight : INT; END_VAR
    F_Add := nLeft + nRight;
    END_FUNCTION
    (* S1102: the inputs have no comment *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1101", "S1102")
_INTERFACE = frozenset({"VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports objects and inputs, outputs, in-outs without a comment."""
    pou = b.pou
    if pou is None or pou.pou is None or not pou.pou.name or pou.name.startswith("__"):
        return
    if "S1101" in chosen and not pou.pou.comment and pou.owner is None:
        b.report("S1101", pou.pou.name_span, name=pou.name)
    if "S1102" in chosen:
        for block in pou.pou.blocks:
            if block.section in _INTERFACE:
                for decl in block.variables:
                    if not decl.comment:
                        b.report("S1102", decl.name_span, name=decl.name)
