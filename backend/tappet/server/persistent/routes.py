"""Acts on the list of persistent variables."""

from __future__ import annotations

from starlette.concurrency import run_in_threadpool

from tappet.project.kinds.persistent import PERSISTENT, PersistentData
from tappet.server.dependencies import CommissioningDep, Engineer, StoreDep
from tappet.server.objects.replies import object_detail
from tappet.server.objects.shapes import ObjectDetail
from tappet.server.persistent.service import missing_paths, with_paths
from tappet.server.problems import Problem
from tappet.server.routing import Router

router = Router(prefix="/projects/{project_id}/objects/{object_id}", tags=["objects"])


@router.post("/instance-paths")
async def add_instance_paths(
    who: Engineer, project_id: str, object_id: str, store: StoreDep, commissioning: CommissioningDep
) -> ObjectDetail:
    """Add the paths of all persistent variables that programs and function blocks declare to the list of
    persistent variables, behind those that are there (PERS-07).

    Builds the application; the problem `build-errors` (409) when that is not possible.
    """
    item = await run_in_threadpool(store.get, project_id, object_id)
    if not isinstance(item.data, PersistentData) or item.kind != PERSISTENT.name or item.parent_id is None:
        raise Problem(422, "no-persistent-list", f"'{item.name}' is no list of persistent variables.")
    built = await commissioning.build(project_id, item.parent_id)
    if built.package is None:
        name = built.application.name
        raise Problem(409, "build-errors", f"'{name}' has errors, so that its variables are not known.")
    paths = await run_in_threadpool(missing_paths, item.data.declaration, item.name, built.package)
    if not paths:
        return object_detail(item)
    data = item.data.model_copy(update={"declaration": with_paths(item.data.declaration, paths)})
    saved = await run_in_threadpool(
        store.save, project_id, object_id, item.revision, data.model_dump(mode="json"), who.username
    )
    return object_detail(saved)
