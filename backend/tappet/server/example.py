"""Example projects: brought into the store once, and run when the local runtime is empty."""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path

from starlette.concurrency import run_in_threadpool

import tappet
from tappet.project import folder
from tappet.project.edit import change_data
from tappet.project.errors import ProjectError
from tappet.project.kinds.device import DEVICE, DeviceData
from tappet.project.model import Project
from tappet.server.audit import Act, Result
from tappet.server.audited import ActRecord
from tappet.server.auth.identity import Identity
from tappet.server.auth.roles import Role
from tappet.server.builds.recording import recording
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.services import Services
from tappet.server.settings import LOCAL_RUNTIME

log = logging.getLogger(__name__)
PATIENCE_S = 120.0
"""How long the local runtime may take to come up; its first start compiles the executive."""
AUTHOR = "example"


class UnknownExampleError(ProjectError):
    """No example of this name is installed."""

    code = "unknown_example"


def example_folders() -> dict[str, Path]:
    """The examples in the package or in the checkout, by name."""
    package = Path(tappet.__file__).resolve().parent
    roots = (package / "projects", package.parents[1] / "projects")
    return {
        path.parent.name: path.parent
        for root in reversed(roots)
        for path in sorted(root.glob("*/tappet-project.json"))
    }


def find_example(name: str) -> Path:
    """The folder of an example. Raises UnknownExampleError naming those there are."""
    found = example_folders()
    if name not in found:
        known = ", ".join(sorted(found)) or "none"
        raise UnknownExampleError(f"there is no example '{name}'; installed: {known}")
    return found[name]


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
            await services.commissioning.download(
                project_id, application.id, link, "download", start=True, begin=begin, project=project
            )
        except Exception as error:
            refused = Act("download", application.name, project_id=project_id, runtime_id=link.id)
            await run_in_threadpool(act.stop, error, refused)
            raise
        await run_in_threadpool(act.end, Result.OK)
        log.info("the example '%s' runs on the local runtime", project.name)


def _load_once(services: Services, path: Path) -> str:
    content = folder.load(path, with_extra_files=True)
    for info in services.store.projects():
        if info.name == content.name:
            return info.id
    info = services.store.create_project(
        content.name,
        AUTHOR,
        description=content.description,
        content=_on_local_runtime(content),
        comment=f"Example from {path.name}",
    )
    return info.id


def _on_local_runtime(project: Project) -> Project:
    """Devices that lead nowhere lead to the local runtime."""
    for item in project.find_kind(DEVICE.name):
        if isinstance(item.data, DeviceData) and item.data.runtime_id is None:
            data = item.data.model_copy(update={"runtime_id": LOCAL_RUNTIME})
            project = change_data(project, item.id, data)
    return project


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
