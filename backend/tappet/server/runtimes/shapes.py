"""Runtimes: soft PLCs this server is connected to."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, ClassVar, Literal

from pydantic import Field, StringConstraints

from tappet.runtime.operations.reports import RuntimeException
from tappet.server.shapes import Line, Reply, Request

RuntimeName = Annotated[Line, StringConstraints(min_length=1, max_length=100, strip_whitespace=True)]
RuntimeUrl = Annotated[str, StringConstraints(pattern=r"^wss?://[^\s/?#@]+(/[^\s?#]*)?$", max_length=500)]
Activity = Literal["empty", "stop", "run", "exception"]


class NewRuntime(Request):
    """A runtime to connect to."""

    name: RuntimeName
    url: RuntimeUrl = Field(description="`ws://host:port` or `wss://...` of a running `tappet runtime`.")
    token: Annotated[Line, StringConstraints(max_length=500)] = Field(
        description="The access token that runtime printed."
    )


class RuntimeState(Reply):
    """A runtime as it is now; while not connected, `since` says since when and the rest is the last known."""

    SENTENCES: ClassVar = ("problem", "scheduling")

    id: str
    name: str
    url: str
    connected: bool
    since: datetime | None = Field(description="Since when it is connected, or not.")
    state: Activity | None
    application: str | None
    code_id: str | None
    data_id: str | None
    exception: RuntimeException | None
    scheduling: str | None = Field(description="Real-time class the runtime got, and what it misses.")
    problem: str | None = Field(default=None, description="Why there is no connection.")
    halted: tuple[str, ...] = Field(default=(), description="Tasks that stand at a statement.")
    debug_sequence: int = Field(default=0, description="Grows with every change of the debugger's state.")


class Symbol(Reply):
    """A variable or a group of variables below a path."""

    name: str
    path: str
    type: str
    kind: str
    leaf: bool
