"""The call being written and its current parameter."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.services.results import Signature
from tappet.lang.services.signature_help import signature

OBJECTS = {
    "F": "(* Sum *)\nFUNCTION F : INT\nVAR_INPUT a : INT; (* one *)"
    " b : INT := 2; END_VAR "
    "VAR_OUTPUT c : BOOL; END_VAR\nEND_FUNCTION",
    "FB": "FUNCTION_BLOCK FB VAR_INPUT x : BOOL; END_VAR "
    "METHOD Go : BOOL VAR_INPUT v : REAL; END_VAR END_METHOD END_FUNCTION_BLOCK",
}


def ask(code: str) -> Signature | None:
    declarations = "i : INT; fb : FB; afb : ARRAY[0..1] OF FB; t : TON;"
    project = Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR {declarations} END_VAR\n{code}\nEND_PROGRAM", **OBJECTS)
    return signature(project.workspace, project.document, project.position)


@pytest.mark.parametrize(
    ("code", "label", "active"),
    [
        ("i := F(|", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "a : INT"),
        ("i := F(1, |)", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "b : INT := 2"),
        ("i := F(1, F(2, 3), |", "F(a : INT, b : INT := 2, c => : BOOL) : INT", None),
        ("i := F(1, F(2, |", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "b : INT := 2"),
        ("i := F(b := |", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "b : INT := 2"),
        ("i := F(1, c => |", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "c => : BOOL"),
        ("i := F(i|", "F(a : INT, b : INT := 2, c => : BOOL) : INT", "a : INT"),
        ("fb(|", "FB(x : BOOL)", "x : BOOL"),
        ("afb[1](|", "FB(x : BOOL)", "x : BOOL"),
        ("fb.Go(|", "Go(v : REAL) : BOOL", "v : REAL"),
        (
            "t(IN := TRUE, PT := |",
            "TON(IN : BOOL, PT : TIME := T#1s, Q => : BOOL, ET => : TIME)",
            "PT : TIME := T#1s",
        ),
        ("i := LIMIT(1, |", "LIMIT(MN : ANY, IN : ANY, MX : ANY) : ANY", "IN : ANY"),
        ("i := MAX(1, 2, 3, 4, |", "MAX(IN1 : ANY, IN2 : ANY, ...) : ANY", "..."),
        ("i := REAL_TO_INT(|", "REAL_TO_INT(IN : REAL) : INT", "IN : REAL"),
    ],
)
def test_call_and_parameter(code: str, label: str, active: str | None) -> None:
    found = ask(code)
    assert found is not None
    assert found.label == label
    if active is None:
        assert found.active in (None, 1, 2)
    else:
        assert found.active is not None
        parameter = found.parameters[found.active]
        assert found.label[parameter.start : parameter.end] == active


def test_comments_of_the_call_and_its_parameters() -> None:
    found = ask("i := F(|")
    assert found is not None
    assert (found.comment, found.parameters[0].comment) == ("Sum", "one")


@pytest.mark.parametrize(
    "code", ["|", "i := (|", "i := 1 + (2 * |", "F(1); |", "IF (|", "unknown(|", "F(1, // |"]
)
def test_no_call(code: str) -> None:
    assert ask(code) is None
