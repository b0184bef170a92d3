"""Objects of the project tree."""

from __future__ import annotations

from functools import reduce
from operator import or_
from typing import Any, Literal

from pydantic import BaseModel, Field, GetJsonSchemaHandler, TypeAdapter, create_model
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from tappet.project.data import UnknownData
from tappet.project.kind_registry import kinds
from tappet.server.projects.shapes import Name
from tappet.server.shapes import Number, Reply, Request


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
    """An object with its data, whose shape depends on `kind`."""

    data: dict[str, Any]

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """One of the shapes that the installed kinds give. They are documented and not checked: data that
        were stored by another version of a plug-in are answered as they are (CON-03)."""
        schema = handler(TypeAdapter(_any_detail()).core_schema)
        return {"title": cls.__name__, "description": cls.__doc__, **schema}


def _any_detail() -> Any:
    shapes: list[type[BaseModel]] = [
        create_model(
            f"{''.join(word.capitalize() for word in kind.name.split('_'))}Object",
            __base__=ObjectSummary,
            __doc__=kind.description,
            kind=(Literal[kind.name], ...),  # type: ignore[arg-type]
            data=(kind.data, ...),
        )
        for kind in kinds().values()
    ]
    return reduce(or_, [*shapes, UnknownObjectKind])


class UnknownObjectKind(ObjectSummary):
    """An object whose kind is not installed, or whose data do not fit it; kept unchanged (CON-03)."""

    data: UnknownData


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
    index: Number | None = Field(default=None, description="Place among the siblings; null is the end.")


class ObjectSave(Request):
    """New data on top of the revision that was edited."""

    base_revision: Number
    data: dict[str, Any]
    comment: str = Field(default="", max_length=2000)
    autosave: bool = Field(
        default=False,
        description="Saved by the editor, not the user: such revisions shortly after each other become one.",
    )


class ObjectContent(Request):
    """New data of one object on top of the revision that was edited."""

    object_id: str
    base_revision: Number
    data: dict[str, Any]


class ObjectsSave(Request):
    """New data of several objects, saved as one change of the project."""

    objects: list[ObjectContent] = Field(max_length=10_000)
    comment: str = Field(default="", max_length=2000)


class ObjectMove(Request):
    """A new name or place; what is left out stays. A new parent without index: the end of its children."""

    base_revision: Number | None = Field(
        default=None, description="Refuse if the content is newer than this."
    )
    name: Name | None = None
    parent_id: str | None = Field(default=None, description="Null: the root of the view (when sent at all).")
    excluded: bool | None = Field(default=None, description="From the build.")
    index: Number | None = None


class ObjectsToDelete(Request):
    """Objects that go as one change of the project."""

    object_ids: list[str] = Field(min_length=1, max_length=10_000)


class CopyTarget(Request):
    """Where a copy goes."""

    parent_id: str | None
    index: Number | None = Field(default=None, description="Place among the siblings; null is the end.")
    source_project_id: str | None = Field(
        default=None, description="The project that the object is in, when it is another one."
    )
