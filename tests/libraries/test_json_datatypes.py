"""FB_JsonReadWriteDatatype on the runtime: variables of any type against Python's json module."""

from __future__ import annotations

import json
import random

import pytest

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

NUMBERS = random.Random(8259)
SESSION = BuildSession()
LIBRARIES = (
    "Standard",
    "Tc2_System, * (Beckhoff Automation GmbH)",
    "Tc3_JsonXml, * (Beckhoff Automation GmbH)",
)
TYPES = """TYPE E_Mode : (Off := 0, On := 7, Fault := -3) INT; END_TYPE
TYPE ST_Point : STRUCT x : LREAL; y : LREAL := 1.5; END_STRUCT END_TYPE
TYPE ST_All : STRUCT
    b : BOOL; s8 : SINT := -8; u8 : BYTE := 200; s16 : INT := -300; u16 : WORD := 65535;
    s32 : DINT := -70000; u32 : UDINT := 4294967295; s64 : LINT := -9223372036854775807;
    u64 : ULINT := 18446744073709551615; r : REAL := 0.1; l : LREAL := -2.5E-7; t : STRING(20) := 'say "so"';
    e : E_Mode := E_Mode.Fault; d : TIME := T#1S500MS; m : DT := DT#2017-04-04-12:42:42;
    day : DATE := D#2024-02-29;
    a : ARRAY [1..3] OF INT := [1, 2, 3]; g : ARRAY [0..1, 2..4] OF USINT := [1, 2, 3, 4, 5, 6];
    p : ARRAY [0..1] OF ST_Point; inner : ST_Point; pNone : POINTER TO INT;
    bit0 : BIT; bit1 : BIT := TRUE;
END_STRUCT END_TYPE
"""
WHOLE = {
    "b": False, "s8": -8, "u8": 200, "s16": -300, "u16": 65535, "s32": -70000, "u32": 2**32 - 1,
    "s64": -(2**63) + 1, "u64": 2**64 - 1, "r": 0.1, "l": -2.5e-7, "t": 'say "so"', "e": -3, "d": 1500,
    "m": "2017-04-04T12:42:42", "day": "2024-02-29T00:00:00", "a": [1, 2, 3], "g": [[1, 2, 3], [4, 5, 6]],
    "p": [{"x": 0.0, "y": 1.5}, {"x": 0.0, "y": 1.5}], "inner": {"x": 0.0, "y": 1.5},
    "bit0": False, "bit1": True,
}  # fmt: skip


def compiled(text: str, previous: CodePackage | None = None) -> CodePackage:
    options = BuildOptions(libraries=tuple(LibraryReference(name) for name in LIBRARIES), level=1)
    tasks = (Task("Main", interval_ns=10_000_000, programs=("PLC_PRG",)),)
    sources = [Source("Types", TYPES), Source("PLC_PRG", text)]
    result = build_application(sources, tasks, options, previous, SESSION)
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    assert not errors, errors
    assert result.package is not None
    return result.package


def read_text(runtime: LocalRuntime, name: str) -> str:
    value = runtime.read(f"PLC_PRG.{name}")
    assert isinstance(value, str)
    return value


