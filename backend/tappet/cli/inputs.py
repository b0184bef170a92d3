"""PATH arguments: a project folder, or plain `.st` files."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tappet import libraries
from tappet.cli.errors import UsageError
from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.iec.task import Task
from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.project.project_file import PROJECT_FILE, is_project
from tappet.runtime.unit_tests.discovery import TEST_LIBRARY, has_suites

if TYPE_CHECKING:
    from tappet.lang.coding_settings import StaticAnalysis
    from tappet.project.model import Project
    from tappet.runtime.unit_tests.recordings import RecordedTest

BARE_TASK_INTERVAL_NS = 10_000_000
"""A PROGRAM of a bare .st file runs every 10 ms (docs/architecture.md, section 3)."""


@dataclass(frozen=True, slots=True)
class ApplicationInput:
    """One application as `build_application` takes it."""

    name: str
    sources: tuple[Source, ...]
    tasks: tuple[Task, ...]
    options: BuildOptions
    recordings: tuple[RecordedTest, ...] = ()
    """Recordings of the flight recorder that are tests."""


def load_project(path: Path) -> Project:
    """The project in a folder; raises UsageError naming the file that cannot be read."""
    from tappet.project import folder
    from tappet.project.errors import ProjectError

    if not is_project(path):
        raise UsageError(f"{path} is no project folder: it has no {PROJECT_FILE}")
    try:
        return folder.load(path)
    except ProjectError as error:
        raise UsageError(str(error)) from error


def applications(paths: Sequence[Path], only: str | None = None) -> list[ApplicationInput]:
    """The applications that the paths hold: those of a project folder, or one of all `.st` files together.

    Raises UsageError when a path is neither, or when `only` names no application.
    """
    if len(paths) == 1 and is_project(paths[0]):
        found = project_applications(load_project(paths[0]))
    else:
        found = [_plain_files(paths)]
    if only is not None:
        chosen = [application for application in found if application.name.casefold() == only.casefold()]
        if not chosen:
            names = ", ".join(application.name for application in found)
            raise UsageError(f"there is no application '{only}'; there is {names or 'none'}")
        return chosen
    return found


def one_application(paths: Sequence[Path], only: str | None = None) -> ApplicationInput:
    """The single application that the paths hold; raises UsageError when there are several."""
    found = applications(paths, only)
    if len(found) != 1:
        names = ", ".join(application.name for application in found)
        raise UsageError(f"choose one application with --application: {names or 'the project has none'}")
    return found[0]


def project_applications(project: Project) -> list[ApplicationInput]:
    """Every application of a project with its libraries and tasks."""
    from tappet.motion.queue_sources import with_queues
    from tappet.project import sources as project_sources
    from tappet.runtime.unit_tests.recordings import recorded_tests
    from tappet.user_cache import cache_folder

    cache = cache_folder("objects")
    return [
        ApplicationInput(
            application.name,
            tuple(with_queues(project_sources.application_sources(project, application.id), cache)),
            tuple(project_sources.tasks(project, application.id)),
            BuildOptions(
                application.name,
                project=project.name,
                compiled=int(time.time()),
                libraries=tuple(project_sources.libraries(project, application.id)),
                static=_static(project, application.id),
                disabled_warnings=project_sources.disabled_warnings(project, application.id),
                heap=project_sources.heap(project, application.id),
                reserve=project_sources.change_reserve(project, application.id),
                once=True,
            ),
            recorded_tests(project, application.id),
        )
        for application in project.applications()
    ]


def _static(project: Project, application_id: str) -> StaticAnalysis:
    from tappet.lang.coding_settings import static_analysis
    from tappet.project import sources as project_sources

    chosen = project_sources.static_analysis(project, application_id)
    return static_analysis(chosen.rules, chosen.prefixes, chosen.limits)


def _plain_files(paths: Sequence[Path]) -> ApplicationInput:
    files: list[Path] = []
    for path in paths:
        if path.is_dir():
            files += sorted(path.rglob("*.st"))
        elif path.is_file():
            files.append(path)
        else:
            raise UsageError(f"{path} does not exist")
    if not files:
        raise UsageError(f"no .st file in {', '.join(str(path) for path in paths)}")
    sources = [_read(path) for path in files]
    programs = [
        declaration.name
        for source in sources
        for declaration in parse(source).unit.declarations
        if isinstance(declaration, ast.Pou) and declaration.kind == "PROGRAM"
    ]
    tasks = (Task("Task", interval_ns=BARE_TASK_INTERVAL_NS, programs=tuple(programs)),) if programs else ()
    texts = [source.text for source in sources]
    # the test library keeps room for the results of many tests: only tests get it
    names = [n for n in libraries.names() if n != TEST_LIBRARY or has_suites(texts)]
    references = tuple(LibraryReference(libraries.as_called(name, texts)) for name in names)
    options = BuildOptions(
        files[0].stem,
        compiled=int(time.time()),
        libraries=references,
        free_addresses=False,
        once=True,
    )
    return ApplicationInput(files[0].stem, tuple(sources), tasks, options)


def _read(path: Path) -> Source:
    raw = path.read_bytes()
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return Source(uri=str(path), text=text, name=path.stem)
