"""Pointers in an image: moved with it to another address, or found to lead out of it."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence

from tappet.codegen.symbol_map import SymbolMap

POINTERS = ("pointer", "reference", "interface")
_WORD = struct.Struct("<Q")


def pointer_places(symbols: SymbolMap) -> Iterator[int]:
    """Offsets of all variables that hold an address."""
    holds: dict[int, bool] = {}

    def has_pointer(number: int) -> bool:
        known = holds.get(number)
        if known is None:
            holds[number] = False  # a type does not contain itself
            info = symbols.types[number]
            known = holds[number] = info.kind in POINTERS or any(
                has_pointer(part) for part, _ in symbols.parts(number)
            )
        return known

    def walk(number: int, base: int) -> Iterator[int]:
        if not has_pointer(number):
            return
        if symbols.types[number].kind in POINTERS:
            yield base
            return
        for part, offset in symbols.parts(number):
            yield from walk(part, base + offset)

    for root in symbols.roots.values():
        yield from walk(root.type, root.offset)


def moved_image(
    places: Sequence[int], image: bytes, old: int, new: int, otherwise: bytes
) -> tuple[bytes, list[int]]:
    """`image`, which lay at the address `old`, as it is at `new`. Where a pointer leads elsewhere, to
    constants of the code, to memory of `__NEW` or of a call, it is as in `otherwise`; those that were not are
    the second result."""
    moved = bytearray(image)
    elsewhere = []
    for at in places:
        (value,) = _WORD.unpack_from(image, at)
        if value == 0:
            continue
        if old <= value <= old + len(image):
            _WORD.pack_into(moved, at, value - old + new)
        elif moved[at : at + 8] != otherwise[at : at + 8]:
            moved[at : at + 8] = otherwise[at : at + 8]
            elsewhere.append(at)
    return bytes(moved), elsewhere
