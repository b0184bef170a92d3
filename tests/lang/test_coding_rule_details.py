"""Coding rules at their edges: what they must not report, and where a finding lies."""

from __future__ import annotations

import pytest
from sample_stage import diagnose

from tappet.lang.analysis import analyse
from tappet.lang.parser import parse
from tappet.lang.rules.coding.cognitive_complexity import cognitive_complexity
from tappet.lang.source import Source


def messages(text: str, *codes: str) -> list[tuple[str, int]]:
    """The codes among these that are reported, with their lines from 1; @ lines left out."""
    return [(d.code, d.span.line + 1) for d in diagnose(f"@static\n{text}") if d.code in codes]


BLOCK = """FUNCTION_BLOCK FB
VAR_INPUT x : INT; END_VAR
VAR n, m, k : INT; a, b : ARRAY[0..9] OF INT; f : TON_LIKE; p : POINTER TO INT; bGo, bDone : BOOL; END_VAR
VAR_TEMP i : INT; END_VAR
{body}
END_FUNCTION_BLOCK
FUNCTION_BLOCK TON_LIKE
VAR_OUTPUT q : INT; END_VAR
q := q + 1;
END_FUNCTION_BLOCK
"""
HEAD = 4


def in_block(body: str, *codes: str) -> list[tuple[str, int]]:
    return [(code, line - HEAD) for code, line in messages(BLOCK.format(body=body), *codes)]


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ("FOR i := 0 TO 9 DO\nn := 2 * x;\na[i] := n;\nEND_FOR", [2]),
        ("FOR i := 0 TO 9 DO\nn := 100;\na[i] := n;\nEND_FOR", [2]),
        ("FOR i := 0 TO 9 DO\nn := 2 * i;\na[i] := n;\nEND_FOR", []),  # the counter
        ("FOR i := 0 TO 9 DO\nn := n + x;\nEND_FOR", []),  # itself
        ("FOR i := 0 TO 9 DO\nm := n;\nn := a[i];\nEND_FOR", []),  # written behind
        ("FOR i := 0 TO 9 DO\nbDone := FALSE;\nIF a[i] > 3 THEN bDone := TRUE; END_IF\nEND_FOR", []),
        ("FOR i := 0 TO 9 DO\na[i] := n;\nn := x;\nEND_FOR", []),  # read before
        ("FOR i := 0 TO 9 DO\nIF a[i] > 3 THEN n := x; END_IF\nEND_FOR", []),  # not in each turn
        ("FOR i := 0 TO 9 DO\nIF a[i] > 3 THEN EXIT; END_IF\nn := x;\nEND_FOR", []),
        ("FOR i := 0 TO 9 DO\nf();\nn := f.q;\nEND_FOR", []),  # a call may change it
        ("FOR i := 0 TO 9 DO\nf();\nn := m;\nEND_FOR", []),
        ("FOR i := 0 TO 9 DO\np^ := i;\nn := m;\nEND_FOR", []),  # may be m
        ("WHILE bGo DO\nbGo := FALSE;\nm := m + 1;\nEND_WHILE", []),  # the condition
        ("WHILE n < 3 DO\nn := n + 1;\nm := x;\nEND_WHILE", [3]),
        ("REPEAT\nm := SEL(x > 3, 1, 2);\nn := n + m;\nUNTIL n > 9 END_REPEAT", [2]),
        ("REPEAT\nm := TO_INT(TIME());\nn := n + m;\nUNTIL n > 9 END_REPEAT", []),  # the clock goes on
        ("FOR i := 0 TO 9 DO\nn := a[k];\nb[i] := n;\nEND_FOR", [2]),
        ("FOR i := 0 TO 9 DO\nn := a[k];\na[i] := n;\nEND_FOR", []),
        ("FOR i := 0 TO 9 DO\nFOR k := 0 TO 9 DO\nm := a[i];\nn := n + m * b[k];\nEND_FOR\nEND_FOR", [3]),
    ],
)
def test_code_that_a_loop_repeats(body: str, lines: list[int]) -> None:
    assert in_block(body, "S1244") == [("S1244", line) for line in lines]


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("FOR i := 0 TO 9 DO a[i] := b[9 - i]; END_FOR", []),
        ("FOR i := 0 TO 9 DO a[i] := b[10 - i]; END_FOR", ["S1246"]),
        ("FOR i := 0 TO 9 BY 3 DO a[i] := 0; n := b[i / 3]; END_FOR", []),
        ("FOR i := 0 TO 10 BY 3 DO a[i] := 0; END_FOR", []),  # 9 is the last
        ("FOR i := 9 TO 0 BY -1 DO n := n + a[i - 1]; END_FOR", ["S1246"]),
        ("FOR i := 0 TO 9 DO IF i > 0 THEN n := a[i - 1]; END_IF END_FOR", []),  # the condition keeps it in
        ("FOR i := 0 TO 9 DO n := SEL(i > 0, 0, a[i - 1]); END_FOR", []),
        ("FOR i := 0 TO 9 DO bDone := i > 0 AND_THEN a[i - 1] = 2; END_FOR", []),
        ("FOR i := 0 TO 9 DO bDone := i > 0 AND a[i - 1] = 2; END_FOR", ["S1246"]),
        ("FOR i := 0 TO 9 DO IF i = 9 THEN EXIT; END_IF n := a[i + 1]; END_FOR", []),
        ("FOR i := 0 TO 9 DO n := a[i * 2]; END_FOR", ["S1246"]),
        ("FOR i := 0 TO 9 DO i := i + 1; n := a[i - 1]; END_FOR", []),  # not known any more
        ("n := a[x MOD 10];", []),
        ("n := a[x MOD 11];", ["S1246"]),
        ("n := a[LIMIT(0, x, 9)] + a[x];", []),
        ("n := a[LIMIT(0, x, 10)];", ["S1246"]),
        ("FOR i := 1 TO 9 DO a[i] := 0; END_FOR", ["S1247"]),
        ("FOR i := 0 TO 8 DO a[i] := 0; END_FOR", ["S1247"]),
        ("FOR i := 0 TO 9 DO a[i] := 0; END_FOR", []),
        ("FOR i := 0 TO 3 DO a[i] := 0; END_FOR", []),  # a part on purpose
        ("FOR i := 0 TO 8 DO a[i] := a[i + 1]; END_FOR", []),
        ("FOR i := 1 TO 9 DO IF a[i] > a[0] THEN n := i; END_IF END_FOR", []),
        ("FOR i := 0 TO 8 DO IF a[i] > 3 THEN EXIT; END_IF END_FOR", []),
        ("FOR i := 0 TO 8 BY 2 DO a[i] := 0; END_FOR", []),
    ],
)
def test_indices_of_loops(body: str, found: list[str]) -> None:
    assert [code for code, _ in in_block(body, "S1246", "S1247")] == found


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ("F := x;", []),
        ("IF x > 1 THEN F := 1; ELSE F := 2; END_IF", []),
        ("IF x > 1 THEN F := 1; END_IF", [1]),
        ("F := 0;\nIF x > 1 THEN RETURN; END_IF\nF := 2;", []),
        ("CASE x OF\n1: F := 1;\nELSE F := 2;\nEND_CASE", []),
        ("CASE x OF\n1: F := 1;\nEND_CASE", [1]),
        ("FOR i := 1 TO 3 DO F := F + i; END_FOR", []),
        ("FOR i := 1 TO x DO F := F + i; END_FOR", [1]),
        ("WHILE TRUE DO\nIF x > i THEN F := 1; RETURN; END_IF\ni := i + 1;\nEND_WHILE", []),
        ("REPEAT F := x; UNTIL F > 3 END_REPEAT", []),
        ("i := 1;", []),  # W1209 reports it
        ("Give(F);", []),
        ("__TRY F := 10 / x; __FINALLY i := 1; __ENDTRY", []),
        ("__TRY F := 10 / x; __CATCH i := 1; __ENDTRY", [1]),
        ("__TRY IF x > 1 THEN RETURN; END_IF\ni := 1; __FINALLY F := i; __ENDTRY", []),
    ],
)
def test_results_on_every_way(body: str, lines: list[int]) -> None:
    text = (
        "FUNCTION F : INT\nVAR_INPUT x : INT; END_VAR\nVAR i : INT; END_VAR\n"
        f"{body}\nEND_FUNCTION\nFUNCTION Give : BOOL\nVAR_IN_OUT n : INT; END_VAR\nn := 1;\nGive := TRUE;\n"
        "END_FUNCTION\n"
    )
    assert [line for _, line in messages(text, "S1421")] == lines


