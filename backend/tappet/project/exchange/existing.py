"""What an import does with an object whose name exists already: what is possible, what was decided."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from tappet.project.data import MAX_TEXT
from tappet.project.naming import MAX_NAME

ExistingAct = Literal["overwrite", "rename", "merge", "skip"]


class Decision(BaseModel):
    """What to do with one object of an import."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    act: ExistingAct = Field(
        description="overwrite: the object of the project gets the content of the file, its history goes on; "
        "rename: it comes in beside it under another name; merge: the changes of both sides are joined; "
        "skip: it stays out."
    )
    name: Annotated[str, Field(min_length=1, max_length=MAX_NAME)] | None = Field(
        default=None, description="With rename: the name; null: a counted one."
    )
    texts: dict[str, Annotated[str, Field(max_length=MAX_TEXT)]] = Field(
        default={}, description="With merge: what the user has made of texts of both, by field of the data."
    )


class Decisions(BaseModel):
    """What to do with the objects of an import whose names exist already."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    all: ExistingAct = Field(
        default="rename", description="What is done with all that nothing else is said of."
    )
    objects: dict[str, Decision] = Field(
        default={},
        description="By key of the object in the preview; those below it follow unless they are named.",
    )


class Existing(BaseModel):
    """The object of the project that has the name of an imported one."""

    model_config = ConfigDict(frozen=True)

    object_id: str
    path: str
    acts: tuple[ExistingAct, ...] = Field(
        description="What is possible: objects of different kinds are never joined or overwritten."
    )
    same: bool = Field(description="Both are equal, with all that is below them.")
    proposal: str = Field(description="A free name.")


class ComparedText(BaseModel):
    """A text of an object in the project and in the file."""

    model_config = ConfigDict(frozen=True)

    field: str
    ours: str
    theirs: str
    merged: str = Field(description="With the changes of both; where they conflict, with those of the file.")
    conflicts: tuple[int, ...] = Field(description="Lines of `merged` where both differ, from 1.")


class Comparison(BaseModel):
    """An object in the project beside the one of the file."""

    model_config = ConfigDict(frozen=True)

    ancestor: bool = Field(description="The project knows what both were made from.")
    texts: tuple[ComparedText, ...]
    fields: tuple[str, ...] = Field(description="Fields that are no texts and conflict.")


Histories = Mapping[str, Sequence[Mapping[str, Any]]]
"""States of objects by id, newest first."""
