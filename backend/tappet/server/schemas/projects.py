"""Projects and their objects."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any

from pydantic import Field, StringConstraints

from tappet.server.schemas.base import Reply, Request

Name = Annotated[str, StringConstraints(min_length=1, max_length=255)]


class ProjectSummary(Reply):
    """A project in the list."""

    id: str
    name: str
    description: str
    created: datetime
    modified: datetime


class NewProject(Request):
    """A project to be made: empty, or with a soft PLC, an application and a first program."""

    name: Name
    description: str = ""
    template: str = Field(default="standard", description="`standard` or `empty`.")


class ProjectChange(Request):
    """What to change of a project; fields left out stay."""

    name: Name | None = None
    description: str | None = None


class ObjectSummary(Reply):
    """An object in the tree."""

    id: str
    parent_id: str | None
    kind: str
    subkind: str | None = Field(description="What the declaration says: `program`, `struct` ...")
    name: str
    index: int = Field(description="Order among the siblings, from 0.")
    revision: int
    badges: list[str]


class ObjectDetail(ObjectSummary):
    """An object with its data, whose shape depends on `kind` (see /placement and the data schemas)."""

    data: dict[str, Any]


class NewObject(Request):
    """An object to be made; what is left out comes from the template of its kind."""

    parent_id: str | None
    kind: str
    name: Name
    subkind: str | None = None
    data: dict[str, Any] | None = None


class ObjectSave(Request):
    """New data on top of the revision that was edited."""

    base_revision: int
    data: dict[str, Any]


class ObjectMove(Request):
    """A new name or place."""

    base_revision: int | None = None
    name: Name | None = None
    parent_id: str | None = None
    index: int | None = Field(default=None, ge=0)


class CopyTarget(Request):
    """Where a copy goes."""

    parent_id: str | None


class Revision(Reply):
    """One save."""

    revision: int
    at: datetime
    author: str
    comment: str
    object_id: str | None = None
    object_name: str | None = None
    change: str | None = Field(default=None, description="`created`, `updated`, `moved`, `deleted`.")


class RevertTarget(Request):
    """The revision to go back to, as a new revision."""

    revision: int
