"""A recipe definition: variables, and recipes with values for them."""

from __future__ import annotations

from tappet.project.naming import name_key
from tappet.project.object_kind import Compiled, JsonFile, Naming, ObjectKind, Placement, Renaming
from tappet.project.recipes.definition import RecipeDefinitionData

_WITH_VARIABLES = ("pou", "gvl", "persistent", "axis", "cam")


def _renamed(data: RecipeDefinitionData, renaming: Renaming) -> RecipeDefinitionData:
    """Paths begin with the new name of what has the variables."""
    if renaming.kind not in _WITH_VARIABLES:
        return data

    def path_of(path: str) -> str:
        first, dot, rest = path.partition(".")
        return f"{renaming.new}{dot}{rest}" if name_key(first) == name_key(renaming.old) else path

    variables = [row.model_copy(update={"path": path_of(row.path)}) for row in data.variables]
    if variables == data.variables:
        return data
    recipes = [
        recipe.model_copy(update={"values": {path_of(path): text for path, text in recipe.values.items()}})
        for recipe in data.recipes
    ]
    return data.model_copy(update={"variables": variables, "recipes": recipes})


RECIPE_DEFINITION = ObjectKind(
    name="recipe_definition",
    words="recipe definition",
    description="Variables of an application, and recipes with values for them.",
    data=RecipeDefinitionData,
    placement=Placement(parents=("recipe_manager",), in_folders=False),
    naming=Naming(proposal="Recipes"),
    order=162,
    compiled=Compiled(in_parent=True),
    follow=_renamed,
    folder=JsonFile(flat=True),
    reported=True,
)
