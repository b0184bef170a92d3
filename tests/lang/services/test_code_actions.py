"""What mends a message: the text after the edits, or what else is to be done."""

from __future__ import annotations

import pytest
from marked_texts import Project, split_object

from tappet.lang.services.code_actions import code_actions
from tappet.lang.services.documents import Program
from tappet.lang.services.results import CodeAction
from tappet.lang.services.workspace import Workspace
from tappet.lang.source import Span

OBJECTS = {
    "E_Mode": "TYPE E_Mode : (Off, Auto, Manual); END_TYPE",
    "E_Color": "{attribute 'qualified_only'}\nTYPE E_Color : (Red, Green); END_TYPE",
    "I_Axis": "INTERFACE I_Axis\nMETHOD Halt : BOOL\nVAR_INPUT\n    xNow : BOOL;\nEND_VAR\nEND_METHOD\n"
    "PROPERTY Speed : REAL GET END_GET SET END_SET END_PROPERTY\nEND_INTERFACE",
    "FB_Motor": "FUNCTION_BLOCK FB_Motor VAR_INPUT xOn : BOOL; END_VAR VAR_OUTPUT xRuns : BOOL; END_VAR "
    "xRuns := xOn; END_FUNCTION_BLOCK",
    "F_Add": "FUNCTION F_Add : INT VAR_INPUT a : INT; b : REAL; END_VAR F_Add := a; END_FUNCTION",
}
HEAD = "PROGRAM PLC_PRG\nVAR\n    iCount : INT;\n    xFlag : BOOL;\n    motor : FB_Motor;\n"
HEAD += "    eMode : E_Mode;\n    eColor : E_Color;\n    timer : TON;\n    uiSize : UINT;\nEND_VAR\n"
USES = "\niCount := iCount; xFlag := xFlag; motor(); timer(); eMode := Off; eColor := E_Color.Red;"
USES += " uiSize := uiSize;"


def offered(text: str, **others: str) -> tuple[Project, list[CodeAction]]:
    project = Project(PLC_PRG=text, **OBJECTS, **others)
    libraries = {"BLINK": ["Util"], "TONN": ["Other"]}
    everything = Span(0, 0, 10_000, 0)
    found = code_actions(
        project.snapshot, "PLC_PRG", everything, lambda name: libraries.get(name.upper(), [])
    )
    return project, found


def applied(project: Project, action: CodeAction) -> str:
    """The text of the program after the edits of an action."""
    text = project.objects["PLC_PRG"]
    for edit in sorted(action.edits, key=lambda e: e.place.span, reverse=True):
        assert edit.place.document == "PLC_PRG"
        lines = text.split("\n")
        starts = [0]
        for line in lines:
            starts.append(starts[-1] + len(line) + 1)
        span = edit.place.span
        text = (
            text[: starts[span.line] + span.column]
            + edit.text
            + text[starts[span.end_line] + span.end_column :]
        )
    return text


