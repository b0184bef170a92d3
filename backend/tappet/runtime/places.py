"""From a place in the image back to a variable: what is forced or recorded is found again after an online
change.
"""

from __future__ import annotations

from dataclasses import dataclass

from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.codegen.symbol_types import TypeInfo

_COMPOSITE = ("struct", "union", "fb", "program", "gvl")


@dataclass(frozen=True, slots=True)
class Place:
    """Bytes of the image, or one bit of the byte at `offset`."""

    offset: int
    size: int
    bit: int | None = None


def path_at(symbols: SymbolMap, place: Place) -> str | None:
    """Path of the variable that is exactly `place`, the outermost of several; None when there is none.

    In the areas of %I, %Q and %M a declared variable goes before the bare address.
    """
    name = _located(symbols, place)
    if name is not None:
        return name
    found = _locate(symbols, place)
    return found[0] if found is not None and found[1] == 0 else None


def name_at(symbols: SymbolMap, offset: int) -> str:
    """The variable that holds the byte at `offset`, for people; the offset itself where none does."""
    found = _locate(symbols, Place(offset, 1))
    return found[0] if found is not None else f"image offset {offset}"


def find_again(old: SymbolMap, new: SymbolMap, place: Place) -> Place | None:
    """Where the variable at `place`, or a part of a simple variable, lies in the new application.

    None when it is gone or its type has another name or size.
    """
    found = _locate(old, place)
    if found is None:
        return None
    path, delta = found
    try:
        before, after = old.resolve(path), new.resolve(path)
    except SymbolError:
        return None
    if before.type.name != after.type.name or before.size != after.size:
        return None
    if delta or (place.bit is None and after.bit is not None):
        return Place(after.offset + delta, place.size, place.bit)
    return Place(after.offset, after.size, after.bit)


def _locate(symbols: SymbolMap, place: Place) -> tuple[str, int] | None:
    """Path of the variable that is, or contains, `place`, and how many bytes inside it the place begins."""
    for area, (start, length) in symbols.areas.items():
        if start <= place.offset < start + length:
            path = _area_path(symbols, area, place.offset - start, place)
            return None if path is None else (path, 0)
    for root in symbols.roots.values():
        info = symbols.types[root.type]
        if root.offset <= place.offset < root.offset + info.size:
            found = _descend(symbols, root.name, info, root.offset, place)
            if found is not None:
                return found
    return None


def _located(symbols: SymbolMap, place: Place) -> str | None:
    """The first global or program variable declared AT an address that is exactly `place`."""
    if not any(start <= place.offset < start + length for start, length in symbols.areas.values()):
        return None
    for root in symbols.roots.values():
        for member in symbols.types[root.type].members:
            if not member.absolute:
                continue
            size = 1 if member.bit is not None else symbols.types[member.type].size
            if (member.offset, size, member.bit) == (place.offset, place.size, place.bit):
                return f"{root.name}.{member.name}"
    return None


def _area_path(symbols: SymbolMap, area: str, offset: int, place: Place) -> str | None:
    if place.bit is not None:
        if symbols.byte_addressing:
            return f"%{area}X{offset}.{place.bit}"
        return f"%{area}X{offset // 2}.{offset % 2 * 8 + place.bit}"
    letter = {1: "B", 2: "W", 4: "D", 8: "L"}.get(place.size)
    if letter is None or (not symbols.byte_addressing and offset % place.size):
        return None
    return f"%{area}{letter}{offset if symbols.byte_addressing else offset // place.size}"


def _descend(
    symbols: SymbolMap, path: str, info: TypeInfo, base: int, place: Place
) -> tuple[str, int] | None:
    exact = place.bit is None and base == place.offset and info.size == place.size
    if exact and info.kind not in ("program", "gvl"):
        return path, 0
    if info.kind in _COMPOSITE:
        for member in info.members:
            if member.absolute:
                continue
            inner = symbols.types[member.type]
            start = base + member.offset
            if not start <= place.offset < start + max(inner.size, 1):
                continue
            if member.bit is not None:
                if member.bit == place.bit and start == place.offset:
                    return f"{path}.{member.name}", 0
                continue
            found = _descend(symbols, f"{path}.{member.name}", inner, start, place)
            if found is not None:
                return found
        return None
    if info.kind == "array" and info.elem is not None:
        inner = symbols.types[info.elem]
        if not inner.size:
            return None
        number = (place.offset - base) // inner.size
        index = _unflatten(number, info.bounds)
        return _descend(symbols, f"{path}[{index}]", inner, base + number * inner.size, place)
    if place.bit is not None and info.kind in ("bits", "int", "uint"):
        return f"{path}.{(place.offset - base) * 8 + place.bit}", 0
    if place.bit is None and base <= place.offset and place.offset + place.size <= base + info.size:
        return path, place.offset - base
    return None


def _unflatten(number: int, bounds: tuple[tuple[int, int], ...]) -> str:
    indices: list[str] = []
    for low, high in reversed(bounds):
        number, rest = divmod(number, high - low + 1)
        indices.append(str(low + rest))
    return ", ".join(reversed(indices))
