"""Operand types, implicit conversions, places and names (spec language_operators.md)."""

from __future__ import annotations

import pytest
from every_type import ALL, TYPES, found
from resolved import body_of, codes, messages, program

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import carried_type
from tappet.lang.source import Source

NAMES = {
    "SINT": "si", "INT": "i", "DINT": "di", "LINT": "li", "USINT": "us", "UINT": "ui", "UDINT": "ud",
    "ULINT": "ul", "BYTE": "by", "WORD": "w", "DWORD": "dw", "LWORD": "lw", "REAL": "re", "LREAL": "lr",
    "BOOL": "b", "TIME": "tm", "STRING": "str",
}  # fmt: skip


def typed(expression: str) -> ast.Expr:
    """An expression over `ALL`, resolved."""
    analysis = program(ALL, f"{expression};", TYPES)
    statement = body_of(analysis)[0]
    assert isinstance(statement, ast.ExprStmt)
    return statement.expr


TABLE = {
    "SINT": ("INT DINT LINT REAL LREAL", "USINT UINT UDINT ULINT BYTE WORD DWORD LWORD", "BOOL TIME STRING"),
    "INT": ("DINT LINT REAL LREAL", "UINT UDINT ULINT WORD DWORD LWORD", "SINT USINT BYTE BOOL"),
    "DINT": ("LINT LREAL", "UDINT ULINT DWORD LWORD REAL", "INT SINT WORD BYTE"),
    "LINT": ("", "ULINT LWORD REAL LREAL", "DINT UDINT INT"),
    "USINT": ("BYTE INT UINT WORD DINT UDINT DWORD LINT ULINT LWORD REAL LREAL", "SINT", "BOOL"),
    "BYTE": ("USINT INT UINT WORD DINT UDINT DWORD LINT ULINT LWORD REAL LREAL", "SINT", "BOOL"),
    "UINT": ("WORD UDINT ULINT DWORD LWORD DINT LINT REAL LREAL", "INT", "USINT BYTE SINT"),
    "WORD": ("UINT UDINT ULINT DWORD LWORD DINT LINT REAL LREAL", "INT", "USINT BYTE SINT"),
    "UDINT": ("DWORD ULINT LWORD LINT LREAL", "DINT REAL", "UINT WORD INT"),
    "DWORD": ("UDINT ULINT LWORD LINT LREAL", "DINT REAL", "UINT WORD INT TIME"),
    "REAL": ("LREAL", "", "INT LINT BOOL TIME"),
    "LREAL": ("", "REAL", "INT LINT BOOL"),
    "BOOL": ("", "", "BYTE INT REAL TIME STRING"),
    "TIME": ("", "", "DWORD UDINT INT BOOL REAL"),
    "STRING": ("", "", "INT BOOL TIME"),
}
CASES = [
    (source, target, verdict)
    for source, groups in TABLE.items()
    for verdict, group in zip(("", "W", "E"), groups, strict=True)
    for target in group.split()
]


@pytest.mark.parametrize(("source", "target", "verdict"), CASES)
def test_implicit_conversion(source: str, target: str, verdict: str) -> None:
    """The table of language_operators.md section 1."""
    reported = found(f"{NAMES[target]} := {NAMES[source]};")
    assert [c[0] for c in reported] == ([verdict] if verdict else [])


