"""Recipes of projects: read, written, compared, imported and exported."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

from fastapi import Query
from starlette.concurrency import run_in_threadpool
from starlette.responses import PlainTextResponse

from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import CommissioningDep, Engineer, LinkDep, StoreDep, Viewer
from tappet.server.objects.replies import object_detail
from tappet.server.objects.shapes import ObjectDetail
from tappet.server.problems import Problem
from tappet.server.recipes import service
from tappet.server.recipes.service import Definition
from tappet.server.recipes.shapes import (
    ComparedValue,
    DefinitionOrder,
    Name,
    RecipeComparison,
    RecipeOrder,
    RecipeText,
    RecipeValues,
    RecipeVariables,
    RecipeWritten,
)
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.values import service as values
from tappet.server.values.service import Written

router = Router(tags=["recipes"])


@router.post("/runtimes/{runtime_id}/recipes/read")
async def read_recipe(who: Engineer, body: RecipeOrder, link: LinkDep, store: StoreDep) -> ObjectDetail:
    """Take the present values of all variables of a definition, of one moment, into a recipe; it is made if
    it is not there."""
    definition = await run_in_threadpool(service.load, store, body.project_id, body.definition_id)
    found = await service.read(link, definition)
    return await run_in_threadpool(
        _save, store, body.project_id, definition, body.recipe, found, who.username, link.name
    )


@router.post("/runtimes/{runtime_id}/recipes/write")
async def write_recipe(
    act: Annotated[ActRecord, audited("recipe-written", Role.OPERATOR, quoted=True)],
    body: RecipeOrder,
    link: LinkDep,
    store: StoreDep,
    language: LanguageDep,
) -> RecipeWritten:
    """Write all values of a recipe at the beginning of one cycle, or none; a value beyond a limit becomes the
    limit."""
    definition = await run_in_threadpool(service.load, store, body.project_id, body.definition_id)
    recipe = definition.recipe(body.recipe)
    wanted, limited = service.within_limits(link, definition, recipe)

    async def begin(written: list[Written]) -> None:
        named = f"{definition.item.name}: {recipe.name}"
        rows = [Act("recipe-written", named, None, None, body.project_id, link.id)]
        rows += [Act("write", w.path, w.old_literal, w.new_literal or None, None, link.id) for w in written]
        await act.begin_async(*rows)

    await values.write(link, wanted, begin)
    found = await values.read(link, [value.expression for value in wanted])
    return in_language(RecipeWritten(values=found, limited=limited), language)


@router.post("/runtimes/{runtime_id}/recipes/compare")
async def compare_recipes(
    who: Viewer, body: DefinitionOrder, link: LinkDep, store: StoreDep, language: LanguageDep
) -> RecipeComparison:
    """The variables of a definition with their present values, and the recipes that have others."""
    definition = await run_in_threadpool(service.load, store, body.project_id, body.definition_id)
    found = await values.read(link, [variable.path for variable in definition.data.variables])
    symbols = link.loaded_symbols()
    rows = [
        ComparedValue(
            path=value.expression,
            type=value.type,
            present=value.literal,
            error=value.error,
            differing=[
                recipe.name
                for recipe in definition.data.recipes
                if (text := recipe.values.get(value.expression))
                and not service.same(symbols, value.expression, text, value.literal)
            ],
        )
        for value in found
    ]
    return in_language(RecipeComparison(values=rows), language)


@router.get(
    "/projects/{project_id}/recipes/{definition_id}/{recipe}/file",
    response_class=PlainTextResponse,
    responses={200: {"content": {"text/plain": {"schema": {"type": "string", "format": "binary"}}}}},
)
def export_recipe(
    who: Viewer, project_id: str, definition_id: str, recipe: Name, store: StoreDep
) -> PlainTextResponse:
    """A recipe as a file of text, in the columns of the recipe manager."""
    definition = service.load(store, project_id, definition_id)
    found = definition.recipe(recipe)
    name = quote(service.file_name(definition, found))
    return PlainTextResponse(
        service.to_file(definition, found),
        headers={"Content-Disposition": f"attachment; filename*=UTF-8''{name}"},
    )


@router.get("/projects/{project_id}/recipes/{definition_id}/variables")
async def list_recipe_variables(
    who: Viewer,
    project_id: str,
    definition_id: str,
    store: StoreDep,
    commissioning: CommissioningDep,
    query: Annotated[str, Query(max_length=200, description="Parts of the path, separated by blanks.")] = "",
    below: Annotated[
        str,
        Query(max_length=400, description="Members of this structure, array or instance only, all of them."),
    ] = "",
) -> RecipeVariables:
    """The elementary variables of the application, members of instances and elements of arrays among them.

    Builds the application; the problem `build-errors` (409) when that is not possible.
    """
    definition = await run_in_threadpool(service.load, store, project_id, definition_id)
    application_id = await run_in_threadpool(service.application_of, store, project_id, definition_id)
    built = await commissioning.build(project_id, application_id)
    if built.package is None:
        name = built.application.name
        raise Problem(409, "build-errors", f"'{name}' has errors, so that its variables are not known.")
    return await run_in_threadpool(service.variables, built.package, definition, query, below)


@router.post("/projects/{project_id}/recipes/{definition_id}/file")
def parse_recipe_file(
    who: Viewer, project_id: str, definition_id: str, body: RecipeText, store: StoreDep
) -> RecipeValues:
    """What a recipe file holds for a definition; nothing is changed."""
    found = service.from_file(service.load(store, project_id, definition_id), body.text)
    return RecipeValues(values=found.values, unknown=found.unknown, missing=found.missing)


@router.put("/projects/{project_id}/recipes/{definition_id}/{recipe}/file")
def import_recipe(
    who: Engineer, project_id: str, definition_id: str, recipe: Name, body: RecipeText, store: StoreDep
) -> ObjectDetail:
    """Take the values of a recipe file into a recipe; it is made if it is not there."""
    definition = service.load(store, project_id, definition_id)
    found = service.from_file(definition, body.text)
    return _save(store, project_id, definition, recipe, found.values, who.username, "")


def _save(
    store: StoreDep,
    project_id: str,
    definition: Definition,
    recipe: str,
    found: dict[str, str],
    username: str,
    comment: str,
) -> ObjectDetail:
    data = definition.with_values(recipe, found)
    item = definition.item
    saved = store.save(
        project_id, item.id, item.revision, data.model_dump(mode="json"), username, comment=comment
    )
    return object_detail(saved)
