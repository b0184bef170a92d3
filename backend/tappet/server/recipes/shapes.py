"""Recipes over REST."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, ClassVar, Self

from pydantic import Base64Bytes, Field, StringConstraints, model_validator

from tappet.runtime.file_access import LARGEST
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
    wholes: list[RecipeVariableType] = Field(
        description="Structures, arrays and instances that fit: all members are added in one step (`below`)."
    )
    more: bool = Field(description="There are more that fit; ask for less.")
    types: dict[str, str] = Field(description="The types of the variables that the definition has, by path.")


class ControllerFile(Reply):
    """A recipe file in the controller."""

    recipe: str
    name: str = Field(description="Of the file.")
    size: int = Field(description="Bytes.")
    modified: datetime


class ControllerFiles(Reply):
    """The recipe files of a definition in the controller, by name."""

    folder: str = Field(description="Below the folder of files of the application.")
    files: list[ControllerFile]


class FileContent(Request):
    """What a recipe file is to hold."""

    text: Annotated[str, StringConstraints(max_length=4_000_000)] | None = None
    base64: Annotated[Base64Bytes, Field(max_length=LARGEST)] | None = Field(
        default=None, description="Of a binary file, instead of the text."
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.text is None) == (self.base64 is None):
            raise ValueError("a file has a text or base64, one of them")
        return self

    @property
    def data(self) -> bytes:
        """The bytes of the file."""
        return self.base64 if self.base64 is not None else (self.text or "").encode()


class RecipeText(Request):
    """A recipe file."""

    text: Annotated[str, StringConstraints(max_length=4_000_000)]


class RecipeValues(Reply):
    """What a recipe file holds for a definition."""

    values: dict[str, str] = Field(description="Literals by the paths of the definition.")
    unknown: list[str] = Field(description="Paths that the definition does not have.")
    missing: list[str] = Field(description="Variables of the definition that the file does not have.")
