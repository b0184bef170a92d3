"""Which test runs, on a page that outlives the process it runs in: TEST_PLACE of the library."""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass

from tappet.runtime.posix import PAGE

_LAYOUT = struct.Struct("<256s i i ?")
"""sTest, diSuite, diMark, xOrdered."""


@dataclass(frozen=True, slots=True)
class Place:
    """What ran last."""

    suite: int
    """Number of the suite; 0: none was called."""
    test: str
    """Name within the suite; empty: the suite outside of its tests."""
    mark: int
    """Number of the last mark that was reached; 0: none."""
    ordered: bool


class PlacePage:
    """A memory file of one page: whoever waits for the process makes it, the process maps it."""

    def __init__(self) -> None:
        self.fd = os.memfd_create("tappet-tests", os.MFD_CLOEXEC)
        os.ftruncate(self.fd, PAGE)

    def read(self) -> Place:
        """What ran last since `clear`."""
        name, suite, mark, ordered = _LAYOUT.unpack(os.pread(self.fd, _LAYOUT.size, 0))
        return Place(suite, name.split(b"\0")[0].decode("utf-8", "replace"), mark, ordered)

    def clear(self) -> None:
        """Nothing runs."""
        os.pwrite(self.fd, bytes(PAGE), 0)

    def close(self) -> None:
        """Release it."""
        os.close(self.fd)
