"""Bodies are small enough to be understood.

Source: coding guidelines of PLCopen, CP14 (nesting), CP20 (complexity), CP23 (number of parameters), N/A
length.

Passes:
    @static
    VAR nCount : INT; END_VAR
    IF nCount > 1 THEN nCount := 0; END_IF
Fails:
    @static
    VAR n1 : INT; END_VAR
    IF n1 > 1 THEN IF n1 > 2 THEN IF n1 > 10 THEN IF n1 > 100 THEN
        IF n1 > 1000 THEN          (* S1301: the fifth level *)
        n1 := 0;
    END_IF END_IF END_IF END_IF END_IF
Fails:
    @static
    VAR b1, b2 : BOOL; n1 : INT; END_VAR
    IF b1 AND b2 OR b1 THEN n1 := 1; END_IF   (* S1302: many decisions *)
    IF b1 AND b2 OR b1 THEN n1 := 2; END_IF
    IF b1 AND b2 OR b1 THEN n1 := 1; END_IF
    IF b1 AND b2 OR b1 THEN n1 := 2; END_IF
    IF b1 AND b2 OR b1 THEN n1 := 1; END_IF
Fails:
    @static
    FUNCTION F_Many : INT          (* S1303: too many parameters *)
    VAR_INPUT n0, n1, n2, n3, n4, n5, n6, n7, n8, n9, n10 : INT; END_VAR
    F_Many := n0;
    END_FUNCTION
Fails:
    @static
    PROGRAM Unused                 (* S1305: no statement *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import BOOL
from tappet.lang.walk import bodies, own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1301", "S1302", "S1303", "S1304", "S1305")
_PARAMETERS = frozenset({"VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"})
_DECIDING = (ast.While, ast.RepeatUntil, ast.For)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Measures a body and reports what is beyond the limits."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    node = pou.pou
    limits = b.session.options.static.settings
    measured = {
        "S1302": (1 + _decisions(node.body), limits.complexity),
        "S1303": (sum(p.section in _PARAMETERS for p in pou.parameters), limits.parameters),
        "S1304": (sum(1 for _ in statements(node.body)), limits.statements),
    }
    for code, (count, limit) in measured.items():
        if count > limit and code in chosen:
            b.report(code, node.name_span, name=pou.name, count=count, limit=limit)
    if "S1301" in chosen:
        _nesting(b, node.body, 1)
    empty = not node.body and not pou.methods and node.kind in ("PROGRAM", "ACTION")
    if empty and "S1305" in chosen:
        b.report("S1305", node.name_span, name=pou.name)


def _decisions(body: list[ast.Stmt]) -> int:
    count = 0
    for s in statements(body):
        if isinstance(s, (ast.If, ast.Case)):
            count += len(s.branches)
        elif isinstance(s, _DECIDING):
            count += 1
        for e in own_expressions(s):
            if isinstance(e, ast.Binary) and e.type == BOOL:
                count += e.op in ("AND", "OR", "AND_THEN", "OR_ELSE")
    return count


def _nesting(b: Body, body: list[ast.Stmt], depth: int) -> None:
    limit = b.session.options.static.settings.nesting
    for s in body:
        inner = bodies(s)
        if inner and depth > limit:
            b.report("S1301", s.span, depth=depth, limit=limit)
            return
        for part in inner:
            _nesting(b, part, depth + 1)