@pytest.mark.parametrize(
    ("code", "title", "expected"),
    [
        ("iCountt := 3;", "Replace by 'iCount'", "iCount := 3;"),
        ("motor.xRun := TRUE;", "Replace by 'xRuns'", "motor.xRuns := TRUE;"),
        ("motor(xOnn := TRUE);", "Replace by 'xOn'", "motor(xOn := TRUE);"),
        ("iCount := F_Ad(1, 2);", "Replace by 'F_Add'", "iCount := F_Add(1, 2);"),
        ("eColor := Green;", "Replace by 'E_Color.Green'", "eColor := E_Color.Green;"),
        ("iCount := xFlag;", "Convert with BOOL_TO_INT", "iCount := BOOL_TO_INT(xFlag);"),
        ("iCount := 1.5 + 2;", "Convert with LREAL_TO_INT", "iCount := LREAL_TO_INT(1.5 + 2);"),
        ("uiSize := iCount;", "Convert with INT_TO_UINT", "uiSize := INT_TO_UINT(iCount);"),
        ("IF iCount THEN ; END_IF", "Compare with 0", "IF iCount <> 0 THEN ; END_IF"),
        ("IF iCount + 1 THEN ; END_IF", "Compare with 0", "IF (iCount + 1) <> 0 THEN ; END_IF"),
        ("iCount = F_Add(a := 1, b := 2);", "Replace by ':='", "iCount := F_Add(a := 1, b := 2);"),
        ("timer(PT := 3s);", "Insert 'T#'", "timer(PT := T#3s);"),
        ("motor(xRuns := xFlag);", "Replace by '=>'", "motor(xRuns => xFlag);"),
        ("motor(xOn => xFlag);", "Replace by ':='", "motor(xOn := xFlag);"),
        ("here: iCount := 1;", "Remove label 'here'", "\niCount := 1;"),
        ("iCount := 5\nxFlag := TRUE;", "Insert ';'", "iCount := 5;\nxFlag := TRUE;"),
        ("iCount := (5;", "Insert ')'", "iCount := (5);"),
        ("iCount := (5\n;", "Insert ')'", "iCount := (5)\n;"),
        ("xFlag := FALSE\n;\n;iCount := F_Add(a := 1 b := 2);", "Insert ','", "F_Add(a := 1, b := 2);"),
        ("IF xFlag\niCount := 1; END_IF", "Insert 'THEN'", "IF xFlag THEN\niCount := 1; END_IF"),
        ("  IF xFlag THEN\n    iCount := 1;", "Insert 'END_IF'", "    iCount := 1;\n  END_IF\nEND_PROGRAM"),
        ("IF xFlag THEN ; END_FOR", "Replace by 'END_IF'", "IF xFlag THEN ; END_IF"),
        (
            "    CASE eMode OF\n        Off: ;\n    END_CASE",
            "Add Auto, Manual",
            "        Off: ;\n        Auto:\n            ;\n        Manual:\n            ;\n    END_CASE",
        ),
        ("CASE eMode OF\n    Off: ;\nEND_CASE", "Add ELSE", "    Off: ;\nELSE\n    ;\nEND_CASE"),
        ("CASE eColor OF\nE_Color.Red: ;\nEND_CASE", "Add Green", "E_Color.Green:\n    ;\nEND_CASE"),
    ],
)
def test_the_text_is_mended(code: str, title: str, expected: str) -> None:
    project, found = offered(f"{HEAD}{code}{USES if 'END_IF' not in title else ''}\nEND_PROGRAM")
    action = next((item for item in found if item.title == title), None)
    assert action is not None, [item.title for item in found]
    after = applied(project, action)
    assert expected in after
    _, left = offered(after)
    assert title not in [item.title for item in left]


@pytest.mark.parametrize(
    ("code", "declared"),
    [
        ("diNew := iCount;", "diNew : INT;"),
        ("iCount := diNew;", "diNew : INT;"),
        ("rNew := 3;", "rNew : INT;"),
        ("rNew := 3.5;", "rNew : LREAL;"),
        ("IF NOT iNew THEN ; END_IF", "iNew : BOOL;"),
        ("xFlag := iNew AND xFlag;", "iNew : BOOL;"),
        ("FOR xNew := 0 TO 3 DO ; END_FOR", "xNew : INT;"),
        ("iCount := F_Add(a := 1, b := iNew);", "iNew : REAL;"),
        ("timer(PT := iNew);", "iNew : TIME;"),
        ("other(IN := xFlag, PT := T#1s);", "other : TON;"),
        ("udiNew;", "udiNew : UDINT;"),
    ],
)
def test_an_unknown_name_is_declared_with_the_type_its_place_wants(code: str, declared: str) -> None:
    project, found = offered(f"{HEAD}{code}{USES}\nEND_PROGRAM")
    action = next(item for item in found if item.key == "declareAs")
    assert f"    uiSize : UINT;\n    {declared}\nEND_VAR" in applied(project, action)
    asked = next(item for item in found if item.key == "declare")
    assert f"{asked.declare} : {asked.type};" == declared
    assert not asked.edits


@pytest.mark.parametrize(
    ("code", "titles"),
    [
        ("iCountt := 3;", ["Declare 'iCountt' as INT", "Declare 'iCountt'...", "Replace by 'iCount'"]),
        ("iPressure := 3;", ["Declare 'iPressure' as INT", "Declare 'iPressure'..."]),
    ],
)
def test_a_declaration_comes_first_and_only_near_names_are_proposed(code: str, titles: list[str]) -> None:
    _, found = offered(f"{HEAD}{code}{USES}\nEND_PROGRAM")
    assert [action.title for action in found] == titles
    assert [action.preferred for action in found] == [True] + [False] * (len(titles) - 1)


def test_without_a_block_of_variables_one_is_made() -> None:
    project, found = offered("PROGRAM PLC_PRG\nxNew := TRUE;\nEND_PROGRAM")
    action = next(item for item in found if item.key == "declareAs")
    assert applied(project, action) == (
        "PROGRAM PLC_PRG\nVAR\n    xNew : BOOL;\nEND_VAR\nxNew := TRUE;\nEND_PROGRAM"
    )


