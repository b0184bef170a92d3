"""Documents of Tc3_JsonXml against Python's json module."""

import base64
import json
import random
from typing import Any

import pytest
from tests.libraries.st_program import run

NUMBERS = random.Random(8259)
WORDS = ["", "plain", 'say "so"', "back\\slash", "line\nend\ttab", "\x01\x1f", "it's $5", "a/b"]


def _literal(text: str) -> str:
    """A text in ST; every character that is not plain is written by its number."""
    plain = all(32 <= ord(c) < 127 and c not in "$'" for c in text)
    if plain:
        return f"'{text}'"
    return "'" + "".join(c if 32 <= ord(c) < 127 and c not in "$'" else f"${ord(c):02X}" for c in text) + "'"


def _filled(name: str, data: bytes) -> str:
    """Statements that put bytes into a text of any length."""
    parts = [f"{name}[{n}] := {byte};" for n, byte in enumerate(data)]
    return " ".join([*parts, f"{name}[{len(data)}] := 0;"])


def _some(depth: int) -> Any:
    kind = NUMBERS.randrange(8 if depth else 6)
    if kind == 6:
        return [_some(depth - 1) for _ in range(NUMBERS.randrange(4))]
    if kind == 7:
        return {f"k{n}": _some(depth - 1) for n in range(NUMBERS.randrange(4))}
    exponent = NUMBERS.randint(-300, 300)
    choices: list[Any] = [
        None,
        NUMBERS.random() < 0.5,
        NUMBERS.randint(-(2**63), 2**64 - 1),
        NUMBERS.uniform(-1, 1) * 10.0**exponent,
        NUMBERS.choice(WORDS),
        NUMBERS.choice(["ä", "日本", "\U0001f600"]),
    ]
    return choices[kind]


def _parsed(texts: list[bytes]) -> list[tuple[bool, int, str]]:
    """For each text whether it is JSON, where it is wrong, and what is written of it."""
    lines = []
    for n, text in enumerate(texts):
        lines.append(f"{_filled('sIn', text)} v := fb.ParseDocument(sIn); ok[{n}] := v <> 0;")
        lines.append(f"wrong[{n}] := fb.nErrorAt; fb.CopyDocument(aOut[{n}], SIZEOF(aOut[{n}]));")
    last = len(texts) - 1
    program_text = f"""
        PROGRAM Main
        VAR
            fb : FB_JsonDomParser; v : SJsonValue; sIn : STRING(2000);
            aOut : ARRAY[0..{last}] OF STRING(2000);
            ok : ARRAY[0..{last}] OF BOOL; wrong : ARRAY[0..{last}] OF UDINT;
        END_VAR
        {chr(10).join(lines)}
        END_PROGRAM"""
    with run(program_text, 1) as program:
        ok = program.literal("Main.ok").strip("[]").split(", ")
        at = program.literal("Main.wrong").strip("[]").split(", ")
        return [(ok[n] == "TRUE", int(at[n]), program.literal(f"Main.aOut[{n}]")) for n in range(len(texts))]


def _text_of(literal: str) -> str:
    """The characters of an ST literal."""
    found, n, body = bytearray(), 0, literal[1:-1]
    names = {"R": 13, "L": 10, "N": 10, "T": 9, "P": 12, "$": 36, "'": 39}
    while n < len(body):
        if body[n] != "$":
            found += body[n].encode("latin-1")
            n += 1
        elif body[n + 1] in names:
            found.append(names[body[n + 1]])
            n += 2
        else:
            found.append(int(body[n + 1 : n + 3], 16))
            n += 3
    return found.decode("utf-8")


def test_what_is_read_and_written_again_is_the_same_document() -> None:
    documents = [
        NUMBERS.choice([[_some(3) for _ in range(4)], {"a": _some(3), "b": _some(2)}]) for _ in range(12)
    ]
    documents += [[], {}, "text", 5, -0.5, None, True, [[[[]]]], {"": {"": []}}]
    texts = []
    for number, document in enumerate(documents):
        layout = {"indent": 2} if number % 3 == 0 else {"ensure_ascii": number % 2 == 0}
        texts.append(json.dumps(document, **layout).encode()[:1999])
    fitting = [(d, t) for d, t in zip(documents, texts, strict=True) if len(t) < 1500]
    found = _parsed([text for _, text in fitting])
    assert [ok for ok, _, _ in found] == [True] * len(fitting)
    for (document, _), (_, _, written) in zip(fitting, found, strict=True):
        assert json.loads(_text_of(written)) == document


