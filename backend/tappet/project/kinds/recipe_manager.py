"""The recipe manager of an application: how its recipes are kept in the controller."""

from __future__ import annotations

from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import Compiled, Merging, Naming, ObjectKind, Placement
from tappet.project.recipes.code import LIBRARY, write_definitions
from tappet.project.recipes.definition import RecipeDefinitionData, RecipeManagerData
from tappet.project.source_text import SourceWriter


def _source(project: Project, manager: ProjectObject, writer: SourceWriter) -> None:
    definitions = [
        item
        for item in project.children(manager.id)
        if isinstance(item.data, RecipeDefinitionData) and not item.excluded
    ]
    if definitions:
        write_definitions(manager.data_as(RecipeManagerData), definitions, writer)


RECIPE_MANAGER = ObjectKind(
    name="recipe_manager",
    words="recipe manager",
    description="How recipes of an application are kept in the controller.",
    data=RecipeManagerData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="free", proposal="Recipe Manager", unique="place"),
    order=160,
    compiled=Compiled(
        source=_source,
        libraries=lambda data, path: [LibraryReference(name=LIBRARY, place=path)],
    ),
    merging=Merging(),
)
