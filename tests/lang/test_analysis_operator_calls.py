"""Operators in functional form: their overloads, and calls that are wrong (spec language_operators.md)."""

from __future__ import annotations

import pytest
from every_type import ALL, TYPES, found
from resolved import analysed, codes, program, value_of

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import AnalysisOptions, carried_type
from tappet.lang.symbols import BuiltinSymbol


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
        ("i := LIMIT(LOW := 1, IN := 2, MX := 3);", "E0514"),
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
