"""Traces that run in controllers, and stored recordings."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, ClassVar, Literal

from pydantic import Field, StringConstraints

from tappet.project.trace import TraceChannel, TraceData
from tappet.server.shapes import Reply, Request
from tappet.traces.questions import MOST_POINTS

TraceName = Annotated[str, Field(min_length=1, max_length=200)]
Title = Annotated[str, StringConstraints(max_length=200, pattern=r"^[^\x00-\x1f\x7f]*$")]
Comment = Annotated[str, StringConstraints(max_length=10_000, pattern=r"^[^\x00]*$")]
Nanoseconds = Annotated[int, Field(ge=0, lt=1 << 63)]
Width = Annotated[int, Field(ge=1, le=MOST_POINTS)]
Channels = Annotated[str, Field(pattern=r"^\d{1,3}(,\d{1,3}){0,255}$")]
"""Numbers among the sampled channels, separated by commas."""
ExportFormat = Literal["csv", "parquet", "trace"]


class TraceDownload(Request):
    """A trace to be downloaded."""

    data: TraceData
    start: bool = True
    project_id: str | None = Field(default=None, max_length=32)


class TraceSettings(Reply):
    """The settings of a trace that runs in a controller."""

    data: TraceData


class TraceSettingsOrder(Request):
    """Settings of a trace."""

    data: TraceData


class TraceDigest(Reply):
    """Differs where settings differ that the runtime has to know: a download is needed."""

    digest: str


class AxisTemplate(Reply):
    """The channels of the device trace of an axis."""

    channels: list[TraceChannel]


class TraceProblem(Reply):
    """What is wrong with settings, and where."""

    SENTENCES: ClassVar = ("message",)

    record: int
    channel: int | None
    field: Literal["variable", "condition", "trigger.variable", "trigger.level", "task", "formula"]
    message: str


class SampledChannel(Reply):
    """A channel as it is sampled."""

    index: int = Field(description="Number of the channel in the settings of the record.")
    name: str
    type: str


class TriggerState(Reply):
    """What the trigger has seen (TRC-82)."""

    percent: int = Field(description="Of the samples behind the trigger.")
    at_ns: str | None = Field(description="Unix time of the event.")


class RunningRecord(Reply):
    """A record that runs."""

    name: str
    task: str
    interval_ns: int
    state: Literal["stopped", "recording", "waiting", "triggered", "done"]
    trigger: TriggerState | None = Field(description="Null where none is set.")
    samples: int = Field(description="Since the download.")
    first: int = Field(description="Number of the oldest sample of the picture.")
    capacity: int
    lost: int = Field(description="Samples that a long-term recording could not read in time.")
    channels: list[SampledChannel]


class RecordingRecord(Reply):
    """A record of a stored recording."""

    name: str
    task: str
    interval_ns: int
    samples: int
    first_ns: str | None
    last_ns: str | None
    trigger_ns: str | None
    channels: list[SampledChannel]


class RecordingInfo(Reply):
    """A stored recording."""

    SENTENCES: ClassVar = ("problem",)

    id: str
    title: str
    comment: str
    trace: str
    application: str
    runtime_id: str | None
    runtime: str
    project_id: str | None
    started_at: datetime
    ended_at: datetime | None
    started_by: str
    state: Literal["recording", "complete", "interrupted"]
    problem: str | None = Field(description="Why it ended early.")
    bytes: int
    lost: int
    keep_bytes: int | None = Field(description="Where it takes more, its oldest samples are dropped.")
    keep_seconds: int | None = Field(description="Older samples are dropped; counted from the newest one.")
    dropped: int = Field(description="Samples that these limits have cost.")
    records: list[RecordingRecord]


class Recording(RecordingInfo):
    """A stored recording with the settings of its trace."""

    data: TraceData


class RecordingList(Reply):
    """Stored recordings, newest first, and the room they take."""

    recordings: list[RecordingInfo]
    used_bytes: int
    quota_bytes: int
    keep_days: float | None = Field(description="Older recordings are deleted; null: none is.")


class TraceState(Reply):
    """A trace that runs in a controller."""

    name: str
    application: str
    data_digest: str
    running: bool
    downloaded_at: datetime
    downloaded_by: str
    recording: RecordingInfo | None
    records: list[RunningRecord]


class SnapshotOrder(Request):
    """A recording to be made of what a trace holds now."""

    title: Title = ""
    project_id: str | None = Field(default=None, max_length=32)


class RecordingOrder(SnapshotOrder):
    """A long-term recording to be begun."""

    seconds: int | None = Field(default=None, ge=1, le=31_622_400, description="It ends then by itself.")
    keep_mib: int | None = Field(
        default=None, ge=1, le=1 << 20, description="Where it takes more, its oldest samples are dropped."
    )
    keep_seconds: int | None = Field(
        default=None,
        ge=1,
        le=31_622_400,
        description="Older samples are dropped, counted from the newest.",
    )


class RecordingChange(Request):
    """What is changed of a stored recording; null: as it is."""

    title: Title | None = None
    comment: Comment | None = None


class ChannelStatistics(Reply):
    """Of a span of a channel."""

    count: int
    invalid: int
    minimum: float | None
    maximum: float | None
    mean: float | None
    rms: float | None
    deviation: float | None
    first: float | None
    last: float | None
    minimum_ns: str | None
    maximum_ns: str | None


class ChannelSpectrum(Reply):
    """Single-sided amplitudes; frequency n is n times `step_hz`."""

    step_hz: float
    sample_hz: float
    samples: int
    pieces: int
    amplitudes: list[float]
