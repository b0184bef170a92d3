"""From the settings of a trace object to what the runtime samples.

A variable with a fixed place is copied as it is; one behind a pointer, a computed index or an operator
becomes an expression whose value is sampled as LREAL.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal, TypeVar

from tappet.codegen.expressions.compiler import (
    compile_condition,
    compile_crossing,
    compile_expression,
    place_of,
)
from tappet.codegen.expressions.places import ExpressionError, Place, elementary_of
from tappet.codegen.expressions.program import ExpressionProgram
from tappet.codegen.package import TaskSpec
from tappet.codegen.symbol_map import SymbolMap
from tappet.lang.types import Kind
from tappet.project.trace import TraceData, TraceRecord
from tappet.runtime.sampled import TraceSpec
from tappet.runtime.trace_record import NumberType, TraceRecordSpec, TraceSource

Field = Literal["variable", "condition", "trigger.variable", "trigger.level", "task"]
RESERVE_NS = 20_000_000_000
"""A reader that comes at least so often loses no sample."""
_FALLBACK_INTERVAL_NS = 1_000_000
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class TraceProblem:
    """What is wrong with the settings of a trace, and where."""

    record: int
    channel: int | None
    field: Field
    message: str


class TraceSettingsError(ValueError):
    """The trace cannot be downloaded; `problems` says why."""

    def __init__(self, problems: Sequence[TraceProblem]) -> None:
        super().__init__("; ".join(problem.message for problem in problems))
        self.problems = list(problems)


@dataclass(frozen=True, slots=True)
class TraceTask:
    """What a trace needs to know of a task."""

    name: str
    interval_ns: int
    """0 unless it is cyclic."""


def trace_tasks(tasks: Sequence[TaskSpec]) -> list[TraceTask]:
    """Of an application."""
    return [TraceTask(t.name, t.interval_ns if t.kind == "cyclic" else 0) for t in tasks]


def samples_behind_trigger(samples: int, position: int) -> int:
    """How many samples follow the trigger: round(N * p / 100) (trace.md, section 9; trace EX-01)."""
    return math.floor(samples * position / 100 + 0.5)


def compile_trace(
    name: str, data: TraceData, symbols: SymbolMap, tasks: Sequence[TraceTask], code_id: str, author: str
) -> TraceSpec:
    """What the runtime gets; TraceSettingsError with everything that is wrong."""
    problems: list[TraceProblem] = []
    records = [
        _RecordCompiler(number, record, symbols, problems).compiled(tasks, data.points)
        for number, record in enumerate(data.records)
    ]
    if problems:
        raise TraceSettingsError(problems)
    settings = data.model_dump_json().encode()
    return TraceSpec(name, code_id, settings, data.digest(), author, records)


class _RecordCompiler:
    def __init__(
        self, number: int, record: TraceRecord, symbols: SymbolMap, problems: list[TraceProblem]
    ) -> None:
        self.number = number
        self.record = record
        self.symbols = symbols
        self.problems = problems

    def tried(self, field: Field, channel: int | None, make: Callable[[], T]) -> T | None:
        """What `make` gives; a problem is noted."""
        try:
            return make()
        except ExpressionError as error:
            self.problems.append(TraceProblem(self.number, channel, field, str(error)))
            return None

    def compiled(self, tasks: Sequence[TraceTask], points: int) -> TraceRecordSpec:
        """The record; what is wrong is among the problems."""
        record, symbols = self.record, self.symbols
        task = self._task(tasks)
        samples = min(record.buffer, points)
        condition = None
        if record.condition.strip():
            condition = self.tried("condition", None, lambda: compile_condition(record.condition, symbols))
        sources = [
            self.tried("variable", number, partial(self._source, number, channel.variable))
            for number, channel in enumerate(record.channels)
            if channel.recorded
        ]
        interval = (task.interval_ns if task is not None else 0) or _FALLBACK_INTERVAL_NS
        return TraceRecordSpec(
            name=record.name,
            task=task.name if task is not None else None,
            every=record.every,
            samples=samples,
            reserve=min(1_000_000, RESERVE_NS // (interval * record.every)),
            after=samples_behind_trigger(samples, record.trigger.position),
            sources=[source for source in sources if source is not None],
            condition=condition,
            rise=self._edge(upwards=True),
            fall=self._edge(upwards=False),
        )

    def _task(self, tasks: Sequence[TraceTask]) -> TraceTask | None:
        wanted = self.record.task.strip()
        for task in tasks:
            if not wanted or task.name.upper() == wanted.upper():
                return task
        names = ", ".join(task.name for task in tasks) or "none"
        text = (
            f"the application has no task '{wanted}'; it has {names}"
            if wanted
            else "the application has no task"
        )
        self.problems.append(TraceProblem(self.number, None, "task", text))
        return None

    def _edge(self, *, upwards: bool) -> ExpressionProgram | None:
        trigger, symbols = self.record.trigger, self.symbols
        if trigger.edge not in ("both", "positive" if upwards else "negative"):
            return None
        value, level = trigger.variable, trigger.level
        if upwards or trigger.edge == "negative":  # said once
            before = len(self.problems)
            self.tried("trigger.variable", None, lambda: compile_expression(value, symbols))
            if len(self.problems) > before:
                return None
            return self.tried("trigger.level", None, lambda: compile_crossing(value, level, upwards, symbols))
        try:
            return compile_crossing(value, level, upwards, symbols)
        except ExpressionError:
            return None

    def _source(self, number: int, variable: str) -> TraceSource:
        text = variable.strip()
        place = place_of(text, self.symbols)
        if place is not None and place.info.kind != "reference":
            return _copied(number, text, place)
        program = compile_expression(text, self.symbols)
        return TraceSource(number, text, program.type_name, "f8", program=program)


def _copied(number: int, text: str, place: Place) -> TraceSource:
    """A variable that is sampled as it lies in the image."""
    if place.bit is not None:
        return TraceSource(number, text, "BOOL", "u1", place.offset, place.bit, truth=True)
    type_ = elementary_of(place.info, place.path)
    if type_.kind is Kind.REAL:
        number_type: NumberType = "f4" if type_.size == 4 else "f8"
    else:
        letter = "i" if type_.kind is Kind.SIGNED else "u"
        number_type = f"{letter}{type_.size}"  # type: ignore[assignment]
    return TraceSource(
        number, text, place.info.name, number_type, place.offset, truth=type_.kind is Kind.BOOL
    )
