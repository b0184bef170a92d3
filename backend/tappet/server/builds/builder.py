"""Builds applications in compiler processes, off the event loop; a build can be cancelled."""

from __future__ import annotations

import asyncio
import hashlib
import logging
import sys
from collections import OrderedDict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import msgpack
from msgspec import convert, to_builtins

from tappet.codegen.variable_changes import ChangeReport
from tappet.iec.heap import DEFAULT_HEAP, HeapSettings
from tappet.iec.memory import DEFAULT_RESERVE, ChangeReserve
from tappet.iec.places import Span
from tappet.iec.source import Scope, Source
from tappet.iec.task import Task
from tappet.project import sources as texts
from tappet.project.kinds.application import NO_RULES, StaticAnalysisData
from tappet.project.library_reference import LibraryReference
from tappet.project.library_texts import library_requirements, library_sources
from tappet.project.model import Project
from tappet.server.builds.messages import BuildOrder
from tappet.server.builds.shapes import BuildReport, Diagnostic, Part, Severity
from tappet.server.problems import Problem
from tappet.server.worker_process import WorkerCrashedError, WorkerProcess

log = logging.getLogger(__name__)
KEPT_BUILDS = 32
"""Newest build of so many applications stay at hand."""
NO_CHANGES = ChangeReport()
WORKER = (sys.executable, "-m", "tappet.server.builds.worker")


@dataclass(frozen=True, slots=True)
class Application:
    """An application of a project as it is to be built: its texts, tasks and libraries."""

    project_id: str
    application_id: str
    name: str
    sources: tuple[Source, ...]
    tasks: tuple[Task, ...]
    libraries: tuple[LibraryReference, ...]
    paths: dict[str, str]
    """Path in the tree of each object that messages are about, by id."""
    static: StaticAnalysisData = NO_RULES
    """The coding rules that are checked."""
    project: str = ""
    """Name of the project."""
    heap: HeapSettings = DEFAULT_HEAP
    """The memory of `__NEW`."""
    reserve: ChangeReserve = DEFAULT_RESERVE
    """The memory that a download sets aside for online changes."""
    disabled_warnings: frozenset[str] = frozenset()
    """Codes of warnings that are not reported."""

    @classmethod
    def of(cls, project_id: str, project: Project, application_id: str) -> Application:
        """Raises UnknownObjectError when the id is no application."""
        found = tuple(texts.application_sources(project, application_id))
        tasks = tuple(texts.tasks(project, application_id))
        ids = {segment.object_id for source in found for segment in source.segments}
        ids |= {task.object_id for task in tasks if task.object_id} | {application_id}
        ids |= {manager.id for manager in texts.objects_with_libraries(project, application_id)}
        return cls(
            project_id,
            application_id,
            project.get(application_id).name,
            found,
            tasks,
            tuple(texts.libraries(project, application_id)),
            {id: project.path_of(id) for id in ids},
            texts.static_analysis(project, application_id),
            project.name,
            texts.heap(project, application_id),
            texts.change_reserve(project, application_id),
            texts.disabled_warnings(project, application_id),
        )

    @classmethod
    def library(cls, project_id: str, project: Project) -> Application:
        """What a project is as a library: all its code but programs, in no application."""
        found = tuple(library_sources(project))
        ids = {segment.object_id for source in found for segment in source.segments}
        ids |= {item.id for item in project.walk() if texts.compiled(item).libraries is not None}
        return cls(
            project_id,
            "",
            project.name,
            found,
            (),
            tuple(library_requirements(project)),
            {id: project.path_of(id) for id in ids} | {"": project.name},
        )


@dataclass(frozen=True, slots=True)
class Built:
    """A finished build."""

    application: Application
    fingerprint: str
    report: BuildReport
    package: bytes | None
    change_base: str | None
    """Code id of the package that this one can be changed over from."""
    change_reasons: tuple[str, ...]
    changes: ChangeReport = NO_CHANGES
    """What an online change from there does to the variables."""


