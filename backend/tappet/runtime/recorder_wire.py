"""How frames of recorders travel: the head of the message that `protocol` describes, and what writes it."""

from __future__ import annotations

import struct

VERSION = 2
"""Of the whole wire."""
MARK = 0xC1
"""Begins no MessagePack value."""
HEAD = struct.Struct("<BBHIIIQ")
"""Mark, version, 0, recorder, count, frame size, frames dropped so far."""


def pack_frames(recorder: int, count: int, frame_size: int, dropped: int, data: bytes) -> bytes:
    """Frames of a recorder as one binary message."""
    return HEAD.pack(MARK, VERSION, 0, recorder, count, frame_size, dropped) + data
