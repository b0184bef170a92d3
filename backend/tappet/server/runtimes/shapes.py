"""Runtimes: soft PLCs this server is connected to."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from tappet.server.builds.shapes import Part
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


class CodePlace(Reply):
    """A place in the program. Object and part are known for applications that this server downloaded."""

    pou: str | None
    uri: str | None = None
    object_id: str | None = None
    object_path: str | None = None
    part: Part | None = None
    element: str | None = Field(default=None, description="Id of the element in a drawn part.")
    line: int | None = Field(
        default=None, description="From 1: in the part, or in the whole text where no part is known."
    )


class CallFrame(CodePlace):
    """One level of the call stack, the innermost first."""


class RuntimeException(CodePlace):
    """Why an application stopped."""

    code: int | str
    name: str = Field(default="", description="Name of the code, such as `DIV_ZERO`.")
    message: str
    task: str
    call_stack: list[CallFrame] = Field(default_factory=list)
    values: dict[str, str] = Field(
        default_factory=dict, description="Numbers of the fault and variables of the programs, as literals."
    )


class RuntimeState(Reply):
    """A runtime as it is now; while not connected, `since` says since when and the rest is the last known."""

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


class LogEntry(Reply):
    """One line of a runtime's log."""

    id: int
    at: datetime
    severity: str
    component: str
    message: str


class Symbol(Reply):
    """A variable or a group of variables below a path."""

    name: str
    path: str
    type: str
    kind: str
    leaf: bool
