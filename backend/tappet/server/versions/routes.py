"""Versions of an application in a runtime, and back to an earlier one."""

from __future__ import annotations

from typing import Annotated

from fastapi import Path, Query
from starlette.concurrency import run_in_threadpool

from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.builds.recording import recording
from tappet.server.builds.shapes import DownloadReport, LoadOrder, LoginReport, LoginTarget
from tappet.server.dependencies import CommissioningDep, RuntimesDep, ServicesDep, Viewer
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.versions.service import source_of, versions
from tappet.server.versions.shapes import Version

router = Router(prefix="/projects/{project_id}/applications/{application_id}/versions", tags=["build"])
CodeId = Annotated[str, Path(pattern=r"^[0-9A-Za-z_-]{1,128}$")]


@router.get("")
async def read_versions(
    project_id: str,
    application_id: str,
    runtime_id: Annotated[str, Query(description="The runtime they were brought into.")],
    who: Viewer,
    commissioning: CommissioningDep,
    runtimes: RuntimesDep,
    services: ServicesDep,
) -> list[Version]:
    """What was brought into a runtime, by whom and when; the newest first."""
    link = runtimes.get(runtime_id)
    application = await commissioning.application(project_id, application_id)
    runs = link.info.code_id if link.info is not None else None

    def read() -> list[Version]:
        return services.database.read(
            lambda db: versions(db, commissioning.packages, project_id, application.name, runtime_id, runs)
        )

    return await run_in_threadpool(read)


@router.post("/{code_id}/compare")
async def compare_version(
    project_id: str,
    application_id: str,
    code_id: CodeId,
    body: LoginTarget,
    who: Viewer,
    commissioning: CommissioningDep,
    runtimes: RuntimesDep,
    language: LanguageDep,
) -> LoginReport:
    """What it costs to bring that version back: whether it goes online, and what happens to variables; which
    persistent ones a download cannot keep."""
    link = runtimes.get(body.runtime_id)
    project = await run_in_threadpool(source_of, commissioning.packages, code_id)
    report = await commissioning.compare(project_id, application_id, link, language, project)
    return in_language(report, language)


@router.post("/{code_id}/restore")
async def restore_version(
    act: Annotated[ActRecord, audited("restore", Role.ENGINEER, quoted=True)],
    project_id: str,
    application_id: str,
    code_id: CodeId,
    body: LoadOrder,
    commissioning: CommissioningDep,
    runtimes: RuntimesDep,
    language: LanguageDep,
    services: ServicesDep,
) -> DownloadReport:
    """Bring a version back into the runtime. The project stays as it is."""
    link = runtimes.get(body.runtime_id)
    begin = recording(act, project_id, link)
    project = await run_in_threadpool(source_of, commissioning.packages, code_id)
    built = await commissioning.download(project_id, application_id, link, body, begin, project)
    services.debug.restore(link)
    info = link.info
    report = DownloadReport(
        application=built.application.name,
        code_id=built.report.code_id or "",
        data_id=built.report.data_id or "",
        state=info.state if info is not None else "unknown",
    )
    return in_language(report, language)
