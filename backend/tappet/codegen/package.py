"""The code package: everything a runtime needs to load one application.

Serialised with msgspec (MessagePack) behind a magic and a version; the types below are the format.
`from_bytes` checks foreign bytes and names the faulty field.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct, field

from tappet.codegen.converted_values import Conversion, convert
from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbol_types import Bit
from tappet.iec.heap import DEFAULT_HEAP
from tappet.iec.memory import DEFAULT_RESERVE, MAX_IMAGE
from tappet.iec.places import SourceMap
from tappet.iec.task import SOFT_PLC, TaskKind, TaskPolicy, Watchdog

MAGIC = b"TAPPET-PKG"
VERSION = 3
MAX_PACKAGE = 1 << 30
"""Largest accepted serialised package in bytes."""

INIT_SYMBOL = "tappet.init"
"""`void()`: runs every initialiser that is no constant; call it after `initial_image` was copied."""
ONLINE_CHANGE_SYMBOL = "tappet.online_change"
"""`void()`: present with an online change; call it once after moves and `initialise` were done."""
EXIT_SYMBOL = "tappet.exit"
"""`void()`: calls FB_Exit of all instances; call it before the application is replaced by a download."""
COPY_EXIT_PREFIX = "tappet.copy_exit."
"""`void()` for each data object with such instances, behind it the symbol of the object: calls FB_Exit with
bInCopyCode TRUE; call it before an online change moves or removes the object (LDEC-105, LDEC-106)."""


Natural = Annotated[int, Meta(ge=0)]


class PackageError(ValueError):
    """The bytes are no valid package of this version."""


class TaskSpec(Struct, frozen=True):
    """One task of the application as it lies in the package: with the places that the build gives it."""

    name: str
    kind: TaskKind = "cyclic"
    interval_ns: int = 10_000_000
    """Period of a cyclic task; 0 for the other kinds."""
    priority: Annotated[int, Meta(ge=SOFT_PLC.highest_priority, le=SOFT_PLC.lowest_priority)] = 1
    """0 (highest) to 31."""
    event: str | None = None
    """Path of the BOOL variable of an event or status task, name of the event of an external one."""
    event_offset: Natural | None = None
    """Place of that variable in the image, filled by the build."""
    event_bit: Bit | None = None
    """Bit of it when it is a bit address, else None: the whole byte."""
    watchdog: Watchdog | None = None
    programs: tuple[str, ...] = ()
    """Programs in calling order."""
    processors: tuple[Natural, ...] = ()
    """Processors that it may run on; none: as the runtime does by itself."""
    policy: TaskPolicy = "fifo"
    """How the operating system runs it."""
    symbol: str = ""
    """Exported function that runs one cycle of the programs, filled by the build."""


class DataObject(Struct, frozen=True, array_like=True):
    """Place of a data object in the image."""

    offset: Natural
    size: Natural


class RemanentRange(Struct, frozen=True, array_like=True):
    """One RETAIN or PERSISTENT variable; identified by path and type, not by offset."""

    path: str
    offset: Natural
    size: Natural
    type_signature: str
    """Changes whenever the layout or the meaning of the bytes changes."""


class OnlineChange(Struct, frozen=True):
    """How to get from the running application to this one without stopping it.

    Order: link, call what `left_behind` names in the old code, put the image of `rearranged` into place, call
    `ONLINE_CHANGE_SYMBOL`. With `moves` and `initialise` empty only code changed and nothing else is swapped.
    """

    base_code_id: str
    base_data_id: str
    moves: tuple[tuple[Natural, Natural, Natural], ...] = ()
    """(old offset, new offset, size); unchanged data objects stay where they are and are not listed."""
    initialise: tuple[tuple[Natural, Natural], ...] = ()
    """(offset, size) in the new image that get their bytes from `initial_image`."""
    reasons: tuple[str, ...] = ()
    """What changed, one line each, for the user."""
    refused: str = ""
    """Why the running application cannot become this one; '' when it can."""
    bits: tuple[tuple[Natural, Bit, Natural, Bit], ...] = ()
    """(old offset, old bit, new offset, new bit) of BIT members whose structure changed."""
    conversions: tuple[Conversion, ...] = ()
    """Values whose type has changed; where one does not fit, the initial value stays."""


class Facts(Struct):
    """What the runtime and the next build want to know besides."""

    byte_addressing: bool = False
    signatures: dict[str, str] = field(default_factory=dict)
    """Layout of each data object: an equal one may keep its place."""
    created: dict[str, str] = field(default_factory=dict)
    """Layout of what __NEW makes."""
    watched: list[tuple[Natural, Natural, Natural]] = field(default_factory=list)
    """Offset, size and asking byte of values that are monitored by a call."""
    project: str = ""
    """Name of the project."""
    compiled: Natural = 0
    """Unix time of the build in s; 0: not told."""
    update_io_in_stop: bool = True
    """PLC-02."""
    outputs_in_stop: Literal["keep", "default"] = "keep"
    """PLC-03."""
    heap_limit: Natural = DEFAULT_HEAP.limit
    """Bytes that __NEW may take in all."""
    life_cycle: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Function block types, in upper case, with FB_INIT, FB_REINIT or FB_EXIT, and which of them."""
    reserve: tuple[Natural, Natural] = (DEFAULT_RESERVE.percent, DEFAULT_RESERVE.least)
    """Memory to set aside for online changes: percent of the data, bytes at least."""
    heap_poison: bool = DEFAULT_HEAP.poison
    """Whether memory is filled when __DELETE gives it back."""


