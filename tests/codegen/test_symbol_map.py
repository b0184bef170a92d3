"""Symbol map and values: paths, bits, addresses, browsing, literals both ways."""

from __future__ import annotations

import struct

import msgspec
import pytest
from compiled_programs import build
from hypothesis import given
from hypothesis import strategies as st

from tappet.codegen import literals, values
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.codegen.symbol_types import TypeInfo

TEXT = """
TYPE E_Mode : (Off, On := 7) UINT; END_TYPE
TYPE ST_Item : STRUCT x : INT; tag : STRING(4); flag : BIT; other : BIT; END_STRUCT END_TYPE
FUNCTION_BLOCK FB
VAR_INPUT a : ARRAY [1..2, -1..1] OF ST_Item; END_VAR
VAR {attribute 'hide'} secret : INT; p : POINTER TO INT; END_VAR
METHOD M END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    f : FB; m : E_Mode; sub : DINT (-5..5); n : ARRAY [0..1] OF ARRAY [0..2] OF BYTE; w : WSTRING(3);
    at1 AT %MW5 : WORD; bit1 AT %QX1.9 : BOOL; t : TIME; d : LWORD; ref : REFERENCE TO INT;
END_VAR
END_PROGRAM
"""


@pytest.fixture(scope="module")
def symbols() -> SymbolMap:
    return build(TEXT).symbols


@pytest.mark.parametrize(
    ("path", "spelling", "size", "bit", "kind"),
    [
        ("plc_prg.F.A[2, 1].X", "PLC_PRG.f.a[2, 1].x", 2, None, "int"),
        ("PLC_PRG.f.a[1,-1].other", "PLC_PRG.f.a[1, -1].other", 1, 1, "bool"),
        ("PLC_PRG.n[1][2]", "PLC_PRG.n[1][2]", 1, None, "bits"),
        ("PLC_PRG.n[1, 2]", "PLC_PRG.n[1][2]", 1, None, "bits"),
        ("PLC_PRG.d.63", "PLC_PRG.d.63", 1, 7, "bool"),
        ("PLC_PRG.w[2]", "PLC_PRG.w[2]", 2, None, "bits"),
        ("PLC_PRG.m", "PLC_PRG.m", 2, None, "enum"),
        ("%mw5", "%MW5", 2, None, "bits"),
        ("%QX1.9", "%QX1.9", 1, 1, "bool"),
        ("PLC_PRG", "PLC_PRG", None, None, "program"),
    ],
)
def test_paths(symbols: SymbolMap, path: str, spelling: str, size: int | None, bit: int | None, kind: str):
    ref = symbols.resolve(path)
    assert (ref.path, ref.bit, ref.type.kind) == (spelling, bit, kind)
    assert size is None or ref.size == size


def test_variables_at_addresses_share_their_bytes(symbols: SymbolMap):
    assert symbols.resolve("PLC_PRG.at1").offset == symbols.resolve("%MW5").offset
    bit, direct = symbols.resolve("PLC_PRG.bit1"), symbols.resolve("%QX1.9")
    assert (bit.offset, bit.bit) == (direct.offset, direct.bit)


def test_static_variables_are_seen_in_every_instance():
    """LDEC-26: one place for all instances, derived blocks and the program itself included."""
    symbols = build("""
FUNCTION_BLOCK FB_Base
VAR own : INT; END_VAR
VAR_STAT calls : DINT; END_VAR
calls := calls + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
VAR_STAT name : STRING(8); END_VAR
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR a : FB_Base; b : ARRAY [1..2] OF FB_Derived; END_VAR
VAR_STAT cycles : DINT; END_VAR
a(); b[1](); b[2]();
END_PROGRAM
""").symbols
    places = [symbols.resolve(f"PLC_PRG.{path}.calls").offset for path in ("a", "b[1]", "b[2]")]
    assert len(set(places)) == 1
    assert symbols.resolve("PLC_PRG.b[2].name").type.length == 8
    assert symbols.resolve("PLC_PRG.cycles").offset not in places
    assert [child.name for child in symbols.children("PLC_PRG.b[1]")] == ["own", "calls", "name"]


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("", "empty"),
        ("Nope.x", "'Nope' is no program"),
        ("PLC_PRG.nope", "'PLC_PRG' .* has no member 'nope'"),
        ("PLC_PRG.f.a[3, 0]", "index 3 is outside 1..2"),
        ("PLC_PRG.f.a[1]", "needs 2 indices"),
        ("PLC_PRG.f.a[1, 0", "missing at the end"),
        ("PLC_PRG.d.64", "bit 64 is outside 0..63"),
        ("PLC_PRG.t.3", "has no bits"),
        ("PLC_PRG.ref.x", "is a reference"),
        ("PLC_PRG.m[1]", "is no array"),
        ("PLC_PRG..x", "expected a member name"),
        ("PLC_PRG;", "unexpected ';'"),
        ("%MX1.16", "bit 16 is outside"),
        ("%M", "is no address"),
        ("%MD100000", "lies outside"),
        ("PLC_PRG.w[9]", "index 9 is outside 0..3"),
    ],
)
def test_wrong_paths_say_what_is_wrong(symbols: SymbolMap, path: str, message: str):
    with pytest.raises(SymbolError, match=message):
        symbols.resolve(path)