class Builder:
    """Orders builds, one at a time per application, and remembers the newest of each."""

    def __init__(self, workers: int, cache: Path, command: Sequence[str] = WORKER) -> None:
        self._cache = cache
        self._workers = [WorkerProcess(command) for _ in range(max(1, workers))]
        self._built: OrderedDict[tuple[str, str], Built] = OrderedDict()
        self._running: dict[tuple[str, str], tuple[str, asyncio.Task[Built]]] = {}
        self._cleaned: set[tuple[str, str]] = set()
        """Applications whose next build uses nothing of earlier ones."""

    async def build(
        self, application: Application, previous: tuple[str, bytes] | None, *, fresh: bool = False
    ) -> Built:
        """The build of exactly these texts on top of `previous` (code id, package), from memory if known.

        With `fresh` everything is compiled anew. Raises problems: 409 when it was cancelled, 500 when the
        compiler crashed.
        """
        key = (application.project_id, application.application_id)
        fresh = fresh or key in self._cleaned
        order, fingerprint = await asyncio.to_thread(self._order, application, previous, fresh=fresh)
        known = self._built.get(key)
        if not fresh and known is not None and known.fingerprint == fingerprint:
            self._built.move_to_end(key)
            return known
        while key in self._running:
            running, task = self._running[key]
            if running == fingerprint:
                return await self._wait(task)
            with suppress(asyncio.CancelledError, WorkerCrashedError):
                await asyncio.shield(task)
        task = asyncio.create_task(self._run(key, application, order, fingerprint))
        self._running[key] = (fingerprint, task)
        task.add_done_callback(lambda done: self._finished(key, done))
        return await self._wait(task)

    def clean(self, project_id: str, application_id: str) -> None:
        """Forget what builds of an application have left; one that runs is cancelled."""
        self.cancel(project_id, application_id)
        self._built.pop((project_id, application_id), None)
        self._cleaned.add((project_id, application_id))

    async def check(self, application: Application) -> BuildReport:
        """All messages about an application, without code; it does not count as a build.

        Raises the problem 500 when the compiler crashed.
        """
        order, _ = await asyncio.to_thread(self._order, application, None, check_only=True)
        try:
            outcome = await self._worker(order).ask(asdict(order))
        except WorkerCrashedError as error:
            raise _crashed(error) from error
        report = _report(application, outcome)
        faulty = any(diagnostic.severity is Severity.ERROR for diagnostic in report.diagnostics)
        return report.model_copy(update={"ok": not faulty})

    async def variant(self, application: Application, code_id: str, package: bytes) -> bytes:
        """The instrumented variant of an application whose package is known.

        Raises the problems 409, when these texts give another one, and 500, when the compiler crashed.
        """
        order, _ = await asyncio.to_thread(self._order, application, (code_id, package), instrumented=True)
        try:
            outcome = await self._worker(order).ask(asdict(order))
        except WorkerCrashedError as error:
            raise _crashed(error) from error
        variant: bytes | None = outcome["variant"]
        if variant is None or outcome["code_id"] != code_id:
            raise Problem(
                409,
                "no-debug-code",
                f"The texts kept for '{application.name}' do not give the code that runs; download it again.",
            )
        return variant

    async def warm(self) -> None:
        """Starts the compiler processes before the first build asks for them."""
        await asyncio.gather(*(worker.warm() for worker in self._workers))

    def cancel(self, project_id: str, application_id: str) -> bool:
        """Ends the running build of an application; False when there is none."""
        running = self._running.get((project_id, application_id))
        return running is not None and running[1].cancel()

    async def close(self) -> None:
        """Ends the compiler processes."""
        for _, task in list(self._running.values()):
            task.cancel()
        await asyncio.gather(*(worker.close() for worker in self._workers))

    async def _wait(self, task: asyncio.Task[Built]) -> Built:
        try:
            return await asyncio.shield(task)
        except asyncio.CancelledError:
            if task.cancelled():
                raise Problem(409, "build-cancelled", "The build was cancelled.") from None
            raise
        except WorkerCrashedError as error:
            raise _crashed(error) from error

    def _finished(self, key: tuple[str, str], task: asyncio.Task[Built]) -> None:
        if self._running.get(key, (None, None))[1] is task:
            del self._running[key]
        if not task.cancelled() and task.exception() is not None:
            log.error("build of %s failed", key, exc_info=task.exception())

    def _order(
        self,
        application: Application,
        previous: tuple[str, bytes] | None,
        *,
        check_only: bool = False,
        instrumented: bool = False,
        fresh: bool = False,
    ) -> tuple[BuildOrder, str]:
        """The order, and a fingerprint of everything the outcome depends on.

        A check has caches of its own: other coding rules would make the next build one of everything. So has
        what is debugged: its texts are those that run, not those that are edited.
        """
        key = f"{application.project_id}/{application.application_id}"
        if check_only or instrumented:
            key += "/check" if check_only else "/debug"
        order = BuildOrder(
            key=key,
            application=application.name,
            project=application.project,
            sources=tuple(to_builtins(source) for source in application.sources),
            tasks=tuple(asdict(task) for task in application.tasks),
            libraries=application.libraries,
            previous=previous[1] if previous else None,
            cache=str(self._cache),
            static=application.static.model_dump(),
            heap=asdict(application.heap),
            reserve=asdict(application.reserve),
            disabled_warnings=tuple(sorted(application.disabled_warnings)),
            check_only=check_only,
            instrumented=instrumented,
            fresh=fresh,
        )
        return order, _fingerprint(order, previous[0] if previous else None)

    def _worker(self, order: BuildOrder) -> WorkerProcess:
        number = int(hashlib.sha256(order.key.encode()).hexdigest(), 16) % len(self._workers)
        return self._workers[number]

    async def _run(
        self, key: tuple[str, str], application: Application, order: BuildOrder, fingerprint: str
    ) -> Built:
        outcome = await self._worker(order).ask(asdict(order))
        built = Built(
            application,
            fingerprint,
            _report(application, outcome),
            outcome["package"],
            outcome["change_base"],
            tuple(outcome["change_reasons"]),
            convert(outcome["change_report"], ChangeReport),
        )
        self._cleaned.discard(key)
        self._built[key] = built
        self._built.move_to_end(key)
        while len(self._built) > KEPT_BUILDS:
            self._built.popitem(last=False)
        return built


