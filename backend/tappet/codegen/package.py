"""The code package: everything a runtime needs to load one application.

Serialised with msgpack behind a magic and a version; `from_bytes` checks foreign bytes and names
the faulty field.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import msgpack

from tappet.codegen.symbol_map import SymbolMap

MAGIC = b"TAPPET-PKG"
VERSION = 1
MAX_IMAGE = 1 << 30
"""Largest accepted memory image in bytes; the image has to lie below 2 GiB."""
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


class PackageError(ValueError):
    """The bytes are no valid package of this version."""


@dataclass(frozen=True, slots=True)
class WatchdogSpec:
    """Watchdog of a task: fires when `time_ns` is exceeded `sensitivity` times in a row (TASK rules)."""

    time_ns: int
    sensitivity: int = 1


@dataclass(frozen=True, slots=True)
class TaskSpec:
    """One task of the application."""

    name: str
    kind: str = "cyclic"
    """cyclic, freewheeling, event or status."""
    interval_ns: int = 10_000_000
    """Period of a cyclic task; 0 for the other kinds."""
    priority: int = 1
    """0 (highest) to 31."""
    event: str | None = None
    """Path of the BOOL variable of an event or status task."""
    event_offset: int | None = None
    """Place of that variable in the image, filled by the build."""
    event_bit: int | None = None
    """Bit of it when it is a bit address, else None: the whole byte."""
    watchdog: WatchdogSpec | None = None
    programs: tuple[str, ...] = ()
    """Programs in calling order."""
    symbol: str = ""
    """Exported function that runs one cycle of the programs, filled by the build."""


@dataclass(frozen=True, slots=True)
class DataObject:
    """Place of a data object in the image."""

    offset: int
    size: int


@dataclass(frozen=True, slots=True)
class RemanentRange:
    """One RETAIN or PERSISTENT variable; identified by path and type, not by offset."""

    path: str
    offset: int
    size: int
    type_signature: str
    """Changes whenever the layout or the meaning of the bytes changes."""


@dataclass(frozen=True, slots=True)
class OnlineChange:
    """How to get from the running application to this one without stopping it.

    Order: link, call what `left_behind` names in the old code, put the image of `rearranged` into place, call
    `ONLINE_CHANGE_SYMBOL`. With `moves` and `initialise` empty only code changed and nothing else is swapped.
    """

    base_code_id: str
    base_data_id: str
    moves: tuple[tuple[int, int, int], ...] = ()
    """(old offset, new offset, size); unchanged data objects stay where they are and are not listed."""
    initialise: tuple[tuple[int, int], ...] = ()
    """(offset, size) in the new image that get their bytes from `initial_image`."""
    reasons: tuple[str, ...] = ()
    """What changed, one line each, for the user."""
    refused: str = ""
    """Why the running application cannot become this one; '' when it can."""
    bits: tuple[tuple[int, int, int, int], ...] = ()
    """(old offset, old bit, new offset, new bit) of BIT members whose structure changed."""


@dataclass(slots=True)
class CodePackage:
    """A linked-ready application."""

    application: str
    code_id: str
    """Hash of the object code and the layout."""
    data_id: str
    """Hash of the layout: equal means the same data image."""
    triple: str
    objects: list[bytes] = field(repr=False)
    """ELF relocatable objects importing `tappet.data.*`, `tappet.area.*`, `tappet_fault`, `tappet_now_ns`,
    libc and libm."""
    image_size: int
    data_objects: dict[str, DataObject]
    """By external symbol (`tappet.data.PLC_PRG`, `tappet.area.I`)."""
    initial_image: bytes = field(repr=False)
    """Constant initial values of the whole image; as long as `image_size`."""
    tasks: list[TaskSpec]
    symbols: SymbolMap = field(repr=False)
    retain: list[RemanentRange] = field(default_factory=list)
    persistent: list[RemanentRange] = field(default_factory=list)
    exports: list[str] = field(default_factory=list)
    """Functions the objects define for the runtime: tasks, init, exit, online change."""
    type_ids: dict[str, int] = field(default_factory=dict)
    """Number of each function block type as stored in its instances; kept over online changes."""
    online_change: OnlineChange | None = None
    no_init: list[tuple[int, int]] = field(default_factory=list)
    """(offset, size) of variables that keep their value at every reset (attribute no_init)."""
    runtime: dict[str, Any] = field(default_factory=dict)
    """Further facts for the runtime (sizes for reports, addressing mode)."""

    def to_bytes(self) -> bytes:
        """Serialise; the inverse of `from_bytes`."""
        body = {
            "application": self.application,
            "code_id": self.code_id,
            "data_id": self.data_id,
            "triple": self.triple,
            "objects": self.objects,
            "image_size": self.image_size,
            "data_objects": {name: [d.offset, d.size] for name, d in self.data_objects.items()},
            "initial_image": _pack_image(self.initial_image),
            "tasks": [_task_to_list(t) for t in self.tasks],
            "symbols": self.symbols.to_table(),
            "retain": [[r.path, r.offset, r.size, r.type_signature] for r in self.retain],
            "persistent": [[r.path, r.offset, r.size, r.type_signature] for r in self.persistent],
            "exports": self.exports,
            "type_ids": self.type_ids,
            "online_change": _online_to_list(self.online_change),
            "no_init": [list(r) for r in self.no_init],
            "runtime": self.runtime,
        }
        packed: bytes = msgpack.packb(body, use_bin_type=True)
        return MAGIC + bytes([VERSION]) + packed

    @classmethod
    def from_bytes(cls, data: bytes) -> CodePackage:
        """Read a package; raises PackageError naming the field that is wrong."""
        body = _unpack(data)
        image_size = _typed(body, "image_size", int)
        if not 0 <= image_size <= MAX_IMAGE:
            raise PackageError(f"image_size {image_size} is outside 0..{MAX_IMAGE}")
        objects = _typed(body, "objects", list)
        if not all(isinstance(o, bytes) and o[:4] == b"\x7fELF" for o in objects):
            raise PackageError("objects: every entry must be an ELF object")
        try:
            package = cls(
                application=_typed(body, "application", str),
                code_id=_typed(body, "code_id", str),
                data_id=_typed(body, "data_id", str),
                triple=_typed(body, "triple", str),
                objects=objects,
                image_size=image_size,
                data_objects={
                    str(name): DataObject(int(place[0]), int(place[1]))
                    for name, place in _typed(body, "data_objects", dict).items()
                },
                initial_image=_unpack_image(_typed(body, "initial_image", list), image_size),
                tasks=[_task_from_list(t) for t in _typed(body, "tasks", list)],
                symbols=SymbolMap.from_table(_typed(body, "symbols", dict)),
                retain=[_range_from_list(r) for r in _typed(body, "retain", list)],
                persistent=[_range_from_list(r) for r in _typed(body, "persistent", list)],
                exports=[str(e) for e in _typed(body, "exports", list)],
                type_ids={str(k): int(v) for k, v in _typed(body, "type_ids", dict).items()},
                online_change=_online_from_list(body.get("online_change")),
                no_init=[(int(r[0]), int(r[1])) for r in _typed(body, "no_init", list)],
                runtime=_typed(body, "runtime", dict),
            )
        except PackageError:
            raise
        except (TypeError, ValueError, OverflowError, IndexError, KeyError, AttributeError) as error:
            raise PackageError(f"malformed package: {error}") from error
        _check_ranges(package)
        return package


def _typed(body: dict[str, Any], key: str, kind: type) -> Any:
    if key not in body:
        raise PackageError(f"field {key} is missing")
    value = body[key]
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise PackageError(f"field {key} must be {kind.__name__}, not {type(value).__name__}")
    return value


def _unpack(data: bytes) -> dict[str, Any]:
    head = len(MAGIC) + 1
    if len(data) > MAX_PACKAGE:
        raise PackageError(f"package of {len(data)} bytes is larger than {MAX_PACKAGE}")
    if data[: len(MAGIC)] != MAGIC or len(data) < head:
        raise PackageError("not a Tappet code package")
    if data[len(MAGIC)] != VERSION:
        raise PackageError(f"package version {data[len(MAGIC)]} is not {VERSION}; rebuild the application")
    try:
        body = msgpack.unpackb(data[head:], raw=False)
    except (ValueError, TypeError, msgpack.UnpackException) as error:
        raise PackageError(f"damaged package: {error}") from error
    if not isinstance(body, dict):
        raise PackageError("damaged package: no map at top level")
    return body


def _check_ranges(package: CodePackage) -> None:
    size = package.image_size
    for name, place in package.data_objects.items():
        if place.offset < 0 or place.size < 0 or place.offset + place.size > size:
            raise PackageError(f"data object {name} lies outside the image of {size} bytes")
    for kind in (package.retain, package.persistent):
        for r in kind:
            if r.offset < 0 or r.size < 0 or r.offset + r.size > size:
                raise PackageError(f"remanent variable {r.path} lies outside the image of {size} bytes")
    for offset, length in package.no_init:
        if offset < 0 or length < 0 or offset + length > size:
            raise PackageError(f"no_init range {offset}+{length} lies outside the image of {size} bytes")
    for task in package.tasks:
        if not 0 <= task.priority <= 31:
            raise PackageError(f"task {task.name}: priority {task.priority} is outside 0..31")
        if task.event_offset is not None and not 0 <= task.event_offset < size:
            raise PackageError(f"task {task.name}: event variable lies outside the image")
    change = package.online_change
    if change is not None:
        for _, new, length in change.moves:
            if new < 0 or length < 0 or new + length > size:
                raise PackageError(f"move to {new}+{length} lies outside the image of {size} bytes")
        for _, old_bit, offset, new_bit in change.bits:
            if not (0 <= offset < size and 0 <= old_bit < 8 and 0 <= new_bit < 8):
                raise PackageError(f"bit {offset}.{new_bit} lies outside the image of {size} bytes")
        for offset, length in change.initialise:
            if offset < 0 or length < 0 or offset + length > size:
                raise PackageError(f"initialise {offset}+{length} lies outside the image of {size} bytes")


def _pack_image(image: bytes) -> list[Any]:
    """Image as [offset, bytes, offset, bytes ...] without long runs of zeros."""
    parts: list[Any] = []
    page = 256
    run_start: int | None = None
    for at in range(0, len(image), page):
        used = any(image[at : at + page])
        if used and run_start is None:
            run_start = at
        elif not used and run_start is not None:
            parts += [run_start, image[run_start:at]]
            run_start = None
    if run_start is not None:
        parts += [run_start, image[run_start:]]
    return parts


def _unpack_image(parts: list[Any], size: int) -> bytes:
    image = bytearray(size)
    for at, chunk in zip(parts[::2], parts[1::2], strict=True):
        if not isinstance(at, int) or not isinstance(chunk, bytes) or at < 0 or at + len(chunk) > size:
            raise PackageError(f"initial_image does not fit the image of {size} bytes")
        image[at : at + len(chunk)] = chunk
    return bytes(image)


def _task_to_list(task: TaskSpec) -> list[Any]:
    watchdog = [task.watchdog.time_ns, task.watchdog.sensitivity] if task.watchdog else None
    return [
        task.name, task.kind, task.interval_ns, task.priority, task.event, task.event_offset, task.event_bit,
        watchdog, list(task.programs), task.symbol,
    ]  # fmt: skip


def _task_from_list(row: list[Any]) -> TaskSpec:
    name, kind, interval, priority, event, offset, bit, watchdog, programs, symbol = row
    if kind not in ("cyclic", "freewheeling", "event", "status"):
        raise PackageError(f"task {name}: unknown kind {kind!r}")
    return TaskSpec(
        str(name), kind, int(interval), int(priority),
        None if event is None else str(event), _optional_int(offset), _optional_int(bit),
        WatchdogSpec(int(watchdog[0]), int(watchdog[1])) if watchdog else None,
        tuple(str(p) for p in programs), str(symbol),
    )  # fmt: skip


def _optional_int(value: Any) -> int | None:
    return None if value is None else int(value)


def _range_from_list(row: list[Any]) -> RemanentRange:
    path, offset, size, signature = row
    return RemanentRange(str(path), int(offset), int(size), str(signature))


def _online_to_list(change: OnlineChange | None) -> list[Any] | None:
    if change is None:
        return None
    return [
        change.base_code_id,
        change.base_data_id,
        [list(m) for m in change.moves],
        [list(r) for r in change.initialise],
        list(change.reasons),
        change.refused,
        [list(b) for b in change.bits],
    ]


def _online_from_list(row: list[Any] | None) -> OnlineChange | None:
    if row is None:
        return None
    base_code, base_data, moves, initialise, reasons, *more = row
    refused, bits = more if len(more) == 2 else ("".join(str(r) for r in more), ())
    return OnlineChange(
        str(base_code),
        str(base_data),
        tuple((int(a), int(b), int(c)) for a, b, c in moves),
        tuple((int(a), int(b)) for a, b in initialise),
        tuple(str(r) for r in reasons),
        str(refused),
        tuple((int(a), int(b), int(c), int(d)) for a, b, c, d in bits),
    )


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
    return after


def left_behind(old: CodePackage, new: CodePackage) -> list[str]:
    """Functions of the old code to call before its data objects are moved or removed, in their order."""
    change = new.online_change
    sources = sorted(start for start, _, _ in change.moves) if change is not None else []
    found = []
    for symbol, place in old.data_objects.items():
        function = COPY_EXIT_PREFIX + symbol
        if function not in old.exports:
            continue
        moved = any(place.offset <= start < place.offset + place.size for start in sources)
        if moved or new.data_objects.get(symbol) != place:
            found.append(function)
    return found
