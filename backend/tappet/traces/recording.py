"""What is known of a recording besides its samples; kept as JSON beside them and in `*.trace` files."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from tappet.runtime.trace_record import TraceSource


class ChannelInfo(Struct, frozen=True):
    """A sampled channel."""

    index: int
    """Number of the channel in the settings of the record."""
    name: str
    type: str
    number: str
    """How its values are kept, as numpy calls it."""


def channels_of(sources: Sequence[TraceSource]) -> list[ChannelInfo]:
    """Of a record in the runtime."""
    return [ChannelInfo(s.channel, s.name, s.type_name, s.number) for s in sources]


class RecordInfo(Struct, frozen=True):
    """A record of a recording."""

    name: str
    task: str
    interval_ns: int
    """Of a cyclic task, else 0."""
    every: int
    channels: list[ChannelInfo]
    trigger_ns: int | None = None
