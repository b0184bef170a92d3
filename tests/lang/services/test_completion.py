"""What is proposed where."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.lang.analysis.builtins import OPERATORS
from tappet.lang.analysis.type_conversions import find_operator
from tappet.lang.services.completion import complete
from tappet.lang.services.operators import CONVERTIBLE, OPERATOR_HEADS, head_of
from tappet.lang.services.results import Completion, ItemKind

OBJECTS = {
    "GVL_Line": "{attribute 'qualified_only'}\nVAR_GLOBAL\n  udiCount : UDINT;"
    " // bottles\n  eMode : E_Mode;\nEND_VAR",
    "Globals": "VAR_GLOBAL g_xStop : BOOL; END_VAR VAR_GLOBAL CONSTANT c_iMax : INT := 5; END_VAR",
    "E_Mode": "TYPE E_Mode : (Off, Auto, Manual); END_TYPE",
    "E_Color": "{attribute 'qualified_only'}\nTYPE E_Color : (Red, Green); END_TYPE",
    "ST_Point": "TYPE ST_Point : STRUCT x : INT; (* across *) y : INT; mode : E_Mode; END_STRUCT END_TYPE",
    "I_Axis": "INTERFACE I_Axis METHOD Halt : BOOL END_METHOD "
    "PROPERTY Speed : REAL GET END_GET END_PROPERTY END_INTERFACE",
    "FB_Base": "FUNCTION_BLOCK FB_Base VAR_INPUT xBase : BOOL; END_VAR "
    "METHOD Reset END_METHOD END_FUNCTION_BLOCK",
    "FB_Motor": """
        FUNCTION_BLOCK FB_Motor EXTENDS FB_Base IMPLEMENTS I_Axis
        VAR_INPUT xOn : BOOL; {attribute 'hide'} xSecret : BOOL; END_VAR
        VAR_OUTPUT xRuns : BOOL; END_VAR
        VAR_IN_OUT stPos : ST_Point; END_VAR
        VAR iInner : INT; END_VAR
        VAR_TEMP iTemp : INT; END_VAR
        METHOD Halt : BOOL END_METHOD
        PROPERTY Speed : REAL GET Speed := 1; END_GET END_PROPERTY
        ACTION Act END_ACTION
        END_FUNCTION_BLOCK""",
    "FB_Quiet": """
        {attribute 'hide_all_locals'}
        FUNCTION_BLOCK FB_Quiet VAR_INPUT a : INT; END_VAR
        VAR_OUTPUT b : BOOL; END_VAR VAR c, d : INT; END_VAR
        END_FUNCTION_BLOCK""",
    "FB_Guarded": "FUNCTION_BLOCK FB_Guarded METHOD PRIVATE Hidden END_METHOD "
    "METHOD PROTECTED Inner END_METHOD METHOD Open VAR_INPUT xFast : BOOL; END_VAR END_METHOD "
    "END_FUNCTION_BLOCK",
    "F_Add": "(* Sum *) FUNCTION F_Add : INT VAR_INPUT a : INT; b : INT; END_VAR END_FUNCTION",
}  # fmt: skip
VARS = """
    motor : FB_Motor; quiet : FB_Quiet; p : ST_Point; aP : ARRAY[0..2] OF ST_Point; pp : POINTER TO ST_Point;
    ref : REFERENCE TO ST_Point; axis : I_Axis; timer : TON; iCount : INT; xFlag : BOOL; eMode : E_Mode;
    eColor : E_Color; sText : STRING; guarded : FB_Guarded;
