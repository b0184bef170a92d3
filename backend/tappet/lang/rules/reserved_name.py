"""Names of IL operators are no good names: the same declaration does not compile when the body is IL.

Source: spec language_declarations.md section 9.

Passes:
    VAR nStart : INT; END_VAR
    nStart := 1;
Fails:
    VAR ST : INT; END_VAR          (* W1206: ST is an IL operator *)
    ST := 1;
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.iec import words
from tappet.lang.languages.il.operators import INSTRUCTIONS

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1206",)
_IL_OPERATORS = frozenset(
    name
    for name in INSTRUCTIONS
    if name.isalpha() and name not in (*words.KEYWORDS, *words.OPERATOR_FUNCTIONS)
)
"""Those that ST has no meaning for, so that they may be names in it."""


def check_pou(b: Body) -> None:
    """Reports variables with the name of an IL operator."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    for block in pou.pou.blocks:
        for decl in block.variables:
            if decl.name.upper() in _IL_OPERATORS and block.section not in ("VAR_INPUT", "VAR_OUTPUT"):
                b.report("W1206", decl.name_span, name=decl.name)
