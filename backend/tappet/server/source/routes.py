"""Source download and source upload."""

from __future__ import annotations

from typing import Annotated

from starlette.concurrency import run_in_threadpool

from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import CommissioningDep, LinkDep, RuntimesDep, StoreDep
from tappet.server.projects.replies import project_summary
from tappet.server.projects.shapes import ProjectSummary
from tappet.server.routing import Router
from tappet.server.source.service import check_wanted, fetch_source, project_of, store_source
from tappet.server.source.shapes import SourceOrder, SourceTarget, StoredSource

router = Router(tags=["runtimes"])


@router.post("/projects/{project_id}/applications/{application_id}/source-download")
async def download_source(
    act: Annotated[ActRecord, audited("source-download", Role.ENGINEER, quoted=True)],
    project_id: str,
    application_id: str,
    body: SourceTarget,
    store: StoreDep,
    runtimes: RuntimesDep,
    commissioning: CommissioningDep,
) -> StoredSource:
    """Keep the source of the project as it is now in the controller, in place of the one that is there."""
    link = runtimes.get(body.runtime_id)
    project = await run_in_threadpool(store.load, project_id, with_files=True)
    check_wanted(project, application_id)
    built = await commissioning.build_of(project_id, project, application_id)
    await act.begin_async(
        Act("source-download", built.application.name, None, project.name, project_id, link.id)
    )
    return await store_source(link, project, act.who.username, built.report.code_id or "")


@router.post("/runtimes/{runtime_id}/source-upload", status_code=201)
async def upload_source(
    act: Annotated[ActRecord, audited("source-upload", Role.ENGINEER, quoted=True)],
    body: SourceOrder,
    link: LinkDep,
    store: StoreDep,
) -> ProjectSummary:
    """Make a project of the source in the controller. A name that is taken is counted on."""
    await act.begin_async(Act("source-upload", body.name or "", runtime_id=link.id))
    info, archive = await fetch_source(link)
    content = await run_in_threadpool(project_of, link, archive)
    made = await run_in_threadpool(
        lambda: store.create_project(
            body.name or content.name,
            act.who.username,
            description=content.description,
            content=content,
            comment=f"{link.name}: {info.project}"[:200],
            free_name=True,
        )
    )
    act.resulted(subject=made.name, project_id=made.id)
    return project_summary(made)