def test_a_method_may_leave_its_result_to_the_system() -> None:
    text = """FUNCTION_BLOCK FB
VAR n : INT; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
n := 1;
END_METHOD
METHOD Go : BOOL
n := 2;
END_METHOD
PROPERTY Count : INT
GET
IF n > 3 THEN Count := n; END_IF
END_GET
END_PROPERTY
END_FUNCTION_BLOCK
"""
    assert messages(text, "S1421") == [("S1421", 7), ("S1421", 10)]


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ("r := 1;\nr := 2;", [1]),
        ("r REF= n;\nr := 2;", []),
        ("IF __ISVALIDREF(r) THEN r := 2; END_IF", []),
        ("IF NOT __ISVALIDREF(r) THEN RETURN; END_IF\nr := 2;", []),
        ("IF __ISVALIDREF(r) AND_THEN r > 2 THEN n := 1; END_IF", []),
        ("n := r + s;", [1]),
        ("s := 2;", []),
    ],
)
def test_references_before_they_are_bound(body: str, lines: list[int]) -> None:
    text = (
        "PROGRAM Main\nVAR n : INT; END_VAR\nVAR r : REFERENCE TO INT; s : REFERENCE TO INT REF= n; END_VAR\n"
        f"{body}\nEND_PROGRAM\n"
    )
    assert [line - 3 for _, line in messages(text, "S1238")] == lines


