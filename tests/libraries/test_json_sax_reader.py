"""FB_JsonSaxReader against Python: what it tells of documents, and the texts of bytes and times."""

from __future__ import annotations

import base64
import json
import random

from tests.libraries.st_program import run

NUMBERS = random.Random(8259)
HANDLER = """
    FUNCTION_BLOCK FB_Handler IMPLEMENTS ITcJsonSaxHandler
    VAR_INPUT nLeft : INT := 1000; END_VAR
    VAR s : STRING(1000); END_VAR
    END_FUNCTION_BLOCK
    METHOD PRIVATE Note : HRESULT
    VAR_INPUT t : STRING(200); END_VAR
    s := CONCAT(s, CONCAT(t, ' ')); nLeft := nLeft - 1;
    Note := SEL(nLeft <= 0, 0, 1);
    END_METHOD
    METHOD OnStartObject : HRESULT
    OnStartObject := Note('{');
    END_METHOD
    METHOD OnEndObject : HRESULT
    OnEndObject := Note('}');
    END_METHOD
    METHOD OnStartArray : HRESULT
    OnStartArray := Note('[');
    END_METHOD
    METHOD OnEndArray : HRESULT
    OnEndArray := Note(']');
    END_METHOD
    METHOD OnKey : HRESULT
    VAR_IN_OUT CONSTANT key : STRING; END_VAR
    VAR_INPUT len : UDINT; END_VAR
    OnKey := Note(CONCAT(CONCAT('K', key), CONCAT('/', UDINT_TO_STRING(len))));
    END_METHOD
    METHOD OnString : HRESULT
    VAR_IN_OUT CONSTANT value : STRING; END_VAR
    VAR_INPUT len : UDINT; END_VAR
    OnString := Note(CONCAT(CONCAT('S', value), CONCAT('/', UDINT_TO_STRING(len))));
    END_METHOD
    METHOD OnDint : HRESULT
    VAR_INPUT value : DINT; END_VAR
    OnDint := Note(CONCAT('D', DINT_TO_STRING(value)));
    END_METHOD
    METHOD OnUdint : HRESULT
    VAR_INPUT value : UDINT; END_VAR
    OnUdint := Note(CONCAT('U', UDINT_TO_STRING(value)));
    END_METHOD
    METHOD OnLint : HRESULT
    VAR_INPUT value : LINT; END_VAR
    OnLint := Note(CONCAT('L', LINT_TO_STRING(value)));
    END_METHOD
    METHOD OnUlint : HRESULT
    VAR_INPUT value : ULINT; END_VAR
    OnUlint := Note(CONCAT('W', ULINT_TO_STRING(value)));
    END_METHOD
    METHOD OnLreal : HRESULT
    VAR_INPUT value : LREAL; END_VAR
    OnLreal := Note(CONCAT('F', LREAL_TO_STRING(value)));
    END_METHOD
    METHOD OnBool : HRESULT
    VAR_INPUT value : BOOL; END_VAR
    OnBool := Note(BOOL_TO_STRING(value));
    END_METHOD
    METHOD OnNull : HRESULT
    OnNull := Note('null');
    END_METHOD
"""


def told(document: str, left: int = 1000) -> tuple[list[str], str, str]:
    """What the handler was told, whether all was read, and the error."""
    text = f"""{HANDLER}
        PROGRAM Main
        VAR fb : FB_JsonSaxReader; h : FB_Handler; sJson : STRING(500) := '{document}';
            ok : BOOL; hr : HRESULT; END_VAR
        h.nLeft := {left}; ok := fb.Parse(sJson, h, hrErrorCode => hr);
        END_PROGRAM"""
    with run(text, 1) as program:
        calls = program.literal("Main.h.s")[1:-1].split(" ")[:-1]
        return calls, program.literal("Main.ok"), program.literal("Main.hr")


def test_the_document_of_the_manual_is_told_in_its_order() -> None:
    document = '{"Values":{"Timestamp":"2017-04-04T12:42:42","Sensor1":42.5,"Sensor2":42}}'
    assert told(document) == (
        [
            "{", "KValues/6", "{", "KTimestamp/9", "S2017-04-04T12:42:42/19", "KSensor1/7", "F42.5",
            "KSensor2/7", "U42", "}", "}",
        ],
        "TRUE",
        "0",
    )  # fmt: skip


