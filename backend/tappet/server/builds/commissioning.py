"""Login and download: how the application of a project and the one in a runtime come together."""

from __future__ import annotations

import logging
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, replace
from typing import Literal

from msgspec import structs
from starlette.concurrency import run_in_threadpool

from tappet.project.kinds.application import ApplicationData
from tappet.project.model import Project, ProjectObject
from tappet.project.store import Store
from tappet.project.store.records import UnknownProjectError
from tappet.runtime.client import RuntimeRefused
from tappet.runtime.exception_report import summary
from tappet.runtime.operations.download import ReadImageMemory
from tappet.runtime.operations.life_cycle import Reset, Start
from tappet.server.builds.builder import Application, Builder, Built
from tappet.server.builds.packages import PackageStore, StoredPackage
from tappet.server.builds.remanent_changes import remanent_changes
from tappet.server.builds.shapes import (
    BuildReport,
    ChangedVariable,
    LoadOrder,
    LoginReport,
    Relation,
    ReserveUse,
)
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.translation.language import Language

log = logging.getLogger(__name__)
Step = Literal["reset_origin", "download", "online_change", "start"]
Begin = Callable[[Step, Built], Awaitable[None]]
"""Called with what is to be done next; when it raises, it is not done."""


@dataclass(slots=True)
class Commissioning:
    """Builds, compares and loads."""

    store: Store
    builder: Builder
    packages: PackageStore

    async def application(self, project_id: str, application_id: str) -> Application:
        """The application as it is stored now. Raises UnknownProjectError, UnknownObjectError."""

        def read() -> Application:
            return Application.of(project_id, self.store.load(project_id), application_id)

        return await run_in_threadpool(read)

    async def build(self, project_id: str, application_id: str, *, fresh: bool = False) -> Built:
        """Builds on top of what was downloaded last, so that data keep their places.

        With `fresh` nothing is used that earlier builds have left.
        """
        return await self._build(await self.application(project_id, application_id), fresh=fresh)

    async def build_of(self, project_id: str, project: Project, application_id: str) -> Built:
        """The same for a project that has been read. Raises UnknownObjectError."""
        return await self._build(await run_in_threadpool(Application.of, project_id, project, application_id))

    async def _build(self, application: Application, *, fresh: bool = False) -> Built:
        place = application.project_id, application.application_id
        last = await run_in_threadpool(self.packages.latest, *place)
        return await self.builder.build(application, _base(last), fresh=fresh)

    async def clean(self, project_id: str, application_id: str | None) -> list[str]:
        """Forgets builds and downloads of an application, of None those of all; answers their names.

        After that the application can only be brought into a runtime by a download.
        """

        def found() -> list[ProjectObject]:
            project = self.store.load(project_id)
            if application_id is None:
                return project.applications()
            return [item for item in project.applications() if item.id == application_id]

        applications = await run_in_threadpool(found)
        for item in applications:
            self.builder.clean(project_id, item.id)
            await run_in_threadpool(self.packages.remove, project_id, item.id)
        return [item.name for item in applications]

    async def boot_application(self, project_id: str, application_id: str) -> tuple[str, bytes]:
        """Name and package of an application, as the file that a runtime starts with. What is built from now
        on keeps the places of its data, as after a download. Raises the problem `build-errors`.
        """
        built = await self.build(project_id, application_id)
        package = _package(built, "made a boot application")
        code_id = built.report.code_id or ""
        await run_in_threadpool(self.packages.put, project_id, application_id, code_id, package)
        return built.application.name, package

    async def analyse(self, project_id: str, application_id: str) -> BuildReport:
        """Checks with all coding rules that the application has chosen; makes no code."""

        def read() -> Application:
            project = self.store.load(project_id)
            application = Application.of(project_id, project, application_id)
            data = project.get(application_id).data
            assert isinstance(data, ApplicationData)
            return replace(application, static=data.static_analysis)

        return await self.builder.check(await run_in_threadpool(read))

    async def compare(
        self,
        project_id: str,
        application_id: str,
        link: RuntimeLink,
        language: Language = "en",
        project: Project | None = None,
    ) -> LoginReport:
        """What login finds; builds when the loaded application is one of this project. Messages of the
        compiler are in the words of `language`. `project` is an earlier state of the project that is compared
        in its place."""
        application = await self.application(project_id, application_id)
        if project is not None:
            application = await run_in_threadpool(Application.of, project_id, project, application_id)
        if not link.connected:
            link.loaded_symbols()  # raises the problem that says since when
        info = link.info
        if info is None or info.code_id is None:
            return LoginReport(
                relation=Relation.EMPTY, reasons=[f"There is no application in '{link.name}'."]
            )
        loaded = await run_in_threadpool(self.packages.find, info.code_id)
        if loaded is None:
            if info.application != application.name:
                reason = f"'{link.name}' runs the application '{info.application}' of another project."
                return LoginReport(relation=Relation.FOREIGN, reasons=[reason])
            reason = (
                f"'{link.name}' runs a version of '{info.application}' that this server has not "
                "downloaded; it can only be replaced."
            )
            return LoginReport(relation=Relation.DOWNLOAD, reasons=[reason])
        if (loaded.project_id, loaded.application_id) != (project_id, application_id):
            reason = f"'{link.name}' runs another application, '{info.application}'."
            origin = await run_in_threadpool(self._project_name, loaded.project_id)
            return LoginReport(relation=Relation.FOREIGN, reasons=[reason], loaded_project=origin)
        built = await self.builder.build(application, _base(loaded))
        if not built.report.ok:
            reason = "The project has errors; the running application is older than it."
            return LoginReport(relation=Relation.DOWNLOAD, reasons=[reason, *_first_errors(built, language)])
        if built.report.code_id == info.code_id:
            return LoginReport(relation=Relation.SAME, reasons=[])
        package = _package(built, "compared")
        remanent = await run_in_threadpool(remanent_changes, loaded.data, package)
        if built.change_base == info.code_id:
            reasons = list(built.change_reasons) or ["Only code has changed; all data stay in place."]
            reserve = await _reserve_use(link, built)
            if reserve is not None and reserve.needed > reserve.reserved:
                reason = (
                    f"The online change needs {reserve.needed} bytes of the memory reserved for online "
                    f"changes, which has {reserve.reserved}; download. The properties of the application set "
                    "how much a download reserves."
                )
                return LoginReport(
                    relation=Relation.DOWNLOAD,
                    reasons=[reason],
                    reserve=reserve,
                    persistent=remanent.persistent,
                    retain_layout_changes=remanent.layout,
                )
            return LoginReport(
                reserve=reserve,
                relation=Relation.ONLINE_CHANGE,
                reasons=reasons,
                changes=[ChangedVariable(**structs.asdict(row)) for row in built.changes.rows],
                changes_omitted=built.changes.omitted,
                persistent=remanent.persistent,
                retain_layout_changes=remanent.layout,
            )
        reasons = list(built.change_reasons) or ["The running application is another one."]
        return LoginReport(
            relation=Relation.DOWNLOAD,
            reasons=reasons,
            persistent=remanent.persistent,
            retain_layout_changes=remanent.layout,
        )

    def _project_name(self, project_id: str) -> str | None:
        """None for a project that has been deleted since."""
        try:
            return self.store.project(project_id).name
        except UnknownProjectError:
            return None

    async def download(
        self,
        project_id: str,
        application_id: str,
        link: RuntimeLink,
        order: LoadOrder,
        begin: Begin,
        project: Project,
    ) -> Built:
        """Builds and loads; `begin` is called right before what changes the runtime. `project` is what is
        built, with its further files.

        Raises problems: 422 errors in the project, 409 no such online change, or loaded but not started.
        """
        application = await run_in_threadpool(Application.of, project_id, project, application_id)
        loaded: StoredPackage | None = None
        if link.info is not None and link.info.code_id is not None:
            loaded = await run_in_threadpool(self.packages.find, link.info.code_id)
            if loaded and (loaded.project_id, loaded.application_id) != (project_id, application_id):
                loaded = None
        if order.mode == "online_change" and loaded is None:
            raise Problem(
                409,
                "no-online-change",
                f"'{link.name}' does not run a version of '{application.name}' that can be changed over "
                "from; download instead.",
            )
        built = await self.builder.build(application, _base(loaded))
        package = _package(built, "downloaded")
        assert built.report.code_id is not None
        code_id = built.report.code_id
        # Kept first: without it the next login would take the application for a stranger's.
        await run_in_threadpool(self.packages.put, project_id, application_id, code_id, package)
        async with link.client() as client:
            if order.initialise_persistent and order.mode == "download" and loaded is not None:
                await begin("reset_origin", built)
                await client.call(Reset("origin"))
            await begin(order.mode, built)
            await client.download(package, order.mode)
        try:  # what is loaded runs without it, too
            await run_in_threadpool(self.packages.put_source, project_id, application_id, code_id, project)
        except OSError:
            log.exception("the source of '%s' was not kept, so nothing can be compared with it", link.name)
        if order.start and order.mode == "download":
            await begin("start", built)
            await _start(link, built)
        await link.refresh()
        return built


