"""Values that come from outside: batches of writes, and the table of forced variables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from tappet.runtime.executive.records import Block, Layout
from tappet.runtime.places import Place
from tappet.runtime.posix import write_memory


@dataclass(frozen=True, slots=True)
class PlacedValue:
    """Bytes for a place in the image; for a bit one byte, 0 or 1."""

    place: Place
    data: bytes

    def __post_init__(self) -> None:
        if self.place.bit is None:
            if len(self.data) != self.place.size or not self.data:
                raise ValueError(
                    f"{len(self.data)} bytes given for {self.place.size} bytes at {self.place.offset}"
                )
        elif not 0 <= self.place.bit <= 7 or len(self.data) != 1:
            raise ValueError(f"bit {self.place.bit} at {self.place.offset} takes one byte 0 or 1, bit 0..7")


class ValueList:
    """A VALUE_LIST of the executive in native memory; never changed once a task may see it."""

    def __init__(self, layouts: dict[str, Layout], image: int, values: Sequence[PlacedValue]) -> None:
        head, item = layouts["VALUE_LIST"], layouts["VALUE_ITEM"]
        data = [_native(v) for v in values]
        self._block = Block(head.size + item.size * len(values) + sum(len(d) for d in data))
        record = self._record = self._block.array(head, 1)[0]
        self.address = record.address
        items = self.address + head.size
        bytes_at = items + item.size * len(values)
        record["count"] = len(values)
        record["pItems"] = items
        for i, (value, raw) in enumerate(zip(values, data, strict=True)):
            entry = type(record)(item, items + i * item.size)
            entry["pTarget"] = image + value.place.offset
            entry["pValue"] = bytes_at
            entry["size"] = len(value.data)
            entry["mask"] = 0 if value.place.bit is None else 1 << value.place.bit
            write_memory(bytes_at, raw)
            bytes_at += len(raw)

    @property
    def cycle(self) -> int:
        """The cycle of the task in which a queued batch was stored; 0 before."""
        return self._record["cycle"]

    @cycle.setter
    def cycle(self, number: int) -> None:
        self._record["cycle"] = number


def _native(value: PlacedValue) -> bytes:
    """The value's bytes, padded to whole words so that each begins on an eight-byte boundary."""
    data = value.data
    if value.place.bit is not None:
        data = b"\xff" if data[0] & 1 else b"\0"
    return data + b"\0" * (-len(data) % 8)


@dataclass(frozen=True, slots=True)
class Origin:
    """Who has forced a variable, by what, and when."""

    user: str = ""
    source: str = ""
    """Of the order: `workbench`, `api`, or `wire` for a client of the runtime itself; empty: not known."""
    at_ns: int = 0
    """Unix time."""
    program: str = ""
    """What a script calls itself."""
    address: str = ""

    def __str__(self) -> str:
        """As the log tells it: `anna, workbench, 10.0.0.7`."""
        parts = (self.user, self.source, self.program, self.address)
        return ", ".join(part for part in parts if part) or "unknown"


NOBODY = Origin()


@dataclass(frozen=True, slots=True)
class Force:
    """One forced variable, what it held before, and where the force comes from."""

    value: PlacedValue
    before: bytes
    origin: Origin = NOBODY


class ForceTable:
    """The forced variables of an application, in the order in which they were forced."""

    def __init__(self) -> None:
        self._forces: dict[tuple[int, int | None], Force] = {}

    def __len__(self) -> int:
        return len(self._forces)

    def __iter__(self) -> Iterator[Force]:
        return iter(self._forces.values())

    @property
    def values(self) -> list[PlacedValue]:
        """What the executive stores at begin and end of each cycle."""
        return [f.value for f in self._forces.values()]

    def set(self, value: PlacedValue, before: bytes, origin: Origin) -> None:
        """Force a variable, or give a forced one another value; the value before the first force is kept."""
        key = (value.place.offset, value.place.bit)
        known = self._forces.get(key)
        same = known is not None and known.value.place == value.place
        kept = known.before if known is not None and same else before
        self._forces[key] = Force(value, kept, origin)

    def release(self, places: Iterable[tuple[int, int | None]] | None) -> list[Force]:
        """Take forces off, all with None; returns those that were there."""
        if places is None:
            released = list(self._forces.values())
            self._forces.clear()
            return released
        return [self._forces.pop(key) for key in places if key in self._forces]

    def move(self, moved: dict[Place, Place | None]) -> list[Place]:
        """After an online change: new places; returns the old places of forces whose variable is gone."""
        gone = [f.value.place for f in self._forces.values() if moved[f.value.place] is None]
        kept = [(moved[f.value.place], f) for f in self._forces.values()]
        self._forces = {
            (place.offset, place.bit): Force(PlacedValue(place, f.value.data), f.before, f.origin)
            for place, f in kept
            if place is not None
        }
        return gone
