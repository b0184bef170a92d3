"""Operand types, conversions, folding, operators in functional form (spec language_operators.md)."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from resolved import analysed, body_of, codes, constant, messages, program, value_of

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import AnalysisOptions, carried_type, conversion, folding
from tappet.lang.source import Source
from tappet.lang.symbols import BuiltinSymbol

ALL = (
    "VAR b : BOOL; si : SINT; i : INT; di : DINT; li : LINT; us : USINT; ui : UINT; ud : UDINT; ul : ULINT; "
    "by : BYTE; w : WORD; dw : DWORD; lw : LWORD; re : REAL; lr : LREAL; tm : TIME; ltm : LTIME; d : DATE; "
    "td : TOD; dtm : DT; str : STRING; wstr : WSTRING; e : E; sub : INT(0..10); p : POINTER TO INT; "
    "q : POINTER TO BYTE; arr : ARRAY[0..7] OF INT; st : S; r : REFERENCE TO INT; END_VAR"
)
TYPES = "TYPE E : (one, two); END_TYPE TYPE S : STRUCT x : INT; y : REAL; END_STRUCT END_TYPE"
NAMES = {
    "SINT": "si", "INT": "i", "DINT": "di", "LINT": "li", "USINT": "us", "UINT": "ui", "UDINT": "ud",
    "ULINT": "ul", "BYTE": "by", "WORD": "w", "DWORD": "dw", "LWORD": "lw", "REAL": "re", "LREAL": "lr",
    "BOOL": "b", "TIME": "tm", "STRING": "str",
}  # fmt: skip


def found(body: str) -> list[str]:
    """Codes of a body with a variable of every type."""
    return codes(program(ALL, body, TYPES))


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
        ('str := "abc";', ["E0301"]),
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
    ("expression", "expected"),
    [
        ("7 + 2 + 4 + 7", 20),
        ("7 / 2", 3),
        ("-7 / 2", -3),
        ("-9 MOD 2", -1),
        ("9 MOD -2", 1),
        ("1 / 2", 0),
        ("1.0 / 0.0", math.inf),
        ("2 ** 3", 8.0),
        ("2#1001_0011 AND 2#1000_1010", 130),
        ("16#0F XOR 16#FF", 240),
        ("NOT BYTE#2#1001_0011", 108),
        ("USINT#200 + USINT#100", 300),
        ("UDINT#4294967295 + UDINT#1", 0),
        ("DINT#2147483647 + DINT#1", -2147483648),
        ("ULINT#0 - ULINT#1", 18446744073709551615),
        ("20 > 30 > 40 > 50 > 60 > 70", False),
        ("1 < 2 = TRUE", True),
        ("'abc' < 'abd'", True),
        ("T#1s > T#999ms", True),
        ("D#1996-05-06 > D#1972-03-29", True),
        ("FALSE < TRUE", True),
        ("TRUE XOR TRUE XOR TRUE", True),
        ("T#45s + T#50s", 95000),
        ("REAL#0.1 + REAL#0.2", struct.unpack("f", struct.pack("f", 0.30000001192092896))[0]),
        ("SEL(TRUE, 3, 4)", 4),
        ("SEL(FALSE, 3, 4)", 3),
        ("MAX(40, MAX(90, 30))", 90),
        ("MIN(90, 30)", 30),
        ("MAX(T#1s, T#2s)", 2000),
        ("MAX('abc', 'abd')", b"abd"),
        ("LIMIT(30, 90, 80)", 80),
        ("LIMIT(30, 10, 80)", 30),
        ("MUX(0, 30, 40, 50)", 30),
        ("MUX(9, 30, 40, 50)", 50),
        ("SHL(BYTE#16#45, 2)", 0x14),
        ("SHL(WORD#16#45, 2)", 0x114),
        ("ROL(BYTE#16#45, 2)", 0x15),
        ("ROR(BYTE#16#45, 2)", 0x51),
        ("ROR(WORD#16#45, 2)", 0x4011),
        ("SHR(BYTE#16#FF, 9)", 0),
        ("SHR(INT#-32768, 1)", -16384),
        ("SHR(INT#-32768, 20)", -1),
        ("SHL(16#45, 2)", 0x14),
        ("ABS(-2)", 2),
        ("SQRT(16)", 4.0),
        ("LN(0)", -math.inf),
        ("EXPT(7, 2)", 49.0),
        ("TRUNC(1.9)", 1),
        ("TRUNC(-1.4)", -1),
        ("TRUNC_INT(1.0E10)", 32767),
        ("INT_TO_SINT(4223)", 127),
        ("INT_TO_SINT(255)", -1),
        ("WORD_TO_BYTE(16#1234)", 52),
        ("DINT_TO_UINT(-1)", 65535),
        ("REAL_TO_INT(1.5)", 2),
        ("REAL_TO_INT(-1.5)", -2),
        ("REAL_TO_INT(0.49999999999999994)", 1),  # rounds to 0.5 in single precision first
        ("LREAL_TO_INT(0.49999999999999994)", 0),
        ("LREAL_TO_DINT(-2.5)", -3),
        ("REAL_TO_BOOL(0.4)", True),
        ("BOOL_TO_TIME(TRUE)", 1),
        ("TIME_TO_DWORD(T#5m)", 300000),
        ("TOD_TO_SINT(TOD#00:00:00.012)", 12),
        ("DATE_TO_INT(D#1970-01-15)", 29952),
        ("DT_TO_BYTE(DT#1970-01-15-05:05:05)", 129),
        ("LTIME_TO_ULINT(LTIME#1000d15h23m12s34ms2us44ns)", 86455392034002044),
        ("TO_INT(2.5)", 3),
        ("ADD(7, 2, 4, 7)", 20),
        ("MUL(7, 2, 4, 7)", 392),
        ("XOR(16#0F, 16#FF)", 240),
        ("GT(30, 20)", True),
        ("ANDN(16#FF, BYTE#16#0F)", 0xF0),
        ("MOVE(13)", 13),
        ("SIZEOF(LREAL)", 8),
        ("XSIZEOF(x)", 8),
        ("UPPER_BOUND(x, 1)", 0),
    ],
)
def test_folding(expression: str, expected: ast.Constant) -> None:
    found_value = constant(expression)
    assert found_value == expected
    assert isinstance(found_value, bool) == isinstance(expected, bool)


def test_nan_folds_without_an_exception() -> None:
    result = constant("SQRT(-1.0)")
    assert isinstance(result, float)
    assert math.isnan(result)


def test_named_constants_fold_in_their_type() -> None:
    declaration = "VAR CONSTANT a : INT := 30000; b : BYTE := 250; r : REAL := 0.1; END_VAR"
    assert constant("a * 2", declaration) == 60000
    assert constant("b + b", declaration) == 500
    assert constant("r", declaration) == 0.10000000149011612
    assert constant("a.0", declaration) is False
    assert constant("a.4", declaration) is True


def test_functional_form_is_the_operator() -> None:
    analysis = program(ALL, "i := ADD(i, 1, i);", TYPES)
    call = value_of(analysis)
    assert isinstance(call, ast.Call)
    assert isinstance(call.expansion, ast.Binary)
    assert (call.type, carried_type(call)) == (t.INT, t.DINT)
    assert call.expansion.op == "+"
    assert isinstance(call.expansion.left, ast.Binary)


@pytest.mark.parametrize(
    ("body", "parameters", "result"),
    [
        ("i := SEL(b, i, 3);", (t.BOOL, t.INT, t.INT), t.INT),
        ("di := MAX(i, di, si);", (t.DINT, t.DINT, t.DINT), t.DINT),
        ("re := MIN(re, 1.5);", (t.REAL, t.REAL), t.REAL),
        ("w := SHL(by, us);", (t.BYTE, t.ULINT), t.BYTE),
        ("re := SIN(re);", (t.REAL,), t.REAL),
        ("re := SQRT(i);", (t.REAL,), t.REAL),
        ("lr := SQRT(di);", (t.LREAL,), t.LREAL),
        ("re := ATAN2(re, 1.0);", (t.REAL, t.REAL), t.REAL),
        ("i := REAL_TO_INT(re);", (t.REAL,), t.INT),
        ("str := INT_TO_STRING(i);", (t.INT,), t.String(80)),
        ("i := STRING_TO_INT(str);", (t.String(80),), t.INT),
        ("i := ANY_TO_INT(re);", (t.REAL,), t.INT),
        ("i := TO_INT(lr);", (t.LREAL,), t.INT),
        ("tm := TIME();", (), t.TIME),
        ("p := ADR(arr[2]);", (None,), t.Pointer(t.INT)),
        ("e := SEL(b, one, two);", (t.BOOL,), None),
        ("b := __ISVALIDREF(r);", (None,), t.BOOL),
        ("by := MUX(i, by, 5);", (t.INT, t.BYTE, t.BYTE), t.BYTE),
    ],
)
def test_operator_overloads(body: str, parameters: tuple[t.Type | None, ...], result: t.Type | None) -> None:
    analysis = program(ALL, body, TYPES)
    assert codes(analysis) == []
    call = value_of(analysis)
    assert isinstance(call, ast.Call)
    assert isinstance(call.target, BuiltinSymbol)
    if result is not None:
        assert call.target.parameter_types == parameters
        assert call.target.return_type == result
    else:
        assert isinstance(call.type, t.Enum)


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("i := SEL(b, i);", "E0513"),
        ("i := SEL(i, i, i);", "E0301"),
        ("i := SEL(b, i, str);", "E0304"),
        ("i := LIMIT(MN := 1, IN := 2, MX := 3);", "E0514"),
        ("i := SHL(re, 2);", "E0303"),
        ("re := SIN(b);", "E0303"),
        ("p := ADR(i + 1);", "E0323"),
        ("p := ADR(i.3);", "E0323"),
        ("b := __ISVALIDREF(i);", "E0323"),
        ("i := BYTE_TO_INT(str);", "E0301"),
        ("i := __FENCE();", "E0518"),
        ("MAX := 3;", "E0201"),
        ("i := MAX;", "E0201"),
    ],
)
def test_faulty_operator_calls(body: str, code: str) -> None:
    assert code in found(body)


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


INTEGER_TYPES = [e for e in conversion.NUMBERS if e.is_integer]


@given(
    st.sampled_from(["+", "-", "*", "/", "MOD"]),
    st.sampled_from(INTEGER_TYPES),
    st.sampled_from(INTEGER_TYPES),
    st.data(),
)
def test_integer_arithmetic_is_exact_in_the_computed_type(
    op: str, left: t.Elementary, right: t.Elementary, data: st.DataObject
) -> None:
    a = data.draw(st.integers(*conversion.RANGES[left.name]))
    b = data.draw(st.integers(*conversion.RANGES[right.name]).filter(lambda n: n != 0))
    meeting = conversion.OPERANDS[(left.name, right.name)]
    result = folding.arithmetic(op, a, b, meeting.computed)
    low, high = conversion.RANGES[meeting.computed.name]
    assert isinstance(result, int)
    assert low <= result <= high
    exact = {
        "+": a + b, "-": a - b, "*": a * b,
        "/": abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1),
        "MOD": abs(a) % abs(b) * (-1 if a < 0 else 1),
    }[op]  # fmt: skip
    if meeting.warnings == ("", "") and low <= exact <= high:
        assert result == exact


@given(st.floats(allow_nan=False))
def test_real_rounding_agrees_with_single_precision(value: float) -> None:
    rounded = folding.round_real(value)
    assert math.isinf(rounded) or struct.unpack("f", struct.pack("f", rounded))[0] == rounded


@given(st.integers(-(1 << 70), 1 << 70), st.sampled_from(INTEGER_TYPES))
def test_wrapping_keeps_the_low_bytes(value: int, to: t.Elementary) -> None:
    wrapped = folding.wrap(value, to)
    assert isinstance(wrapped, int)
    assert (wrapped - value) % (1 << (8 * to.size)) == 0
    assert folding.fits(wrapped, to)


def test_intrinsics_of_system_sources() -> None:
    text = (
        "PROGRAM P\nVAR n : LINT; a : LWORD; ok : BOOL; buf : ARRAY[0..31] OF LWORD; r : DINT; END_VAR\n"
        "n := __CALL(a, 1, n, 2.5); r := __SETJMP(ADR(buf)); __LONGJMP(ADR(buf), 1); a := "
        "__FRAME_ADDRESS();\n"
        "__MEMCPY(ADR(buf), ADR(n), 8); __MEMSET(ADR(buf), 0, SIZEOF(buf)); n := __LOAD_ACQUIRE(n);\n"
        "__STORE_RELEASE(n, 5); n := __XADD(ADR(n), 1); ok := __COMPARE_AND_SWAP(ADR(n), 1, 2); __FENCE();\n"
        "END_PROGRAM"
    )
    assert codes(analysed(text, options=AnalysisOptions(system=True))) == []
    assert set(codes(analysed(text))) == {"E0518"}
