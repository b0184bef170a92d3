"""Reads and assignments by the flow of control: branches, loops, early ends (W1134, W1135, S1222)."""

from __future__ import annotations

import pytest
from sample_stage import diagnose

CODES = ("W1134", "W1135", "S1222")
HEAD = """@static
FUNCTION F : INT
VAR_INPUT x : INT; END_VAR
VAR_IN_OUT io : INT; END_VAR
VAR n, m, i : INT; b : BOOL; p : POINTER TO INT; END_VAR
"""
HEAD_LINES = HEAD.count("\n") - 1


def messages(body: str) -> list[tuple[str, int]]:
    found = diagnose(f"{HEAD}{body}\nEND_FUNCTION")
    return [(d.code, d.span.line + 1 - HEAD_LINES) for d in found if d.code in CODES]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("F := n;\nn := 1;\nF := n;", [("W1134", 1)]),
        ("IF x > 1 THEN n := 1; END_IF\nF := n;", [("S1222", 2)]),
        ("IF x > 1 THEN n := 1; ELSE n := 2; END_IF\nF := n;", []),
        ("IF x > 1 THEN n := 1; ELSE RETURN; END_IF\nF := n;", []),
        ("IF x > 1 THEN n := 1; F := n; RETURN; END_IF\nF := n;", [("W1134", 2)]),
        ("CASE x OF\n1: n := 1;\n2: n := 2;\nEND_CASE\nF := n;", [("S1222", 5)]),
        ("CASE x OF\n1: n := 1;\nELSE n := 2;\nEND_CASE\nF := n;", []),
        ("WHILE m < x DO m := m + 1; END_WHILE\nF := m;", [("S1222", 1)]),
        ("m := x - 1;\nWHILE m < x DO m := m + 1; n := m; END_WHILE\nF := n;", [("S1222", 3)]),
        ("REPEAT n := x; UNTIL n > 3 END_REPEAT\nF := n;", []),
        ("REPEAT IF x > 1 THEN EXIT; END_IF\nn := x; UNTIL n > 3 END_REPEAT\nF := n;", [("S1222", 3)]),
        ("REPEAT IF x > 1 THEN CONTINUE; END_IF\nn := x; UNTIL n > 3 END_REPEAT\nF := 1;", [("S1222", 2)]),
        ("FOR i := 1 TO x DO\nIF i > 1 THEN F := n; END_IF\nn := i;\nEND_FOR", [("S1222", 2)]),
        ("FOR i := 1 TO x DO F := i; END_FOR\nF := F + i;", []),
        ("FOR i := 1 TO 3 DO n := i; END_FOR\nF := n;", []),
        ("FOR i := 3 TO 1 DO n := i; END_FOR\nF := n;", [("S1222", 2)]),
        ("FOR i := 3 TO 1 BY -1 DO IF x > i THEN EXIT; END_IF\nn := i; END_FOR\nF := n;", [("S1222", 3)]),
        ("WHILE TRUE DO\nn := x;\nIF n > 3 THEN EXIT; END_IF\nEND_WHILE\nF := n;", []),
        ("p := ADR(n);\np^ := 3;\nF := n;", []),
        ("n.3 := TRUE;\nF := n;", []),
        ("F := n := x;\nF := F + n;", []),
        ("b S= x > 1;\nIF b THEN F := 1; END_IF", []),
        ("__TRY n := x; __FINALLY m := 1; __ENDTRY\nF := n;", []),  # a fault does not lead here
        ("__TRY n := x; __CATCH m := 1; __ENDTRY\nF := n;", [("S1222", 2)]),
        ("__TRY m := x; __CATCH RETURN; __ENDTRY\nF := m;", []),
        ("__TRY n := x;\n__FINALLY F := n; __ENDTRY", [("S1222", 2)]),
        ("__TRY m := 1; __FINALLY n := x; __ENDTRY\nF := n;", []),
        ("FOR i := 1 TO 3 DO\n__TRY EXIT; __FINALLY n := x; __ENDTRY\nEND_FOR\nF := n;", []),
    ],
)
def test_reads(body: str, expected: list[tuple[str, int]]) -> None:
    assert [entry for entry in messages(body) if entry[0] != "W1135"] == expected


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ("n := x;\nF := 1;", [1]),
        ("n := x;\nF := n;\nn := 2 * x;", [3]),
        ("n := 0;\nn := x;\nF := n;", []),  # a constant to begin with
        ("n := x + 1;\nIF x > 1 THEN n := x; ELSE n := 2 * x; END_IF\nF := n;", [1]),
        ("n := x + 1;\nIF x > 1 THEN n := x; END_IF\nF := n;", []),
        ("n := x;\nIF x > 1 THEN n := x + 1; RETURN; END_IF\nF := n;", [2]),
        ("n := x;\nFOR i := 1 TO x DO\nF := F + n;\nn := i;\nEND_FOR", []),
        ("FOR i := 1 TO x DO\nn := i;\nEXIT;\nEND_FOR\nF := n;", []),
        ("FOR i := 1 TO x DO\nn := i + 1;\nn := i + 2;\nF := n;\nEND_FOR", [2]),
        ("n := x;\nWHILE n > 1 DO\nn := n - 1;\nEND_WHILE\nF := 1;", []),
        ("REPEAT\nm := x;\nn := m;\nUNTIL n > 3 END_REPEAT\nF := 1;", []),
        ("n := x;\np := ADR(n);\nF := p^;", []),
        ("n := x;\nG(n);\nEND_FUNCTION\nFUNCTION G : INT\nVAR_IN_OUT v : INT; END_VAR\nv := 1;", []),
        ("CASE x OF\n1: n := x;\n2: n := x + 1;\nRETURN;\nEND_CASE\nF := n;", [3]),
    ],
)
def test_assignments_that_nothing_reads(body: str, lines: list[int]) -> None:
    assert [line for code, line in messages(body) if code == "W1135"] == lines


def test_a_body_with_jumps_is_left_out() -> None:
    assert messages("again: IF x > n THEN n := x; JMP again; END_IF\nm := x;") == []


def test_temporary_variables_of_blocks() -> None:
    variables = "VAR_TEMP t : INT; END_VAR\nVAR k : INT; END_VAR"
    text = f"FUNCTION_BLOCK FB\n{variables}\nk := k + t;\nt := k;\nEND_FUNCTION_BLOCK"
    assert [d.code for d in diagnose(text) if d.code in CODES] == ["W1134", "W1135"]