WRITES = """PROGRAM PLC_PRG
VAR
    fb : FB_JsonReadWriteDatatype; st : ST_All; doc : STRING(4000); n, size : UDINT; s : STRING(255);
    fbWriter : FB_JsonSaxWriter; keyed : STRING(4000); ok : ARRAY [0..4] OF BOOL;
    hr : ARRAY [0..4] OF HRESULT;
    single : INT := 12; room : UDINT := 4000; copy : STRING(4000); tiny : STRING := 'full'; nTiny : UDINT;
END_VAR
n := fb.CopyJsonStringFromSymbol('ST_All', SIZEOF(st), ADR(st), doc, SIZEOF(doc));
size := fb.GetSizeJsonStringFromSymbol('st_all', SIZEOF(st), ADR(st));
s := fb.GetJsonStringFromSymbol('INT', SIZEOF(single), ADR(single));
ok[0] := fb.GetJsonFromSymbol('ST_All', SIZEOF(st), ADR(st), room, ADR(copy));
fbWriter.ResetDocument(); fbWriter.StartObject();
ok[1] := fb.AddJsonKeyValueFromSymbol(fbWriter, 'Values', 'ST_Point', SIZEOF(st.inner), ADR(st.inner));
ok[2] := fb.AddJsonKeyValueFromSymbol(fbWriter, 'None', 'ST_None', 4, ADR(st), hrErrorCode => hr[2]);
ok[3] := fb.AddJsonKeyValueFromSymbol(fbWriter, 'Size', 'ST_Point', 4, ADR(st), hrErrorCode => hr[3]);
fbWriter.EndObject(); fbWriter.CopyDocument(keyed, SIZEOF(keyed));
nTiny := fb.CopyJsonStringFromSymbol('ST_All', SIZEOF(st), ADR(st), tiny, 5, hrErrorCode => hr[4]);
END_PROGRAM
"""


def test_variables_become_documents() -> None:
    with LocalRuntime(compiled(WRITES)) as runtime:
        runtime.run(cycles=1)
        assert json.loads(read_text(runtime, "doc")) == WHOLE
        assert read_text(runtime, "copy") == read_text(runtime, "doc")
        size = len(read_text(runtime, "doc")) + 1
        assert [runtime.read(f"PLC_PRG.{name}") for name in ("n", "size", "room")] == [size] * 3
        assert read_text(runtime, "s") == "12"
        assert json.loads(read_text(runtime, "keyed")) == {"Values": {"x": 0.0, "y": 1.5}}
        assert runtime.literal("PLC_PRG.ok") == "[TRUE, TRUE, FALSE, FALSE, FALSE]"
        fail = -2147467259
        assert runtime.literal("PLC_PRG.hr") == f"[0, 0, {fail}, {fail}, {fail}]"
        assert [runtime.read("PLC_PRG.tiny"), runtime.read("PLC_PRG.nTiny")] == ["", 0]


READS = """PROGRAM PLC_PRG
VAR
    fb : FB_JsonReadWriteDatatype; st : ST_All; json, doc : STRING(4000); ok : BOOL; hr : HRESULT;
END_VAR
ok := fb.SetSymbolFromJson(json, 'ST_All', SIZEOF(st), ADR(st), hrErrorCode => hr);
fb.CopyJsonStringFromSymbol('ST_All', SIZEOF(st), ADR(st), doc, SIZEOF(doc));
END_PROGRAM
"""
OTHER = {
    "b": True, "s8": -128, "u8": 255, "s16": 32767, "u16": 0, "s32": 2**31 - 1, "u32": 1, "s64": -(2**63),
    "u64": 2**63, "r": 1.5, "l": 1e300, "t": "twenty characters it", "e": 7, "d": 0,
    "m": "2000-01-01T00:00:00", "day": "1999-12-31T00:00:00", "a": [-1, 0, 32767],
    "g": [[9, 8, 7], [6, 5, 4]], "p": [{"x": 3.0, "y": -4.0}, {"x": 0.0, "y": 0.0}],
    "inner": {"x": 1.0, "y": 2.0}, "bit0": True, "bit1": False,
}  # fmt: skip
WRONG = [
    {"none": 1}, {"b": 1}, {"s8": 128}, {"s8": -129}, {"u8": -1}, {"u8": 256}, {"u32": 2**32},
    {"s64": 2**63}, {"u64": -1}, {"u64": 2**64}, {"s16": 1.5}, {"s16": "1"}, {"r": 1e39},
    {"t": "twenty-one characters"}, {"t": 5},
    {"m": "2023-02-29T00:00:00"}, {"m": "today"}, {"m": 5}, {"a": [1, 2]},
    {"a": [1, 2, 3, 4]}, {"a": [1, 2, "3"]},
    {"g": [1, 2]}, {"inner": []}, {"inner": {"z": 1}}, {"pNone": 1}, {"e": None}, [], 5, "x",
    {"s32": 1, "inner": {"x": 1.0, "y": "no"}},
]  # fmt: skip