def test_wording_and_numbers_of_codesys() -> None:
    analysis = program(ALL, "by := i; ui := i; si := us; re := di; foo := 1;", TYPES)
    assert [(d.alias, d.message) for d in analysis.diagnostics if d.code not in ("W1103", "W1206")] == [
        ("C0032", "Cannot convert type 'INT' to type 'BYTE'"),
        (
            "C0195",
            "Implicit conversion from signed Type 'INT' to unsigned Type 'UINT' : possible change of sign",
        ),
        (
            "C0196",
            "Implicit conversion from unsigned Type 'USINT' to signed Type 'SINT' : possible change of sign",
        ),
        ("C0197", "Implicit conversion from 'DINT' to 'REAL' : possible loss of information"),
        ("C0046", "Identifier 'foo' not defined"),
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("si := 127;", []),
        ("si := 128;", ["E0301"]),
        ("us := -1;", ["E0301"]),
        ("re := 5; lr := 5; re := 1.5;", []),
        ("i := 1.5;", ["E0301"]),
        ("re := 1.0E39;", ["E0302"]),
        ("b := 1; b := 0;", []),
        ("b := 2;", ["E0301"]),
        ("tm := 5;", ["E0301"]),
        ("ltm := T#5s; d := D#2020-01-01;", []),
        ("sub := 10;", []),
        ("sub := 11;", ["E0324"]),
        ("sub := i;", []),
        ("e := 0; e := one; i := e; e := i;", []),
        ("e := 100000;", ["E0301"]),
        ("str := 'abc'; wstr := \"abc\";", []),
        ('str := "abc";', ["W1152"]),
        ("p := 0; p := ADR(i); dw := ADR(i); lw := ADR(i);", ["W1302"]),
        ("i := ADR(i);", ["E0301"]),
        ("i := r; r := i; i := r + 1;", []),
        ("by := SIZEOF(arr); si := SIZEOF(st);", []),
        ("w := NOT 16#F; by := NOT 2#1001_0011; w := w AND NOT 1;", []),
        ("ui := 70000;", ["E0301"]),
        ("i := 7 * 2 * 4 * 7; us := 100 + 100;", []),
        ("us := 200 + 100;", ["E0301"]),
        ("li := 9223372036854775807 + 9223372036854775807;", ["E0301"]),
        ("li := 18446744073709551615 * 2;", ["E0330"]),
        ("i := 5 / 0;", ["E0316"]),
        ("i := i / 0;", ["W1120"]),
        ("i := INT#5; by := INT#5; si := DINT#34;", []),
    ],
)
def test_constants_adapt(body: str, expected: list[str]) -> None:
    assert found(body) == expected


@pytest.mark.parametrize(
    ("expression", "type_", "computed"),
    [
        ("i + i", t.INT, t.DINT),
        ("si * us", t.SINT, t.DINT),
        ("by + by", t.BYTE, t.DINT),
        ("ui - ui", t.UINT, t.DINT),
        ("di + i", t.DINT, t.DINT),
        ("ud + ud", t.UDINT, t.UDINT),
        ("ud + di", t.DINT, t.LINT),
        ("ud + i", t.UDINT, t.LINT),
        ("dw + dw", t.DWORD, t.DWORD),
        ("ul + ui", t.ULINT, t.ULINT),
        ("li + ud", t.LINT, t.LINT),
        ("re + i", t.REAL, t.REAL),
        ("re * 2", t.REAL, t.REAL),
        ("re * 0.1", t.REAL, t.REAL),
        ("lr + re", t.LREAL, t.LREAL),
        ("i + 1", t.INT, t.DINT),
        ("by + 1000", t.INT, t.DINT),
        ("tm + tm", t.TIME, t.TIME),
        ("w AND by", t.WORD, t.WORD),
        ("i AND 16#F", t.INT, t.INT),
        ("b OR b", t.BOOL, t.BOOL),
        ("e + 5", t.INT, t.DINT),
        ("sub + 1", t.INT, t.DINT),
        ("p + 4", t.Pointer(t.INT), t.Pointer(t.INT)),
        ("p - q", t.UDINT, t.LINT),
        ("i < ui", t.BOOL, t.DINT),
        ("di < ud", t.BOOL, t.LINT),
        ("i = 5", t.BOOL, t.DINT),
        ("str < 'abc'", t.BOOL, t.String(80)),
        ("p = 0", t.BOOL, t.LWORD),
        ("re ** 2", t.REAL, t.REAL),
        ("i ** 2", t.LREAL, t.LREAL),
    ],
)
def test_operand_types(expression: str, type_: t.Type, computed: t.Type) -> None:
    """LOPR-02, LOPR-03."""
    e = typed(expression)
    assert isinstance(e, ast.Binary)
    assert (e.type, e.operand_type) == (type_, computed)
    assert carried_type(e) == (t.BOOL if type_ is t.BOOL else computed)


