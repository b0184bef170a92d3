"""Recipe files in a controller: those that the recipe manager of the running application uses."""

from __future__ import annotations

from tappet.runtime.operations.files import DeleteFile, ListFiles, ReadFile, WriteFile
from tappet.runtime.operations.instants import instant_of
from tappet.server.recipes.service import Definition
from tappet.server.recipes.shapes import ControllerFile
from tappet.server.runtimes.links import RuntimeLink


def name_in_controller(definition: Definition, recipe: str) -> str:
    """What the file of a recipe is called there."""
    return recipe + _ending(definition)


async def listed(link: RuntimeLink, definition: Definition) -> list[ControllerFile]:
    """The recipe files of a definition, by name."""
    ending = _ending(definition)
    async with link.client() as client:
        found = await client.call(ListFiles(definition.manager.folder, ending))
    return [
        ControllerFile(
            recipe=file.name.removesuffix(ending),
            name=file.name,
            size=file.size,
            modified=instant_of(file.modified_ns),
        )
        for file in found
        if file.name != ending
    ]


async def read(link: RuntimeLink, definition: Definition, recipe: str) -> bytes:
    """The content of a recipe file."""
    async with link.client() as client:
        return await client.call(ReadFile(definition.manager.folder, name_in_controller(definition, recipe)))


async def write(link: RuntimeLink, definition: Definition, recipe: str, data: bytes) -> None:
    """Makes or replaces a recipe file."""
    name = name_in_controller(definition, recipe)
    async with link.client() as client:
        await client.call(WriteFile(definition.manager.folder, name, data))


async def delete(link: RuntimeLink, definition: Definition, recipe: str) -> None:
    """Takes a recipe file away."""
    async with link.client() as client:
        await client.call(DeleteFile(definition.manager.folder, name_in_controller(definition, recipe)))


def _ending(definition: Definition) -> str:
    return f".{definition.item.name}.{definition.manager.extension}"
