"""Projects and their revisions."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from tappet.server.shapes import Number, Reply, Request

Name = Annotated[str, StringConstraints(min_length=1, max_length=255)]


class ProjectSummary(Reply):
    """A project in the list."""

    id: str
    name: str
    description: str
    revision: int = Field(description="Number of the last change; grows by one with each.")
    created: datetime
    created_by: str
    modified: datetime
    modified_by: str


class NewProject(Request):
    """A project to be made: empty, with a soft PLC, an application and a first program, or with an axis that
    moves, too."""

    name: Name
    description: str = ""
    template: Literal["standard", "motion", "empty"] = "standard"
    example: str | None = Field(
        default=None, description="Name of an example to begin with, instead of a template."
    )


class Example(Reply):
    """A project to begin with."""

    name: str
    title: str
    description: str


class ProjectChange(Request):
    """What to change of a project; fields left out stay."""

    name: Name | None = None
    description: str | None = None


class Revision(Reply):
    """One change: of a project, or a state of an object."""

    revision: int
    at: datetime
    author: str
    comment: str
    autosave: bool
    action: str = Field(
        description="`create`, `import`, `save`, `add`, `copy`, `rename`, `move`, `delete`, `revert` ..."
    )
    project_revision: int = Field(description="The change of the project that this was, or was part of.")
    object_id: str | None = Field(default=None, description="Null when a change touched several objects.")
    object_name: str | None = None
    object_count: int = Field(default=1, description="How many objects the change touched.")
    change: str | None = Field(default=None, description="`created`, `updated`, `moved`, `deleted`.")


class RevertTarget(Request):
    """The revision to go back to, as a new revision."""

    revision: Number
    comment: str = Field(default="", max_length=2000)


class BodyLanguage(Reply):
    """A language that bodies can be in."""

    name: str = Field(description="As the data of objects name it: `ST`.")
    title: str = Field(description="In full, in English.")
    text: bool = Field(description="Bodies can be text.")
    drawn: bool = Field(description="Bodies can be elements, stored as JSON.")
    compiled: bool = Field(description="Bodies are compiled; otherwise those of other tools are kept.")
    offered: bool = Field(description="New objects can be written in it.")
