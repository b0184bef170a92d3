"""Messages of the WebSocket `/api/v1/events`: who changes what in a project."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from tappet.server.objects.shapes import ObjectSummary
from tappet.server.shapes import Reply, Request


class OpenObject(Request):
    """Shows the other users which object this one has open; null for none. The first asks who is there."""

    op: Literal["open"]
    object_id: Annotated[str, StringConstraints(max_length=64)] | None


class ObjectChanged(Reply):
    """An object was created, changed, moved or deleted."""

    op: Literal["object"] = "object"
    change: Literal["created", "updated", "deleted", "moved"]
    object: ObjectSummary
    author: str


class PresentUser(Reply):
    """Somebody who has the project open, in one page or program."""

    id: int
    """Of the connection."""
    username: str
    object_id: str | None


class Presence(Reply):
    """All who have the project open, once to a page that has asked."""

    op: Literal["presence"] = "presence"
    users: list[PresentUser]


class PresenceChanged(Reply):
    """Who has come or opened something else, and who has left, since the last message of this kind."""

    op: Literal["presence_changed"] = "presence_changed"
    present: list[PresentUser]
    left: list[int]
    """Ids of connections."""


EventMessage = Annotated[ObjectChanged | Presence | PresenceChanged, Field(discriminator="op")]
