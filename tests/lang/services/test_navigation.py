"""Definition, type definition, references, highlights, implementations."""

from __future__ import annotations

import pytest
from marked_texts import LIBRARY, Project, split_object

from tappet.lang.services.documents import Position, Program
from tappet.lang.services.navigation import (
    definition,
    highlights,
    implementations,
    references,
    type_definition,
)
from tappet.lang.services.workspace import Workspace

OBJECTS = {
    "GVL": "VAR_GLOBAL\n  g_a : INT;\nEND_VAR",
    "E": "TYPE E : (Off, On); END_TYPE",
    "S": "TYPE S : STRUCT x : INT; e : E; END_STRUCT END_TYPE",
    "Base": "FUNCTION_BLOCK Base\nMETHOD Go : BOOL\nEND_METHOD\nEND_FUNCTION_BLOCK",
    "FB": "FUNCTION_BLOCK FB EXTENDS Base IMPLEMENTS I\n"
    "VAR_INPUT xIn : BOOL; END_VAR\nMETHOD Go : BOOL\nGo := xIn;\n"
    "END_METHOD\nPROPERTY P : INT\nGET\nP := 1;\nEND_GET\nEND_PROPERTY\nEND_FUNCTION_BLOCK",
    "I": "INTERFACE I\nMETHOD Go : BOOL\nEND_METHOD\nEND_INTERFACE",
    "F": "FUNCTION F : INT\nVAR_INPUT a : INT; END_VAR\nF := a;\nEND_FUNCTION",
}


def project(code: str, declarations: str = "a : INT; s : S; fb : FB; i : I; t : TON; en : E;") -> Project:
    return Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR {declarations} END_VAR\n{code}\nEND_PROGRAM", **OBJECTS)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("|a := 1;", "PLC_PRG:2:5 a"),
        ("g_|a := 1;", "GVL:2:3 g_a"),
        ("GVL.g_|a := 1;", "GVL:2:3 g_a"),
        ("s.|x := 1;", "S:1:17 x"),
        ("fb.G|o();", "FB:3:8 Go"),
        ("fb(xI|n := TRUE);", "FB:2:11 xIn"),
        ("a := fb.|P;", "FB:6:10 P"),
        ("i.G|o();", "I:2:8 Go"),
        ("a := |F(1);", "F:1:10 F"),
        ("en := O|n;", "E:1:16 On"),
        ("en := E.O|n;", "E:1:16 On"),
        ("JMP la|b; lab: a := 1;", "PLC_PRG:3:10 lab"),
        ("t(IN| := TRUE);", "tappet-library:/Standard/TON:5:5 IN"),
    ],
)
def test_definition(code: str, expected: str) -> None:
    p = project(code)
    place = definition(p.snapshot, p.document, p.position)
    assert place is not None
    assert p.at(place) == expected


def test_definition_of_types_in_declarations() -> None:
    for declarations, expected in (("v : |S;", "S:1:6 S"), ("v : F|B;", "FB:1:16 FB"), ("v : T|ON;", None)):
        p = project("", declarations)
        place = definition(p.snapshot, p.document, p.position)
        assert place is not None
        if expected is None:
            line = LIBRARY.split("\n")[place.span.line]
            assert line[place.span.column : place.span.end_column] == "TON"
        else:
            assert p.at(place) == expected
    p = Project(
        PLC_PRG="PROGRAM PLC_PRG END_PROGRAM", **{**OBJECTS, "FB": OBJECTS["FB"].replace("Base", "B|ase")}
    )
    place = definition(p.snapshot, p.document, p.position)
    assert place is not None
    assert p.at(place) == "Base:1:16 Base"


@pytest.mark.parametrize("code", ["|IF TRUE THEN END_IF", "unk|nown := 1;", "a := 1|2;"])
def test_no_definition(code: str) -> None:
    p = project(code)
    assert definition(p.snapshot, p.document, p.position) is None


def test_type_definition() -> None:
    for code, expected in (
        ("|s.x := 1;", "S:1:6 S"),
        ("f|b();", "FB:1:16 FB"),
        ("|en := On;", "E:1:6 E"),
        ("|a := 1;", None),
    ):
        p = project(code)
        place = type_definition(p.snapshot, p.document, p.position)
        assert (p.at(place) if place else None) == expected