@pytest.mark.parametrize(
    ("expression", "type_"),
    [
        ("dtm + tm", t.DT), ("td - tm", t.TOD), ("dtm - dtm", t.TIME), ("d - d", t.TIME),
        ("tm * 3", t.TIME), ("3 * tm", t.TIME), ("tm / i", t.TIME), ("tm * re", t.TIME),
    ],
)  # fmt: skip
def test_time_arithmetic(expression: str, type_: t.Type) -> None:
    e = typed(expression)
    assert isinstance(e, ast.Binary)
    assert (e.type, e.operand_type) == (type_, None)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("b := b + 1;", ["E0304"]),
        ("i := str + 1;", ["E0304"]),
        ("tm := tm + 5;", ["E0304"]),
        ("tm := tm * tm;", ["E0304"]),
        ("b := str = 5;", ["E0304"]),
        ("b := 1 < 'x';", ["E0304"]),
        ("b := tm > 5;", ["E0304"]),
        ("b := st = st;", ["E0304"]),
        ("re := re MOD 2;", ["E0304"]),
        ("b := NOT re;", ["E0303"]),
        ("i := -str;", ["E0303"]),
        ("b := b AND i;", ["E0304"]),
        ("p := p * 2;", ["E0304"]),
        ("arr := st;", ["E0301"]),
        ("i := arr;", ["E0301"]),
        ("b := i AND_THEN b;", ["E0304"]),
        ("lw := lw + li;", ["W1001"]),
    ],
)
def test_operations_that_are_not_possible(body: str, expected: list[str]) -> None:
    reported = found(body)
    assert reported[: len(expected)] == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("arr[8] := 1;", ["E0310"]),
        ("arr[i] := 1; arr[us + 1] := 2;", []),
        ("arr[re] := 1;", ["E0311"]),
        ("arr[1, 2] := 1;", ["E0309"]),
        ("i[0] := 1;", ["E0308"]),
        ("by := str[0]; w := wstr[2]; str[1] := 16#78;", []),
        ("i := p[3]; p^ := 5; i := p^;", []),
        ("i := i^;", ["E0312"]),
        ("i.15 := TRUE; b := di.31; b := lw.63;", []),
        ("i.16 := TRUE;", ["E0313"]),
        ("re.2 := TRUE;", ["E0314"]),
        ("st.z := 1;", ["E0204"]),
        ("st.x.3 := TRUE;", []),
        ("i := st.x + arr[st.x];", []),
        ("i := S;", ["E0210"]),
        ("i := p.x;", ["E0204"]),
        ("5 := i;", ["E0305"]),
        ("one := 1;", ["E0305"]),
        ("i + 1 := 2;", ["E0305"]),
        ("str := MID;", ["E0201"]),
        ("%QB3 := 5; by := %IB4; b := %QX1.2;", []),
        ("%IB3 := 5;", ["E0306"]),
        ("b := %IX0.16;", ["E0602"]),
        ("b := %I*;", ["E0608"]),
    ],
)
def test_places(body: str, expected: list[str]) -> None:
    assert found(body) == expected


def test_bit_by_a_named_constant() -> None:
    """LTYP-144."""
    gvl = "VAR_GLOBAL CONSTANT enable : INT := 2; END_VAR"
    analysis = program("VAR x : INT; END_VAR", "x.enable := TRUE;", gvl)
    assert codes(analysis) == []
    assert codes(program("VAR x, n : INT; END_VAR", "x.n := TRUE;")) == ["E0315"]


def test_suggestions_name_the_closest_symbol_and_its_place() -> None:
    analysis = program(
        "VAR x : INT; END_VAR",
        "x := Sped; x := E.twp; x := GVL_Drive.Spead;",
        Source("GVL_Drive", "VAR_GLOBAL Speed : INT; END_VAR", name="GVL_Drive"),
        "TYPE E : (one, two); END_TYPE",
    )
    assert [d.advice for d in analysis.diagnostics] == [
        "Did you mean 'Speed' (GVL_Drive)?",
        "Did you mean 'two'?",
        "Did you mean 'Speed'?",
    ]


def test_ambiguous_and_qualified_names() -> None:
    lists = (
        Source("G1", "VAR_GLOBAL v : INT; w : INT; END_VAR", name="G1"),
        Source("G2", "VAR_GLOBAL v : INT; END_VAR", name="G2"),
        Source("G3", "{attribute 'qualified_only'}\nVAR_GLOBAL z : INT; END_VAR", name="G3"),
    )
    analysis = program(
        "VAR x : INT; w : REAL; END_VAR", "x := v; x := G1.v; x := z; x := G3.z; x := .w;", *lists
    )
    assert codes(analysis) == ["E0203", "E0207"]
    assert messages(analysis) == ["ambiguous use of name 'v'", "Identifier 'z' not defined"]


def test_a_long_sum_does_not_exhaust_the_stack() -> None:
    terms = " + ".join(["i"] * 350)
    assert codes(program("VAR i : INT; END_VAR", f"i := {terms};")) == []
