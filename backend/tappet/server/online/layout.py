"""From expressions to places in the image and in the frames."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from tappet.codegen.symbol_map import SymbolMap, VarRef
from tappet.runtime.recorder import LARGEST_FRAME
from tappet.server.online.shapes import ImagePlace, Item
from tappet.server.values.service import resolve_all

HEADER = struct.Struct("<IIQq")
"""Subscription, flags, cycle, unix time in ns."""


NO_APPLICATION = "There is no application in the runtime."


@dataclass(frozen=True, slots=True)
class FrameLayout:
    """What the frames of a subscription carry."""

    items: tuple[Item, ...]
    places: tuple[tuple[int, int], ...]
    """(offset in the image, size) of the values, in the order in which the frame packs them."""

    @property
    def size(self) -> int:
        """Bytes of values in a frame."""
        return sum(size for _, size in self.places)


def lay_out(symbols: SymbolMap | None, expressions: Sequence[str]) -> FrameLayout:
    """Packs the values of `expressions` one after the other; raises ValueError when they are too large."""
    items: list[Item] = []
    places: list[tuple[int, int]] = []
    at = 0
    found = [NO_APPLICATION] * len(expressions) if symbols is None else resolve_all(symbols, expressions)
    for expression, ref in zip(expressions, found, strict=True):
        if isinstance(ref, str):
            items.append(Item(expression=expression, offset=0, size=0, type="", kind="error", error=ref))
            continue
        size = ref.size if ref.type.leaf or ref.bit is not None else 0
        items.append(_item(expression, ref, at, size))
        if size:
            places.append((ref.offset, size))
            at += size
    if at > LARGEST_FRAME:
        raise ValueError(f"The values take {at} bytes; one subscription carries at most {LARGEST_FRAME}.")
    return FrameLayout(tuple(items), tuple(places))


def _item(expression: str, ref: VarRef, at: int, size: int) -> Item:
    kind = "bool" if ref.bit is not None else ref.type.kind
    is_enum = kind == "enum"
    return Item(
        expression=expression,
        offset=at,
        size=size,
        type=ref.type.name,
        kind=kind,
        enum=dict(ref.type.values) if is_enum else None,
        base=ref.type.base if is_enum else None,
        bit=ref.bit,
        flags=ref.flags,
        section=ref.section,
        place=ImagePlace(offset=ref.offset, size=ref.size, bit=ref.bit),
    )
