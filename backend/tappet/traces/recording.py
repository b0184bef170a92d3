"""What is known of a recording besides its samples; kept as JSON beside them and in `*.trace` files."""

from __future__ import annotations

from msgspec import Struct

from tappet.traces.samples import ChannelInfo


class RecordInfo(Struct, frozen=True):
    """A record of a recording."""

    name: str
    task: str
    interval_ns: int
    """Of a cyclic task, else 0."""
    every: int
    channels: list[ChannelInfo]
    trigger_ns: int | None = None
