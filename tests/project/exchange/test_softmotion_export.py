"""What docs/motion/from-codesys-softmotion.md has an engineer do with an export of a SoftMotion project."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.libraries.missing import report_missing
from tappet.project import edit
from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ImportReport
from tappet.project.model import Project, ProjectObject

SAMPLE = Path(__file__).parent / "samples" / "softmotion.xml"
OF_DRIVES = ("SM3_Drive_Virtual",)


def _imported() -> tuple[Project, ImportReport]:
    done = import_files({SAMPLE.name: SAMPLE.read_bytes()})
    report_missing(done.project, done.report)
    return done.project, done.report


def _only(project: Project, kind: str) -> ProjectObject:
    (found,) = project.find_kind(kind)
    return found


def _errors(project: Project) -> list[str]:
    (one,) = project_applications(project)
    built = build_application(one.sources, one.tasks, options=replace(one.options, level=1))
    return [one.message for one in built.diagnostics if one.severity == "error"]


def test_the_report_names_the_libraries_that_are_not_there() -> None:
    _, report = _imported()
    missing = {entry.object for entry in report.noteworthy() if "not installed" in entry.text}
    assert missing == set(OF_DRIVES)


def test_the_texts_compile_once_the_axes_are_there() -> None:
    project, _ = _imported()
    assert any("'Drive' not defined" in message for message in _errors(project))
    manager = _only(project, "library_manager")
    references = [one for one in manager.data.model_dump()["references"] if one["name"] not in OF_DRIVES]
    project = edit.change_data(project, manager.id, {"references": references})
    project, pool = edit.add_object(project, _only(project, "application").id, "axis_pool")
    project, _ = edit.add_object(project, pool.id, "axis", "Drive", data={"bus_task": "EtherCAT_Task"})
    assert _errors(project) == []
