"""Renaming an axis renames the variable in the texts that use it (AXIS-04)."""

from __future__ import annotations

import pytest
from tests.project.axis_projects import moving, with_axes
from tests.project.test_axes import build

from tappet.project import edit
from tappet.project.model import Project
from tappet.project.renamed_variable import renamed

LISTS = frozenset(["IOCONFIG_GLOBALS", "APPLICATION"])


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("fbPower(Axis := Axis, Enable := TRUE);", "fbPower(Axis := Belt, Enable := TRUE);"),
        ("x := AXIS.fSetPosition + axis.fSetPosition;", "x := Belt.fSetPosition + Belt.fSetPosition;"),
        ("IoConfig_Globals.Axis.bError", "IoConfig_Globals.Belt.bError"),
        ("Application.Axis.bError", "Application.Belt.bError"),
        ("fbMove.Axis.bError; stThing.Axis := 1;", "fbMove.Axis.bError; stThing.Axis := 1;"),
        ("Axis := Other;", "Belt := Other;"),
        ("fb(Master := a[Axis.iOwner], Axis => x)", "fb(Master := a[Belt.iOwner], Axis => x)"),
        ("// Axis\n(* Axis *) s := 'Axis';", "// Axis\n(* Axis *) s := 'Axis';"),
        ("Axis1 := MyAxis;", "Axis1 := MyAxis;"),
        ("p := ADR(Axis);", "p := ADR(Belt);"),
        ("", ""),
    ],
)
def test_uses_of_the_variable(text: str, result: str) -> None:
    assert renamed(text, LISTS, "Axis", "Belt") == result


def body(project: Project, name: str) -> str:
    found = next(item for item in project.objects.values() if item.name == name)
    return str(found.data.model_dump()["implementation"])


def with_name(project: Project, old: str, new: str) -> Project:
    axis = next(item for item in project.find_kind("axis") if item.name == old)
    return edit.rename_object(project, axis.id, new)


def test_a_renamed_axis_is_used_under_its_new_name() -> None:
    project = with_name(moving(with_axes("Drive", "Other")), "Drive", "Conveyor")
    assert body(project, "PLC_PRG").count("Conveyor") == 2
    assert [d for d in build(project).diagnostics if d.severity == "error"] == []


def test_a_text_that_declares_the_name_itself_keeps_it() -> None:
    project = with_axes("Drive")
    (application,) = project.applications()
    declaration = "FUNCTION_BLOCK FB_Own\nVAR_IN_OUT\n    Drive : AXIS_REF_SM3;\nEND_VAR"
    text = {"declaration": declaration, "implementation": "Drive.bErrorAckn := TRUE;"}
    project, block = edit.add_object(project, application.id, "pou", "FB_Own", data=text)
    method = {"declaration": "METHOD Clear", "implementation": "Drive.bErrorAckn := FALSE;"}
    project, _ = edit.add_object(project, block.id, "method", "Clear", data=method)
    text = {
        "declaration": "PROGRAM P\nVAR\n    pDrive : POINTER TO AXIS_REF_VIRTUAL_SM3 := ADR(Drive);\nEND_VAR"
    }
    project, _ = edit.add_object(project, application.id, "pou", "P", data=text)
    project = with_name(project, "Drive", "Belt")
    assert body(project, "FB_Own") == "Drive.bErrorAckn := TRUE;"
    assert body(project, "Clear") == "Drive.bErrorAckn := FALSE;"
    program = next(item for item in project.objects.values() if item.name == "P")
    assert (
        "pDrive : POINTER TO AXIS_REF_VIRTUAL_SM3 := ADR(Belt);" in program.data.model_dump()["declaration"]
    )
    assert [d for d in build(project).diagnostics if d.severity == "error"] == []