@given(st.text(max_size=40))
def test_any_text_is_a_path_or_an_error(text: str):
    table = SymbolMap([TypeInfo("INT", "int", 2)], {}, {"X": ""}, {"M": (0, 8)})
    with pytest.raises(SymbolError):
        table.resolve("?" + text)
    try:
        table.resolve(text)
    except SymbolError:
        return


def test_browsing(symbols: SymbolMap):
    assert [c.name for c in symbols.children()] == ["PLC_PRG"]
    inside = {c.name: c for c in symbols.children("PLC_PRG")}
    assert inside["t"].leaf
    assert not inside["f"].leaf
    assert [c.name for c in symbols.children("PLC_PRG.f")] == ["a", "p"]
    assert [c.path for c in symbols.children("PLC_PRG.f.a")][:2] == [
        "PLC_PRG.f.a[1, -1]",
        "PLC_PRG.f.a[1, 0]",
    ]
    for child in inside.values():
        symbols.resolve(child.path)


def test_table_round_trip(symbols: SymbolMap):
    packed = msgspec.msgpack.encode(symbols)
    assert msgspec.msgpack.decode(packed, type=SymbolMap) == symbols
    broken = msgspec.msgpack.decode(packed)
    broken["types"][0][3] = 10_000
    with pytest.raises(msgspec.ValidationError, match="type index 10000 is out of range"):
        msgspec.convert(broken, SymbolMap)


@pytest.mark.parametrize(
    ("path", "given", "literal"),
    [
        ("PLC_PRG.m", "On", "On"),
        ("PLC_PRG.m", "E_Mode.On", "On"),
        ("PLC_PRG.m", 3, "3"),
        ("PLC_PRG.sub", "-5", "-5"),
        ("PLC_PRG.t", "T#1m30s", "T#1m30s"),
        ("PLC_PRG.d", "16#FF", "255"),
        ("PLC_PRG.d", "2#1010_1010", "170"),
        ("PLC_PRG.w", '"ab"', '"ab"'),
        ("PLC_PRG.f.a[1, 0].tag", "'a$'b'", "'a$'b'"),
        ("PLC_PRG.f.a[1, 0].x", -32768, "-32768"),
        ("PLC_PRG.bit1", "TRUE", "TRUE"),
    ],
)
def test_values_both_ways(symbols: SymbolMap, path: str, given: values.Value, literal: str):
    ref = symbols.resolve(path)
    raw = symbols.encode(ref, given)
    if ref.bit is not None:
        raw = bytes([raw[0] << ref.bit])
    assert symbols.format_literal(ref, symbols.decode(ref, raw)) == literal


@pytest.mark.parametrize(
    ("path", "given", "message"),
    [
        ("PLC_PRG.m", "Maybe", "no value of E_Mode; it has Off, On"),
        ("PLC_PRG.sub", 6, "outside -5..5"),
        ("PLC_PRG.t", "1s", "is no TIME"),
        ("PLC_PRG.t", "5", "is no TIME; write for example T#1s500ms"),
        ("PLC_PRG.t", "T#1s1m", "units must come in the order"),
        ("PLC_PRG.f.a[1, 0].x", 40000, "outside -32768..32767"),
        ("PLC_PRG.f.a[1, 0].x", "four", "is no INT; write for example 12"),
        ("PLC_PRG.f.a[1, 0].x", None, "null is no INT"),
        ("PLC_PRG.f.a[1, 0].tag", "'too long'", "longer than STRING"),
        ("PLC_PRG.bit1", "maybe", "write TRUE or FALSE"),
        ("PLC_PRG.f", 1, "write its members one by one"),
    ],
)
def test_wrong_values_say_what_is_expected(symbols: SymbolMap, path: str, given: values.Value, message: str):
    with pytest.raises(ValueError, match=message):
        symbols.encode(symbols.resolve(path), given)


