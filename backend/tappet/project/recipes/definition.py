"""The data of a recipe manager and of its recipe definitions."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, StrictBool, StringConstraints, model_validator

from tappet.project.data import CodeData, Data, Line
from tappet.project.naming import name_key

Column = Literal["variable", "type", "name", "minimum", "maximum", "comment", "value"]
SEPARATORS = (":=", ";", ",", "\t", " ", "|")
MOST_VARIABLES = 10_000
MOST_RECIPES = 200
"""The block in the controller has room for 256; the rest is for those that programs create."""
RecipeName = Annotated[
    str, StringConstraints(min_length=1, max_length=80, pattern=r"^[^\x00-\x1f/\\.][^\x00-\x1f/\\]*$")
]
"""Part of the name of a file, so it is no path."""


class RecipeVariable(Data):
    """A row of a recipe definition."""

    path: Annotated[Line, Field(max_length=255)] = Field(
        default="", description="Path of an elementary variable: `PLC_PRG.fbOven.rTemperature`."
    )
    name: Annotated[Line, Field(max_length=255)] = ""
    minimum: Annotated[Line, Field(max_length=255)] = Field(
        default="", description="Literal; a smaller value becomes this one when it is written. Empty: none."
    )
    maximum: Annotated[Line, Field(max_length=255)] = ""
    comment: Annotated[Line, Field(max_length=255)] = ""


class Recipe(Data):
    """A column of a recipe definition."""

    name: RecipeName
    values: dict[str, Annotated[Line, Field(max_length=255)]] = Field(
        default_factory=dict,
        description="IEC literals by the path of the variable; where there is none, the variable's own value "
        "counts when the application starts.",
    )


class RecipeDefinitionData(CodeData):
    """Variables, and recipes with a value for each."""

    variables: Annotated[list[RecipeVariable], Field(max_length=MOST_VARIABLES)] = Field(default_factory=list)
    recipes: Annotated[list[Recipe], Field(max_length=MOST_RECIPES)] = Field(default_factory=list)

    @model_validator(mode="after")
    def _names_are_unique(self) -> Self:
        for what, names in (
            ("variable", [variable.path for variable in self.variables]),
            ("recipe", [recipe.name for recipe in self.recipes]),
        ):
            seen: set[str] = set()
            for name in names:
                key = name_key(name)
                if key in seen:
                    raise ValueError(f"the {what} '{name}' is there twice; keep one of them")
                seen.add(key)
        return self


class RecipeManagerData(CodeData):
    """How recipes are kept in the controller."""

    storage: Literal["textual", "binary"] = Field(
        default="textual",
        description="Lines of text, or the bytes of the values, which fit the same variables only.",
    )
    path: Annotated[Line, Field(max_length=200, pattern=r"^[^\x00-\x1f\\:*?]*$")] = Field(
        default="", description="Folder below that of the files of the controller; empty: that one."
    )
    extension: Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_]{1,20}$")] = "txtrecipe"
    separator: Literal[":=", ";", ",", "\t", " ", "|"] = ":="
    columns: list[Column] = Field(
        default=["variable", "value"], description="What stands in a line of a file, left to right."
    )
    in_controller: StrictBool = Field(
        default=True, description="Programs can use the recipes by the blocks of the library."
    )
    save_changes: StrictBool = Field(
        default=True, description="A recipe that changes in the controller is saved in its file."
    )
    load_at_start: StrictBool = Field(
        default=True,
        description="When the application starts, files that are there count instead of the values of the "
        "project.",
    )
    exact_match: StrictBool = Field(
        default=False,
        description="A file is refused when its variables are not exactly those of the definition; otherwise "
        "those of the same path are taken.",
    )

    @model_validator(mode="after")
    def _path_stays_below(self) -> Self:
        if self.path.startswith("/") or ".." in self.path.split("/"):
            raise ValueError(f"the path '{self.path}' leads out of the folder of files; write one below it")
        return self

    @model_validator(mode="after")
    def _columns_suffice(self) -> Self:
        if len(set(self.columns)) != len(self.columns):
            raise ValueError("a column is there twice; keep one of them")
        for needed in ("variable", "value"):
            if needed not in self.columns:
                raise ValueError(f"the column '{needed}' is missing; without it no file can be read")
        return self

    @property
    def folder(self) -> str:
        """The path with a slash at its end, or nothing."""
        path = self.path.strip("/")
        return f"{path}/" if path else ""
