"""Variables that loops keep in registers, and instances that are reached through something else meanwhile."""

from __future__ import annotations

import pytest
from compiled_programs import build
from linked_application import loaded

TEXT = """
FUNCTION_BLOCK FB
VAR_INPUT n : DINT; END_VAR
VAR i : INT; leaf : FB_Leaf; p : POINTER TO DINT; self : POINTER TO FB; END_VAR
METHOD Inc
n := n + 1;
END_METHOD
METHOD Loop
FOR i := 0 TO 9 DO n := n + 1; Inc(); END_FOR
END_METHOD
METHOD LoopBySelf
self := THIS;
FOR i := 0 TO 9 DO n := n + 1; self^.Inc(); END_FOR
END_METHOD
METHOD LoopOverLeaf
p := leaf.Where();
FOR i := 0 TO 9 DO leaf.n := leaf.n + 1; p^ := 100 + i; END_FOR
n := leaf.n;
END_METHOD
METHOD LoopInLeaf
leaf.Loop(ADR(leaf.n));
n := leaf.n;
END_METHOD
METHOD Where : POINTER TO DINT
Where := ADR(n);
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Leaf
VAR_INPUT n : DINT; END_VAR
VAR i : INT; END_VAR
METHOD Where : POINTER TO DINT
Where := ADR(n);
END_METHOD
METHOD Loop
VAR_INPUT p : POINTER TO DINT; END_VAR
FOR i := 0 TO 9 DO n := n + 1; p^ := 100 + i; END_FOR
END_METHOD
END_FUNCTION_BLOCK
FUNCTION ByInOut : DINT
VAR_IN_OUT f : FB; END_VAR
f.Inc();
END_FUNCTION
FUNCTION ByPointer : DINT
VAR_INPUT f : POINTER TO FB; END_VAR
f^.Inc();
END_FUNCTION
PROGRAM PLC_PRG
VAR fb : FB; p : POINTER TO FB; r : REFERENCE TO FB; pn : POINTER TO DINT; i : INT; END_VAR
p := ADR(fb); r REF= fb;
%s
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("body", "n"),
    [
        ("FOR i := 0 TO 9 DO fb.n := fb.n + 1; p^.Inc(); END_FOR", 20),
        ("FOR i := 0 TO 9 DO fb.n := fb.n + 1; r.Inc(); END_FOR", 20),
        ("FOR i := 0 TO 9 DO fb.n := fb.n + 1; ByInOut(fb); END_FOR", 20),
        ("FOR i := 0 TO 9 DO fb.n := fb.n + 1; ByPointer(p); END_FOR", 20),
        ("FOR i := 0 TO 9 DO fb.n := fb.n + 1; r.n := r.n + 1; END_FOR", 20),
        ("pn := fb.Where(); FOR i := 0 TO 9 DO fb.n := fb.n + 1; pn^ := 100 + i; END_FOR", 109),
        ("fb.Loop();", 20),
        ("fb.LoopBySelf();", 20),
        ("fb.LoopOverLeaf();", 109),
        ("fb.LoopInLeaf();", 109),
    ],
)
def test_every_way_to_an_instance_is_seen(body: str, n: int):
    text = TEXT % body
    if "pn := " in body or "Loop" in body:
        text = text.replace("p := ADR(fb); r REF= fb;", "")
    with loaded(build(text)) as application:
        application.cycle()
        assert application.read("PLC_PRG.fb.n") == n


def test_variables_of_a_program_by_its_address():
    text = """
    PROGRAM Other
    VAR_INPUT n : DINT; END_VAR
    END_PROGRAM
    PROGRAM PLC_PRG
    VAR p : POINTER TO DINT; i : INT; END_VAR
    p := ADR(Other);
    FOR i := 0 TO 9 DO Other.n := Other.n + 1; p^ := 100 + i; END_FOR
    END_PROGRAM
    """
    with loaded(build(text)) as application:
        application.cycle()
        assert application.read("Other.n") == 109
