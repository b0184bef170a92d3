"""Frames between the server and its worker processes: orders there, outcomes back, a signal to cancel.

A frame is the length of what follows (8 bytes, little endian) and a msgpack map.
"""

from __future__ import annotations

import signal
import struct
from typing import Any, BinaryIO

import msgpack

LENGTH = struct.Struct("<Q")
LARGEST_FRAME = 1 << 31
CANCEL = signal.SIGUSR1
"""Ends the running order; what earlier ones left for the next stays."""


def read_frame(stream: BinaryIO) -> dict[str, Any] | None:
    """The next map; None at the end of the stream."""
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        return None
    (length,) = LENGTH.unpack(head)
    body = stream.read(length)
    if len(body) < length:
        return None
    frame: dict[str, Any] = msgpack.unpackb(body, raw=False, max_bin_len=LARGEST_FRAME)
    return frame


def pack_frame(content: dict[str, Any]) -> bytes:
    """A map with its length in front."""
    body: bytes = msgpack.packb(content, use_bin_type=True)
    return LENGTH.pack(len(body)) + body
