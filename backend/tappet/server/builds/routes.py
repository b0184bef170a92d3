"""Building an application, login, download."""

from __future__ import annotations

from typing import Annotated

from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from tappet.runtime import boot
from tappet.server.audit import Act, Result
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.builds.commissioning import Commissioning
from tappet.server.builds.recording import recording
from tappet.server.builds.shapes import (
    BuildReport,
    DownloadOrder,
    DownloadReport,
    LoginReport,
    LoginTarget,
)
from tappet.server.dependencies import (
    CommissioningDep,
    Engineer,
    RuntimesDep,
    ServicesDep,
    StoreDep,
    Viewer,
)
from tappet.server.metrics.service import Metrics
from tappet.server.problems import Problem
from tappet.server.projects.routes import download as file_response
from tappet.server.routing import Router
from tappet.server.source.service import check_wanted, source_setting, store_source
from tappet.server.spoken import LanguageDep, in_language
from tappet.translation.language import Language

router = Router(prefix="/projects/{project_id}/applications/{application_id}", tags=["build"])
all_router = Router(prefix="/projects/{project_id}", tags=["build"])
"""What concerns all applications of a project."""


async def _build(
    commissioning: Commissioning,
    metrics: Metrics,
    project_id: str,
    application_id: str,
    *,
    fresh: bool = False,
) -> BuildReport:
    try:
        built = await commissioning.build(project_id, application_id, fresh=fresh)
    except Problem as problem:
        metrics.builds[problem.kind] += 1
        raise
    metrics.builds["ok" if built.report.ok else "errors"] += 1
    metrics.build_seconds += built.report.seconds
    return built.report


@router.post("/build")
async def build(
    project_id: str,
    application_id: str,
    who: Engineer,
    commissioning: CommissioningDep,
    services: ServicesDep,
    language: Language = "en",
) -> BuildReport:
    """Build the application as it is stored. Errors of the program are diagnostics, not problems."""
    report = await _build(commissioning, services.metrics, project_id, application_id)
    return report.in_language(language)


@router.post("/rebuild")
async def rebuild(
    project_id: str,
    application_id: str,
    who: Engineer,
    commissioning: CommissioningDep,
    services: ServicesDep,
    language: Language = "en",
) -> BuildReport:
    """Build the application without anything that earlier builds have left."""
    report = await _build(commissioning, services.metrics, project_id, application_id, fresh=True)
    return report.in_language(language)


@router.post("/clean", status_code=204)
async def clean(
    act: Annotated[ActRecord, audited("clean", Role.ENGINEER)],
    project_id: str,
    application_id: str,
    commissioning: CommissioningDep,
) -> None:
    """Forget what builds and downloads of the application have left; the next login asks for a download."""
    application = await commissioning.application(project_id, application_id)
    await act.begin_async(Act("clean", application.name, project_id=project_id))
    await commissioning.clean(project_id, application_id)


@all_router.post("/clean", status_code=204)
async def clean_all(
    act: Annotated[ActRecord, audited("clean", Role.ENGINEER)],
    project_id: str,
    commissioning: CommissioningDep,
    store: StoreDep,
) -> None:
    """Forget what builds and downloads of all applications of the project have left."""
    project = await run_in_threadpool(store.project, project_id)
    await act.begin_async(Act("clean", project.name, project_id=project_id))
    await commissioning.clean(project_id, None)


@router.get(
    "/boot-application",
    response_class=Response,
    responses={
        200: {"content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}}}
    },
)
async def read_boot_application(
    project_id: str, application_id: str, who: Engineer, commissioning: CommissioningDep
) -> Response:
    """The application as the file that a runtime starts with: it belongs into the data folder of the runtime,
    under this name. A program with errors is the problem `build-errors`.
    """
    _, package = await commissioning.boot_application(project_id, application_id)
    return file_response(package, boot.FILE, "application/octet-stream")


@router.delete("/build", status_code=204)
async def cancel_build(
    project_id: str, application_id: str, who: Engineer, commissioning: CommissioningDep
) -> None:
    """Cancel the running build; who waits for it gets the problem `build-cancelled`."""
    if not commissioning.builder.cancel(project_id, application_id):
        raise Problem(404, "not-found", "No build of this application is running.")


@router.post("/login")
async def log_in(
    project_id: str,
    application_id: str,
    body: LoginTarget,
    who: Viewer,
    commissioning: CommissioningDep,
    runtimes: RuntimesDep,
    language: LanguageDep,
) -> LoginReport:
    """Compare the application with the one in the runtime: shown at once, changed online, or downloaded."""
    link = runtimes.get(body.runtime_id)
    return in_language(await commissioning.compare(project_id, application_id, link, language), language)


@router.post("/logout", status_code=204)
async def log_out(project_id: str, application_id: str, who: Viewer, commissioning: CommissioningDep) -> None:
    """End the login. Nothing is kept per login; the browser closes its online channel."""
    await commissioning.application(project_id, application_id)


@router.post("/download")
async def download(
    act: Annotated[ActRecord, audited("download", Role.ENGINEER, quoted=True)],
    project_id: str,
    application_id: str,
    body: DownloadOrder,
    commissioning: CommissioningDep,
    runtimes: RuntimesDep,
    store: StoreDep,
    language: LanguageDep,
    services: ServicesDep,
) -> DownloadReport:
    """Build and load the application, by download (which stops) or online change (which does not)."""
    link = runtimes.get(body.runtime_id)
    begin = recording(act, project_id, link)
    project = await run_in_threadpool(store.load, project_id, with_files=True)
    with_source = (
        source_setting(project, application_id) == "download" if body.source is None else body.source
    )
    if with_source:
        check_wanted(project, application_id)
    built = await commissioning.download(project_id, application_id, link, body, begin, project)
    services.debug.restore(link)
    source, problem = None, None
    if with_source:
        await act.begin_async(
            Act("source-download", built.application.name, None, project.name, project_id, link.id)
        )
        try:
            source = await store_source(link, project, act.who.username, built.report.code_id or "")
        except Problem as refused:
            problem = refused.detail
            await run_in_threadpool(act.end, Result.FAILED, problem)
    info = link.info
    report = DownloadReport(
        application=built.application.name,
        code_id=built.report.code_id or "",
        data_id=built.report.data_id or "",
        state=info.state if info is not None else "unknown",
        source=source,
        source_problem=problem,
    )
    return in_language(report, language)
