"""Traces: what tasks sample into rings, with condition and trigger. Any client may read them.

The REST routes are those of the server's traces, which compile the settings of a trace object to a
`TraceSpec`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from msgspec import Meta

from tappet.runtime.operations.declaration import Count, Operation, Text
from tappet.runtime.sampled import TraceSpec, TraceStatus
from tappet.runtime.trace_record import Command, TraceFrames

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


class DownloadTrace(Operation[TraceStatus], frozen=True):
    """Keep a trace, in place of one of its name, and start it."""

    op: ClassVar[str] = "download_trace"
    spec: TraceSpec
    start: bool = True

    def run(self, plc: SoftPlc) -> TraceStatus:
        """As it is afterwards."""
        return plc.download_trace(self.spec, self.start)


class ListTraces(Operation[list[TraceStatus]], frozen=True):
    """All traces of the loaded application."""

    op: ClassVar[str] = "traces"

    def run(self, plc: SoftPlc) -> list[TraceStatus]:
        """As of now."""
        return plc.traces()


class CommandTrace(Operation[TraceStatus], frozen=True):
    """Start a trace, stop it, or arm its trigger again."""

    op: ClassVar[str] = "command_trace"
    name: Text
    command: Command

    def run(self, plc: SoftPlc) -> TraceStatus:
        """As it is afterwards."""
        return plc.command_trace(self.name, self.command)


class RemoveTrace(Operation[None], frozen=True):
    """End a trace."""

    op: ClassVar[str] = "remove_trace"
    name: Text

    def run(self, plc: SoftPlc) -> None:
        """Its samples are gone."""
        plc.remove_trace(self.name)


class UploadTrace(Operation[bytes], frozen=True):
    """The settings that were downloaded with a trace."""

    op: ClassVar[str] = "upload_trace"
    name: Text

    def run(self, plc: SoftPlc) -> bytes:
        """As they came."""
        return plc.trace_settings(self.name)


class TakeTrace(Operation[TraceFrames], frozen=True):
    """Samples of a record from a number on; fewer than asked for where the reply would be too long."""

    op: ClassVar[str] = "take_trace"
    name: Text
    record: Annotated[int, Meta(ge=0, le=1000)]
    first: Count
    limit: Annotated[int, Meta(ge=1, le=1_000_000)]

    def run(self, plc: SoftPlc) -> TraceFrames:
        """Nothing is taken away."""
        return plc.take_trace(self.name, self.record, self.first, self.limit)
