"""Statements that hide what happens are not used.

Source: coding guidelines of PLCopen, L10 (no CONTINUE), L17 (CASE and ELSIF end with ELSE), L18 (no EXIT),
L19 (no GOTO), L20 (one RETURN), CP13 (loops), L4 (no recursion by jumps).

Passes:
    @static
    VAR nMode, nCount : INT; END_VAR
    CASE nMode OF
        1: nCount := nCount + 1;
        2: nCount := nCount + 2;
    ELSE
        nCount := 0;
    END_CASE
Fails:
    @static
    VAR nCount : INT; END_VAR
    again: nCount := nCount + 1;
    IF nCount < 10 THEN JMP again; END_IF   (* S1201: JMP *)
Fails:
    @static
    VAR nCount : INT; END_VAR
    IF nCount > 10 THEN RETURN; END_IF
    nCount := nCount + 1;
    IF nCount > 5 THEN RETURN; END_IF   (* S1202: the second RETURN *)
    nCount := nCount + 1;
Fails:
    @static
    VAR i, nCount : INT; END_VAR
    FOR i := 1 TO 10 DO
        IF nCount > 5 THEN EXIT; END_IF   (* S1203: EXIT *)
        IF nCount > 3 THEN CONTINUE; END_IF   (* S1204: CONTINUE *)
        nCount := nCount + i;
    END_FOR
Fails:
    @static
    VAR nMode, nCount : INT; END_VAR
    CASE nMode OF                  (* S1205: no ELSE *)
        1: nCount := 1;
        2: nCount := 2;
    END_CASE
    IF nMode = 1 THEN              (* S1206: ELSIF without ELSE *)
        nCount := 1;
    ELSIF nMode = 2 THEN
        nCount := 2;
    END_IF
Fails:
    @static
    VAR nMode, nCount : INT; END_VAR
    CASE nMode OF                  (* S1207: one branch *)
        1: nCount := 1;
    ELSE
        nCount := 2;
    END_CASE
Fails:
    @static
    VAR nCount : INT; END_VAR
    WHILE nCount < 10 DO           (* S1208: WHILE *)
        nCount := nCount + 1;
    END_WHILE
Fails:
    @static
    VAR nCount : INT; END_VAR
    nCount := 1;
    ;                              (* S1209: empty *)
Fails:
    @static
    VAR nCount : INT; END_VAR
    nCount := 1;
    RETURN;                        (* S1210: at the end *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Enum
from tappet.lang.walk import statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1201", "S1202", "S1203", "S1204", "S1205", "S1206", "S1207", "S1208", "S1209", "S1210")
_SIMPLE = {ast.Jump: "S1201", ast.Exit: "S1203", ast.Continue: "S1204", ast.While: "S1208"}


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the statements of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    body = b.pou.pou.body
    returns = 0
    limit = b.session.options.static.settings.returns
    for s in statements(body):
        code = _SIMPLE.get(s.__class__, "")
        fields: dict[str, object] = {}
        if isinstance(s, ast.Return):
            returns += 1
            if s is body[-1]:
                code = "S1210"
            elif returns > limit:
                code, fields = "S1202", {"limit": limit}
        elif isinstance(s, ast.Case):
            if s.otherwise is None and not isinstance(s.selector.type, Enum):
                code = "S1205"
            elif len(s.branches) < 2:
                code = "S1207"
        elif isinstance(s, ast.If) and len(s.branches) > 1 and s.otherwise is None:
            code = "S1206"
        if code and code in chosen:
            b.report(code, s.span, **fields)
    if "S1209" in chosen:
        for s in body:
            if s.__class__ is ast.Empty and s.label is None:
                b.report("S1209", s.span)
