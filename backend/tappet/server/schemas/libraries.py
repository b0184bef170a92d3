"""The installed libraries and their items (the shape of `tappet library show`)."""

from __future__ import annotations

from typing import Any

from pydantic import ConfigDict, Field

from tappet.server.schemas.base import Reply


class LibrarySummary(Reply):
    """An installed library."""

    name: str
    version: str
    namespace: str
    company: str
    title: str
    description: str
    item_count: int


class Pin(Reply):
    """A parameter or member."""

    model_config = ConfigDict(extra="allow")

    name: str
    type: str
    default: str | None = None
    comment: str = ""


class LibraryItem(Reply):
    """A function, function block, type or enumeration."""

    model_config = ConfigDict(extra="allow")

    name: str
    kind: str
    comment: str = ""
    inputs: list[Pin] = Field(default_factory=list)
    outputs: list[Pin] = Field(default_factory=list)
    in_out: list[Pin] = Field(default_factory=list)
    members: list[Pin] = Field(default_factory=list)
    values: list[dict[str, Any]] = Field(default_factory=list)
    returns: str | None = None


class Library(LibrarySummary):
    """A library with everything in it."""

    items: list[LibraryItem]