def test_numbers_have_the_smallest_kind_that_holds_them() -> None:
    numbers = [0, -1, 2**32 - 1, 2**32, -(2**31), -(2**31) - 1, 2**64 - 1, -(2**63), True, False, None]
    kinds = "UDUWDLWL"
    calls, ok, _ = told(json.dumps(numbers))
    wanted = [kind + str(number) for kind, number in zip(kinds, numbers, strict=False)]
    assert (calls, ok) == (["[", *wanted, "TRUE", "FALSE", "null", "]"], "TRUE")
    assert told("[[],{},[{}]]")[0] == ["[", "[", "]", "{", "}", "[", "{", "}", "]", "]"]


def test_a_handler_ends_the_reading_and_wrong_documents_are_not_told() -> None:
    assert told('{"a":[1,2,3]}', left=4) == (["{", "Ka/1", "[", "U1"], "FALSE", "1")
    for wrong in ("[1,", "", "[1 2]"):
        assert told(wrong) == ([], "FALSE", "-2147467259")


def test_bytes_are_decoded() -> None:
    rows = [bytes(NUMBERS.randrange(256) for _ in range(size)) for size in range(1, 9)]
    texts = [base64.b64encode(row).decode() for row in rows]
    wrong = ["", "abc", "ab=c", "====", "a===", "abc-", "QUJDRA=", "QUJDREVGR0hJSktM"]  # the last: no room
    hexes = [row.hex() for row in rows] + ["", "abc", "0g", "00112233445566778899"]
    lines = []
    for n, text in enumerate(texts + wrong):
        lines.append(f"s := '{text}'; k := 8; ok[{n}] := fb.DecodeBase64(s, ADR(a[{n}]), k); n[{n}] := k;")
        lines.append(f"is[{n}] := fb.IsBase64(s);")
    for m, text in enumerate(hexes, start=len(texts) + len(wrong)):
        lines.append(f"s := '{text}'; k := 8; ok[{m}] := fb.DecodeHexBinary(s, ADR(a[{m}]), k); n[{m}] := k;")
        lines.append(f"is[{m}] := fb.IsHexBinary(s);")
    last = len(texts) + len(wrong) + len(hexes) - 1
    text = f"""
        PROGRAM Main
        VAR fb : FB_JsonSaxReader; s : STRING; k : DINT; a : ARRAY[0..{last}] OF ARRAY[0..7] OF BYTE;
            ok, is : ARRAY[0..{last}] OF BOOL; n : ARRAY[0..{last}] OF DINT; END_VAR
        {chr(10).join(lines)}
        END_PROGRAM"""
    with run(text, 1) as program:
        wanted = [*rows, *[None] * len(wrong), *rows, *[None] * 4]
        for n, row in enumerate(wanted):
            done = program.literal(f"Main.ok[{n}]") == "TRUE"
            size = int(program.literal(f"Main.n[{n}]"))
            found = bytes(int(byte) for byte in program.numbers(f"Main.a[{n}]")[:size])
            assert (done, found) == (row is not None, row or b""), n
        room = [len(texts) + len(wrong) - 1, last]
        fits = [n for n in range(last + 1) if program.literal(f"Main.is[{n}]") == "TRUE"]
        assert fits == sorted([*(n for n, row in enumerate(wanted) if row is not None), *room])


def test_times_are_decoded() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_JsonSaxReader; dtValue : DT; dc : DCTIME; ft : FILETIME;
            ok : ARRAY[0..2] OF BOOL; w : ARRAY[0..7] OF BOOL;
        END_VAR
        ok[0] := fb.DecodeDateTime('2017-08-09T06:54:00', nDT => dtValue);
        ok[1] := fb.DecodeDcTime('2017-04-04T12:42:42.000000005Z', nDC => dc);
        ok[2] := fb.DecodeFileTime('2017-04-04T12:42:42.0000007', nFT => ft);
        w[0] := fb.IsISO8601TimeFormat('2017-04-04'); w[1] := fb.IsISO8601TimeFormat('2017-04-31T00:00:00');
        w[2] := fb.IsISO8601TimeFormat('2017-04-04 12:42:42');
        w[3] := fb.IsISO8601TimeFormat('2017-04-04T12:42:42.');
        w[4] := fb.IsISO8601TimeFormat('2017-04-04T12:42:42x'); w[5] := fb.IsISO8601TimeFormat('');
        w[6] := fb.DecodeDcTime('1999-12-31T23:59:59'); w[7] := fb.IsISO8601TimeFormat('2017-04-04T24:00:01');
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.ok") == "[TRUE, TRUE, TRUE]"
        assert program.literal("Main.w") == str([True, *[False] * 7]).upper()
        assert program.literal("Main.dtValue") == "DT#2017-08-09-06:54:00"
        assert program.literal("Main.dc") == "544624962000000005"
        assert program.literal("Main.ft") == "131357833620000007"
