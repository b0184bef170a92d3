"""Every place of something, with how it is used."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.services.cross_references import cross_references, cross_references_of

OBJECTS = {
    "GVL": "VAR_GLOBAL iCount : INT; xIn AT %IX0.0 : BOOL; END_VAR",
    "FB": "FUNCTION_BLOCK FB\nVAR_INPUT iIn : INT; END_VAR\nVAR_IN_OUT iBoth : INT; END_VAR\n"
    "VAR_OUTPUT iOut : INT; END_VAR\nVAR iCount : INT; END_VAR\niCount := iIn;\nMETHOD Go : INT\nGo := 1;\n"
    "END_METHOD\nEND_FUNCTION_BLOCK",
}


def project(code: str) -> Project:
    variables = "fb : FB; i : INT; p : POINTER TO INT; r : REFERENCE TO INT; t : TON;"
    return Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR {variables} END_VAR\n{code}\nEND_PROGRAM", **OBJECTS)


def uses(code: str) -> list[tuple[str, str]]:
    """`document:line` and access of each place of what is marked, declarations left out."""
    p = project(code)
    found = cross_references(p.snapshot, p.document, p.position)
    return [
        (f"{item.place.document}:{item.place.span.line + 1}", item.role)
        for item in found
        if item.role != "declaration"
    ]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("|i := i + 1;", [("PLC_PRG:3", "write"), ("PLC_PRG:3", "read")]),
        ("p := ADR(|i);", [("PLC_PRG:3", "address")]),
        ("r REF= |i;", [("PLC_PRG:3", "address")]),
        ("f|b(iIn := 1, iBoth := i);\nfb.iIn := 2;", [("PLC_PRG:3", "call"), ("PLC_PRG:4", "read")]),
        ("i := fb.G|o();", [("FB:8", "write"), ("PLC_PRG:3", "call")]),
        ("fb(iIn := 1, iBoth := |i, iOut => i);", [("PLC_PRG:3", "write"), ("PLC_PRG:3", "write")]),
        ("fb(i|In := 1, iBoth := i);", [("FB:6", "read"), ("PLC_PRG:3", "write")]),
        ("FOR |i := 0 TO 3 DO ; END_FOR", [("PLC_PRG:3", "write")]),
    ],
)
def test_how_a_place_uses_a_name(code: str, expected: list[tuple[str, str]]) -> None:
    assert sorted(uses(code)) == sorted(expected)


def test_a_name_without_its_owner_finds_everything_of_that_name() -> None:
    p = project("iCount := 1;")
    found = {(item.symbol, item.role) for item in cross_references_of(p.snapshot, "icount")}
    assert found == {
        ("GVL.iCount", "declaration"),
        ("GVL.iCount", "write"),
        ("FB.iCount", "declaration"),
        ("FB.iCount", "write"),
    }
    assert {item.symbol for item in cross_references_of(p.snapshot, "FB.iCount")} == {"FB.iCount"}


def test_something_of_a_library_has_places_in_the_project_only() -> None:
    p = project("t(IN := TRUE); i := 1;")
    assert [p.at(item.place) for item in cross_references_of(p.snapshot, "TON")] == ["PLC_PRG:2:69 TON"]


def test_an_address_is_found_in_declarations_and_statements() -> None:
    p = project("%QX1.0 := %IX0.0;")
    found = [(item.place.document, item.role) for item in cross_references_of(p.snapshot, "%ix0.0")]
    assert found == [("PLC_PRG", "read"), ("GVL", "declaration")]
    assert [item.role for item in cross_references_of(p.snapshot, "%QX1.0")] == ["write"]


@pytest.mark.parametrize("name", ["", "  ", ".", "nothing", "%", "a.b.c", "("])
def test_a_name_of_nothing_has_no_places(name: str) -> None:
    assert cross_references_of(project("").snapshot, name) == []


@pytest.mark.parametrize(
    ("expression", "symbol"),
    [
        ("PLC_PRG.fb.iCount", "FB.iCount"),
        ("PLC_PRG.aFb[2].iCount", "FB.iCount"),
        ("plc_prg.pFb^.icount", "FB.iCount"),
        ("PLC_PRG.aPoint[1].rX", "Point.rX"),
        ("PLC_PRG.aFb[2]", "PLC_PRG.aFb"),
        ("GVL.iCount", "GVL.iCount"),
    ],
)
def test_a_path_through_instances_names_what_its_last_name_means(expression: str, symbol: str) -> None:
    head = "fb : FB; aFb : ARRAY[1..3] OF FB; pFb : POINTER TO FB; aPoint : ARRAY[0..1] OF Point;"
    code = "aPoint[0].rX := 1.0; aFb[1](); iCount := 2;"
    p = Project(
        PLC_PRG=f"PROGRAM PLC_PRG\nVAR {head} END_VAR\n{code}|\nEND_PROGRAM",
        Point="TYPE Point : STRUCT rX : REAL; END_STRUCT END_TYPE",
        **OBJECTS,
    )
    found = cross_references_of(p.snapshot, expression)
    assert {item.symbol for item in found} == {symbol}
    assert [item.role for item in found].count("declaration") == 1
