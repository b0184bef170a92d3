"""The source of the application, which an engineer keeps in the controller: an archive of the project.

One file of one name in the folder of the runtime, a head and the archive: nothing that comes over the wire
names a path. The runtime never unpacks it.
"""

from __future__ import annotations

import hashlib
import threading
from dataclasses import dataclass
from pathlib import Path

import msgspec

from tappet.disk_full import is_disk_full
from tappet.runtime.errors import DiskFullError, PlcError
from tappet.whole_file import PRIVATE, replace_file

FILE = "source.tappet"
MAX_SOURCE = 64 << 20
"""Bytes of an archive."""
_MAGIC = b"TPSRC1"
_MOST_HEAD = 1 << 16


class SourceNote(msgspec.Struct, frozen=True):
    """What the runtime is told about an archive."""

    project: str
    stored_by: str
    stored_at_ms: int
    """Milliseconds since 1970, by the clock of who stored it."""
    code_id: str
    """The code that was built from it; empty when that is not known."""


@dataclass(frozen=True, slots=True)
class SourceInfo:
    """The archive in a controller."""

    project: str
    stored_by: str
    stored_at_ms: int
    code_id: str
    size: int
    """Bytes."""
    digest: str
    """SHA-256 of the archive, in hexadecimal."""
    current: bool
    """The application that is loaded was built from it."""


class _Head(msgspec.Struct, frozen=True):
    note: SourceNote
    size: int
    digest: str


class SourceStore:
    """The archive of one runtime; without a folder it is kept in memory. May be used by several threads."""

    def __init__(self, folder: Path | None) -> None:
        self._path = folder / FILE if folder is not None else None
        self._lock = threading.Lock()
        self._memory: bytes | None = None

    def put(self, note: SourceNote, data: bytes) -> None:
        """Keep an archive in place of the one that is there.

        Raises DiskFullError and PlcError; the one that is there stays then.
        """
        if len(data) > MAX_SOURCE:
            raise PlcError(f"the source has {len(data)} bytes; at most {MAX_SOURCE >> 20} MiB are kept")
        head = msgspec.json.encode(_Head(note, len(data), hashlib.sha256(data).hexdigest()))
        content = b"".join([_MAGIC, len(head).to_bytes(4, "little"), head, data])
        with self._lock:
            if self._path is None:
                self._memory = content
                return
            try:
                replace_file(self._path, content, mode=PRIVATE, to_disk=True)
            except OSError as error:
                if is_disk_full(error):
                    raise DiskFullError("there is no room for the source") from error
                raise PlcError(f"the source could not be stored: {error.strerror or error}") from error

    def info(self, loaded_code: str | None) -> SourceInfo | None:
        """What is there; None for nothing, and for a file that is damaged. `loaded_code` is what runs."""
        with self._lock:
            found = self._read_head()
        if found is None:
            return None
        head, _ = found
        note = head.note
        current = bool(note.code_id) and note.code_id == loaded_code
        return SourceInfo(
            note.project, note.stored_by, note.stored_at_ms, note.code_id, head.size, head.digest, current
        )

    def read(self, digest: str, offset: int, size: int) -> bytes:
        """A part of the archive with this digest. Raises PlcError when another one, or none, is there."""
        with self._lock:
            found = self._read_head()
            if found is None or found[0].digest != digest:
                raise PlcError("the source in the controller has changed meanwhile; read it again")
            head, begin = found
            size = max(0, min(size, head.size - offset))
            return self._bytes(begin + offset, size)

    def remove(self) -> None:
        """Forget it."""
        with self._lock:
            self._memory = None
            if self._path is not None:
                self._path.unlink(missing_ok=True)

    def _read_head(self) -> tuple[_Head, int] | None:
        """The head, and where the archive begins; None where there is none that is whole."""
        start = self._bytes(0, len(_MAGIC) + 4)
        if len(start) < len(_MAGIC) + 4 or not start.startswith(_MAGIC):
            return None
        length = int.from_bytes(start[len(_MAGIC) :], "little")
        if length > _MOST_HEAD:
            return None
        begin = len(start) + length
        try:
            head = msgspec.json.decode(self._bytes(len(start), length), type=_Head)
        except (msgspec.MsgspecError, UnicodeDecodeError):
            return None
        return (head, begin) if begin + head.size == self._size() else None

    def _size(self) -> int:
        if self._path is None:
            return len(self._memory or b"")
        try:
            return self._path.stat().st_size
        except OSError:
            return 0

    def _bytes(self, offset: int, size: int) -> bytes:
        if self._path is None:
            return (self._memory or b"")[offset : offset + size]
        try:
            with self._path.open("rb") as file:
                file.seek(offset)
                return file.read(size)
        except OSError:
            return b""
