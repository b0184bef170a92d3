"""Comparisons of projects."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import Field, StringConstraints

from tappet.project.compare.differences import State
from tappet.project.data import MAX_TEXT
from tappet.server.shapes import Number, Reply, Request

FieldName = Annotated[str, StringConstraints(min_length=1, max_length=200)]


class ComparedProject(Request):
    """A project of this server to compare with; the same one, at another revision, too."""

    kind: Literal["project"]
    project_id: str
    revision: Number | None = Field(default=None, description="As it was after this change; null: now.")


class ComparedRuntime(Request):
    """The source of the application that a runtime runs, as it was downloaded."""

    kind: Literal["runtime"]
    runtime_id: str


class NewComparison(Request):
    """What to compare the project with."""

    old: ComparedProject | ComparedRuntime = Field(discriminator="kind")
    revision: Number | None = Field(
        default=None,
        description="The project as it was after this change; null: as it is, which differences can be "
        "taken over into.",
    )


class ComparedObject(Reply):
    """An object on one side."""

    id: str
    name: str
    path: str
    revision: int


class DifferenceItem(Reply):
    """What is different in one object."""

    key: str
    state: State = Field(
        description="`added`: only in the project; `removed`: only in what it is compared with."
    )
    kind: str
    subkind: str | None
    old: ComparedObject | None
    new: ComparedObject | None
    fields: list[str] = Field(description="Of the data, that differ.")
    renamed: bool
    moved: bool = Field(description="It is below another object.")
    reordered: bool = Field(description="It is elsewhere among the same siblings.")


class ComparisonDetail(Reply):
    """A comparison. It is kept for some time; ask for it again for what differs by now."""

    id: str
    title: str = Field(description="What the project is compared with.")
    at: datetime | None = Field(description="Of what time that is, where it is known.")
    project_revision: int
    can_merge: bool = Field(description="The project is compared as it is, not an earlier revision of it.")
    differences: list[DifferenceItem]
    notes: list[str] = Field(description="What reading the files had to say.")


class DifferenceDetail(Reply):
    """Both sides of an object; null where it is not."""

    old: dict[str, Any] | None = Field(description="Data.")
    new: dict[str, Any] | None


class TakenDifference(Request):
    """What to take over of one difference."""

    key: str
    whole: bool = Field(default=True, description="Everything; otherwise what follows.")
    name: bool = False
    place: bool = False
    fields: list[FieldName] = Field(default=[], max_length=200)
    texts: dict[FieldName, Annotated[str, StringConstraints(max_length=MAX_TEXT)]] = Field(
        default={}, description="Texts of fields with some blocks taken over, as they shall be."
    )
    base_revision: Number | None = Field(
        default=None, description="Of the object when it was compared; refuse if it is another one by now."
    )


class MergeOrder(Request):
    """Differences to take over, as one change of the project."""

    take: list[TakenDifference] = Field(min_length=1, max_length=100_000)
    comment: str = Field(default="", max_length=2000)


class MergeOutcome(Reply):
    """The project after it."""

    project_revision: int
    touched: list[str] = Field(description="Ids of the objects that are other than before, or gone.")