"""


def proposals(code: str, declarations: str = VARS) -> list[Completion]:
    project = Project(
        PLC_PRG=f"PROGRAM PLC_PRG\nVAR\n{declarations}\nEND_VAR\n{code}\nEND_PROGRAM", **OBJECTS
    )
    return complete(project.workspace, project.document, project.position)


def labels(code: str, declarations: str = VARS) -> list[str]:
    return [item.label for item in proposals(code, declarations)]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("p.|", ["x", "y", "mode"]),
        ("p.m|", ["x", "y", "mode"]),
        ("aP[1].|", ["x", "y", "mode"]),
        ("aP[p.x + 1].|", ["x", "y", "mode"]),
        ("pp^.|", ["x", "y", "mode"]),
        ("pp[2].|", ["x", "y", "mode"]),
        ("ref.|", ["x", "y", "mode"]),
        ("x := 1 + p.|;", ["x", "y", "mode"]),
        ("IF p.|", ["x", "y", "mode"]),
        ("iCount := motor.|", ["xBase", "xOn", "xRuns", "Halt", "Act", "Speed", "Reset", "iInner"]),
        ("motor.|", ["xBase", "xOn", "xRuns", "Halt", "Act", "Speed", "Reset"]),  # no writing to locals
        ("guarded.|", ["Open", "Open(...)"]),
        ("quiet.|", ["a", "b"]),
        ("axis.|", ["Halt", "Speed"]),
        ("xFlag := timer.|", ["IN", "PT", "Q", "ET"]),
        ("GVL_Line.|", ["udiCount", "eMode"]),
        ("E_Color.|", ["Red", "Green"]),
        ("Standard.|", ["TON"]),
        ("xFlag.|", []),
        ("nothing.|", []),
        ("sText.|", []),
        ("PLC_PRG.p.|", ["x", "y", "mode"]),
    ],
)
def test_members_behind_a_dot(code: str, expected: list[str]) -> None:
    assert labels(code) == expected


def test_bits_behind_an_integer() -> None:
    assert labels("iCount.|") == sorted((str(bit) for bit in range(16)), key=str)


def test_content_operator_behind_a_pointer() -> None:
    assert labels("pp.|") == ["^"]


def test_global_namespace_behind_a_leading_dot() -> None:
    found = labels("a := .|")
    assert "g_xStop" in found
    assert "iCount" not in found


def test_members_inside_a_block_and_its_method() -> None:
    block = (
        "FUNCTION_BLOCK FB_X EXTENDS FB_Base VAR iOwn : INT; END_VAR METHOD M "
        "VAR t : INT; END_VAR THIS^.| END_METHOD END_FUNCTION_BLOCK"
    )
    project = Project(FB_X=block, **OBJECTS)
    found = [item.label for item in complete(project.workspace, "FB_X", project.position)]
    assert {"iOwn", "xBase", "M", "Reset"} <= set(found)
    project = Project(FB_X=block.replace("THIS^.", "SUPER^."), **OBJECTS)
    found = [item.label for item in complete(project.workspace, "FB_X", project.position)]
    assert found == ["xBase", "Reset"]


def test_names_in_scope_at_a_statement() -> None:
    found = {item.label: item for item in proposals("iC|")}
    assert found["iCount"].kind is ItemKind.VARIABLE
    assert found["iCount"].detail == "INT"
    assert found["g_xStop"].detail == "BOOL"
    assert found["c_iMax"].kind is ItemKind.CONSTANT
    assert found["Auto"].kind is ItemKind.ENUM_VALUE
    assert found["F_Add"].comment == "Sum"
    assert found["TON"].kind is ItemKind.FUNCTION_BLOCK
    assert "udiCount" not in found  # qualified_only
    assert "Red" not in found
    assert found["IF ... END_IF"].snippet
    assert found["LIMIT"].detail.startswith("LIMIT(")
    assert found["iCount"].rank < found["g_xStop"].rank < found["TON"].rank < found["LIMIT"].rank


def test_names_inside_a_child_text_of_its_own() -> None:
    project = Project(
        FB_X="FUNCTION_BLOCK FB_X VAR iOwn : INT; END_VAR END_FUNCTION_BLOCK",
        FB_X__Work="METHOD Work\nVAR t : INT; END_VAR\n|\nEND_METHOD",
        FB_X__Act="ACTION Act\nEND_ACTION",
    )
    found = [item.label for item in complete(project.workspace, "FB_X.Work", project.position)]
    assert {"iOwn", "t", "Act", "Work", "THIS^"} <= set(found)


def test_conversions_for_what_is_typed() -> None:
    assert "INT_TO_REAL" in labels("a := INT_|")
    assert "TO_LREAL" in labels("a := TO_|")
    assert "INT_TO_REAL" not in labels("a := |")


@pytest.mark.parametrize(
    ("code", "first"),
    [
        (
            "motor(|",
            ["xBase :=, xOn :=, stPos :=, ...", "xBase :=", "xOn :=", "stPos :=", "xRuns =>", "xFlag"],
        ),
        ("motor(xOn := TRUE, |);", ["xBase :=", "stPos :=", "xRuns =>"]),
        ("motor(|, xOn := TRUE);", ["xBase :=", "stPos :=", "xRuns =>"]),
        ("iCount := F_Add(|", ["a :=, b :=", "a :=", "b :=", "iCount", "c_iMax"]),
        ("timer(IN := xFlag, P|", ["PT :=", "Q =>", "ET =>"]),
        ("eMode := |", ["Off", "Auto", "Manual", "eMode"]),
        ("IF eMode = |", ["Off", "Auto", "Manual", "eMode"]),
        ("eColor := |", ["E_Color.Red", "E_Color.Green", "eColor"]),
        ("CASE eMode OF |", ["Off", "Auto", "Manual"]),
        ("CASE eColor OF E_Color.Red: ; |", ["E_Color.Green"]),
        ("FOR |", ["iCount", "c_iMax"]),
        ("p := (|", ["x :=", "y :=", "mode :="]),
        ("p := (x := 1, |", ["y :=", "mode :="]),
        ("timer(IN := |", ["xFlag", "FALSE", "g_xStop", "TRUE"]),
        ("IF |", ["xFlag", "FALSE", "g_xStop", "TRUE"]),
        ("iCount := |", ["iCount", "c_iMax"]),
    ],
)
def test_what_fits_comes_first(code: str, first: list[str]) -> None:
    found = labels(code)
    assert found[: len(first)] == first


def test_enumeration_values_as_labels_of_a_case() -> None:
    found = proposals("CASE eMode OF\n  Off: iCount := 1;\n  |\nEND_CASE")
    assert [item.label for item in found if item.rank == 2] == ["Auto", "Manual"]


@pytest.mark.parametrize("line", ["a : |", "a : ARRAY[0..1] OF |", "a : POINTER TO |", "a : REFERENCE TO S|"])
def test_types_where_a_type_stands(line: str) -> None:
    found = labels("", f"{line}\n")
    assert {"INT", "STRING", "ST_Point", "FB_Motor", "TON", "I_Axis", "E_Mode", "ARRAY", "Standard"} <= set(
        found
    )
    assert not {"F_Add", "PLC_PRG", "iCount", "IF"} & set(found)


def test_values_where_an_initial_value_stands() -> None:
    assert "c_iMax" in labels("", "a : INT := |")
    assert labels("", "a : E_Color := |")[:2] == ["E_Color.Red", "E_Color.Green"]
    assert labels("", "a : BOOL := |")[:2] == ["a", "FALSE"]
    assert labels("", "a : ST_Point := (y := 1, |")[:2] == ["x :=", "mode :="]
    assert labels("", "a : TON := (|")[:3] == ["IN :=", "PT :=", "a"]


def test_usual_types_come_first() -> None:
    assert labels("", "a : |")[:4] == ["BOOL", "INT", "DINT", "REAL"]


@pytest.mark.parametrize(
    ("code", "label", "insert"),
    [
        ("|", "timer(...)", "timer(IN := $1, PT := $2, Q => $3, ET => $4);$0"),
        ("tim|", "timer(...)", "timer(IN := $1, PT := $2, Q => $3, ET => $4);$0"),
        ("iCount := F|", "F_Add(...)", "F_Add(a := $1, b := $2)$0"),
        ("guarded.|", "Open(...)", "Open(xFast := $1);$0"),
        ("timer(|", "IN :=, PT :=, Q =>, ...", "IN := $1, PT := $2, Q => $3, ET => $4"),
        ("timer(|\nxFlag := TRUE;", "IN :=, PT :=, Q =>, ...", "IN := $1, PT := $2, Q => $3, ET => $4"),
    ],
)
def test_whole_calls_with_a_place_for_each_parameter(code: str, label: str, insert: str) -> None:
    found = {item.label: item for item in proposals(code)}
    assert found[label].insert == insert
    assert found[label].snippet


def test_no_whole_call_of_an_instance_inside_a_value() -> None:
    assert "timer(...)" not in labels("xFlag := t|")


def test_flags_and_end_inside_a_block() -> None:
    project = Project(P="PROGRAM P\nVAR |\nEND_VAR\nEND_PROGRAM")
    assert [item.label for item in complete(project.workspace, "P", project.position)] == [
        "CONSTANT",
        "INTERNAL",
        "NON_RETAIN",
        "PERSISTENT",
        "PRIVATE",
        "PROTECTED",
        "PUBLIC",
        "RETAIN",
    ]
    project = Project(P="PROGRAM P\nVAR_INPUT |\nEND_VAR\nEND_PROGRAM")
    assert "PUBLIC" not in [item.label for item in complete(project.workspace, "P", project.position)]


def test_heads_outside_of_objects() -> None:
    project = Project(P="|")
    assert "FUNCTION_BLOCK" in [item.label for item in complete(project.workspace, "P", project.position)]


def test_bases_and_interfaces_in_a_head() -> None:
    project = Project(X="FUNCTION_BLOCK X EXTENDS |", **OBJECTS)
    found = [item.label for item in complete(project.workspace, "X", project.position)]
    assert "FB_Motor" in found
    assert "I_Axis" not in found
    project = Project(X="FUNCTION_BLOCK X IMPLEMENTS |", **OBJECTS)
    found = [item.label for item in complete(project.workspace, "X", project.position)]
    assert "I_Axis" in found
    assert "FB_Motor" not in found


@pytest.mark.parametrize("code", ["(* p.| *)", "// p.|", "s := 'p.|';", "{info 'p.|'}"])
def test_nothing_in_comments_strings_and_messages(code: str) -> None:
    assert labels(code) == []


def test_attribute_names_in_a_pragma() -> None:
    assert "qualified_only" in labels("{attribute '|'}")


def test_obsolete_blocks_are_marked() -> None:
    project = Project(
        P="PROGRAM P\nVAR a : |; END_VAR\nEND_PROGRAM",
        Old="{attribute 'obsolete' := 'use New'}\nFUNCTION_BLOCK Old END_FUNCTION_BLOCK",
    )
    found = {item.label: item for item in complete(project.workspace, "P", project.position)}
    assert found["Old"].deprecated


@pytest.mark.parametrize(
    "code", ["|", "p.|", "motor(|", "IF p.x = |", "CASE |", "x := (p.|", "aP[|", ")|", "a ' |"]
)
def test_half_written_text_gives_proposals_without_failing(code: str) -> None:
    proposals(code)


def test_stale_analysis_serves_while_a_new_one_would_be_slow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tappet.lang.services.workspace.SLOW_S", 0.0)
    project = Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR\n{VARS}\nEND_VAR\n\nEND_PROGRAM", **OBJECTS)
    before = project.snapshot
    marked = Project(PLC_PRG=f"PROGRAM PLC_PRG\nVAR\n{VARS}\nEND_VAR\np.|\nEND_PROGRAM")
    project.workspace.open("PLC_PRG", marked.objects["PLC_PRG"])
    found = complete(project.workspace, "PLC_PRG", marked.position)
    assert [item.label for item in found] == ["x", "y", "mode"]
    assert project.workspace._snapshots["App"] is before


def test_every_documented_operator_exists() -> None:
    assert set(OPERATOR_HEADS) <= set(OPERATORS) | {"AND", "OR", "XOR", "NOT", "MOD"}
    assert all(
        find_operator(f"TO_{name}") and find_operator(f"INT_TO_{name}")
        for name in CONVERTIBLE
        if name != "INT"
    )


def test_every_operator_of_the_user_is_documented() -> None:
    system = {name for name in OPERATORS if name.startswith("__")}
    assert not [name for name in set(OPERATORS) - system if head_of(name) is None and "TO_" not in name]