def test_what_is_called_like_a_function_is_no_variable_but_may_be_in_a_library() -> None:
    _, found = offered(f"{HEAD}iCount := Blink(3);{USES}\nEND_PROGRAM")
    assert [(item.key, item.library) for item in found if item.report.code == "E0201"] == [
        ("addLibrary", "Util")
    ]


def test_an_unknown_type_is_spelled_right_or_found_in_a_library() -> None:
    project, found = offered(
        "PROGRAM PLC_PRG\nVAR\n    t : TONN;\n    s : BOOLL;\nEND_VAR\nt(); s;\nEND_PROGRAM"
    )
    titles = [item.title for item in found]
    assert "Add library Other" in titles
    assert "    t : TON;\n" in applied(project, found[titles.index("Replace by 'TON'")])
    assert "    s : BOOL;\n" in applied(project, found[titles.index("Replace by 'BOOL'")])


@pytest.mark.parametrize(
    ("declaration", "left"),
    [
        ("    unused : INT; // why\n    x : INT;", "VAR\n    x : INT;\nEND_VAR"),
        ("    unused, x : INT;", "VAR\n    x : INT;\nEND_VAR"),
        ("    x, unused : INT;", "VAR\n    x : INT;\nEND_VAR"),
        ("    x : INT; unused : INT;", "VAR\n    x : INT; \nEND_VAR"),
        ("    unused : ARRAY[0..1] OF INT := [1,\n        2];\n    x : INT;", "VAR\n    x : INT;\nEND_VAR"),
    ],
)
def test_a_variable_that_is_never_used_goes(declaration: str, left: str) -> None:
    project, found = offered(f"PROGRAM PLC_PRG\nVAR\n{declaration}\nEND_VAR\nx := 1;\nEND_PROGRAM")
    (action,) = [item for item in found if item.key == "removeVariable"]
    assert left in applied(project, action)


def test_the_members_of_an_interface_are_written_into_a_plain_text() -> None:
    text = "FUNCTION_BLOCK FB_Axis IMPLEMENTS I_Axis\nVAR\nEND_VAR\nEND_FUNCTION_BLOCK"
    project, found = offered(text)
    (action,) = found
    assert action.title == "Implement Halt, Speed of I_Axis"
    after = applied(project, action)
    assert "METHOD Halt : BOOL\nVAR_INPUT\n    xNow : BOOL;\nEND_VAR\nEND_METHOD" in after
    assert "PROPERTY Speed : REAL\nGET\nEND_GET\nSET\nEND_SET\nEND_PROPERTY\nEND_FUNCTION_BLOCK" in after
    assert offered(after)[1] == []


def test_in_a_project_the_members_of_an_interface_are_objects_to_be_made() -> None:
    block = split_object("FB_Axis", "FUNCTION_BLOCK FB_Axis IMPLEMENTS I_Axis", "", "END_FUNCTION_BLOCK")
    others = Project(**OBJECTS)
    workspace = Workspace(lambda unsaved: [Program("App", [block, *others.programs(unsaved)[0].texts])])
    document = "FB_Axis/declaration"
    (action,) = code_actions(workspace.snapshot(document), document, Span(0, 0, 9, 0))
    assert action.edits == ()
    assert action.owner == document
    assert [(m.kind, m.name, m.accessors) for m in action.members] == [
        ("method", "Halt", ()),
        ("property", "Speed", ("Get", "Set")),
    ]


def test_a_missing_end_and_a_declaration_go_to_the_parts_of_an_object() -> None:
    text = split_object(
        "P", "PROGRAM P\nVAR\n    a : BOOL;\nEND_VAR", "IF a THEN\n    b := a;", "END_PROGRAM"
    )
    workspace = Workspace(lambda unsaved: [Program("App", [text])])
    document = "P/implementation"
    found = code_actions(workspace.snapshot(document), document, Span(0, 0, 9, 0))
    edits = {item.key: item.edits[0] for item in found if item.edits}
    assert (edits["insert"].place.span, edits["insert"].text) == (Span(1, 11, 1, 11), "\nEND_IF")
    assert edits["insert"].place.document == document
    assert edits["declareAs"].place.document == "P/declaration"
    assert (edits["declareAs"].place.span, edits["declareAs"].text) == (Span(3, 0, 3, 0), "    b : BOOL;\n")


def test_messages_elsewhere_are_left_alone() -> None:
    project = Project(PLC_PRG=f"{HEAD}aa := 1;\nbb := 2;{USES}\nEND_PROGRAM", **OBJECTS)
    line = HEAD.count("\n") + 1
    found = code_actions(project.snapshot, "PLC_PRG", Span(line, 1, line, 1))
    assert {dict(item.values)["name"] for item in found} == {"bb"}
