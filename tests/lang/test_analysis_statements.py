"""Statements and initial values (spec language_st.md section 2, language_types.md section 4)."""

from __future__ import annotations

import pytest
from resolved import analysed, body_of, codes, messages, program, variable

from tappet.lang import ast
from tappet.lang import types as t

VARIABLES = (
    "VAR i, j : INT; u : USINT; r : REAL; b, c : BOOL; e : E3; a : ARRAY[1..3] OF INT; s : STRING; END_VAR"
)
TYPES = (
    "TYPE E3 : (one, two, three); END_TYPE TYPE S : STRUCT x : INT; y : ARRAY[0..1] OF REAL; "
    "END_STRUCT END_TYPE"
)


def found(body: str) -> list[str]:
    return codes(program(VARIABLES, body, TYPES))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("IF i > 3 THEN j := 1; ELSIF b THEN j := 2; ELSE j := 3; END_IF", []),
        ("IF i THEN j := 1; END_IF", ["E0307"]),
        ("WHILE b DO EXIT; END_WHILE REPEAT CONTINUE; UNTIL i END_REPEAT", ["E0307"]),
        ("EXIT;", ["E0801"]),
        ("CONTINUE;", ["E0801"]),
        ("CASE i OF 1, 5: j := 1; 10..20: j := 2; ELSE j := 3; END_CASE", []),
        ("CASE i OF 1: j := 1; 1: j := 2; END_CASE", ["E0811"]),
        ("CASE i OF 3..5: j := 1; 4: j := 2; END_CASE", ["E0811"]),
        ("CASE i OF 3..5: j := 1; 1..4: j := 2; END_CASE", ["E0804"]),
        ("CASE i OF 1: j := 1; 0..10: j := 2; 20: j := 3; END_CASE", ["E0804"]),
        ("CASE i OF 5..3: j := 1; END_CASE", ["E0810"]),
        ("CASE i OF j: j := 1; END_CASE", ["E0805"]),
        ("CASE i OF 40000: j := 1; END_CASE", ["E0301"]),
        ("CASE r OF 1: j := 1; END_CASE", ["E0806"]),
        ("CASE e OF one: j := 1; two..E3.three: j := 2; END_CASE", []),
        ("CASE e OF one: j := 1; END_CASE", ["W1104"]),
        ("CASE e OF 0, 1, 2: j := 1; END_CASE", []),
        ("FOR i := 1 TO 10 DO j := i; END_FOR", []),
        ("FOR i := 10 TO 1 BY -3 DO j := i; END_FOR", []),
        ("FOR u := 10 TO 0 BY -1 DO j := u; END_FOR", ["W1106"]),
        ("FOR i := 1 TO 40000 DO j := i; END_FOR", ["E0808"]),
        ("FOR i := 1 TO DINT#40000 DO j := i; END_FOR", ["E0301"]),
        ("FOR u := -9 TO 2 DO j := u; END_FOR", ["E0808"]),
        ("FOR i := 5 TO UINT#65535 DO j := i; END_FOR", ["W1002", "W1136"]),
        ("FOR r := 1 TO 2 DO j := 1; END_FOR", ["E0807"]),
        ("FOR i := 1 TO 9 BY 0 DO j := 1; END_FOR", ["E0809"]),
        ("FOR i := 1.5 TO 9 DO j := 1; END_FOR", ["E0808"]),
        ("FOR i := one TO three DO j := i; END_FOR", []),
        ("FOR 5 := 1 TO 2 DO j := i; END_FOR", ["E0305"]),
        ("again: i := i + 1; IF i < 4 THEN JMP again; END_IF", []),
        ("JMP nowhere;", ["E0802"]),
        ("l: i := 1; l: i := 2; JMP l;", ["E0803"]),
        ("l: i := 1;", ["W1115"]),
        ("i := j := 3; IF b := (i = 1) THEN j := 2; END_IF", []),
        ("i := r := j;", ["E0301"]),
        ("b S= c; b R= i > 3;", []),
        ("i S= b;", ["E0322"]),
        ("b S= i;", ["E0322"]),
        ("a := [1, 2, 3];", ["E0333"]),
        ("s := 'abc'; s := s;", ["W1107"]),
        (";;", []),
    ],
)
def test_statements(body: str, expected: list[str]) -> None:
    assert found(body) == expected


def test_overlapping_ranges_are_named_as_in_codesys() -> None:
    analysis = program(VARIABLES, "CASE i OF 3..5: j := 1; 1..4: j := 2; END_CASE", TYPES)
    assert messages(analysis) == ["Case contains overlapping range 1 .. 4 and 3 .. 5"]
    assert {d.alias for d in analysis.diagnostics if d.severity == "error"} == {"C0219"}


