"""Analysis never raises, whatever the tree, and is fast enough by counting, not by the clock."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.lang import ast
from tappet.lang.analysis import Analysis, analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

SAMPLE = """
TYPE E_Mode : (Off, On := 5, Auto) := On; END_TYPE
TYPE ST_Rec EXTENDS ST_Base : STRUCT n : INT := 3; a : ARRAY[0..N, 1..2] OF REAL;
p : POINTER TO ST_Rec; b : BIT;
END_STRUCT END_TYPE
TYPE ST_Base : UNION x : LREAL; y : STRING(10); END_UNION END_TYPE
TYPE T_Sub : INT(0..100) := 7; END_TYPE
VAR_GLOBAL CONSTANT N : INT := 4; M : INT := N * 2 + 1; END_VAR
VAR_GLOBAL RETAIN gMode : E_Mode; gRec : ARRAY[1..3] OF ST_Rec := [2((n := 1)), (n := 2)]; END_VAR
INTERFACE IThing METHOD Go : BOOL VAR_INPUT x : INT; END_VAR END_METHOD
PROPERTY V : INT GET END_GET END_PROPERTY
END_INTERFACE
FUNCTION_BLOCK FB_Base IMPLEMENTS IThing
VAR_INPUT in1 : INT; t : TIME; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_IN_OUT io : DINT; END_VAR
VAR s : STRING := 'abc'; x AT %MW4 : INT; END_VAR VAR_TEMP tmp : INT; END_VAR
q := in1 > 3 AND NOT q; io := io + 1; tmp := LEN2(s);
METHOD Go : BOOL VAR_INPUT x : INT; END_VAR Go := x > in1; THIS^.in1 := x; END_METHOD
PROPERTY V : INT GET V := in1; END_GET SET in1 := V; END_SET END_PROPERTY
ACTION Act q := FALSE; END_ACTION
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Child EXTENDS FB_Base
VAR itf : IThing; r : REFERENCE TO INT; END_VAR
SUPER^(io := 5); itf := THIS^; r REF= in1; r := 5;
METHOD Go : BOOL VAR_INPUT x : INT; END_VAR Go := SUPER^.Go(x + 1); END_METHOD
END_FUNCTION_BLOCK
FUNCTION LEN2 : INT VAR_INPUT s : STRING; END_VAR VAR_STAT k : INT; END_VAR
k := k + 1; LEN2 := SEL(k > 3, 1, MAX(2, k)); END_FUNCTION
PROGRAM P
VAR fb : FB_Child; i : INT; r : REAL; d : DINT; m : E_Mode; a : ARRAY[0..3] OF INT := [1, 2(3)];
p : POINTER TO INT;
tm : TIME := T#5s; w : WORD := 16#FF; END_VAR
fb(in1 := i, io := d, q => a[1].0); fb.V := fb.V + 1; i := fb.itf.V; fb.Act();
CASE m OF Off: i := 1; On..Auto: i := 2; END_CASE
FOR i := 0 TO 3 DO a[i] := a[3 - i] * 2 MOD 5; IF a[i] = 3 THEN EXIT; END_IF END_FOR
WHILE i < 10 AND_THEN p <> 0 DO i := i + p^; END_WHILE
again: REPEAT i := i - 1; UNTIL i <= 0 END_REPEAT
IF r > 1.5 THEN JMP again; END_IF
w := SHL(w, 2) AND NOT 1; r := SQRT(REAL_TO_LREAL(r)) ** 2; p := ADR(a[0]); tm := tm * 2 + T#1s; %QB3 := 5;
gRec[2].a[1, 2] := INT_TO_REAL(i) / 2; gMode := Auto; i := j := SIZEOF(gRec);
END_PROGRAM
VAR_CONFIG P.fb.x AT %IX0.0 : BOOL; END_VAR
"""


def _analyse(*texts: str) -> Analysis:
    return analyse([parse(Source(f"t{n}", text)).unit for n, text in enumerate(texts)])


@pytest.mark.parametrize(
    "text", ["VAR_GLOBAL x : FB(", "PROGRAM P VAR x : FB(", "PROGRAM P VAR f : INT; END_VAR x := f().y;"]
)
def test_texts_that_once_raised(text: str) -> None:
    assert _analyse(text) is not None


def test_the_sample_itself_is_nearly_clean() -> None:
    assert {d.code for d in _analyse(SAMPLE).diagnostics if d.severity == "error"} <= {
        "E0301", "E0417", "E0506", "E0201", "E0606", "E0505", "E0003", "E0448",
    }  # fmt: skip


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.randoms(use_true_random=False))
def test_any_cut_of_a_program(chance: random.Random) -> None:
    text = SAMPLE
    for _ in range(chance.randint(1, 6)):
        start = chance.randrange(len(text))
        end = min(len(text), start + chance.randint(1, 60))
        piece = chance.choice(
            ["", text[start:end][::-1], "END_VAR", ";", "(", "x", ":=", SAMPLE[end : end + 30]]
        )
        text = text[:start] + piece + text[end:]
    for diagnostic in _analyse(text).diagnostics:
        assert str(diagnostic)


WORDS = [
    "PROGRAM",
    "P",
    "END_PROGRAM",
    "VAR",
    "END_VAR",
    "x",
    "y",
    "INT",
    ":",
    ";",
    ":=",
    "(",
    ")",
    "[",
    "]",
    ",",
    ".",
    "^",
    "+",
    "-",
    "*",
    "/",
    "AND",
    "NOT",
    "=",
    "<",
    "TYPE",
    "END_TYPE",
    "STRUCT",
    "END_STRUCT",
    "ARRAY",
    "OF",
    "1",
    "2",
    "..",
    "0",
    "'a'",
    "TRUE",
    "IF",
    "THEN",
    "END_IF",
    "FUNCTION",
    "F",
    "END_FUNCTION",
    "FUNCTION_BLOCK",
    "B",
    "END_FUNCTION_BLOCK",
    "POINTER",
    "TO",
    "REFERENCE",
    "EXTENDS",
    "IMPLEMENTS",
    "INTERFACE",
    "END_INTERFACE",
    "METHOD",
    "END_METHOD",
    "PROPERTY",
    "GET",
    "SET",
    "CASE",
    "END_CASE",
    "FOR",
    "DO",
    "END_FOR",
    "THIS",
    "SUPER",
    "=>",
    "ADR",
    "SIZEOF",
    "SEL",
    "CONSTANT",
    "VAR_INPUT",
    "VAR_IN_OUT",
    "VAR_GLOBAL",
    "AT",
    "%IX0.0",
    "%I*",
    "T#1s",
    "1.5",
    "REF=",
    "S=",
    "__NEW",
    "__QUERYINTERFACE",
    "VAR_CONFIG",
    "VAR_EXTERNAL",
    "VAR_STAT",
]


@settings(max_examples=150, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=80))
def test_any_sequence_of_words(words: list[str]) -> None:
    _analyse(" ".join(words))


EXPRESSIONS = st.recursive(
    st.sampled_from(
        [
            "i",
            "r",
            "b",
            "s",
            "a",
            "st1",
            "e",
            "p",
            "fb",
            "1",
            "300",
            "1.5",
            "'x'",
            "TRUE",
            "T#1s",
            "E1",
            "F1",
            "G",
        ]
    ),
    lambda inner: st.one_of(
        st.tuples(
            inner,
            st.sampled_from(
                ["+", "-", "*", "/", "MOD", "AND", "OR", "XOR", "=", "<>", "<", ">", "**", "AND_THEN"]
            ),
            inner,
        ).map(lambda x: f"({x[0]} {x[1]} {x[2]})"),
        inner.map(lambda x: f"NOT {x}"),
        inner.map(lambda x: f"(-{x})"),
        inner.map(lambda x: f"{x}^"),
        st.tuples(inner, st.sampled_from(["x", "3", "nope", "Up()", "q"])).map(lambda x: f"{x[0]}.{x[1]}"),
        st.tuples(inner, inner).map(lambda x: f"{x[0]}[{x[1]}]"),
        st.tuples(
            st.sampled_from(
                [
                    "SEL",
                    "MAX",
                    "LIMIT",
                    "MUX",
                    "SHL",
                    "ADR",
                    "SIZEOF",
                    "ABS",
                    "TO_INT",
                    "INT_TO_REAL",
                    "F1",
                    "fb",
                    "TRUNC",
                    "BITADR",
                    "__NEW",
                ]
            ),
            st.lists(inner, max_size=3),
        ).map(lambda x: f"{x[0]}({', '.join(x[1])})"),
    ),
    max_leaves=8,
)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(EXPRESSIONS, EXPRESSIONS)
def test_any_expression(left: str, right: str) -> None:
    parsed = parse(
        Source(
            "t",
            "TYPE E1 : (one, two); END_TYPE TYPE S1 : STRUCT x : INT; END_STRUCT END_TYPE "
            "FUNCTION F1 : INT VAR_INPUT a : INT; END_VAR F1 := a; END_FUNCTION "
            "FUNCTION_BLOCK FB1 VAR_OUTPUT q : BOOL; END_VAR METHOD Up : INT Up := 1; END_METHOD "
            "END_FUNCTION_BLOCK "
            "PROGRAM P VAR i : INT; r : REAL; b : BOOL; s : STRING; a : ARRAY[0..9] OF INT; st1 : S1; "
            f"e : E1; p : POINTER TO S1; fb : FB1; END_VAR\n{left} := {right};\nIF {left} THEN {right}; "
            f"END_IF\nEND_PROGRAM",
        )
    )
    analysis = analyse([parsed.unit])
    program = next(p for p in analysis.pous if p.name == "P")
    assert program.pou is not None
    errors = any(d.severity == "error" for d in [*parsed.diagnostics, *analysis.diagnostics])
    for statement in program.pou.body:
        if isinstance(statement, ast.Assign) and not errors:
            assert statement.value.type is not None
            assert statement.target.type is not None


@pytest.mark.parametrize("name", ["Standard"])
def test_libraries_have_no_errors(name: str) -> None:
    from tappet.libraries import load

    analysis = analyse([parse(source).unit for source in load(name).sources])
    assert [str(d) for d in analysis.diagnostics if d.severity == "error"] == []


def test_messages_are_in_the_order_of_the_text() -> None:
    found = _analyse("PROGRAM P\nVAR x : INT; END_VAR\nx := TRUE;\ny := 1;\nz := 2;\nEND_PROGRAM").diagnostics
    assert [d.span.line for d in found] == sorted(d.span.line for d in found)


def test_nothing_but_json_types_in_texts() -> None:
    for diagnostic in _analyse(SAMPLE).diagnostics:
        json.dumps([diagnostic.code, diagnostic.message, diagnostic.advice, list(diagnostic.span)])


def test_no_dispatch_by_chains_of_isinstance() -> None:
    """The two tables of handlers cover every class of statements and expressions that needs one."""
    from tappet.lang.analysis.expressions import EXPRESSIONS as TABLE
    from tappet.lang.analysis.statements import STATEMENTS

    silent = {ast.Return, ast.Empty, ast.PragmaStmt, ast.HaltPoint}
    assert set(ast.Expr.__subclasses__()) == set(TABLE)
    assert set(ast.Stmt.__subclasses__()) - silent == set(STATEMENTS)
    assert Path(ast.__file__).exists()


@pytest.mark.parametrize(
    ("before", "after"),
    [("NOT ", ""), ("a[", "]"), ("F(", ")"), ("-", ""), ("SEL(b, 1, ", ")"), ("(x := ", ")")],
)
def test_the_deepest_nesting_the_parser_accepts(before: str, after: str) -> None:
    depth = 2000
    while True:
        nested = f"{before * depth}1{after * depth}"
        text = (
            "FUNCTION F : INT\nVAR_INPUT v : INT; END_VAR\nF := v;\nEND_FUNCTION\n"
            "PROGRAM P\nVAR a : ARRAY[0..9] OF INT; b : BOOL; x, y : INT; END_VAR "
            f"VAR z : INT := {nested}; END_VAR\nVAR CONSTANT c : INT := {nested}; END_VAR\n"
            f"y := {nested};\nEND_PROGRAM"
        )
        result = parse(Source("t", text))
        if not any(d.code == "E0107" for d in result.diagnostics) or depth < 10:
            break
        depth = depth * 3 // 4
    analyse([result.unit])