class CodePackage(Struct, repr_omit_defaults=True):
    """A linked-ready application."""

    application: str
    code_id: str
    """Hash of the object code and the layout."""
    data_id: str
    """Hash of the layout: equal means the same data image."""
    triple: str
    objects: list[bytes]
    """ELF relocatable objects importing `tappet.data.*`, `tappet.area.*`, `tappet_fault`, `tappet_now_ns`,
    libc and libm."""
    image_size: Annotated[int, Meta(ge=0, le=MAX_IMAGE)]
    data_objects: dict[str, DataObject]
    """By external symbol (`tappet.data.PLC_PRG`, `tappet.area.I`)."""
    initial_image: bytes
    """Constant initial values of the whole image; as long as `image_size`."""
    tasks: list[TaskSpec]
    symbols: SymbolMap
    retain: list[RemanentRange] = field(default_factory=list)
    persistent: list[RemanentRange] = field(default_factory=list)
    exports: list[str] = field(default_factory=list)
    """Functions the objects define for the runtime: tasks, init, exit, online change."""
    type_ids: dict[str, int] = field(default_factory=dict)
    """Number of each function block type as stored in its instances; kept over online changes."""
    online_change: OnlineChange | None = None
    no_init: list[tuple[Natural, Natural]] = field(default_factory=list)
    """(offset, size) of variables that keep their value at every reset (attribute no_init)."""
    facts: Facts = field(default_factory=Facts)
    source_maps: dict[str, SourceMap] = field(default_factory=dict)
    """What the lines of the texts show, by uri: from the line of a fault to an object or a drawn element."""

    def to_bytes(self) -> bytes:
        """Serialise; the inverse of `from_bytes`."""
        packed = msgspec.structs.replace(self, initial_image=_pack_image(self.initial_image))
        return MAGIC + bytes([VERSION]) + msgspec.msgpack.encode(packed)

    @classmethod
    def from_bytes(cls, data: bytes) -> CodePackage:
        """Read a package; raises PackageError naming the field that is wrong."""
        head = len(MAGIC) + 1
        if len(data) > MAX_PACKAGE:
            raise PackageError(f"package of {len(data)} bytes is larger than {MAX_PACKAGE}")
        if data[: len(MAGIC)] != MAGIC or len(data) < head:
            raise PackageError("not a Tappet code package")
        if data[len(MAGIC)] != VERSION:
            raise PackageError(
                f"package version {data[len(MAGIC)]} is not {VERSION}; rebuild the application"
            )
        try:
            package = _DECODER.decode(memoryview(data)[head:])
            package.initial_image = _unpack_image(package.initial_image, package.image_size)
        except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
            raise PackageError(f"damaged package: {error}") from error
        _check(package)
        return package