def test_references_over_the_project_with_their_role() -> None:
    p = project("|a := a + s.x;\nIF a > 1 THEN a := F(a := a); END_IF")
    found = [(p.at(r.place), r.role) for r in references(p.snapshot, p.document, p.position)]
    assert found == [
        ("PLC_PRG:2:5 a", "declaration"),
        ("PLC_PRG:3:1 a", "write"),
        ("PLC_PRG:3:6 a", "read"),
        ("PLC_PRG:4:4 a", "read"),
        ("PLC_PRG:4:15 a", "write"),
        ("PLC_PRG:4:27 a", "read"),
    ]
    assert len(references(p.snapshot, p.document, p.position, with_declaration=False)) == 5


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("a := |F(1);", {"F:1:10 F", "F:3:1 F", "PLC_PRG:3:6 F"}),
        ("a := fb.|P;", {"FB:6:10 P", "FB:8:1 P", "PLC_PRG:3:9 P"}),
        ("fb(xI|n := TRUE);", {"FB:2:11 xIn", "FB:4:7 xIn", "PLC_PRG:3:4 xIn"}),
        ("en := O|n;", {"E:1:16 On", "PLC_PRG:3:7 On"}),
        ("a|: JMP a;", {"PLC_PRG:3:1 a", "PLC_PRG:3:8 a"}),
    ],
)
def test_references_of_other_things(code: str, expected: set[str]) -> None:
    p = project(code)
    assert {p.at(r.place) for r in references(p.snapshot, p.document, p.position)} == expected


def test_references_of_a_type() -> None:
    p = Project(
        PLC_PRG="PROGRAM PLC_PRG VAR s : |S; p : POINTER TO S; END_VAR END_PROGRAM",
        **{**OBJECTS, "S2": "TYPE S2 EXTENDS S : STRUCT y : INT; END_STRUCT END_TYPE"},
    )
    found = {p.at(r.place) for r in references(p.snapshot, p.document, p.position)}
    assert found == {"S:1:6 S", "S2:1:17 S", "PLC_PRG:1:25 S", "PLC_PRG:1:43 S"}


def test_references_in_a_variable_configuration() -> None:
    p = Project(
        PLC_PRG="PROGRAM PLC_PRG VAR f|b : IO; END_VAR fb(); END_PROGRAM",
        IO="FUNCTION_BLOCK IO VAR xIn AT %I* : BOOL; END_VAR END_FUNCTION_BLOCK",
        Config="VAR_CONFIG PLC_PRG.fb.xIn AT %IX0.0 : BOOL; END_VAR",
    )
    found = {p.at(r.place) for r in references(p.snapshot, p.document, p.position)}
    assert found == {"PLC_PRG:1:21 fb", "PLC_PRG:1:38 fb", "Config:1:20 fb"}
    p = Project(
        GVL="VAR_GLOBAL sen|sor AT %I* : INT; END_VAR",
        Config="VAR_CONFIG .sensor AT %IW0 : INT; END_VAR",
    )
    found = {p.at(r.place) for r in references(p.snapshot, p.document, p.position)}
    assert found == {"GVL:1:12 sensor", "Config:1:13 sensor"}


def test_highlights_stay_in_the_document() -> None:
    p = project("g_|a := 1; a := g_a;")
    assert [p.at(r.place) for r in highlights(p.snapshot, p.document, p.position)] == [
        "PLC_PRG:3:1 g_a",
        "PLC_PRG:3:16 g_a",
    ]


def test_implementations() -> None:
    for name, text, expected in (
        ("I", OBJECTS["I"].replace("INTERFACE I", "INTERFACE |I", 1), {"FB:1:16 FB"}),
        ("I", OBJECTS["I"].replace("Go", "|Go"), {"FB:3:8 Go"}),
        ("Base", OBJECTS["Base"].replace("Base", "|Base", 1), {"FB:1:16 FB"}),
        ("Base", OBJECTS["Base"].replace("Go", "|Go"), {"FB:3:8 Go"}),
    ):
        p = Project(**{**OBJECTS, name: text})
        assert {p.at(place) for place in implementations(p.snapshot, p.document, p.position)} == expected


def test_places_of_an_object_in_two_documents() -> None:
    text = split_object("P", "PROGRAM P\nVAR\n  a : INT;\nEND_VAR", "a := 1;\na := 2;", "END_PROGRAM")
    workspace = Workspace(lambda unsaved: [Program("App", [text])])
    snapshot = workspace.snapshot("P/implementation")
    place = definition(snapshot, "P/implementation", Position(1, 0))
    assert place is not None
    assert (place.document, place.span[:2]) == ("P/declaration", (2, 2))
    found = references(snapshot, "P/declaration", Position(2, 2))
    assert [(r.place.document, r.place.span.line) for r in found] == [
        ("P/declaration", 2),
        ("P/implementation", 0),
        ("P/implementation", 1),
    ]
