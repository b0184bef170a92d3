"""The process image: every variable of the application in one piece of memory below 4 GiB."""

from __future__ import annotations

import os
from dataclasses import dataclass

from tappet.iec.memory import DEFAULT_RESERVE, MAX_IMAGE, ChangeReserve
from tappet.runtime.posix import Mapping, map_memory, pages, read_memory, write_memory


class ImageError(RuntimeError):
    """The image cannot hold the application."""


@dataclass(frozen=True, slots=True)
class ImageMemory:
    """How full the memory of the variables is, in bytes."""

    size: int
    """Taken now."""
    downloaded: int
    """Taken by the last download; what is beyond is what online changes have added."""
    capacity: int
    """What there may be before a download is needed."""


class Image:
    """A memory file, mapped shared. Its address stays the same until it is closed."""

    def __init__(self, size: int, reserve: ChangeReserve = DEFAULT_RESERVE, wanted_address: int = 0) -> None:
        """At `wanted_address` where that is free: a recording is replayed where it was made."""
        if size > MAX_IMAGE:
            raise ImageError(f"image of {size} bytes; at most {MAX_IMAGE} are possible")
        reserved = pages(size + reserve.room(size))
        self._fd = os.memfd_create("tappet-image", os.MFD_CLOEXEC)
        try:
            os.ftruncate(self._fd, reserved)
            self._mapping: Mapping = map_memory(reserved, self._fd, low=True, at=wanted_address)
        except OSError as error:
            os.close(self._fd)
            raise ImageError(f"no memory for an image of {size} bytes: {error}") from error
        self.size = size
        self.downloaded = size
        """Bytes at the download: what is beyond them takes of the reserve."""
        self._accessible = reserved
        self._restrict(size)

    @property
    def address(self) -> int:
        """Where the image begins."""
        return self._mapping.address

    @property
    def low(self) -> bool:
        """Whether pointers to it fit into DWORD."""
        return self._mapping.low

    @property
    def capacity(self) -> int:
        """Largest size it can grow to in place."""
        return self._mapping.size

    def memory(self) -> ImageMemory:
        """As of now."""
        return ImageMemory(self.size, self.downloaded, self.capacity)

    def resize(self, size: int) -> None:
        """Grow or shrink for an online change; the address stays. ImageError when it does not fit."""
        if size > self.capacity:
            raise ImageError(
                f"the changed application needs {size} bytes of data, the running one has room for "
                f"{self.capacity}; a download is needed"
            )
        self._restrict(size)
        self.size = size

    def _restrict(self, size: int) -> None:
        """Nothing behind the image is accessible: a wild pointer ends in an exception, not in silence."""
        wanted = pages(size)
        if wanted > self._accessible:
            self._mapping.protect(self._accessible, wanted - self._accessible, accessible=True)
        elif wanted < self._accessible:
            self._mapping.protect(wanted, self._accessible - wanted, accessible=False)
        self._accessible = wanted

    def read(self, offset: int, size: int) -> bytes:
        """Copy of a part; ValueError outside the image."""
        self.check(offset, size)
        return read_memory(self.address + offset, size)

    def write(self, offset: int, data: bytes) -> None:
        """Store bytes; only while no task runs. ValueError outside the image."""
        self.check(offset, len(data))
        write_memory(self.address + offset, data)

    def check(self, offset: int, size: int) -> None:
        """ValueError when the range is not inside the image."""
        if offset < 0 or size < 0 or offset + size > self.size:
            raise ValueError(f"{size} bytes at offset {offset} lie outside the image of {self.size} bytes")

    def close(self) -> None:
        """Release the memory."""
        if self._mapping.size:
            self._mapping.close()
            os.close(self._fd)
