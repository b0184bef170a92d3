"""A body can be followed by a reader.

Every break of the straight way counts 1 (IF, ELSIF, ELSE, CASE, a loop, a jump, each change between AND and
OR), and those inside others 1 more for each level around them: what is nested is harder to follow than what
stands in a row. McCabe's number (S1302) counts ways and not levels.

Source: cognitive complexity after G. A. Campbell (2018); CODESYS Static Analysis SA0178.

Passes:
    @static
    VAR nA : INT; END_VAR
    IF nA > 1 THEN nA := 0; END_IF
    IF nA > 2 THEN nA := 1; END_IF
Fails:
    @static
    PROGRAM Main                   (* S1306: 21 *)
    VAR nA : INT; END_VAR
    IF nA > 1 THEN
        IF nA > 2 THEN
            IF nA > 3 THEN
                IF nA > 4 THEN
                    IF nA > 5 THEN
                        IF nA > 6 THEN nA := 0; END_IF
                    END_IF
                END_IF
            END_IF
        END_IF
    END_IF
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import BOOL
from tappet.lang.walk import bodies, own_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1306",)
_LOGIC = frozenset({"AND", "OR", "XOR", "AND_THEN", "OR_ELSE"})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Measures a body and reports it beyond the limit."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    limit = b.session.options.static.settings.cognitive
    count = cognitive_complexity(pou.pou.body)
    if count > limit:
        b.report("S1306", pou.pou.name_span, name=pou.name, count=count, limit=limit)


def cognitive_complexity(body: list[ast.Stmt], level: int = 0) -> int:
    """How hard a list of statements is to follow, `level` statements deep."""
    count = 0
    for s in body:
        count += sum(_is_change(e) for e in own_expressions(s))
        if isinstance(s, ast.If):
            count += level + len(s.branches) + (s.otherwise is not None)
        elif isinstance(s, (ast.Case, ast.For, ast.While, ast.RepeatUntil)):
            count += level + 1
        elif isinstance(s, ast.Jump):
            count += 1
        for part in bodies(s):
            count += cognitive_complexity(part, level + 1)
    return count


def _is_change(e: ast.Expr) -> bool:
    """Whether a logical operation begins a row of its own: `a AND b AND c` is one."""
    if not isinstance(e, ast.Binary) or e.op not in _LOGIC or e.type != BOOL:
        return False
    return not (isinstance(e.left, ast.Binary) and e.left.op == e.op)
