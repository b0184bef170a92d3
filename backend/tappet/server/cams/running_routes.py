"""Cams of an application that runs: read back into the editor, and written (CAM-94)."""

from __future__ import annotations

from typing import Annotated

from starlette.concurrency import run_in_threadpool

from tappet.project.cams import running
from tappet.project.cams.running import RunningCamError
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.cams.running import CamOfApplication
from tappet.server.cams.shapes import CamName, RunningCamAnswer, RunningCamOrder
from tappet.server.dependencies import LinkDep, Viewer
from tappet.server.problems import Problem
from tappet.server.routing import Router

router = Router(prefix="/runtimes/{runtime_id}/cams", tags=["cams"])


@router.post("/{name}/read")
async def read_running_cam(
    name: CamName, body: RunningCamOrder, who: Viewer, link: LinkDep
) -> RunningCamAnswer:
    """The cam that the application runs, in the shape of the editor's; nothing is stored.

    What the editor cannot show is the problem `running-cam`, with the number of the element.
    """
    found = (await CamOfApplication.read(link, name)).variables()
    try:
        cam = await run_in_threadpool(running.read_back, name, found, body.cam)
    except RunningCamError as error:
        raise _problem(error) from error
    return RunningCamAnswer(cam=cam, same=cam is body.cam)


@router.post("/{name}/write", status_code=204)
async def write_running_cam(
    name: CamName,
    body: RunningCamOrder,
    act: Annotated[ActRecord, audited("write", Role.OPERATOR, quoted=True)],
    link: LinkDep,
) -> None:
    """Give the application another cam, at the beginning of a cycle; its axes follow that one at once.

    There is room for as many elements and tappets as were compiled; a cam with more is the problem
    `running-cam`.
    """
    application = await CamOfApplication.read(link, name)
    found = application.variables()
    try:
        values = await run_in_threadpool(running.to_write, name, found, body.cam)
    except RunningCamError as error:
        raise _problem(error) from error

    async def begin() -> None:
        old = f"{found.cam['nElements']} elements, {found.cam['nTappets']} tappets"
        new = f"{values.cam['nElements']} elements, {values.cam['nTappets']} tappets"
        await act.begin_async(Act("write", name, old, new, None, link.id))

    await application.write(values, begin)


def _problem(error: RunningCamError) -> Problem:
    return Problem(422, "running-cam", f"{error}.")