async def _start(link: RuntimeLink, built: Built) -> None:
    async with link.client() as client:
        try:
            await client.call(Start())
        except RuntimeRefused as refusal:
            await link.refresh()
            why = summary(link.exception) if link.exception is not None else str(refusal)
            raise Problem(
                409,
                "start-failed",
                f"'{built.application.name}' was downloaded to '{link.name}', but does not start: {why}.",
                exception=link.state().exception,
            ) from refusal


async def _reserve_use(link: RuntimeLink, built: Built) -> ReserveUse | None:
    """How full the reserve is, and will be; None where nobody knows."""
    try:
        async with link.client() as client:
            memory = await client.call(ReadImageMemory())
    except RuntimeRefused:  # one of an older version
        return None
    if memory is None or built.report.data_size is None:
        return None
    return ReserveUse(
        used=max(0, memory.size - memory.downloaded),
        needed=max(0, built.report.data_size - memory.downloaded),
        reserved=memory.capacity - memory.downloaded,
    )


def _package(built: Built, purpose: str) -> bytes:
    """Raises the problem `build-errors`."""
    if built.package is None:
        raise Problem(
            422,
            "build-errors",
            f"'{built.application.name}' has errors and cannot be {purpose}.",
            diagnostics=[d for d in built.report.diagnostics if d.severity == "error"],
        )
    return built.package


def _base(stored: StoredPackage | None) -> tuple[str, bytes] | None:
    return (stored.code_id, stored.data) if stored is not None else None


def _first_errors(built: Built, language: Language) -> list[str]:
    errors = [d.in_language(language) for d in built.report.diagnostics if d.severity == "error"]
    return [f"{d.object_path}: {d.code}: {d.message}" for d in errors[:3]]
