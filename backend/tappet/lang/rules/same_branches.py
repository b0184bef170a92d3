"""The branches of an IF or CASE do different things.

Source: spec LST-25.

Passes:
    VAR a : BOOL; n : INT; END_VAR
    IF a THEN n := 1; ELSE n := 2; END_IF
Fails:
    VAR a : BOOL; n : INT; END_VAR
    IF a THEN n := 1; ELSE n := 1; END_IF   (* W1132: both do the same *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.walk import same

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1132",)
NODES = (ast.If,)


def check_statement(b: Body, s: ast.If) -> None:
    """Reports an IF with ELSE whose branches are all the same."""
    if not s.otherwise:
        return
    first = s.branches[0][1]
    if all(same(body, first) for _, body in s.branches[1:]) and same(s.otherwise, first):
        b.report("W1132", s.branches[0][0].span)
