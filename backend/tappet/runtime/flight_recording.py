"""A recording of the flight recorder as a file: past cycles of an application, and all it takes to show and
replay them elsewhere.

The file is text, so that a project folder and a browser can hold it: a line `TAPPET-FLIGHT 2 sha256=...`,
then the digested bytes in base64: MessagePack of `FlightRecording`, deflated. `read_recording` checks foreign
files completely before anything is made of them.
"""

from __future__ import annotations

import base64
import binascii
import hashlib
import re
import zlib
from typing import Annotated

import msgspec
from msgspec import Meta, Struct

from tappet.codegen.package import MAX_PACKAGE, CodePackage, PackageError
from tappet.iec.memory import MAX_IMAGE
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight_deltas import BLOCK, FlightError, delta_runs
from tappet.runtime.flight_tasks import TaskProgress

VERSION = 2
ENDING = "flight"
MAX_FILE = 16 * 1024 * 1024
"""Characters of a file: a text of a project object holds no more (project.data.MAX_TEXT)."""
MAX_CONTENT = 512 << 20
"""Bytes of what is deflated in it."""
MOST_BETWEEN = 100_000
"""Cycles of a task between two of the bus cycle task."""
_HEAD = re.compile(r"TAPPET-FLIGHT (\d{1,4}) sha256=([0-9a-f]{64})\n")
_COLUMNS = 76
_SLACK = 0.94

Natural = Annotated[int, Meta(ge=0, le=(1 << 63) - 1)]
Offset = Annotated[int, Meta(ge=0, lt=MAX_IMAGE)]
Bit = Annotated[int, Meta(ge=0, le=7)]


class RecordingError(ValueError):
    """The file is no recording, or a damaged one."""


class RecordedCycle(Struct, frozen=True, array_like=True):
    """The end of one cycle of the bus cycle task."""

    cycle: Natural
    timestamp_ns: Natural
    """Unix time."""
    due_ns: int
    """When it was to begin, by the clock of the application (`start_ns` is its zero)."""
    delta: bytes
    """What the changed blocks held before (`flight_deltas`)."""
    tasks: list[TaskProgress]
    """All tasks; the bus cycle task has just ended its programs."""


class RecordedTask(Struct, frozen=True):
    """Where a task stood when the recording was taken."""

    name: str
    end: TaskProgress


class RecordedValue(Struct, frozen=True, array_like=True):
    """Bytes, or one bit, that came from outside."""

    offset: Offset
    bit: Bit | None
    data: bytes


class RecordedWrite(Struct, frozen=True):
    """Values that were stored together at the begin of a cycle of a task, by its number."""

    task: Natural
    cycle: Natural
    values: list[RecordedValue]


class RecordedForces(Struct, frozen=True):
    """All forces from a cycle of the bus cycle task on."""

    cycle: Natural
    values: list[RecordedValue]


class FlightRecording(Struct, frozen=True):
    """Past cycles of one application."""

    application: str
    project: str
    code_id: str
    data_id: str
    saved_ns: Natural
    """Unix time."""
    package: bytes
    """The code package, with symbols and source maps."""
    image_address: Natural
    """Where the image lay: pointers in it mean that."""
    image_size: Annotated[int, Meta(ge=0, le=MAX_IMAGE)]
    base: bytes
    """The image at the end of the last cycle, in whole blocks."""
    cycles: list[RecordedCycle]
    """Oldest first."""
    bus: Natural | None
    """Number of the bus cycle task."""
    tasks: list[RecordedTask]
    start_ns: int
    """Zero of the application's time, on the clock of `due_ns`."""
    epoch_ns: int
    """Unix time where that clock is 0."""
    period: Annotated[int, Meta(ge=1)] = 1
    """An entry every so many cycles."""
    parts: Annotated[int, Meta(ge=1)] = 1
    """More than 1: entries cover parts of a large image in turn."""
    virtual: bool = False
    writes: list[RecordedWrite] = []
    forces: list[RecordedForces] = []
    exception: ExceptionReport | None = None

    def code(self) -> CodePackage:
        """The package; raises RecordingError for a damaged one."""
        try:
            package = CodePackage.from_bytes(self.package)
        except PackageError as error:
            raise RecordingError(f"the recording holds no usable code: {error}") from error
        if package.image_size != self.image_size:
            raise RecordingError(
                f"the recording's image has {self.image_size} bytes, that of its code {package.image_size}"
            )
        return package


_DECODER = msgspec.msgpack.Decoder(FlightRecording)


