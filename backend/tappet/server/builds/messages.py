"""The seam between the web server and a compiler process: orders there, outcomes back, a signal to cancel.

A frame is the length of what follows (8 bytes, little endian) and a msgpack map.
"""

from __future__ import annotations

import signal
import struct
from dataclasses import dataclass
from typing import Any, BinaryIO

import msgpack

from tappet.project.library_reference import LibraryReference

LENGTH = struct.Struct("<Q")
LARGEST_FRAME = 1 << 31
CANCEL = signal.SIGUSR1
"""Ends the running build; what earlier ones left for the next stays."""


@dataclass(frozen=True, slots=True)
class BuildOrder:
    """Everything a build depends on, as plain data."""

    key: str
    """Names the application; builds of one key share their caches."""
    application: str
    sources: tuple[dict[str, Any], ...]
    """Fields of `iec.source.Source`."""
    tasks: tuple[dict[str, Any], ...]
    """Fields of `iec.task.Task`."""
    libraries: tuple[LibraryReference, ...]
    previous: bytes | None
    """Package that runs now; unchanged data keep their places."""
    cache: str
    """Folder of compiled objects."""
    static: dict[str, Any]
    """Fields of `project.kinds.application.StaticAnalysisData`."""
    heap: dict[str, Any]
    """Fields of `iec.heap.HeapSettings`."""
    disabled_warnings: tuple[str, ...] = ()
    """Codes of warnings that are not reported."""
    check_only: bool = False
    """Make no package."""
    project: str = ""
    """Name of the project, for programs that ask."""
    fresh: bool = False
    """Use nothing that earlier builds left: no trees, no objects."""


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
