"""The source of a project in a controller."""

from __future__ import annotations

from pydantic import Field

from tappet.server.shapes import Line, Reply, Request


class SourceTarget(Request):
    """The runtime that gets the source."""

    runtime_id: str


class SourceOrder(Request):
    """The project that the source becomes."""

    name: Line | None = Field(
        default=None, min_length=1, max_length=200, description="Another name than the one in the source."
    )


class StoredSource(Reply):
    """The source that a controller has now."""

    project: str
    size: int = Field(description="Bytes of the archive.")
    current: bool = Field(description="The application that is loaded was built from it.")
