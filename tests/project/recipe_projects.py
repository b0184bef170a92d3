"""Projects with a recipe manager, as a user makes them, and programs that give commands to it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tappet.cli.inputs import project_applications
from tappet.codegen.build import BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.project import edit
from tappet.project.model import Project
from tappet.project.new_project import new_project

SESSION = BuildSession()
VALUES = """PROGRAM PLC_PRG
VAR
    fb : RecipeManCommands;
    nOrder, nDone : INT;
    dwResult, dwLast : DWORD;
    sProblem : STRING(255);
    sRecipe : STRING := 'Dark';
    sFile : STRING(255);
    nCount : INT;
    asTexts : ARRAY[0..9] OF STRING;
    nFirst : INT;
    xFan : BOOL;
    nLevel : INT := 3;
    byMask : BYTE;
    uliSerial : ULINT;
    rSpeed : REAL;
    fTemperature : LREAL := 20.5;
    tBake : TIME;
    dStart : DATE;
    sLabel : STRING(12);
    wsTitle : WSTRING(12);
    eMode : E_Mode;
    aStep : ARRAY[1..3] OF Step;
END_VAR"""
COMMANDS = (
    "CreateRecipe('Bread', sRecipe)",
    "CreateRecipeNoSave('Bread', sRecipe)",
    "ReadRecipe('Bread', sRecipe)",
    "WriteRecipe('Bread', sRecipe)",
    "LoadRecipe('Bread', sRecipe)",
    "SaveRecipe('Bread', sRecipe)",
    "LoadAndWriteRecipe('Bread', sRecipe)",
    "LoadFromAndWriteRecipe('Bread', sRecipe, sFile)",
    "ReadAndSaveRecipe('Bread', sRecipe)",
    "ReadAndSaveRecipeAs('Bread', sRecipe, sFile)",
    "ReadAndSaveAs('Bread', sFile)",
    "DeleteRecipe('Bread', sRecipe)",
    "DeleteRecipeFile('Bread', sRecipe)",
    "GetRecipeNames('Bread', ADR(asTexts[0]), 10, nFirst)",
    "GetRecipeValues('Bread', sRecipe, ADR(asTexts[0]), 10, nFirst, 80)",
    "GetRecipeVariableNames('Bread', sRecipe, ADR(asTexts[0]), 10, nFirst)",
    "SetRecipeValues('Bread', sRecipe, ADR(asTexts[0]), 10, nFirst)",
    "WriteRecipe('Cake', sRecipe)",
)
NUMBERS = {command.partition("(")[0]: number for number, command in enumerate(COMMANDS[:-1], start=1)}
NUMBERS["WriteOfNone"] = len(COMMANDS)
BODY = "\n".join(
    [
        "IF nOrder <> 0 THEN",
        "    CASE nOrder OF",
        *(f"    {number}: dwResult := fb.{command};" for number, command in enumerate(COMMANDS, start=1)),
        "    END_CASE",
        "    dwLast := fb.GetLastError();",
        "    sProblem := fb.GetLastErrorText();",
        "    nCount := fb.GetRecipeCount('Bread');",
        "    nDone := nDone + 1;",
        "    nOrder := 0;",
        "END_IF",
    ]
)
PATHS = (
    "PLC_PRG.xFan", "PLC_PRG.nLevel", "PLC_PRG.byMask", "PLC_PRG.uliSerial", "PLC_PRG.rSpeed",
    "PLC_PRG.fTemperature", "PLC_PRG.tBake", "PLC_PRG.dStart", "PLC_PRG.sLabel", "PLC_PRG.wsTitle",
    "PLC_PRG.eMode", "PLC_PRG.aStep[2].nTime",
)  # fmt: skip
LIGHT = dict(
    zip(
        PATHS,
        (
            "TRUE", "7", "16#F0", "18446744073709551615", "1.25", "0.1", "T#1m30s", "D#2026-02-28",
            "'it$'s'", '"Brötchen"', "E_Mode.Auto", "-5",
        ),
        strict=True,
    )
)  # fmt: skip
DARK = dict(
    zip(
        PATHS,
        (
            "FALSE", "-3", "1", "2", "-1.5E-3", "1E300", "T#0ms", "D#1970-01-01", "''", '""', "E_Mode.Off",
            "99",
        ),
        strict=True,
    )
)  # fmt: skip


def project_of(definition: dict[str, Any] | None = None, *, body: str = BODY, **settings: Any) -> Project:
    """A project with the definition Bread."""
    project = new_project("bakery")
    (application,) = project.applications()
    project, manager = edit.add_object(project, application.id, "recipe_manager", data=settings)
    data = definition or {
        "variables": [{"path": path} for path in PATHS],
        "recipes": [{"name": "Light", "values": LIGHT}, {"name": "Dark", "values": DARK}],
    }
    project, _ = edit.add_object(project, manager.id, "recipe_definition", "Bread", data=data)
    for name, text in (
        ("E_Mode", "TYPE E_Mode : (Off, Manual := 3, Auto := 5); END_TYPE"),
        ("Step", "TYPE Step : STRUCT nTime : INT; END_STRUCT END_TYPE"),
    ):
        project, _ = edit.add_object(project, application.id, "dut", name, data={"declaration": text})
    (program,) = project.find_kind("pou")
    return edit.change_data(project, program.id, {"declaration": VALUES, "implementation": body})


def build(project: Project, previous: CodePackage | None = None) -> BuildResult:
    (one,) = project_applications(project)
    return build_application(
        one.sources,
        one.tasks,
        options=replace(one.options, level=1, once=False),
        previous=previous,
        session=SESSION,
    )


def package(project: Project, previous: CodePackage | None = None) -> CodePackage:
    result = build(project, previous)
    told = [d for d in result.diagnostics if d.severity != "info" and d.code != "W1103"]
    assert [str(d) for d in told] == []  # variables that only a recipe uses are unused in some
    assert result.package is not None
    return result.package
