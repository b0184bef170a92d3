"""Projects with cams, as a user makes them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tappet.cli.inputs import project_applications
from tappet.codegen.build import BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.project import edit
from tappet.project.cams.table import CamTable
from tappet.project.model import Project
from tappet.project.new_project import new_project

SESSION = BuildSession()
READING = """PROGRAM PLC_PRG
VAR
    fX : LREAL;
    nElement : INT;
    stValues : SMC_CAMValues;
END_VAR"""


def with_cams(*, library: bool = True, **cams: dict[str, Any] | None) -> Project:
    """A new project with these cams, each with its data or those of a new one."""
    project = new_project("machine")
    (application,) = project.applications()
    if library:
        project, _ = edit.add_object(project, application.id, "axis_pool")
    for name, data in cams.items():
        project, _ = edit.add_object(project, application.id, "cam", name, data=data)
    return project


def reading(project: Project, cam: str = "Cam", more: str = "", variables: str = "") -> Project:
    """PLC_PRG evaluates a cam at fX in each cycle."""
    (program,) = project.find_kind("pou")
    body = f"{more}\nstValues := SMC_CAMEvaluate({cam}, fX, nElement);"
    return edit.change_data(
        project,
        program.id,
        {"declaration": READING.replace("END_VAR", f"    {variables}\nEND_VAR"), "implementation": body},
    )


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
    assert [str(d) for d in result.diagnostics if d.severity != "info"] == []
    assert result.package is not None
    return result.package


def cam(project: Project, name: str = "Cam") -> CamTable:
    return next(item for item in project.find_kind("cam") if item.name == name).data_as(CamTable)


def changed(project: Project, name: str = "Cam", **data: Any) -> Project:
    item = next(item for item in project.find_kind("cam") if item.name == name)
    return edit.change_data(project, item.id, {**item.data.model_dump(), **data})
