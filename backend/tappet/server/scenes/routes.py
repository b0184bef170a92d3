"""3D scenes of a project, shown with the values of a runtime."""

from __future__ import annotations

from pydantic import Field
from starlette.concurrency import run_in_threadpool

from tappet.project.scene import Scene
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
from tappet.server.flight.shapes import Cycle
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.scenes.service import open_past_scene, open_scene, show_past_scene
from tappet.server.settings import LOCAL_RUNTIME
from tappet.server.shapes import Reply, Request

router = Router(prefix="/projects/{project_id}/objects/{object_id}/view", tags=["objects"])


class SceneOrder(Request):
    """How to show a scene."""

    runtime_id: str = Field(default=LOCAL_RUNTIME, description="Runtime whose values move the scene.")
    dark: bool = False
    cycle: Cycle | None = Field(
        default=None,
        description="A past cycle of the flight recorder to show, in a view of one's own; null: the present.",
    )


class PastCycleOrder(Request):
    """Where in the past a view is to stand."""

    cycle: Cycle


class SceneAddress(Reply):
    """Where a view is shown; put it into a frame of a logged-in page."""

    path: str


@router.post("")
async def open_view(
    project_id: str, object_id: str, body: SceneOrder, who: Viewer, store: StoreDep, services: ServicesDep
) -> SceneAddress:
    """Begin to show a scene, or join the view that shows it already."""
    item = await run_in_threadpool(store.get, project_id, object_id)
    if not isinstance(item.data, Scene):
        raise Problem(422, "no-scene", f"'{item.name}' is a {item.kind}; only a scene can be shown in 3D.")
    link = services.runtimes.get(body.runtime_id)
    if body.cycle is not None:
        view_id = await open_past_scene(services.views, item.data, link, body.cycle, dark=body.dark)
        return SceneAddress(path=f"/views/{view_id}/")
    view_id = await open_scene(services.views, item.data, link, services.samplers(link), dark=body.dark)
    return SceneAddress(path=f"/views/{view_id}/")


@router.put("/{view_id}/cycle", status_code=204)
async def show_past_cycle(
    project_id: str, object_id: str, view_id: str, body: PastCycleOrder, who: Viewer, services: ServicesDep
) -> None:
    """Move a view that was opened for a past cycle to another one."""
    await show_past_scene(services.views, view_id, body.cycle)
