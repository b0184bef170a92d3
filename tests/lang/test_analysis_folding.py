"""Values of constant expressions: operators, functions, conversions (spec language_operators.md)."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from resolved import constant

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, folding


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
