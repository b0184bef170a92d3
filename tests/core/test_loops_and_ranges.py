"""Which checks are dropped, which variables live in registers, and which must not."""

from __future__ import annotations

import pytest

from tappet.core import ir, passes
from tappet.core.lower import lower
from tappet.core.walk import visit
from tappet.iec.task import Task
from tappet.lang.analysis.run import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

HEAD = """
FUNCTION Pure : INT VAR_INPUT n : INT; END_VAR Pure := n + 1; END_FUNCTION
FUNCTION Nosy : INT Nosy := PLC_PRG.i; END_FUNCTION
FUNCTION_BLOCK FB VAR_OUTPUT q : INT; END_VAR q := q + 1; END_FUNCTION_BLOCK
INTERFACE I_S
METHOD Deaf : INT END_METHOD
METHOD Listen : INT END_METHOD
END_INTERFACE
FUNCTION_BLOCK FB_S IMPLEMENTS I_S
VAR k : INT; END_VAR
METHOD Deaf : INT k := k + 1; Deaf := k; END_METHOD
METHOD Listen : INT Listen := 1; END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_T EXTENDS FB_S
METHOD Listen : INT Listen := PLC_PRG.x; END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    s : FB_S; t : FB_T; any : I_S;
    a : ARRAY [0..9] OF INT; b : ARRAY [1..10] OF INT; big : ARRAY [0..255] OF INT;
    last : ARRAY [0..32767] OF BYTE;
    i, n, x : INT; u : USINT; w : WORD; f : FB; p : POINTER TO INT; di : DINT; r : REFERENCE TO INT;
END_VAR
"""


def lowered(body: str) -> ir.Function:
    unit = parse(Source("a", HEAD + body + "\nEND_PROGRAM"))
    analysis = analyse([unit.unit])
    assert [str(d) for d in [*unit.diagnostics, *analysis.diagnostics] if d.severity == "error"] == []
    module = lower(analysis, [Task("T", programs=("PLC_PRG",))]).module
    passes.run(module)
    return module.functions["PLC_PRG"]


def checks(function: ir.Function) -> int:
    """Bounds checks that are left."""
    found: set[int] = set()

    def note(node: ir.Expr | ir.Stmt) -> None:
        places = [getattr(node, n) for n in ("place", "target", "source") if hasattr(node, n)]
        for place in places:
            if isinstance(place, ir.Place):
                found.update(id(s) for s in place.subscripts if s.checked)
        if isinstance(node, ir.CheckIndex) and node.subscript.checked:
            found.add(id(node.subscript))

    visit(function.body, note)
    return len(found)


@pytest.mark.parametrize(
    ("body", "left"),
    [
        ("FOR i := 0 TO 9 DO a[i] := 1; END_FOR", 0),
        ("FOR i := 0 TO 8 DO a[i + 1] := a[i]; b[i + 2] := b[9 - i]; END_FOR", 0),
        ("FOR i := 9 TO 0 BY -3 DO a[i] := 1; END_FOR", 0),
        ("FOR i := 0 TO 10 DO a[i] := 1; END_FOR", 1),
        ("FOR i := 0 TO n DO a[i] := 1; END_FOR", 1),
        ("FOR i := 0 TO MIN(n, 9) DO a[i] := 1; END_FOR", 0),
        ("FOR i := 0 TO 9 DO a[i] := 1; i := i + n; END_FOR", 1),
        ("n := 32767; FOR i := 0 TO n DO last[i] := 1; END_FOR", 1),
        ("FOR i := 0 TO 9 DO r REF= i; r := 20; a[i] := 1; END_FOR", 1),
        ("a[ABS(n) MOD 10] := 1;", 1),
        ("a[u MOD 10] := 1;", 0),
        ("a[n MOD 10] := 1;", 1),
        ("a[w AND 7] := 1;", 0),
        ("big[u] := 1;", 0),
        ("big[SHR(w, 8)] := 1;", 0),
        ("a[u / 26] := 1;", 0),
        ("b[LIMIT(1, n, 10)] := 1;", 0),
        ("b[SEL(n > 3, 1, 10)] := 1;", 0),
        ("FOR i := 0 TO 9 DO a[i] := 1; END_FOR a[i] := 2;", 1),
    ],
)
def test_checks_left(body: str, left: int):
    assert checks(lowered(body)) == left


def promoted(function: ir.Function) -> set[int]:
    found: set[int] = set()

    def note(node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Promoted):
            found.update(home.offset for home, _, _, _ in node.variables)

    visit(function.body, note)
    return found


@pytest.mark.parametrize(
    ("body", "count"),
    [
        ("FOR i := 0 TO 9 DO a[i] := i; END_FOR", 1),
        ("FOR i := 0 TO 9 DO x := x + Pure(i); END_FOR", 2),
        ("FOR i := 0 TO 9 DO f(); x := x + f.q; END_FOR", 2),
        ("FOR i := 0 TO 9 DO x := x + Nosy(); END_FOR", 0),
        ("any := s; FOR i := 0 TO 9 DO x := x + any.Deaf(); END_FOR", 3),
        ("any := s; FOR i := 0 TO 9 DO x := x + any.Listen(); END_FOR", 0),
        ("p := ADR(x); FOR i := 0 TO 9 DO p^ := p^ + x; END_FOR", 2),
        ("p := ADR(x); WHILE x < 5 DO p^ := p^ + 1; END_WHILE", 1),
        ("WHILE n < 5 DO n := n + 1; IF n = 3 THEN RETURN; END_IF END_WHILE", 1),
        ("again: n := n + 1; IF n < 3 THEN JMP again; END_IF", 0),
        ("FOR i := 0 TO 3 DO FOR n := 0 TO 3 DO x := x + a[n]; END_FOR END_FOR", 3),
    ],
)
def test_variables_kept_in_registers(body: str, count: int):
    assert len(promoted(lowered(body))) == count
