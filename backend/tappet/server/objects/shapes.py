"""Objects of the project tree."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from tappet.server.projects.shapes import Name
from tappet.server.shapes import Reply, Request


class ObjectSummary(Reply):
    """An object in the tree."""

    id: str
    parent_id: str | None
    kind: str
    subkind: str | None = Field(description="What the declaration says: `program`, `struct` ...")
    name: str
    index: int = Field(description="Order among the siblings, from 0.")
    revision: int
    excluded: bool = Field(description="From the build.")


class ObjectDetail(ObjectSummary):
    """An object with its data, whose shape depends on `kind` (see /placement and the data schemas)."""

    data: dict[str, Any]


class NewObject(Request):
    """An object to be made; what is left out comes from the template of its kind."""

    parent_id: str | None
    kind: str
    name: Name | None = Field(
        default=None, description="Null takes the name that the placement rule proposes."
    )
    subkind: str | None = Field(default=None, description="Which template, such as `function_block`.")
    language: str | None = Field(default=None, description="Language of the body, see /languages.")
    data: dict[str, Any] | None = None
    index: int | None = Field(default=None, ge=0, description="Place among the siblings; null is the end.")


class ObjectSave(Request):
    """New data on top of the revision that was edited."""

    base_revision: int
    data: dict[str, Any]
    comment: str = Field(default="", max_length=2000)
    autosave: bool = Field(
        default=False,
        description="Saved by the editor, not the user: such revisions shortly after each other become one.",
    )


class ObjectContent(Request):
    """New data of one object on top of the revision that was edited."""

    object_id: str
    base_revision: int
    data: dict[str, Any]


class ObjectsSave(Request):
    """New data of several objects, saved as one change of the project."""

    objects: list[ObjectContent] = Field(max_length=10_000)
    comment: str = Field(default="", max_length=2000)


class ObjectMove(Request):
    """A new name or place; what is left out stays. A new parent without index: the end of its children."""

    base_revision: int | None = Field(default=None, description="Refuse if the content is newer than this.")
    name: Name | None = None
    parent_id: str | None = Field(default=None, description="Null: the root of the view (when sent at all).")
    excluded: bool | None = Field(default=None, description="From the build.")
    index: int | None = Field(default=None, ge=0)


class CopyTarget(Request):
    """Where a copy goes."""

    parent_id: str | None
    index: int | None = Field(default=None, ge=0, description="Place among the siblings; null is the end.")
    source_project_id: str | None = Field(
        default=None, description="The project that the object is in, when it is another one."
    )