def test_a_reference_that_fb_init_binds_or_the_caller_passes() -> None:
    text = """FUNCTION_BLOCK FB
VAR r : REFERENCE TO INT; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; rGiven : REFERENCE TO INT; END_VAR
r REF= rGiven;
END_METHOD
r := 2;
END_FUNCTION_BLOCK
FUNCTION F : INT
VAR_INPUT r : REFERENCE TO INT; END_VAR
F := r;
END_FUNCTION
"""
    assert messages(text, "S1238") == []


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("pInt := ADR(n);", ""),
        ("pInt := ADR(a);", ""),
        ("pInt := ADR(d);", "S1237"),
        ("pByte := ADR(d);", ""),
        ("pWord := ADR(ws);", ""),
        ("pWord := ADR(s);", "S1237"),
        ("pText := ADR(sLong);", ""),
        ("pBase := ADR(derived);", ""),
        ("pDerived := ADR(base);", "S1237"),
        ("pInt := pInt + 2;", ""),
        ("pInt := 0;", ""),
        ("pInt := 4096;", "S1235"),
        ("pInt := lw;", "S1235"),
    ],
)
def test_what_a_pointer_takes(statement: str, code: str) -> None:
    text = f"""FUNCTION_BLOCK FB_Base
VAR n : INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
END_FUNCTION_BLOCK
PROGRAM Main
VAR pInt : POINTER TO INT; pByte : POINTER TO BYTE; pWord : POINTER TO WORD; END_VAR
VAR pText : POINTER TO STRING; s : STRING; sLong : STRING(200); ws : WSTRING; END_VAR
VAR pBase : POINTER TO FB_Base; pDerived : POINTER TO FB_Derived; END_VAR
VAR base : FB_Base; derived : FB_Derived; n : INT; d : DINT; a : ARRAY[0..9] OF INT; lw : LWORD; END_VAR
{statement}
END_PROGRAM
"""
    assert [found for found, _ in messages(text, "S1235", "S1237")] == [code] * bool(code)


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("nSmall := 3;", ""),
        ("nSmall := nTiny;", ""),
        ("nTiny := nSmall;", "S1243"),
        ("nSmall := n;", "S1243"),
        ("nSmall := n MOD 10;", ""),
        ("nSmall := LIMIT(0, n, 9);", ""),
        ("nSmall := nTiny + 5;", ""),
        ("nSmall := nTiny + 6;", "S1243"),
        ("nByte := u;", ""),
        ("n := UINT_TO_INT(w);", "S1240"),
        ("d := UINT_TO_DINT(w);", ""),
        ("w := INT_TO_UINT(n);", "S1240"),
        ("b := w - 1 > 3;", "S1241"),
        ("b := n - 1 > 3;", ""),
        ("b := w + 1 > 3;", ""),
        ("b := w + 1 = 0;", "S1241"),
        ("b := TO_UINT(w - 1) > 3;", ""),
        ("w := SHR(w, 1);", ""),
        ("n := SHR(n, 1);", "S1239"),
        ("r := TO_REAL(n / 2);", "S1249"),
        ("r := TO_REAL(n) / 2;", ""),
        ("d := TO_DINT(n / 2);", ""),
    ],
)
def test_numbers_and_their_types(statement: str, code: str) -> None:
    text = f"""VAR nSmall : INT(0..9); nTiny : INT(1..4); nByte : INT(0..255); END_VAR
VAR n : INT; u : USINT; w : UINT; d : DINT; b : BOOL; r : REAL; END_VAR
{statement}
"""
    found = messages(text, "S1239", "S1240", "S1241", "S1243", "S1249")
    assert [each for each, _ in found] == [code] * bool(code)


