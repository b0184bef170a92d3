"""What a position is explained with."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.services.hover import hover
from tappet.lang.services.results import Hover

OBJECTS = {
    "GVL": "VAR_GLOBAL CONSTANT c_tStep : TIME := T#1m30s; c_iMax : INT := 2 * 21; END_VAR",
    "ST_Point": "(* A place *)\nTYPE ST_Point :\nSTRUCT\n    x : INT;\nEND_STRUCT\nEND_TYPE",
    "E_Mode": "TYPE E_Mode : (Off, (* resting *) Auto := 5); END_TYPE",
    "F_Add": "(* Sum of two *)\nFUNCTION F_Add : INT\n"
    "VAR_INPUT a : INT := 1; // first\nb : INT; END_VAR\nEND_FUNCTION",
    "FB_M": "FUNCTION_BLOCK FB_M VAR_OUTPUT xQ : BOOL; END_VAR METHOD Go : BOOL END_METHOD "
    "PROPERTY Speed : REAL GET Speed := 1; END_GET END_PROPERTY END_FUNCTION_BLOCK",
}


def ask(code: str, declarations: str = "") -> Hover | None:
    project = Project(
        PLC_PRG=f"PROGRAM PLC_PRG\nVAR\n{declarations}\nEND_VAR\n{code}\nEND_PROGRAM", **OBJECTS
    )
    return hover(project.snapshot, project.document, project.position)


@pytest.mark.parametrize(
    ("code", "declarations", "shown", "prose"),
    [
        ("iC|ount := 1;", "iCount : INT := 5; // pieces", "VAR iCount : INT := 5;", "pieces"),
        ("x := c_tS|tep;", "x : TIME;", "VAR_GLOBAL CONSTANT c_tStep : TIME := T#1m30s;", "Value: `T#1m30s`"),
        ("x := c_iM|ax;", "x : INT;", "VAR_GLOBAL CONSTANT c_iMax : INT := 2 * 21;", "Value: `42`"),
        ("p.|x := 1;", "p : ST_Point;", "x : INT;", ""),
        ("", "p : ST_Po|int;", "TYPE ST_Point :\nSTRUCT\n    x : INT;\nEND_STRUCT\nEND_TYPE", "A place"),
        ("e := Au|to;", "e : E_Mode;", "E_Mode.Auto := 5;", ""),
        ("e := E_Mode.O|ff;", "e : E_Mode;", "E_Mode.Off := 0;", "resting"),
        (
            "x := F_A|dd(1, 2);",
            "x : INT;",
            "FUNCTION F_Add : INT\nVAR_INPUT\n    a : INT := 1;  // first\n    b : INT;\nEND_VAR",
            "Sum of two",
        ),
        ("x := F_Add(|a := 1, b := 2);", "x : INT;", "VAR_INPUT a : INT := 1;", "first"),
        ("m.G|o();", "m : FB_M;", "METHOD Go : BOOL", ""),
        ("r := m.Sp|eed;", "m : FB_M; r : REAL;", "PROPERTY Speed : REAL (GET)", ""),
        ("t|m();", "tm : TON;", "VAR tm : TON;", "TON: On delay"),
        ("tm.Q|;", "tm : TON;", "VAR_OUTPUT Q : BOOL;", "Delayed signal"),
        ("x := LIM|IT(1, x, 3);", "x : INT;", "LIMIT(MN : ANY, IN : ANY, MX : ANY) : ANY", "at least MN"),
        ("x := INT_TO_|REAL(1);", "x : REAL;", "INT_TO_REAL(IN : INT) : REAL", "Converts INT to REAL"),
        ("x := 16#F|F;", "x : INT;", "255", "16#FF"),
        ("x := T#9|0s;", "x : TIME;", "T#1m30s", "90000 ms"),
        ("PLC_|PRG();", "", "PROGRAM PLC_PRG", ""),
    ],
)
def test_declaration_comment_and_value(code: str, declarations: str, shown: str, prose: str) -> None:
    found = ask(code, declarations)
    assert found is not None
    assert found.code.endswith(shown) or found.code == shown
    assert prose in found.text


@pytest.mark.parametrize(
    "code", ["// iC|ount", "x := 'iC|ount';", "I|F TRUE THEN END_IF", "|", "unknown|();", "x := 5|;"]
)
def test_nothing_to_say(code: str) -> None:
    assert ask(code, "x : INT; iCount : INT;") is None


def test_range_is_the_name() -> None:
    found = ask("abc.|de := 1;", "abc : TON;")
    assert found is None
    found = ask("abc.P|T := T#1s;", "abc : TON;")
    assert found is not None
    assert (found.span.line, found.span.column, found.span.end_column) == (4, 4, 6)
