"""The first cycle of a replay whose variables are not as recorded, and which they are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Protocol

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.runtime.places import name_at
from tappet.runtime.pointers import moved_image

MOST_DIFFERENCES = 20
"""Variables that are named of the first cycle that differs."""
MOST_COUNTED = 200
"""Variables that count for how far two images are from each other."""
_TEXTS = ("string", "wstring")
_POINTER = 8
"""Bytes of an address."""


@dataclass(frozen=True, slots=True)
class Difference:
    """The first cycle whose variables are not as recorded."""

    cycle: int
    variables: tuple[tuple[str, str, str], ...]
    """Name, recorded and replayed value; the first ones."""


class Comparison(Protocol):
    """How recorded images are compared with those of the replay."""

    def difference(self, cycle: int, recorded: bytes, now: bytes) -> Difference | None:
        """What differs at the end of a cycle."""

    def distance(self, recorded: bytes, now: bytes) -> int:
        """How many variables differ, of the first ones."""


class SameProgram:
    """All bytes of both images count: pointers by what they point to, texts up to their end."""

    def __init__(self, symbols: SymbolMap, pointers: Sequence[int], then: int, now: int) -> None:
        """`then` and `now` are the addresses of the images."""
        self._symbols = symbols
        self._pointers = pointers
        self._then = then
        self._now = now

    def difference(self, cycle: int, recorded: bytes, now: bytes) -> Difference | None:
        """What differs at the end of a cycle."""
        then = recorded[: len(now)]
        if now == then:
            return None
        then, _ = moved_image(self._pointers, then, self._then, self._now, now)
        if now == then:
            return None
        rows = list(islice(self._rows(then, now), MOST_DIFFERENCES))
        return Difference(cycle, tuple(rows)) if rows else None

    def distance(self, recorded: bytes, now: bytes) -> int:
        """How many variables differ, of the first ones."""
        then, _ = moved_image(self._pointers, recorded[: len(now)], self._then, self._now, now)
        return sum(1 for _ in islice(self._rows(then, now), MOST_COUNTED))

    def _rows(self, then: bytes, now: bytes) -> Iterator[tuple[str, str, str]]:
        for name in _distinct(name_at(self._symbols, at) for at in differing(then, now)):
            values = [_literal(self._symbols, name, image) for image in (then, now)]
            if values[0] != values[1] or not self._is_text(name):
                yield name, values[0] or "?", values[1] or "?"

    def _is_text(self, name: str) -> bool:
        """Behind the end of a text lies what was in memory where it was put together."""
        try:
            return self._symbols.resolve(name).type.kind in _TEXTS
        except SymbolError:
            return False


class AcrossPrograms:
    """The variables that the recorded program and an online change of it have in common, without pointers."""

    def __init__(self, old: CodePackage, new: CodePackage, pointers: Sequence[int]) -> None:
        """`pointers` are the offsets of those of the old program."""
        self._old = old.symbols
        self._new = new.symbols
        self._segments = list(common_segments(old, new))
        self._addresses = {at + byte for at in pointers for byte in range(_POINTER)}

    def difference(self, cycle: int, recorded: bytes, now: bytes) -> Difference | None:
        """What differs at the end of a cycle."""
        rows = list(islice(self._rows(recorded, now), MOST_DIFFERENCES))
        return Difference(cycle, tuple(rows)) if rows else None

    def distance(self, recorded: bytes, now: bytes) -> int:
        """How many variables differ, of the first ones."""
        return sum(1 for _ in islice(self._rows(recorded, now), MOST_COUNTED))

    def _rows(self, recorded: bytes, now: bytes) -> Iterator[tuple[str, str, str]]:
        for name in _distinct(name_at(self._old, at) for at in self._differing(recorded, now)):
            then, today = _literal(self._old, name, recorded), _literal(self._new, name, now)
            if then is not None and today is not None and then != today:
                yield name, then, today

    def _differing(self, recorded: bytes, now: bytes) -> Iterator[int]:
        for old, new, size in self._segments:
            then, today = recorded[old : old + size], now[new : new + size]
            if then != today:
                yield from (old + at for at in differing(then, today) if old + at not in self._addresses)


def common_segments(old: CodePackage, new: CodePackage) -> Iterator[tuple[int, int, int]]:
    """Old offset, new offset and size of the data that `new`, an online change of `old`, takes over."""
    change = new.online_change
    assert change is not None
    yield from change.moves
    moved = {target for _, target, _ in change.moves}
    for name, before in old.data_objects.items():
        after = new.data_objects.get(name)
        if after is None or (after.offset, after.size) != (before.offset, before.size):
            continue
        if before.offset not in moved and old.facts.signatures.get(name) == new.facts.signatures.get(name):
            yield before.offset, before.offset, before.size


def differing(one: bytes, other: bytes) -> Iterator[int]:
    """Places at which two images of one size differ; whole blocks that are equal are passed over."""
    block = 256
    for start in range(0, len(one), block):
        a, b = one[start : start + block], other[start : start + block]
        if a != b:
            yield from (start + at for at in range(len(a)) if a[at] != b[at])


def _distinct(names: Iterable[str]) -> Iterator[str]:
    """Each name once, as they come."""
    seen: set[str] = set()
    for name in names:
        if name not in seen:
            seen.add(name)
            yield name


def _literal(symbols: SymbolMap, name: str, image: bytes) -> str | None:
    """The value of a variable in an image; None where the program has no such variable."""
    try:
        ref = symbols.resolve(name)
    except SymbolError:
        return None
    return symbols.format_literal(ref, symbols.decode(ref, image[ref.offset : ref.offset + ref.size]))
