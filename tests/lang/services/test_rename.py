"""Renaming everywhere, and the reasons not to."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.services.rename import rename, renameable
from tappet.lang.services.results import ServiceError

OBJECTS = {
    "GVL": "VAR_GLOBAL g_a : INT; g_b : INT; END_VAR",
    "S": "TYPE S : STRUCT x : INT; y : INT; END_STRUCT END_TYPE",
    "E": "TYPE E : (Off, On); END_TYPE",
    "FB": "FUNCTION_BLOCK FB VAR_INPUT xIn : BOOL; END_VAR "
    "VAR iOther : INT; END_VAR METHOD Go xIn := TRUE; END_METHOD "
    "PROPERTY P : INT GET P := 1; END_GET END_PROPERTY END_FUNCTION_BLOCK",
    "F": "FUNCTION F : INT\nF := 1;\nEND_FUNCTION",
}


def project(code: str, declarations: str = "a : INT; b : INT; s : S; fb : FB; t : TON; e : E;") -> Project:
    return Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR {declarations} END_VAR\n{code}\nEND_PROGRAM", **OBJECTS)


def renamed(p: Project, name: str) -> dict[str, str]:
    """The texts after the edits, of the documents that changed."""
    out: dict[str, str] = {}
    edits = rename(p.snapshot, p.document, p.position, name)
    for edit in sorted(edits, key=lambda e: e.place.span, reverse=True):
        document, span = edit.place.document, edit.place.span
        lines = out.get(document, p.objects[document]).split("\n")
        line = lines[span.line]
        lines[span.line] = line[: span.column] + edit.text + line[span.end_column :]
        out[document] = "\n".join(lines)
    return out


@pytest.mark.parametrize(
    ("code", "name", "expected"),
    [
        ("|a := a + 1;", "iCount", {"PLC_PRG": "iCount := iCount + 1;"}),
        ("|a := a + 1;", "A", {"PLC_PRG": "A := A + 1;"}),
        ("g_|a := GVL.g_a;", "g_c", {"PLC_PRG": "g_c := GVL.g_c;", "GVL": "VAR_GLOBAL g_c : INT; g_b"}),
        ("s.|x := s.y;", "across", {"PLC_PRG": "s.across := s.y;", "S": "STRUCT across : INT; y"}),
        (
            "fb(xI|n := TRUE);",
            "xStart",
            {"PLC_PRG": "fb(xStart := TRUE);", "FB": "METHOD Go xStart := TRUE;"},
        ),
        ("fb.G|o();", "Run", {"PLC_PRG": "fb.Run();", "FB": "METHOD Run xIn"}),
        ("a := fb.|P;", "Speed", {"PLC_PRG": "a := fb.Speed;", "FB": "PROPERTY Speed : INT GET Speed := 1;"}),
        ("a := |F();", "F_One", {"PLC_PRG": "a := F_One();", "F": "FUNCTION F_One : INT\nF_One := 1;"}),
        ("e := O|n;", "Running", {"PLC_PRG": "e := Running;", "E": "(Off, Running)"}),
        ("l|ab: JMP LAB;", "start", {"PLC_PRG": "start: JMP start;"}),
    ],
)
def test_every_place_changes(code: str, name: str, expected: dict[str, str]) -> None:
    p = project(code)
    span = renameable(p.snapshot, p.document, p.position)
    assert span.column <= p.position.column <= span.end_column
    found = renamed(p, name)
    assert set(found) == set(expected)
    for document, text in expected.items():
        assert text in found[document]


def test_a_type_changes_in_declarations_too() -> None:
    p = project("", "v : ARRAY[0..1] OF |S;")
    found = renamed(p, "ST_Point")
    assert "OF ST_Point;" in found["PLC_PRG"]
    assert found["S"].startswith("TYPE ST_Point :")


@pytest.mark.parametrize(
    ("code", "name", "reason"),
    [
        ("|a := 1;", "5x", "no identifier"),
        ("|a := 1;", "my var", "no identifier"),
        ("|a := 1;", "a__b", "two underscores"),
        ("|a := 1;", "while", "keyword"),
        ("|a := 1;", "INT", "keyword"),
        ("|a := 1;", "SEL", "operator"),
        ("|a := 1;", "B", "'b' exists already"),
        ("s.|x := 1;", "Y", "'y' exists already"),
        ("g_|a := 1;", "g_b", "'g_b' exists already"),
        ("g_|a := 1;", "b", "'b' of PLC_PRG would be meant"),
        ("fb(xI|n := TRUE);", "iOther", "'iOther' exists already"),
        ("fb.G|o();", "xIn", "'xIn' exists already"),
        ("a := |F();", "PLC_PRG", "'PLC_PRG' exists already"),
        ("e := O|n;", "Off", "exists already"),
        ("t(I|N := TRUE);", "xIn", "library Standard"),
        ("GV|L.g_a := 1;", "GVL2", "object of the project"),
        ("a := 1|2;", "x", "Nothing"),
        ("unkn|own := 1;", "x", "Nothing"),
    ],
)
def test_reason_why_not(code: str, name: str, reason: str) -> None:
    p = project(code)
    with pytest.raises(ServiceError, match=reason):
        rename(p.snapshot, p.document, p.position, name)


def test_what_cannot_be_renamed_has_no_range() -> None:
    for code in ("t(I|N := TRUE);", "GV|L.g_a := 1;", "I|F TRUE THEN END_IF"):
        p = project(code)
        with pytest.raises(ServiceError):
            renameable(p.snapshot, p.document, p.position)
