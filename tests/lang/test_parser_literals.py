"""Every kind of literal: value, type, and what is wrong with a bad one (spec LTYP-30..LTYP-40)."""

from __future__ import annotations

import datetime

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.iec.literals import decode
from tappet.lang import ast
from tappet.lang.parser import parse_expression


@pytest.mark.parametrize(
    ("text", "kind", "prefix", "value"),
    [
        ("14", "int", None, 14),
        ("1_000_000", "int", None, 1_000_000),
        ("0007", "int", None, 7),
        ("2#1001_0011", "int", None, 147),
        ("8#67", "int", None, 55),
        ("16#A", "int", None, 10),
        ("16#ff_ff", "int", None, 65535),
        ("18446744073709551615", "int", None, 2**64 - 1),
        ("7.4", "real", None, 7.4),
        ("1.64e+009", "real", None, 1.64e9),
        ("1E3", "real", None, 1000.0),
        ("TRUE", "bool", None, True),
        ("false", "bool", None, False),
        ("DINT#34", "int", "DINT", 34),
        ("INT#-5", "int", "INT", -5),
        ("SINT#-128", "int", "SINT", -128),
        ("BYTE#16#FF", "int", "BYTE", 255),
        ("WORD#2#101", "int", "WORD", 5),
        ("REAL#2", "real", "REAL", 2.0),
        ("real#0.1", "real", "REAL", 0.10000000149011612),
        ("LREAL#-1.5e-3", "real", "LREAL", -0.0015),
        ("BOOL#1", "bool", "BOOL", True),
        ("BOOL#FALSE", "bool", "BOOL", False),
        ("T#14ms", "time", None, 14),
        ("T#100S12ms", "time", None, 100_012),
        ("t#12h34m15s", "time", None, 45_255_000),
        ("TIME#1d2h3m4s5ms", "time", None, 93_784_005),
        ("T#0s", "time", None, 0),
        ("T#1.5s", "time", None, 1500),
        ("T#5d_14h", "time", None, 482_400_000),
        ("T#49d17h2m47s295ms", "time", None, 2**32 - 1),
        ("LTIME#1000d15h23m12s34ms2us44ns", "ltime", None, 86_455_392_034_002_044),
        ("LTIME#3445343m3424732874823ns", "ltime", None, 206_724_004_732_874_823),
        ("D#1970-01-01", "date", None, 0),
        ("DATE#1996-05-06", "date", None, 831_340_800),
        ("d#1972-03-29", "date", None, 70_675_200),
        ("TIME_OF_DAY#15:36:30.123", "tod", None, 56_190_123),
        ("tod#00:00:00", "tod", None, 0),
        ("TOD#23:59:59.999", "tod", None, 86_399_999),
        ("LTOD#00:00:01.000000002", "ltod", None, 1_000_000_002),
        ("DATE_AND_TIME#1996-05-06-15:36:30", "dt", None, 831_396_990),
        ("dt#1972-03-29-00:00:00", "dt", None, 70_675_200),
        ("DT#1998-02-13-14:20", "dt", None, 887_379_600),
        ("LDT#1970-01-01-00:00:01", "ldt", None, 1_000_000_000),
        ("' Abby and Craig '", "string", None, b" Abby and Craig "),
        ("'costs ($$)'", "string", None, b"costs ($)"),
        ("'$41$'$L$P$R$T'", "string", None, b"A'\n\f\r\t"),
        ("'$l$n$p$r$t'", "string", None, b"\n\n\f\r\t"),
        ("'ä'", "string", None, b"\xe4"),
        ("''", "string", None, b""),
        ("STRING#'x'", "string", "STRING", b"x"),
        ('"weiß 中"', "wstring", None, "weiß 中"),
        ('"$00E4$"$\'"', "wstring", None, "ä\"'"),
        ('WSTRING#"x"', "wstring", "WSTRING", "x"),
    ],
)
def test_value(text: str, kind: str, prefix: str | None, value: object) -> None:
    node, diagnostics = parse_expression(text)
    assert diagnostics == []
    assert isinstance(node, ast.Literal)
    assert (node.kind, node.prefix, node.value, type(node.value)) == (kind, prefix, value, type(value))
    assert node.text == text