def write_recording(recording: FlightRecording, limit: int = MAX_FILE) -> str:
    """The file of a recording; its oldest cycles are left out where it would be longer than `limit`.
    Raises RecordingError where not even the last cycle fits."""
    while True:
        text = _armoured(recording)
        if len(text) <= limit:
            return text
        count = len(recording.cycles)
        if count <= 1:
            raise RecordingError(
                f"one cycle takes {len(text)} characters; a recording has at most {limit}. The image of the"
                " application is too large to be kept with a project"
            )
        keep = min(count - 1, max(1, int(count * limit / len(text) * _SLACK)))
        recording = msgspec.structs.replace(recording, cycles=recording.cycles[-keep:])


def _armoured(recording: FlightRecording) -> str:
    content = zlib.compress(msgspec.msgpack.encode(recording), 6)
    body = base64.b64encode(content).decode()
    lines = "\n".join(body[at : at + _COLUMNS] for at in range(0, len(body), _COLUMNS))
    return f"TAPPET-FLIGHT {VERSION} sha256={hashlib.sha256(content).hexdigest()}\n{lines}\n"


def read_recording(text: str) -> FlightRecording:
    """The recording in a file; raises RecordingError that says what is wrong with it."""
    if len(text) > MAX_FILE:
        raise RecordingError(f"{len(text)} characters are more than a recording has: {MAX_FILE}")
    head = _HEAD.match(text)
    if head is None:
        raise RecordingError("this is no recording of the flight recorder: its first line is another one")
    if int(head[1]) != VERSION:
        raise RecordingError(f"the recording has version {head[1]}; this Tappet reads version {VERSION}")
    try:
        content = base64.b64decode("".join(text[head.end() :].split()), validate=True)
    except (binascii.Error, ValueError) as error:
        raise RecordingError(f"the recording is damaged: {error}") from error
    if hashlib.sha256(content).hexdigest() != head[2]:
        raise RecordingError("the recording is damaged: its digest is another one")
    inflater = zlib.decompressobj()
    try:
        data = inflater.decompress(content, MAX_CONTENT)
        if not inflater.eof:
            raise RecordingError("the recording is damaged: its content is cut off or too large")
        recording = _DECODER.decode(data)
    except (zlib.error, msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        raise RecordingError(f"the recording is damaged: {error}") from error
    _check(recording)
    return recording


def _check_order(cycle: int, before: list[TaskProgress], behind: list[TaskProgress]) -> None:
    """A task goes on, and not endlessly between two cycles of the bus cycle task."""
    for was, now in zip(before, behind, strict=True):
        if not 0 <= now.completed - was.completed <= MOST_BETWEEN:
            raise RecordingError(
                f"a task of the recording has run {now.completed - was.completed} cycles up to cycle {cycle}"
            )


def _check(recording: FlightRecording) -> None:
    """What the types do not say. Raises RecordingError."""
    size = -(-recording.image_size // BLOCK) * BLOCK
    if len(recording.base) != size:
        raise RecordingError(f"the recording's image has {len(recording.base)} bytes instead of {size}")
    if not recording.cycles:
        raise RecordingError("the recording holds no cycle")
    if len(recording.package) > MAX_PACKAGE:
        raise RecordingError("the recording's code is too large")
    if recording.bus is not None and recording.bus >= len(recording.tasks):
        raise RecordingError(f"the recording has no task number {recording.bus}")
    before, tasks = -1, recording.cycles[0].tasks
    for one in recording.cycles:
        if one.cycle <= before:
            raise RecordingError(f"cycle {one.cycle} of the recording comes behind cycle {before}")
        before = one.cycle
        try:
            delta_runs(one.delta, size)
        except FlightError as error:
            raise RecordingError(f"cycle {one.cycle} of the recording is damaged: {error}") from error
        if len(one.tasks) != len(recording.tasks):
            raise RecordingError(
                f"cycle {one.cycle} of the recording has {len(one.tasks)} tasks of {len(recording.tasks)}"
            )
        _check_order(one.cycle, tasks, one.tasks)
        tasks = one.tasks
    if recording.bus is not None:
        end = [task.end for task in recording.tasks]
        if end[recording.bus].completed == tasks[recording.bus].completed:
            _check_order(before, tasks, end)
    for write in recording.writes:
        if write.task >= len(recording.tasks):
            raise RecordingError(f"the recording has no task number {write.task}")
    for value in (v for listed in (recording.writes, recording.forces) for w in listed for v in w.values):
        if value.offset + len(value.data) > recording.image_size:
            raise RecordingError(f"a value at offset {value.offset} of the recording lies outside its image")