def test_documents_become_variables_or_change_nothing() -> None:
    with LocalRuntime(compiled(READS)) as runtime:
        for wrong in [*(json.dumps(document) for document in WRONG), "{", ""]:
            runtime.write("PLC_PRG.json", wrong)
            runtime.run(cycles=1)
            assert (runtime.read("PLC_PRG.ok"), runtime.read("PLC_PRG.hr")) == (False, -2147467259), wrong
            assert json.loads(read_text(runtime, "doc")) == WHOLE, wrong
        names = list(OTHER)
        expected = dict(WHOLE)
        for _ in range(20):
            chosen = NUMBERS.sample(names, NUMBERS.randint(0, len(names)))
            expected |= {name: OTHER[name] for name in chosen}
            runtime.write("PLC_PRG.json", json.dumps({name: OTHER[name] for name in chosen}))
            runtime.run(cycles=1)
            assert runtime.read("PLC_PRG.ok") is True
            assert json.loads(read_text(runtime, "doc")) == expected
        for moment in ("2000-01-01T00:00:00.25", "2000-01-01T00:00:00Z", "2000-01-01"):
            runtime.write("PLC_PRG.json", json.dumps({"m": moment}))
            runtime.run(cycles=1)
            assert json.loads(read_text(runtime, "doc"))["m"] == "2000-01-01T00:00:00"


NAMES = """PROGRAM PLC_PRG
VAR
    more : ARRAY [0..9] OF BYTE; fb : FB_JsonReadWriteDatatype; st : ST_All; s : ARRAY [0..6] OF STRING;
    hr : ARRAY [0..1] OF HRESULT; p : POINTER TO INT; doc : STRING(2000);
END_VAR
p := __NEW(INT);
s[0] := fb.GetDataTypeNameByAddress(SIZEOF(st), ADR(st), hrErrorCode => hr[0]);
s[1] := fb.GetDataTypeNameByAddress(SIZEOF(st.p[1]), ADR(st.p[1]));
s[2] := fb.GetDataTypeNameByAddress(SIZEOF(st.p[1].y), ADR(st.p[1].y));
s[3] := fb.GetDataTypeNameByAddress(SIZEOF(st.g), ADR(st.g));
s[4] := fb.GetDataTypeNameByAddress(1, ADR(st.g[1, 3]));
s[5] := fb.GetDataTypeNameByAddress(3, ADR(st.l));
s[6] := fb.GetDataTypeNameByAddress(2, p, hrErrorCode => hr[1]);
__DELETE(p);
fb.CopyJsonStringFromSymbol(s[0], SIZEOF(st), ADR(st), doc, SIZEOF(doc));
END_PROGRAM
"""


@pytest.mark.parametrize("changed", [False, True], ids=["download", "online change"])
def test_addresses_have_types(changed: bool) -> None:
    first = compiled(NAMES)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=1)
        if changed:
            text = NAMES.replace("more : ARRAY [0..9] OF BYTE;", "more : ARRAY [0..99999] OF LREAL;")
            runtime.plc.download(compiled(text, first).to_bytes(), "online_change")
            runtime.run(cycles=2)
        assert runtime.literal("PLC_PRG.s") == (
            "['ST_All', 'ST_Point', 'LREAL', 'ARRAY [0..1, 2..4] OF USINT', 'USINT', '', '']"
        )
        assert runtime.literal("PLC_PRG.hr") == "[0, -2147467259]"
        assert json.loads(read_text(runtime, "doc")) == WHOLE