@pytest.mark.parametrize(
    ("declaration", "expected"),
    [
        ("VAR x : ARRAY[1..5] OF INT := [1, 2, 3, 4, 5]; END_VAR", []),
        ("VAR x : ARRAY[1..2, 3..4] OF INT := [1, 3(7)]; END_VAR", []),
        ("VAR x : ARRAY[1..3] OF INT := [4(7)]; END_VAR", ["E0327"]),
        ("VAR x : ARRAY[1..3] OF INT := [1, TRUE]; END_VAR", ["E0301"]),
        ("VAR x : ARRAY[1..2] OF S := [(x := 1), (x := 2, y := [1, 2.5])]; END_VAR", []),
        ("VAR x : ARRAY[1..2] OF ARRAY[0..1] OF INT := [[1, 2], [3, 4]]; END_VAR", []),
        ("VAR x : ARRAY[1..2] OF ARRAY[0..1] OF INT := [1, 2, 3, 4]; END_VAR", []),
        ("VAR x : ARRAY[1..2] OF ARRAY[0..1] OF INT := [1, 2, 3, 4, 5]; END_VAR", ["E0327"]),
        ("VAR x : INT := [1]; END_VAR", ["E0326"]),
        ("VAR x : INT := (x := 1); END_VAR", ["E0326"]),
        ("VAR x : S := (x := 1, x := 2); END_VAR", ["E0328"]),
        ("VAR x : S := (z := 1); END_VAR", ["E0204"]),
        ("VAR v : INT; x : S := (x := v); END_VAR", ["E0329"]),
        ("VAR CONSTANT v : INT := 3; END_VAR VAR x : S := (x := v + 1); END_VAR", []),
        ("VAR x : U := (a := 1, b := 2); END_VAR", ["E0431"]),
        ("VAR x : INT := 100000; END_VAR", ["E0301"]),
        ("VAR x : INT(0..5) := 6; END_VAR", ["E0324"]),
        ("VAR x : POINTER TO INT := ADR(y); y : INT; END_VAR", []),
        ("VAR f : FB := (a := 99); END_VAR", []),
        ("VAR f : FB := (q := 99); END_VAR", ["E0204"]),
        ("VAR x : STRING(3) := '12345'; END_VAR", ["W1004"]),
        ("VAR n : INT := 3; x : ARRAY[0..3] OF INT := [n(1)]; END_VAR", ["E0317"]),
    ],
)
def test_initial_values(declaration: str, expected: list[str]) -> None:
    others = (
        TYPES,
        "TYPE U : UNION a : INT; b : REAL; END_UNION END_TYPE",
        "FUNCTION_BLOCK FB\nVAR_INPUT a : INT; END_VAR\nEND_FUNCTION_BLOCK",
    )
    assert codes(program(declaration, "", *others)) == expected


def test_aggregates_carry_their_types() -> None:
    analysis = program("VAR x : ARRAY[1..2] OF S := [(x := 1), (y := [2.5])]; END_VAR", "", TYPES)
    decl = variable(analysis, "P.x").decl
    assert decl is not None
    init = decl.init
    assert isinstance(init, ast.ArrayInit)
    assert isinstance(init.type, t.Array)
    assert init.is_constant
    second = init.elements[1]
    assert isinstance(second, ast.StructInit)
    assert second.type is init.type.element
    member = second.fields[0]
    assert member.parameter is not None
    assert member.parameter.name == "y"
    assert isinstance(member.value, ast.ArrayInit)
    assert member.value.elements[0].constant == 2.5


def test_members_of_structures_are_initialised_in_their_type() -> None:
    analysis = analysed(
        "TYPE T1 : STRUCT a : INT := 5; b : E1; END_STRUCT END_TYPE TYPE E1 : (x, y) := y; END_TYPE"
    )
    struct = analysis.types["T1"]
    assert isinstance(struct, t.Struct)
    first, second = struct.members.values()
    assert first.decl is not None
    assert first.decl.init is not None
    assert first.decl.init.constant == 5
    assert isinstance(second.type, t.Enum)
    assert second.type.default == 1


def test_a_second_analysis_of_the_same_tree_says_the_same() -> None:
    from tappet.lang.analysis import analyse
    from tappet.lang.parser import parse
    from tappet.lang.source import Source

    text = (
        "TYPE E : (one, two); END_TYPE\nFUNCTION_BLOCK FB\nVAR_INPUT a : INT := 3; END_VAR\n"
        "METHOD M : INT\nM := a + 1;\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
        "PROGRAM P\nVAR f : FB := (a := 2); i : INT; r : REAL; e : E; END_VAR\n"
        "r := 5; i := r; i := f.M() + ADD(i, 2, 3); e := two; i := 300 + 5; foo();\nEND_PROGRAM"
    )
    unit = parse(Source("x", text)).unit
    first = analyse([unit])
    second = analyse([unit])
    assert [str(d) for d in first.diagnostics] == [str(d) for d in second.diagnostics]
    assert second.pous[0].pou is not None
    assert body_of(second)[0] is body_of(first)[0]
