"""Where members lie: natural alignment, `pack_mode`, bits packed into bytes (LTYP-105, LPRG-40)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from tappet.lang.ast import Pragma
from tappet.lang.attributes import attribute

PACK_MODES = {"0": 1, "1": 1, "2": 2, "4": 4, "8": 8}
"""Largest alignment by value of the attribute."""
NATURAL = 8
SIZE_LIMIT = 1 << 31
"""Bytes of one variable, list or instance; all data of an application lie below 4 GiB."""


@dataclass(slots=True)
class Placement:
    """Places members one after the other."""

    pack: int = NATURAL
    offset: int = 0
    align: int = 1
    bit: int | None = None
    """Next free bit of the byte before `offset` while BIT members follow each other."""

    def place(self, size: int, align: int) -> int:
        """Offset of the next member of this size and alignment, in bytes."""
        self.bit = None
        align = min(align, self.pack)
        self.align = max(self.align, align)
        start = -(-self.offset // align) * align
        self.offset = start + size
        return start

    def place_bit(self) -> tuple[int, int]:
        """Byte offset and bit number of the next BIT member."""
        if self.bit is None or self.bit > 7:
            self.place(1, 1)
            self.bit = 0
        number = self.bit
        self.bit += 1
        return self.offset - 1, number

    @property
    def size(self) -> int:
        """Bytes of the whole, a multiple of its alignment; an empty structure has one byte."""
        return max(1, -(-self.offset // self.align) * self.align)


def pack_of(pragmas: Iterable[Pragma]) -> tuple[int, str | None]:
    """Largest alignment after 'pack_mode', and the faulty value of the attribute if it is none of 0 1 2 4
    8."""
    mode = attribute(pragmas, "pack_mode")
    if mode is None:
        return NATURAL, None
    pack = PACK_MODES.get(mode.strip())
    return (NATURAL, mode) if pack is None else (pack, None)
