"""A program with a bug, and the recording of the fault that it led to."""

from __future__ import annotations

from contextlib import suppress

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.project import edit
from tappet.project.model import Project
from tappet.runtime.flight_recording import write_recording
from tappet.runtime.local import ApplicationException, LocalRuntime

DECLARATION = """PROGRAM PLC_PRG
VAR
    recipe : DINT := 5;
    pieces : DINT;
END_VAR
"""
BUG = "pieces := pieces + 100 / recipe;"
MENDED = "IF recipe <> 0 THEN pieces := pieces + 100 / recipe; END_IF"


def with_text(project: Project, text: str) -> Project:
    """The project with this body of its program."""
    program = next(item for item in project.walk() if item.name == "PLC_PRG")
    data = program.data.model_dump() | {"declaration": DECLARATION, "implementation": text}
    return edit.change_data(project, program.id, data)


def recording_of(project: Project) -> str:
    """A recording of it: twenty cycles of 20 pieces, then a recipe of 0 ends it in cycle 21."""
    (application,) = project_applications(project)
    package = build_application(application.sources, application.tasks, application.options).package
    assert package is not None
    with LocalRuntime(package) as runtime:
        runtime.run(20)
        runtime.write("PLC_PRG.recipe", 0)
        with suppress(ApplicationException):
            runtime.run(1)
        return write_recording(runtime.plc.flight_recording())