@given(st.floats(width=32, allow_nan=False))
def test_real_literals_read_back(number: float):
    text = values.format_real(number, 4)
    if text not in ("Infinity", "-Infinity"):
        assert struct.pack("<f", float(text)) == struct.pack("<f", number)
        assert "." in text


@given(
    st.sampled_from(["time", "ltime", "date", "tod", "dt", "ldate", "ltod", "ldt"]),
    st.integers(min_value=0, max_value=86_399_999),
)
def test_times_read_back(kind: str, number: int):
    if kind == "date":
        number -= number % 86_400
    elif kind == "ldate":
        number = number * 86_400_000_000_000 % (1 << 62)
        number -= number % 86_400_000_000_000
    assert literals.parse_time(kind, literals.format_time(kind, number)) == number


@pytest.mark.parametrize("text", ["D#99999999999999999999-1-1", "D#2026-1-99999999999999999999"])
def test_a_date_far_out_is_refused(text: str):
    with pytest.raises(ValueError, match="out of range; write for example D#2026-01-31"):
        literals.parse_time("date", text)


@given(st.text(st.characters(max_codepoint=255), max_size=20))
def test_strings_read_back(text: str):
    assert literals.parse_string(literals.format_string(text, False), False) == text


LONG = """
PROGRAM PLC_PRG
VAR a : ARRAY [-5..2499] OF INT; m : ARRAY [1..40, -1..98] OF BYTE; s : ARRAY [0..9] OF INT; n : INT; END_VAR
END_PROGRAM
"""


@pytest.fixture(scope="module")
def long() -> SymbolMap:
    return build(LONG).symbols


@pytest.mark.parametrize(
    ("path", "indices"),
    [
        ("PLC_PRG.a", [(i,) for i in range(-5, 2500)]),
        ("PLC_PRG.m", [(i, j) for i in range(1, 41) for j in range(-1, 99)]),
    ],
)
def test_long_arrays_are_listed_in_parts(long: SymbolMap, path: str, indices: list[tuple[int, ...]]) -> None:
    """Every element once, in order, in lists of at most 1000; each leads where its path leads."""
    parts = long.children(path)
    assert all(not part.leaf and part.kind == "part" for part in parts)
    found = [child for part in parts for child in long.children(part.path)]
    assert max(len(long.children(part.path)) for part in parts) == 1000
    assert [child.path for child in found] == [f"{path}[{', '.join(map(str, i))}]" for i in indices]
    offsets = [long.resolve(child.path).offset for child in found]
    assert offsets == sorted(offsets)


def test_any_part_of_an_array_can_be_listed(long: SymbolMap) -> None:
    assert [c.name for c in long.children("plc_prg.a[ 7 .. 9 ]")] == ["[7]", "[8]", "[9]"]
    assert [c.name for c in long.children("PLC_PRG.m[1, 98..2, 0]")] == ["[1, 98]", "[2, -1]", "[2, 0]"]
    assert [c.name for c in long.children("PLC_PRG.s[9..9]")] == ["[9]"]
    assert [c.name for c in long.children("PLC_PRG.a[-5..1994]")] == ["[-5..994]", "[995..1994]"]


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("PLC_PRG.a[0..2500]", "index 2500 is outside -5..2499"),
        ("PLC_PRG.a[9..8]", "first index is behind"),
        ("PLC_PRG.m[1..2]", "write indices of the array"),
        ("PLC_PRG.a[x..2]", "write indices of the array"),
        ("PLC_PRG.n[0..1]", "has no elements"),
    ],
)
def test_a_part_that_does_not_exist_is_refused(long: SymbolMap, path: str, said: str) -> None:
    with pytest.raises(SymbolError, match=said):
        long.children(path)
