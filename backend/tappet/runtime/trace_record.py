"""One record of a trace in native memory: what is sampled, into which ring, and what can be read of it.

Samples are numbered from the download on. A reader never takes anything away: it asks for samples by number,
so that any number of clients see the same ones, and learns which are overwritten.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from tappet.codegen.expressions.program import KIND_SIZE, Base, ExpressionProgram, Kind, Op
from tappet.codegen.symbol_types import Bit
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.expressions import ExpressionMemory, NativeExpression, memory_of
from tappet.runtime.recorder import merge_ranges

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication

HEADER_SIZE = 16
"""Cycle (i64) and unix time in ns (i64) before the values of a frame."""
SLACK = 64
"""Frames more than a reader may see: the task writes the next ones while it copies."""
MOST_SOURCES = 256
MOST_SAMPLES = 1_000_000
MOST_BYTES = 256 << 20
"""Of one ring."""
MOST_TAKEN = 2 << 20
"""Bytes of samples in one reply."""
MOST_RESERVE = 64 << 20
"""Bytes that a ring has beyond the wanted samples, for a reader that comes now and then."""

NumberType = Literal["u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8"]
TraceState = Literal["stopped", "recording", "waiting", "triggered", "done"]
_STATES: tuple[TraceState, ...] = ("stopped", "recording", "waiting", "triggered", "done")
COMMANDS = {"stop": 1, "start": 2, "rearm": 3}
"""TRACE_COMMAND of types.st."""
Command = Literal["stop", "start", "rearm"]


class TraceSource(Struct, frozen=True):
    """What is sampled: bytes of the image, or the value of an expression as LREAL."""

    channel: Annotated[int, Meta(ge=0, le=100_000)]
    """Number of the channel in the settings of the record."""
    name: Annotated[str, Meta(max_length=4096)]
    type_name: Annotated[str, Meta(max_length=4096)]
    number: NumberType
    """How the bytes of a frame are read; f8 for an expression."""
    offset: Annotated[int, Meta(ge=0, lt=1 << 48)] | None = None
    bit: Bit | None = None
    truth: bool = False
    """BOOL: only the lowest bit counts."""
    program: ExpressionProgram | None = None

    @property
    def size(self) -> int:
        """Bytes in a frame."""
        return int(self.number[1])


class TraceRecordSpec(Struct, frozen=True):
    """What a task samples together, and when."""

    name: Annotated[str, Meta(max_length=100)]
    task: Annotated[str, Meta(max_length=200)] | None
    every: Annotated[int, Meta(ge=1, le=1_000_000)]
    samples: Annotated[int, Meta(ge=1, le=MOST_SAMPLES)]
    """What the ring shows (TRC-27)."""
    reserve: Annotated[int, Meta(ge=0, le=MOST_SAMPLES)]
    """Older samples that can still be read for a while."""
    after: Annotated[int, Meta(ge=0, le=MOST_SAMPLES)]
    """Samples behind the trigger (TRC-23)."""
    sources: Annotated[list[TraceSource], Meta(max_length=MOST_SOURCES)]
    condition: ExpressionProgram | None = None
    rise: ExpressionProgram | None = None
    fall: ExpressionProgram | None = None


class TraceRecordStatus(Struct, frozen=True):
    """A record as it is now."""

    name: str
    task: str
    interval_ns: int
    """Of a cyclic task, else 0."""
    every: int
    state: TraceState
    samples: int
    """Wanted length of the ring."""
    written: int
    """Samples since the download; their numbers count from 0."""
    first: int
    """Number of the oldest sample that belongs to the picture."""
    oldest: int
    """Number of the oldest sample that can be read."""
    trigger_sample: int | None
    trigger_ns: int | None
    after: int
    remaining: int
    """Samples that are still to come behind the trigger."""
    frame_size: int
    sources: list[TraceSource]


class TraceFrames(Struct, frozen=True):
    """Samples as they lie in the ring."""

    first: int
    """Number of the first one; later than asked for where older ones are overwritten."""
    count: int
    data: bytes


def loaded_places(program: ExpressionProgram) -> list[tuple[int, int]]:
    """Offset and size of what an expression reads of the image, but for what addresses lead to."""
    return [
        (step.a, KIND_SIZE[Kind(step.kind)])
        for step in program.steps
        if step.op == Op.LOAD and step.b == Base.IMAGE
    ]


class NativeTraceRecord:
    """A TRACE_RECORD of the executive. Lives as long as the object."""

    def __init__(self, application: LoadedApplication, spec: TraceRecordSpec) -> None:
        self.spec = spec
        self._executive = application.executive
        self.task = application.ownership.number(spec.task)
        image = application.image
        places = [(s.offset or 0, s.size) for s in spec.sources if s.program is None]
        for offset, size in places:
            image.check(offset, size)
        expressions = [s.program for s in spec.sources if s.program is not None]
        conditions = [p for p in (spec.condition, spec.rise, spec.fall) if p is not None]
        loaded = {place for program in (*expressions, *conditions) for place in loaded_places(program)}
        self.places = (*places, *sorted(loaded))
        """What is read of the image: properties that are monitored by a call are kept up to date."""
        values = 8 * len(expressions) + sum(size for _, size in places)
        self.frame_size = HEADER_SIZE + -(-values // 8) * 8
        reserve = min(spec.reserve, MOST_RESERVE // self.frame_size)
        self.capacity = spec.samples + reserve + SLACK
        if self.capacity * self.frame_size > MOST_BYTES:
            raise ValueError(
                f"the ring of '{spec.name}' would take {self.capacity * self.frame_size >> 20} MiB;"
                f" at most {MOST_BYTES >> 20} are possible: choose fewer samples or variables"
            )
        self._ring = Block(self.frame_size * self.capacity)
        self._view = self._ring.view()
        self._memory: ExpressionMemory = memory_of(application)
        layouts = self._executive.layouts
        self._block = Block(layouts["TRACE_RECORD"].size)
        self.record = record = Record(layouts["TRACE_RECORD"], self._block.address)
        self._kept: list[object] = []
        record["divider"], record["capacity"], record["frameSize"] = (
            spec.every,
            self.capacity,
            self.frame_size,
        )
        record["pRing"], record["pMemory"] = self._ring.address, self._memory.address
        record["after"], record["triggerSample"] = spec.after, -1
        context = application.contexts.application
        record["epoch"] = (
            context["epochOffset"] if application.virtual else application.contexts.wall_offset()
        )
        self._range(places, image.address)
        self._expressions(expressions, image.size)
        for name, program in (("pCondition", spec.condition), ("pRise", spec.rise), ("pFall", spec.fall)):
            record[name] = self._native(program, image.size).address if program is not None else 0

    def _native(self, program: ExpressionProgram, image_size: int) -> NativeExpression:
        found = NativeExpression(self._executive, program, image_size)
        self._kept.append(found)
        return found

    def _range(self, places: list[tuple[int, int]], image: int) -> None:
        ranges = merge_ranges(places)
        layout = self._executive.layouts["MEMORY_RANGE"]
        block = Block(layout.size * len(ranges))
        for entry, (offset, size) in zip(block.array(layout, len(ranges)), ranges, strict=True):
            entry["pMemory"], entry["size"] = image + offset, size
        self._kept.append(block)
        self.record["pRanges"], self.record["rangeCount"] = block.address, len(ranges)

    def _expressions(self, programs: list[ExpressionProgram], image_size: int) -> None:
        layout = self._executive.layouts["TRACE_EXPRESSION"]
        block = Block(layout.size * len(programs))
        for entry, program in zip(block.array(layout, len(programs)), programs, strict=True):
            entry["pExpression"], entry["kind"] = self._native(program, image_size).address, program.kind
        self._kept.append(block)
        self.record["pExpressions"], self.record["expressionCount"] = block.address, len(programs)

    # -- what clients do ---------------------------------------------------------------------------------

    def command(self, name: Command) -> None:
        """Have the task start, stop or arm the record at the end of its next cycle."""
        self._executive.store_flag(self.record.place("command"), COMMANDS[name])

    @property
    def commanded(self) -> bool:
        """Whether a command waits for the task."""
        return bool(self.record["command"])

    def postpone(self, duration_ns: int) -> None:
        """The clock of the application goes back so far; only while the task stands."""
        self.record["epoch"] = self.record["epoch"] + duration_ns

    def _written(self) -> int:
        return self._executive.load(self.record.place("written"))

    def _oldest(self, written: int) -> int:
        """The frame behind the last one may be half written: it takes the place of the oldest."""
        return max(0, written - self.capacity + 1)

    def status(self, task: str, interval_ns: int) -> TraceRecordStatus:
        """As of now."""
        record, spec = self.record, self.spec
        written = self._written()
        trigger = record["triggerSample"]
        return TraceRecordStatus(
            name=spec.name,
            task=task,
            interval_ns=interval_ns,
            every=spec.every,
            state=_STATES[record["state"]],
            samples=spec.samples,
            written=written,
            first=max(record["begun"], written - spec.samples),
            oldest=self._oldest(written),
            trigger_sample=trigger if trigger >= 0 else None,
            trigger_ns=record["triggerTime"] if trigger >= 0 else None,
            after=spec.after,
            remaining=record["remaining"] if trigger >= 0 else spec.after,
            frame_size=self.frame_size,
            sources=spec.sources,
        )

    def take(self, first: int, limit: int) -> TraceFrames:
        """At most `limit` samples from number `first` on, or from the oldest one that is left."""
        written = self._written()
        start = max(first, self._oldest(written))
        count = max(0, min(limit, MOST_TAKEN // self.frame_size, written - start))
        data = self._copy(start, count)
        # what the task has begun to overwrite meanwhile is no sample any more
        lost = max(0, min(count, self._oldest(self._written()) - start))
        return TraceFrames(start + lost, count - lost, data[lost * self.frame_size :])

    def _copy(self, first: int, count: int) -> bytes:
        size = self.frame_size
        start = first % self.capacity
        behind = min(count, self.capacity - start)
        data = bytes(self._view[start * size : (start + behind) * size])
        if count > behind:
            data += bytes(self._view[: (count - behind) * size])
        return data