def test_what_python_refuses_is_refused() -> None:
    wrong = [
        "", " ", "{", "[", "[1,]", "[1 2]", '{"a"}', '{"a":}', '{"a":1,}', "{a:1}", "[01]", "[1.]",
        "[.5]", "[+1]",
        "[-]", "[1e]", "[tru]", "[nul", '["', '["\\x"]', '["\\u12"]', "[1]]", "}", '{"a":1]', '["\n"]',
        "[1}", ",",
        '{"a" 1}', "[1e+]", '["a" "b"]', "- 1",
    ]  # fmt: skip
    found = _parsed([text.encode() for text in wrong])
    for text, (ok, at, _) in zip(wrong, found, strict=True):
        with pytest.raises(json.JSONDecodeError):
            json.loads(text)
        assert not ok, text
        assert at <= len(text), text
    assert found[wrong.index("[1 2]")][1] == 3
    assert found[wrong.index('{"a":}')][1] == 5


def test_values_are_read_by_name_and_number() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_JsonDomParser; doc, v : SJsonValue; sJson : STRING(300); i : DINT; l : LREAL;
            s : STRING(80);
            b : ARRAY[0..7] OF BOOL; u : UDINT; h : LINT; it, itEnd : SJsonAIterator; m : SJsonIterator;
            nSum : DINT;
            sNames : STRING(80); j, k : DINT; e : EJsonType;
        END_VAR
        sJson := '{"n":-42,"x":2.75,"s":"two words","t":true,"z":null,"a":[1,2,3],';
        sJson := CONCAT(sJson, '"o":{"deep":"yes"},"big":9007199254740993}');
        doc := fb.ParseDocument(sJson);
        i := fb.GetInt(fb.FindMember(doc, 'n')); l := fb.GetDouble(fb.FindMember(doc, 'x'));
        s := fb.GetString(fb.FindMember(doc, 's')); b[0] := fb.GetBool(fb.FindMember(doc, 't'));
        b[1] := fb.HasMember(doc, 'z'); b[2] := fb.HasMember(doc, 'zz');
        b[3] := fb.IsNull(fb.FindMember(doc, 'z'));
        b[4] := fb.IsInt(fb.FindMember(doc, 'n')); b[5] := fb.IsInt(fb.FindMember(doc, 'x'));
        b[6] := fb.IsDouble(fb.FindMember(doc, 'x')); b[7] := fb.IsString(fb.FindMember(doc, 'nothing'));
        h := fb.GetInt64(fb.FindMember(doc, 'big')); e := fb.GetType(fb.FindMember(doc, 'o'));
        v := fb.FindMember(doc, 'a'); u := fb.GetArraySize(v); j := fb.GetInt(fb.GetArrayValueByIdx(v, 2));
        k := fb.GetInt(fb.GetArrayValueByIdx(v, 3));
        it := fb.ArrayBegin(v); itEnd := fb.ArrayEnd(v);
        WHILE it <> itEnd DO
            nSum := nSum + fb.GetInt(fb.GetArrayValue(it)); it := fb.NextArray(it);
        END_WHILE
        m := fb.MemberBegin(doc);
        WHILE m <> fb.MemberEnd(doc) DO
            sNames := CONCAT(sNames, fb.GetMemberName(m)); m := fb.NextMember(m);
        END_WHILE
        END_PROGRAM"""
    names = ["i", "l", "s", "b", "h", "e", "u", "j", "k", "nSum", "sNames"]
    with run(text, 1) as program:
        assert [program.literal(f"Main.{name}") for name in names] == [
            "-42", "2.75", "'two words'", "[TRUE, TRUE, FALSE, TRUE, TRUE, FALSE, TRUE, FALSE]",
            "9007199254740993",
            "eObjectType", "3", "3", "0", "6", "'nxstzaobig'",
        ]  # fmt: skip


def test_a_document_is_made_and_changed() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_JsonDomParser; doc, v, o : SJsonValue; s, t : STRING(255); b : ARRAY[0..3] OF BOOL;
            x : SJsonValue;
            nStatus : ARRAY[0..1] OF DINT;
        END_VAR
        doc := fb.NewDocument();
        fb.AddIntMember(doc, 'i', -5); fb.AddDoubleMember(doc, 'd', 0.1); fb.AddStringMember(doc, 's', 'a"b');
        fb.AddBoolMember(doc, 'b', TRUE); fb.AddNullMember(doc, 'n');
        fb.AddUint64Member(doc, 'u', 18446744073709551615);
        fb.AddInt64Member(doc, 'm', -9223372036854775807);
        v := fb.AddArrayMember(doc, 'a', 3);
        fb.PushbackIntValue(v, 1); fb.PushbackStringValue(v, 'x'); fb.PushbackBoolValue(v, FALSE);
        fb.PushbackDoubleValue(v, 1.5); fb.PushbackNullValue(v);
        o := fb.AddObjectMember(doc, 'o'); fb.AddUintMember(o, 'p', 7);
        s := fb.GetDocument(); nStatus[0] := fb.initStatus;
        b[0] := fb.RemoveMemberByName(doc, 'a'); b[1] := fb.RemoveMemberByName(doc, 'none');
        b[2] := fb.SetString(fb.FindMember(doc, 'i'), 'now text'); b[3] := fb.SetDouble(0, 1.0);
        fb.SetInt(fb.FindMember(doc, 'o'), 3);
        t := fb.GetDocument(); x := fb.AddIntMember(v, 'not an object', 1); nStatus[1] := fb.initStatus;
        END_PROGRAM"""
    with run(text, 1) as program:
        first = json.loads(_text_of(program.literal("Main.s")))
        assert first == {
            "i": -5, "d": 0.1, "s": 'a"b', "b": True, "n": None, "u": 2**64 - 1, "m": -(2**63) + 1,
            "a": [1, "x", False, 1.5, None], "o": {"p": 7},
        }  # fmt: skip
        second = json.loads(_text_of(program.literal("Main.t")))
        assert second == {
            "i": "now text", "d": 0.1, "s": 'a"b', "b": True, "n": None, "u": 2**64 - 1,
            "m": -(2**63) + 1, "o": 3,
        }  # fmt: skip
        assert program.literal("Main.b") == "[TRUE, FALSE, TRUE, FALSE]"
        assert program.literal("Main.nStatus") == "[0, -2147467259]"


