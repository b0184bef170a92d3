"""Where data objects lie in the image; unchanged ones keep their place over online changes."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass

from tappet.codegen.package import DataObject
from tappet.core.program import OBJECT_ALIGN
from tappet.iec.memory import check_image_size
from tappet.lang import types as t


@dataclass(frozen=True, slots=True)
class Wanted:
    """A data object to place; `signature` changes with its layout."""

    symbol: str
    size: int
    extent: int
    """Bytes that code may take it for: as many are there."""
    signature: str


@dataclass(slots=True)
class Layout:
    """The placed image."""

    objects: dict[str, DataObject]
    size: int
    data_id: str
    kept: set[str]
    """Symbols that are where they were, with the same meaning."""


def place(
    wanted: Iterable[Wanted],
    previous: Mapping[str, DataObject] | None = None,
    signatures: Mapping[str, str] | None = None,
) -> Layout:
    """Offsets for all objects. What has the signature it had stays; the rest goes into gaps or behind.

    Raises ImageTooLargeError.
    """
    items = list(wanted)
    objects: dict[str, DataObject] = {}
    kept: set[str] = set()
    for item in items:
        old = previous.get(item.symbol) if previous else None
        if old is not None and signatures is not None and signatures.get(item.symbol) == item.signature:
            objects[item.symbol] = old
            kept.add(item.symbol)
    gaps = _Gaps(objects.values())
    for item in items:
        if item.symbol not in objects:
            objects[item.symbol] = DataObject(gaps.take(item.size), item.size)
    size = max((_aligned(objects[i.symbol].offset + i.extent) for i in items), default=0)
    check_image_size(size)
    digest = hashlib.blake2b(digest_size=12)
    for item in sorted(items, key=lambda i: i.symbol):
        digest.update(f"{item.symbol}@{objects[item.symbol].offset}:{item.signature};".encode())
    return Layout(objects, size, digest.hexdigest(), kept)


class _Gaps:
    """Free room between objects that stay."""

    def __init__(self, taken: Iterable[DataObject]) -> None:
        self.free: list[tuple[int, int]] = []
        end = 0
        for item in sorted(taken, key=lambda o: o.offset):
            if item.offset > end:
                self.free.append((end, item.offset))
            end = max(end, _aligned(item.offset + item.size))
        self.end = end

    def take(self, size: int) -> int:
        """First fit, else behind everything."""
        need = _aligned(max(size, 1))
        for number, (start, stop) in enumerate(self.free):
            if stop - start >= need:
                self.free[number] = (start + need, stop)
                return start
        start = self.end
        self.end += need
        return start


def _aligned(offset: int) -> int:
    return (offset + OBJECT_ALIGN - 1) // OBJECT_ALIGN * OBJECT_ALIGN


class Signatures:
    """Text that shows whether bytes laid out for one type can be read as another: names, offsets, types."""

    def __init__(self) -> None:
        self.known: dict[int, str] = {}
        self.keep: dict[int, t.Type] = {}

    def forget(self, entities: Set[int]) -> None:
        """Types given by id() are laid out differently now."""
        for key in self.known.keys() & entities:
            del self.known[key]
            del self.keep[key]

    def of(self, type_: t.Type) -> str:
        """Signature of a type."""
        if isinstance(type_, t.Struct | t.FunctionBlock):
            found = self.known.get(id(type_))
            if found is None:
                self.known[id(type_)] = type_.name  # a recursive mention
                self.keep[id(type_)] = type_
                parts = [
                    f"{m.name.upper()}@{m.offset}{'' if m.bit is None else f'.{m.bit}'}:{self.of(m.type)}"
                    for m in type_.members.values()
                ]
                digest = hashlib.blake2b(";".join(parts).encode(), digest_size=8).hexdigest()
                found = self.known[id(type_)] = f"{type_.name.upper()}#{digest}"
            return found
        if isinstance(type_, t.Array):
            return f"A{type_.bounds}{self.of(type_.element)}"
        if isinstance(type_, t.Pointer | t.Reference):
            kind = "P" if isinstance(type_, t.Pointer) else "R"
            base = type_.base
            name = base.name if isinstance(base, t.Struct | t.FunctionBlock) else str(base)
            return f"{kind}:{name}"
        if isinstance(type_, t.Enum | t.Subrange):
            return f"{type_.base}"
        if isinstance(type_, t.String):
            return f"{'W' if type_.wide else 'S'}{type_.length}"
        return str(type_)
