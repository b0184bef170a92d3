"""Blocks with generic constants in the editor: what is written leads to the one text they have."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.services.completion import complete
from tappet.lang.services.formatting import format_text
from tappet.lang.services.hover import hover
from tappet.lang.services.navigation import definition

RING = """FUNCTION_BLOCK FB_Ring
VAR_GENERIC CONSTANT size : INT := 4; END_VAR
VAR_OUTPUT last : INT; END_VAR
VAR buffer : ARRAY[1..size] OF INT; END_VAR
METHOD Fill : INT
VAR_INPUT v : INT; END_VAR
buffer[size] := v;
END_METHOD
END_FUNCTION_BLOCK"""


def project(code: str, declarations: str = "ring : FB_Ring<20>; n : INT;") -> Project:
    return Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR {declarations} END_VAR\n{code}\nEND_PROGRAM", FB_Ring=RING)


@pytest.mark.parametrize(
    ("code", "place"),
    [
        ("ring.Fi|ll(1);", "FB_Ring:5:8 Fill"),
        ("n := ring.la|st;", "FB_Ring:3:12 last"),
        ("ring.Fill(v| := 1);", "FB_Ring:6:11 v"),
    ],
)
def test_members_lead_to_the_text(code: str, place: str) -> None:
    p = project(code)
    found = definition(p.snapshot, p.document, p.position)
    assert found is not None
    assert p.at(found) == place


def test_the_name_of_the_block_leads_to_it() -> None:
    p = project("ring();", "ring : FB_R|ing<20>;")
    found = definition(p.snapshot, p.document, p.position)
    assert found is not None
    assert p.at(found) == "FB_Ring:1:16 FB_Ring"


def test_members_are_proposed_behind_the_dot() -> None:
    p = project("ring.|")
    names = {item.label for item in complete(p.workspace, p.document, p.position)}
    assert {"Fill", "last"} <= names


def test_the_type_is_shown_with_its_values() -> None:
    p = project("ri|ng();")
    found = hover(p.snapshot, p.document, p.position)
    assert found is not None
    assert "FB_Ring<20>" in found.code


def test_messages_of_the_text_are_told_once() -> None:
    p = Project(
        PLC_PRG="PROGRAM PLC_PRG\nVAR a : FB<2>; b : FB<3>; END_VAR\n|a(); b();\nEND_PROGRAM",
        FB="FUNCTION_BLOCK FB\nVAR_GENERIC CONSTANT n : INT; END_VAR\nVAR k : INT; END_VAR\n"
        "k := n + nowhere;\nEND_FUNCTION_BLOCK",
    )
    found = [d for d in p.snapshot.analysis.diagnostics if d.code == "E0201"]
    assert [(d.uri, d.span.line) for d in found] == [("FB", 3)]


def test_values_stand_close_to_the_type() -> None:
    text = """FUNCTION_BLOCK FB EXTENDS Lib.Base < 5 >
VAR
    a : FB_Ring<20>;
    b : ARRAY[0..n] OF FB_Ring<20,n+1>(x:=1);
    c : POINTER TO FB_Ring<n+1> := 0;
END_VAR
a.x := b<c AND c > d;
END_FUNCTION_BLOCK"""
    formatted = format_text(text)
    assert (
        formatted
        == """FUNCTION_BLOCK FB EXTENDS Lib.Base<5>
VAR
    a : FB_Ring<20>;
    b : ARRAY[0..n] OF FB_Ring<20, n + 1>(x := 1);
    c : POINTER TO FB_Ring<n + 1> := 0;
END_VAR
a.x := b < c AND c > d;
END_FUNCTION_BLOCK"""
    )
    assert format_text(formatted) == formatted