def test_the_memory_of_a_document_is_bounded() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_JsonDomParser; doc, v, w : SJsonValue; nAdded : DINT; xFull, xAgain, xDeep : BOOL;
            sDeep : STRING(200); i : INT; sLong : STRING(255); nTexts : DINT;
        END_VAR
        doc := fb.NewDocument(); v := fb.AddArrayMember(doc, 'a', 0);
        WHILE fb.PushbackIntValue(v, 1) DO nAdded := nAdded + 1; END_WHILE
        xFull := fb.initStatus <> 0;
        doc := fb.NewDocument(); xAgain := fb.AddIntMember(doc, 'i', 1) <> 0;
        FOR i := 0 TO 254 DO sLong[i] := 65; END_FOR
        WHILE fb.AddStringMember(doc, 'i', sLong) <> 0 AND fb.initStatus = 0 DO nTexts := nTexts + 1;
        END_WHILE
        FOR i := 0 TO 99 DO sDeep[i] := 91; END_FOR
        FOR i := 100 TO 199 DO sDeep[i] := 93; END_FOR
        w := fb.ParseDocument(sDeep); xDeep := w = 0;
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.nAdded") == "1998"
        assert [program.literal(f"Main.{name}") for name in ("xFull", "xAgain", "xDeep")] == ["TRUE"] * 3
        assert program.literal("Main.nTexts") == str((32768 - 2) // 258)


def test_the_writer_makes_the_document_of_the_manual() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_JsonSaxWriter; s, t : STRING(255); h : ARRAY[0..6] OF HRESULT; nLength : UDINT;
            sTiny : STRING(5);
            nTiny : UDINT;
        END_VAR
        fb.StartObject(); fb.AddKey('Timestamp'); fb.AddDateTime(DT#2017-04-04-12:42:42); fb.AddKey('Values');
        fb.StartObject(); fb.AddKey('Sensor1'); fb.AddReal(42.42); fb.AddKey('Sensor2'); fb.AddDint(42);
        fb.AddKey('Sensor3'); fb.AddBool(TRUE); fb.EndObject(); fb.EndObject();
        s := fb.GetDocument(); nLength := fb.GetDocumentLength();
        nTiny := fb.CopyDocument(sTiny, SIZEOF(sTiny));
        fb.ResetDocument(); fb.StartArray(); fb.AddLreal(0.1); fb.AddLreal(1.0E300);
        fb.AddUlint(18446744073709551615);
        fb.AddString('"'); fb.AddNull(); fb.StartObject(); fb.AddKeyBool('b', FALSE);
        fb.AddKeyNumber('n', -1);
        fb.AddKeyString('s', 'v'); fb.AddKeyLreal('l', 2.5); fb.AddKeyNull('z'); fb.EndObject();
        fb.EndArray();
        t := fb.GetDocument(); h[0] := fb.initStatus;
        h[1] := fb.AddDint(1); fb.ResetDocument(); h[2] := fb.EndObject(); fb.ResetDocument();
        fb.StartObject();
        h[3] := fb.AddDint(1); h[4] := fb.EndArray(); fb.ResetDocument(); h[5] := fb.AddKey('k'); h[6] := 7;
        h[6] := fb.ResetDocument();
        END_PROGRAM"""
    with run(text, 1) as program:
        expected = {
            "Timestamp": "2017-04-04T12:42:42",
            "Values": {"Sensor1": 42.42, "Sensor2": 42, "Sensor3": True},
        }
        written = _text_of(program.literal("Main.s"))
        assert written == json.dumps(expected, separators=(",", ":"))
        assert program.literal("Main.nLength") == str(len(written) + 1)
        assert (program.literal("Main.sTiny"), program.literal("Main.nTiny")) == ("''", "0")
        assert json.loads(_text_of(program.literal("Main.t"))) == [
            0.1, 1e300, 2**64 - 1, '"', None, {"b": False, "n": -1, "s": "v", "l": 2.5, "z": None},
        ]  # fmt: skip
        fail = "-2147467259"
        assert program.literal("Main.h") == f"[0, {fail}, {fail}, {fail}, {fail}, {fail}, 0]"


def test_bytes_and_times_are_written_as_texts() -> None:
    rows = [bytes(NUMBERS.randrange(256) for _ in range(size)) for size in range(8)]
    lines = []
    for row in rows:
        lines += [f"a[{k}] := {byte};" for k, byte in enumerate(row)]
        lines.append(f"fb.AddBase64(ADR(a), {len(row)}); fb.AddHexBinary(ADR(a), {len(row)});")
    text = f"""
        PROGRAM Main
        VAR
            fb : FB_JsonSaxWriter; a : ARRAY[0..9] OF BYTE; s : STRING(2000); t : STRING(255); h : HRESULT;
            ft : FILETIME := 131357833620000007; dc : DCTIME := 544624962000000005;
        END_VAR
        fb.StartArray(); {" ".join(lines)} fb.EndArray(); fb.CopyDocument(s, SIZEOF(s));
        fb.ResetDocument(); fb.StartObject(); fb.AddKeyFileTime('f', ft); fb.AddKeyDcTime('d', dc);
        fb.AddKeyDcTime('e', 0); fb.AddKey('g'); fb.AddFileTime(ft - 7); fb.EndObject();
        t := fb.GetDocument(); fb.ResetDocument(); h := fb.AddFileTime(1);
        END_PROGRAM"""
    with run(text, 1) as program:
        wanted = [text for row in rows for text in (base64.b64encode(row).decode(), row.hex().upper())]
        assert json.loads(_text_of(program.literal("Main.s"))) == wanted
        assert json.loads(_text_of(program.literal("Main.t"))) == {
            "f": "2017-04-04T12:42:42.0000007", "d": "2017-04-04T12:42:42.000000005",
            "e": "2000-01-01T00:00:00", "g": "2017-04-04T12:42:42",
        }  # fmt: skip
        assert program.literal("Main.h") == "-2147467259"
