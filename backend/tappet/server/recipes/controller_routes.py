"""Recipe files in a controller: listed, read, written, deleted.

Paths are made of the names of recipe and definition and the settings of the recipe manager, so that these
routes reach recipe files only.
"""

from __future__ import annotations

from typing import Annotated, Any
from urllib.parse import quote

from fastapi import Depends, Query
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response

from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import LinkDep, StoreDep, Viewer
from tappet.server.recipes import files, service
from tappet.server.recipes.service import Definition
from tappet.server.recipes.shapes import ControllerFiles, FileContent, Name
from tappet.server.routing import Router

router = Router(prefix="/runtimes/{runtime_id}/recipes/files", tags=["recipes"])
_BINARY = {"schema": {"type": "string", "format": "binary"}}
BYTES: dict[int | str, dict[str, Any]] = {200: {"content": {"application/octet-stream": _BINARY}}}


async def _definition(
    store: StoreDep,
    project_id: Annotated[str, Query()],
    definition_id: Annotated[str, Query(description="Object of the kind `recipe_definition`.")],
) -> Definition:
    return await run_in_threadpool(service.load, store, project_id, definition_id)


DefinitionDep = Annotated[Definition, Depends(_definition)]


@router.get("")
async def list_recipe_files(who: Viewer, link: LinkDep, definition: DefinitionDep) -> ControllerFiles:
    """The recipe files of a definition that the controller has."""
    found = await files.listed(link, definition)
    return ControllerFiles(folder=definition.manager.folder, files=found)


@router.get("/{recipe}", response_class=Response, responses=BYTES)
async def read_recipe_file(who: Viewer, link: LinkDep, definition: DefinitionDep, recipe: Name) -> Response:
    """The content of a recipe file in the controller, as it is stored there."""
    name = quote(files.name_in_controller(definition, recipe))
    return Response(
        await files.read(link, definition, recipe),
        media_type="application/octet-stream",
        headers={"Content-Disposition": f"attachment; filename*=UTF-8''{name}"},
    )


@router.put("/{recipe}", status_code=204)
async def write_recipe_file(
    act: Annotated[ActRecord, audited("recipe-file-written", Role.OPERATOR, quoted=True)],
    body: FileContent,
    link: LinkDep,
    definition: DefinitionDep,
    recipe: Name,
) -> None:
    """Make or replace a recipe file in the controller; programs load it with their next command."""
    name = files.name_in_controller(definition, recipe)
    await act.begin_async(Act("recipe-file-written", name, runtime_id=link.id))
    await files.write(link, definition, recipe, body.data)


@router.delete("/{recipe}", status_code=204)
async def delete_recipe_file(
    act: Annotated[ActRecord, audited("recipe-file-deleted", Role.OPERATOR)],
    link: LinkDep,
    definition: DefinitionDep,
    recipe: Name,
) -> None:
    """Take a recipe file of the controller away."""
    name = files.name_in_controller(definition, recipe)
    await act.begin_async(Act("recipe-file-deleted", name, runtime_id=link.id))
    await files.delete(link, definition, recipe)
