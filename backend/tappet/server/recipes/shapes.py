"""Recipes over REST."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field, StringConstraints

from tappet.server.shapes import Reply, Request
from tappet.server.values.shapes import Value

Name = Annotated[str, StringConstraints(min_length=1, max_length=80)]


class DefinitionOrder(Request):
    """A recipe definition of a project."""

    project_id: str
    definition_id: str = Field(description="Object of the kind `recipe_definition`.")


class RecipeOrder(DefinitionOrder):
    """A recipe of a definition."""

    recipe: Name


class RecipeWritten(Reply):
    """What the variables hold after a recipe was written."""

    values: list[Value]
    limited: list[str] = Field(description="Paths whose values were beyond their limits, and set to them.")


class ComparedValue(Reply):
    """A variable of a definition beside its value in the controller."""

    SENTENCES: ClassVar = ("error",)

    path: str
    type: str | None = None
    present: str | None = Field(description="As IEC literal.")
    error: str | None = None
    differing: list[str] = Field(description="The recipes that have another value.")


class RecipeComparison(Reply):
    """A definition beside the controller; all values are of one moment."""

    values: list[ComparedValue]


class RecipeVariableType(Reply):
    """A variable that a recipe can have."""

    path: str
    type: str


class RecipeVariables(Reply):
    """Variables that a recipe definition can have."""

    found: list[RecipeVariableType]
    more: bool = Field(description="There are more that fit; ask for less.")
    types: dict[str, str] = Field(description="The types of the variables that the definition has, by path.")


class RecipeText(Request):
    """A recipe file."""

    text: Annotated[str, StringConstraints(max_length=4_000_000)]


class RecipeValues(Reply):
    """What a recipe file holds for a definition."""

    values: dict[str, str] = Field(description="Literals by the paths of the definition.")
    unknown: list[str] = Field(description="Paths that the definition does not have.")
    missing: list[str] = Field(description="Variables of the definition that the file does not have.")
