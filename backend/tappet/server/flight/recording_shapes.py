"""Recordings of the flight recorder in a project."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, ClassVar

from pydantic import Field

from tappet.runtime.operations.reports import RuntimeException
from tappet.server.builds.shapes import Relation
from tappet.server.runtimes.shapes import RuntimeState
from tappet.server.shapes import Line, Reply, Request


class NewRecording(Request):
    """What to keep, and as what."""

    runtime_id: str
    name: Annotated[Line, Field(min_length=1, max_length=200)]


class RecordingFacts(Reply):
    """What a recording holds."""

    application: str
    project: str
    code_id: str
    saved_at: datetime
    size: int = Field(description="Characters of the file.")
    cycles: int
    first_cycle: int
    first_timestamp: datetime
    last_cycle: int
    last_timestamp: datetime
    writes: int = Field(description="Writes from outside that a replay gives again.")
    exception: RuntimeException | None = None


class OpenedRecording(Reply):
    """A recording that can be looked at as if it were a runtime."""

    runtime: RuntimeState
    relation: Relation = Field(description="How the present program relates to the recorded one.")


class ReplayRequest(Request):
    """What to replay it on."""

    today: bool = Field(
        default=False,
        description="On the present program, by the names of variables; else on the recorded one.",
    )


class DifferentValue(Reply):
    """A variable that is not as recorded."""

    name: str
    recorded: str
    replayed: str


class ReplayReport(Reply):
    """What came of a replay."""

    SENTENCES: ClassVar = ("problem", "notes")

    ok: bool = Field(description="As recorded; on the present program: it does not fail.")
    today: bool
    problem: str | None = None
    cycles: int = 0
    last_cycle: int = 0
    recorded: RuntimeException | None = None
    fault: RuntimeException | None = None
    same_fault: bool = False
    first_difference: int | None = Field(default=None, description="Cycle.")
    variables: list[DifferentValue] = Field(default=[], description="Those that differ in that cycle.")
    notes: list[str] = Field(default=[])