@pytest.mark.parametrize(
    ("statement", "advice"),
    [
        ("n := 3;", "Write INT#3."),
        ("nSmall := 3;", "Write INT#3."),
        ("r := 3;", "Write REAL#3."),
        ("w := 16#FF;", "Write UINT#16#FF."),
        ("n := INT#3;", ""),
        ("n := a[3];", ""),
        ("t := T#3S;", ""),
    ],
)
def test_literals_without_a_type(statement: str, advice: str) -> None:
    head = "VAR nSmall : INT(0..9); n : INT; w : UINT; r : REAL; a : ARRAY[0..9] OF INT; t : TIME; END_VAR\n"
    found = [d.advice for d in diagnose(f"@static\n{head}{statement}\n") if d.code == "S1242"]
    assert found == [advice] * bool(advice)


def test_two_paths_to_a_function_of_a_library() -> None:
    text = """@references Standard
PROGRAM Main
VAR s : STRING; END_VAR
s := CONCAT('a', 'b');
s := Standard.CONCAT(s, 'c');
END_PROGRAM
"""
    assert messages(text, "S1423") == [("S1423", 3)]


@pytest.mark.parametrize(
    ("body", "count"),
    [
        ("n := 1;", 0),
        ("IF b THEN n := 1; ELSIF c THEN n := 2; ELSE n := 3; END_IF", 3),
        ("IF b THEN IF c THEN n := 1; END_IF END_IF", 3),
        ("IF b AND c AND d THEN n := 1; END_IF", 2),
        ("IF b AND c OR d THEN n := 1; END_IF", 3),
        ("FOR n := 1 TO 3 DO WHILE b DO CASE n OF 1: b := c; END_CASE END_WHILE END_FOR", 6),
    ],
)
def test_cognitive_complexity(body: str, count: int) -> None:
    text = f"PROGRAM Main\nVAR n : INT; b, c, d : BOOL; END_VAR\n{body}\nEND_PROGRAM"
    unit = parse(Source("Main", text)).unit
    analyse([unit])
    assert cognitive_complexity(unit.declarations[0].body) == count