_DECODER = msgspec.msgpack.Decoder(CodePackage)
_IMAGE = msgspec.msgpack.Decoder(list[tuple[Natural, bytes]])


def _check(package: CodePackage) -> None:
    """What the types do not say: everything lies inside the image. Raises PackageError."""
    if not all(code[:4] == b"\x7fELF" for code in package.objects):
        raise PackageError("objects: every entry must be an ELF object")
    for what, offset, size in _places(package):
        if offset + size > package.image_size:
            raise PackageError(
                f"{what} at {offset}, {size} bytes, lies outside the image of {package.image_size} bytes"
            )


def _places(package: CodePackage) -> Iterator[tuple[str, int, int]]:
    """What it is, offset and size of everything that has to lie inside the image."""
    for name, place in package.data_objects.items():
        yield f"data object {name}", place.offset, place.size
    for remanent in (*package.retain, *package.persistent):
        yield f"remanent variable {remanent.path}", remanent.offset, remanent.size
    for offset, size in package.no_init:
        yield "no_init: a range", offset, size
    for task in package.tasks:
        if task.event_offset is not None:
            yield f"task {task.name}: the event variable", task.event_offset, 1
    for offset, size, asking in package.facts.watched:
        yield "a watched value", offset, size
        yield "the asking byte of a watched value", asking, 1
    change = package.online_change
    if change is not None:
        for _, offset, size in change.moves:
            yield "online change: what moves", offset, size
        for offset, size in change.initialise:
            yield "online change: what is initialised", offset, size
        for _, _, offset, _ in change.bits:
            yield "online change: a bit", offset, 1
        for conversion in change.conversions:
            yield "online change: what is converted", conversion.target.offset, conversion.target.size


def _pack_image(image: bytes) -> bytes:
    """Image as (offset, bytes) pairs without long runs of zeros."""
    parts: list[tuple[int, bytes]] = []
    page = 256
    run_start: int | None = None
    for at in range(0, len(image), page):
        used = any(image[at : at + page])
        if used and run_start is None:
            run_start = at
        elif not used and run_start is not None:
            parts.append((run_start, image[run_start:at]))
            run_start = None
    if run_start is not None:
        parts.append((run_start, image[run_start:]))
    return msgspec.msgpack.encode(parts)


def _unpack_image(packed: bytes, size: int) -> bytes:
    image = bytearray(size)
    for at, chunk in _IMAGE.decode(packed):
        if at + len(chunk) > size:
            raise PackageError(f"initial_image does not fit the image of {size} bytes")
        image[at : at + len(chunk)] = chunk
    return bytes(image)


def rearranged(package: CodePackage, before: bytes) -> bytearray:
    """The image after an online change: old values at their new places, new variables with initial values."""
    change = package.online_change
    assert change is not None
    after = bytearray(package.image_size)
    shared = min(len(before), len(after))
    after[:shared] = before[:shared]
    for source, target, size in change.moves:
        after[target : target + size] = before[source : source + size]
    for offset, size in change.initialise:
        after[offset : offset + size] = package.initial_image[offset : offset + size]
    for source, old_bit, target, new_bit in change.bits:
        cleared = after[target] & ~(1 << new_bit)
        after[target] = cleared | (before[source] >> old_bit & 1) << new_bit
    for conversion in change.conversions:
        convert(before, after, conversion)
    return after


def left_behind(old: CodePackage, new: CodePackage) -> list[str]:
    """Functions of the old code to call before its data objects are moved or removed, in their order."""
    change = new.online_change
    sources: list[int] = []
    if change is not None:
        sources = sorted(
            [start for start, _, _ in change.moves]
            + [start for start, _, _, _ in change.bits]
            + [conversion.source.offset for conversion in change.conversions]
        )
    found = []
    for symbol, place in old.data_objects.items():
        function = COPY_EXIT_PREFIX + symbol
        if function not in old.exports:
            continue
        moved = any(place.offset <= start < place.offset + place.size for start in sources)
        if moved or new.data_objects.get(symbol) != place:
            found.append(function)
    return found
