"""Projects with axes, as a user makes them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tappet.cli.inputs import project_applications
from tappet.codegen.build import BuildResult, build_application
from tappet.codegen.package import CodePackage
from tappet.project import edit
from tappet.project.model import Project, ProjectObject
from tappet.project.new_project import new_project
from tappet.runtime.local import LocalRuntime

DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower : MC_Power;
    fbMove : MC_MoveAbsolute;
END_VAR"""
BODY = """fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Drive, Execute := fbPower.Status, Position := 50.0, Velocity := 10.0,
    Acceleration := 100.0, Deceleration := 100.0);"""


def with_axes(*names: str, **data: Any) -> Project:
    """A new project with these virtual axes; `data` is that of the first one."""
    project = new_project("machine")
    (application,) = project.applications()
    project, pool = edit.add_object(project, application.id, "axis_pool")
    for number, name in enumerate(names):
        project, _ = edit.add_object(project, pool.id, "axis", name, data=None if number else data or None)
    return project


def moving(project: Project, body: str = BODY) -> Project:
    """PLC_PRG moves the axis Drive to 50."""
    (program,) = project.find_kind("pou")
    return edit.change_data(project, program.id, {"declaration": DECLARATION, "implementation": body})


def only(project: Project, kind: str) -> ProjectObject:
    (found,) = project.find_kind(kind)
    return found


def application_id(project: Project) -> str:
    return only(project, "application").id


def build(project: Project, previous: CodePackage | None = None) -> BuildResult:
    """`previous`: the package that an online change goes on from."""
    (one,) = project_applications(project)
    options = replace(one.options, level=1, once=False)
    return build_application(one.sources, one.tasks, options=options, previous=previous)


def errors(project: Project) -> list[str]:
    return [d.message for d in build(project).diagnostics if d.severity == "error"]


def values(project: Project, cycles: int, *paths: str, **written: Any) -> list[Any]:
    result = build(project)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with LocalRuntime(result.package) as plc:
        plc.start()
        for path, value in written.items():
            plc.write(path.replace("__", "."), value)
        plc.run(cycles)
        return [plc.read(path) for path in paths]