@pytest.mark.parametrize(
    ("text", "code", "says"),
    [
        ("15ms", "E0016", "T# is missing before '15ms'"),
        ("12abc", "E0010", "not a valid number"),
        ("1__", "E0010", "single underscore"),
        ("8#9", "E0010", "Base 8 has no such digit"),
        ("2#102", "E0010", "Base 2 has no such digit"),
        ("3#12", "E0010", "16#FF"),
        ("18446744073709551616", "E0010", "ULINT"),
        ("1e999", "E0010", "largest LREAL"),
        ("9" * 5000, "E0010", "more digits"),
        ("t#5m68s", "E0011", "a lower unit exceeds its limit: 68s"),
        ("t#4ms13d", "E0011", "wrong order of the units"),
        ("T#5s5s", "E0011", "'s' stands twice"),
        ("T#5", "E0011", "the unit of 5 is missing"),
        ("T#5x", "E0011", "unknown unit 'x'"),
        ("T#", "E0011", "a number with its unit"),
        ("T#5us", "E0011", "LTIME#"),
        ("T#-5s", "E0011", "cannot be negative"),
        ("T#50d", "E0011", "The longest time"),
        ("T#1.5ms", "E0011", "finer"),
        ("D#1999-13-01", "E0012", "there is no day 1999-13-01"),
        ("D#1969-12-31", "E0012", "1970-01-01"),
        ("D#2200-01-01", "E0012", "too late"),
        ("D#hello", "E0012", "year-month-day"),
        ("TOD#24:00:00", "E0012", "23:59:59"),
        ("TOD#12", "E0012", "hour:minute:second"),
        ("TOD#12:00:00.0001", "E0012", "finer"),
        ("DT#1999-01-01", "E0012", "DT#1996-05-06-15:36:30"),
        ("'a$zb'", "E0013", "'$z' is no character of a STRING"),
        ('"$41"', "E0013", "four hexadecimal digits"),
        ("SINT#300", "E0014", "Constant 'SINT#300' too large for type 'SINT'"),
        ("BYTE#256", "E0014", "0..255"),
        ("USINT#-1", "E0014", "0..255"),
        ("INT#16#FFFF", "E0014", "-32768..32767"),
        ("REAL#1e39", "E0014", "REAL"),
        ("REAL#3.4028235677973366E38", "E0014", "REAL"),
        ("INT#1.5", "E0015", "whole numbers"),
        ("BOOL#2", "E0015", "TRUE, FALSE, 1 and 0"),
        ("INT#", "E0015", "Write a number after INT#"),
        ("INT#abc", "E0015", "INT"),
        ("STRING#5", "E0015", "STRING#'text'"),
        ("FOO#5", "E0017", "'FOO' before '#'"),
    ],
)
def test_error_names_what_is_wrong_and_what_is_right(text: str, code: str, says: str) -> None:
    node, diagnostics = parse_expression(text)
    assert [d.code for d in diagnostics] == [code]
    assert says in f"{diagnostics[0].message}. {diagnostics[0].advice}"
    assert isinstance(node, ast.Literal)
    assert node.value is None


def test_string_beyond_latin_1_is_kept_in_utf_8_with_a_warning() -> None:
    node, diagnostics = parse_expression("'急停$41'")
    assert [d.code for d in diagnostics] == ["W1501"]
    assert isinstance(node, ast.Literal)
    assert node.value == "急停A".encode()


def test_typed_enumeration_value_is_a_member() -> None:
    node, diagnostics = parse_expression("E_Mode#Auto")
    assert diagnostics == []
    assert isinstance(node, ast.Member)
    assert isinstance(node.base, ast.Name)
    assert (node.base.name, node.name) == ("E_Mode", "Auto")
    assert node.name_span.column == 7


@given(st.integers(0, 2**32 - 1))
def test_every_time_in_milliseconds_can_be_written(ms: int) -> None:
    days, rest = divmod(ms, 86_400_000)
    hours, rest = divmod(rest, 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    seconds, rest = divmod(rest, 1000)
    assert decode(f"T#{days}d{hours}h{minutes}m{seconds}s{rest}ms").value == ms
    assert decode(f"T#{ms}ms").value == ms


@given(st.datetimes(datetime.datetime(1970, 1, 1), datetime.datetime(2106, 2, 7)))
def test_every_date_can_be_written(when: datetime.datetime) -> None:
    expected = int((when.replace(microsecond=0) - datetime.datetime(1970, 1, 1)).total_seconds())
    assert decode(when.strftime("DT#%Y-%m-%d-%H:%M:%S")).value == expected
    assert decode(when.strftime("D#%Y-%m-%d")).value == expected // 86_400 * 86_400
    assert decode(when.strftime("TOD#%H:%M:%S")).value == expected % 86_400 * 1000


@given(st.binary(max_size=40))
def test_every_string_can_be_written_with_escapes(value: bytes) -> None:
    assert decode("'" + "".join(f"${byte:02X}" for byte in value) + "'").value == value


@given(st.text(alphabet=st.characters(codec="ascii"), min_size=1, max_size=30))
def test_decode_takes_anything(text: str) -> None:
    result = decode(f"T#{text}")
    assert (result.value is None) == (result.problem is not None)
