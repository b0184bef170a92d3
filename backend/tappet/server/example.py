"""Example projects: brought into the store once, and run when the local runtime is empty."""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path

from starlette.concurrency import run_in_threadpool

from tappet.server.audit import Act, Result
from tappet.server.audited import ActRecord
from tappet.server.auth.identity import Identity
from tappet.server.auth.roles import Role
from tappet.server.builds.recording import recording
from tappet.server.builds.shapes import LoadOrder
from tappet.server.projects.examples import example_content, find_example
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.services import Services
from tappet.server.settings import LOCAL_RUNTIME

log = logging.getLogger(__name__)
PATIENCE_S = 120.0
"""How long the local runtime may take to come up; its first start compiles the executive."""
AUTHOR = "example"


async def load_example(services: Services, name: str) -> str:
    """Project of the example, brought into the store unless it is there already."""
    return await run_in_threadpool(_load_once, services, find_example(name))


async def run_example(services: Services, project_id: str) -> None:
    """Downloads an example and starts it if the local runtime is empty."""
    link = services.runtimes.find(LOCAL_RUNTIME)
    if link is None or not await _connected(link) or link.info is None or link.info.state != "empty":
        return
    project = await run_in_threadpool(services.store.load, project_id)
    for application in project.applications()[:1]:
        act = ActRecord(
            services.database, services.audit_reserve, Identity("", AUTHOR, Role.ADMIN, "console")
        )
        begin = recording(act, project_id, link)
        try:
            order = LoadOrder(runtime_id=link.id, mode="download")
            await services.commissioning.download(project_id, application.id, link, order, begin, project)
        except Exception as error:
            refused = Act("download", application.name, project_id=project_id, runtime_id=link.id)
            await run_in_threadpool(act.stop, error, refused)
            raise
        await run_in_threadpool(act.end, Result.OK)
        log.info("the example '%s' runs on the local runtime", project.name)


def _load_once(services: Services, path: Path) -> str:
    content = example_content(path)
    for info in services.store.projects():
        if info.name == content.name:
            return info.id
    info = services.store.create_project(
        content.name,
        AUTHOR,
        description=content.description,
        content=content,
        comment=f"Example from {path.name}",
    )
    return info.id


async def _connected(link: RuntimeLink) -> bool:
    """Waits for the runtime to be up."""
    changed = asyncio.Event()
    ignore = link.listen(lambda _: changed.set())
    try:
        async with asyncio.timeout(PATIENCE_S):
            while not link.connected:
                await changed.wait()
                changed.clear()
    except TimeoutError:
        return False
    finally:
        ignore()
    return True
