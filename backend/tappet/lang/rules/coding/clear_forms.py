"""What has a plain form is written in it.

Source: coding guidelines of PLCopen, CP9; CODESYS Static Analysis (size of a pointer).

Passes:
    @static
    VAR bA, bB : BOOL; nA : INT; END_VAR
    bA := nA > 1;
    bB := NOT bA;
Fails:
    @static
    VAR bA : BOOL; nA : INT; END_VAR
    IF nA > 1 THEN                 (* S1220: bA := nA > 1 *)
        bA := TRUE;
    ELSE
        bA := FALSE;
    END_IF
Fails:
    @static
    VAR nA : INT; nSize : UDINT; pA : POINTER TO INT; END_VAR
    pA := ADR(nA);
    nSize := SIZEOF(pA);           (* S1221: the size of the pointer *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Pointer
from tappet.lang.walk import own_expressions, same, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1220", "S1221")


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports roundabout statements and expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    for s in statements(b.pou.pou.body):
        if isinstance(s, ast.If) and "S1220" in chosen and len(s.branches) == 1 and _only_bool(s):
            b.report("S1220", s.span)
        if "S1221" not in chosen:
            continue
        for e in own_expressions(s):
            if isinstance(e, ast.Call) and getattr(e.callee, "name", "").upper() == "SIZEOF" and e.args:
                value = e.args[0].value
                if value is not None and isinstance(value.type, Pointer):
                    b.report("S1221", e.span, type=value.type)


def _only_bool(s: ast.If) -> bool:
    """Whether both branches assign a literal TRUE or FALSE to one variable, and nothing else."""
    one, other = s.branches[0][1], s.otherwise or []
    if len(one) != 1 or len(other) != 1:
        return False
    first, second = one[0], other[0]
    if not isinstance(first, ast.Assign) or not isinstance(second, ast.Assign):
        return False
    literals = all(isinstance(v, ast.Literal) and v.kind == "bool" for v in (first.value, second.value))
    return literals and same(first.target, second.target)