def _crashed(error: WorkerCrashedError) -> Problem:
    return Problem(500, "compiler-crashed", f"The compiler failed: {error}.")


def _fingerprint(order: BuildOrder, previous_code: str | None) -> str:
    content = asdict(order) | {"previous": previous_code, "fresh": False}
    return hashlib.blake2b(msgpack.packb(content), digest_size=16).hexdigest()


def _report(application: Application, outcome: dict[str, Any]) -> BuildReport:
    by_uri: dict[str, Source] = {}
    for source in application.sources:
        if source.uri.upper() not in by_uri or source.scope is Scope.APPLICATION:
            by_uri[source.uri.upper()] = source
    return BuildReport(
        ok=outcome["package"] is not None,
        diagnostics=[_diagnostic(application, by_uri, item) for item in outcome["diagnostics"]],
        code_id=outcome["code_id"],
        data_id=outcome["data_id"],
        code_size=outcome["code_size"] if outcome["package"] is not None else None,
        data_size=outcome["data_size"] if outcome["package"] is not None else None,
        seconds=round(outcome["seconds"], 4),
    )


def _diagnostic(application: Application, by_uri: dict[str, Source], item: dict[str, Any]) -> Diagnostic:
    """The message with its place in the project; lines and columns then count from 1."""
    found = _placed(application, by_uri, item)
    found.keep_facts(item.get("facts", {}))
    return found


def _placed(application: Application, by_uri: dict[str, Source], item: dict[str, Any]) -> Diagnostic:
    source = by_uri.get(item["uri"].upper())
    fields: dict[str, Any] = {
        "code": item["code"],
        "severity": Severity(item["severity"]),
        "message": item["message"],
        "advice": item["advice"] or None,
    }
    if source is None or source.map is None:
        return Diagnostic(**fields, **_place_without_text(application, item))
    found = source.map.place(Span(item["line"], item["column"], item["end_line"], item["end_column"]))
    return Diagnostic(
        **fields,
        object_id=found.object_id,
        object_path=application.paths[found.object_id],
        part=Part(found.part),
        element=found.element,
        line=found.span.line + 1,
        column=found.span.column + 1,
        end_line=found.span.end_line + 1,
        end_column=found.span.end_column + 1,
    )


def _place_without_text(application: Application, item: dict[str, Any]) -> dict[str, Any]:
    """A task that the message names, a library manager, a library text, or the application as a whole."""
    path = item["uri"]
    object_id = next((id for id, known in application.paths.items() if path and known == path), None)
    if object_id is not None:
        item = item | {"uri": ""}  # lines are those of texts
    elif not path:
        object_id = next(
            (t.object_id for t in application.tasks if t.object_id and f"'{t.name}'" in item["message"]),
            application.application_id,
        )
        path = application.paths[object_id]
    line = item["line"] + 1 if item["uri"] else None
    column = item["column"] + 1 if item["uri"] else None
    return {
        "object_id": object_id or None,
        "object_path": path,
        "part": None,
        "line": line,
        "column": column,
        "end_line": item["end_line"] + 1 if item["uri"] else None,
        "end_column": item["end_column"] + 1 if item["uri"] else None,
    }
