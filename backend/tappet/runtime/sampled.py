"""What the tasks of one application sample at the end of their cycles: recorders and traces.

A trace lives in the application that it was downloaded to: it goes on while clients come and go, and ends
with a download or an online change of the application (TRC-70).
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from tappet.codegen.package import TaskSpec
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.recorder import Recorder, RecorderList, RecorderSpec
from tappet.runtime.trace_record import Command, NativeTraceRecord, TraceRecordSpec, TraceRecordStatus

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication

MOST_TRACES = 32
MOST_RECORDS_OF_A_TASK = 64
_PATIENCE_S = 1.0
_MOMENT_S = 0.001


class TraceSpec(Struct, frozen=True):
    """A trace as it is downloaded."""

    name: Annotated[str, Meta(min_length=1, max_length=200)]
    code_id: Annotated[str, Meta(max_length=200)]
    """Of the application whose places it has."""
    settings: Annotated[bytes, Meta(max_length=4 << 20)]
    """Given back to who uploads the trace; the runtime does not read it."""
    digest: Annotated[str, Meta(max_length=100)]
    author: Annotated[str, Meta(max_length=200)]
    records: Annotated[list[TraceRecordSpec], Meta(max_length=64)]


class TraceStatus(Struct, frozen=True):
    """A trace as it is now."""

    name: str
    application: str
    code_id: str
    digest: str
    author: str
    downloaded_ns: int
    records: list[TraceRecordStatus]


class _Trace:
    def __init__(self, spec: TraceSpec, records: list[NativeTraceRecord]) -> None:
        self.spec = spec
        self.records = records
        self.downloaded_ns = time.time_ns()


class Sampled:
    """Recorders and traces of one application. Its owner serialises the calls; the tasks run beside them."""

    def __init__(self, application: LoadedApplication) -> None:
        self._application = application
        self.recorders: dict[int, list[Recorder]] = {}
        self._traces: dict[str, _Trace] = {}

    # -- recorders ---------------------------------------------------------------------------------------

    def record(self, spec: RecorderSpec) -> Recorder:
        """Start a recorder at a task; ValueError when the task or a place does not exist."""
        application = self._application
        if not 0 <= spec.task < len(application.contexts.tasks):
            raise ValueError(f"the application has no task number {spec.task}")
        for offset, size in spec.items:
            application.image.check(offset, size)
        recorder = Recorder(application.executive, spec, application.image.address)
        self._publish_recorders(spec.task, [*self.recorders.get(spec.task, []), recorder])
        return recorder

    def end_record(self, recorder: Recorder) -> None:
        """Stop a recorder; what it has sampled can still be taken."""
        task = recorder.spec.task
        rest = [r for r in self.recorders.get(task, []) if r is not recorder]
        self._publish_recorders(task, rest)

    def _publish_recorders(self, task: int, recorders: list[Recorder]) -> None:
        application = self._application
        cell = application.contexts.tasks[task].place("pRecorders")
        listed = RecorderList(application.executive, recorders)
        self.recorders[task] = recorders
        application.tasks.publish(cell, listed.address if recorders else 0, listed)
        self.ask_for_watched()

    def ask_for_watched(self) -> None:
        """Have Get called for the properties that are watched now."""
        places = [place for found in self.recorders.values() for r in found for place in r.located]
        places += [place for record in self._records() for place in record.places]
        self._application.watched.update(places)

    def restart(self) -> None:
        """The clock of the application is about to be reset; only while the tasks stand."""
        for recorder in (r for recorders in self.recorders.values() for r in recorders):
            recorder.restart()
        if self._application.virtual:
            for record in self._records():
                record.postpone(self._application.contexts.application["virtualNow"])

    # -- traces ------------------------------------------------------------------------------------------

    def _records(self) -> Iterator[NativeTraceRecord]:
        for trace in self._traces.values():
            yield from trace.records

    def download_trace(self, spec: TraceSpec) -> TraceStatus:
        """Keep a trace, in place of one of its name; it is started apart. ValueError says what is wrong."""
        application = self._application
        package = application.package
        if spec.code_id != package.code_id:
            raise ValueError("the trace was made for another application than the loaded one")
        others = [t for key, t in self._traces.items() if key != spec.name.upper()]
        if len(others) >= MOST_TRACES:
            raise ValueError(f"there are {MOST_TRACES} traces already; remove one")
        records = [NativeTraceRecord(application, one) for one in spec.records]
        trace = _Trace(spec, records)
        per_task = [r.task for t in (*others, trace) for r in t.records]
        if any(per_task.count(task) > MOST_RECORDS_OF_A_TASK for task in per_task):
            raise ValueError(f"a task samples at most {MOST_RECORDS_OF_A_TASK} records")
        self._traces[spec.name.upper()] = trace
        self._publish_traces()
        return self._status(trace)

    def remove_trace(self, name: str) -> bool:
        """End a trace; whether there was one."""
        found = self._traces.pop(name.upper(), None)
        if found is not None:
            self._publish_traces()
        return found is not None

    def end_traces(self) -> list[str]:
        """End all traces; their names."""
        names = [trace.spec.name for trace in self._traces.values()]
        for name in names:
            self.remove_trace(name)
        return names

    def _publish_traces(self) -> None:
        application = self._application
        layout = application.executive.layouts["TRACE_LIST"]
        for number, task in enumerate(application.contexts.tasks):
            records = [r for r in self._records() if r.task == number]
            cell = task.place("pTraces")
            if not records:
                application.tasks.publish(cell, 0, None)
                continue
            block = Block(layout.size)
            Record(layout, block.address)["count"] = len(records)
            places = b"".join(r.record.address.to_bytes(8, "little") for r in records)
            at = layout.members["records"].offset
            block.view()[at : at + len(places)] = places
            application.tasks.publish(cell, block.address, (block, records))
        self.ask_for_watched()

    def find_trace(self, name: str) -> list[NativeTraceRecord] | None:
        """The records of a trace; None when there is none of this name."""
        found = self._traces.get(name.upper())
        return None if found is None else found.records

    def trace_settings(self, name: str) -> bytes | None:
        """What was downloaded with a trace."""
        found = self._traces.get(name.upper())
        return None if found is None else found.spec.settings

    def command_trace(self, name: str, command: Command) -> bool:
        """Have the tasks start, stop or arm the records; whether there is such a trace."""
        records = self.find_trace(name)
        for record in records or ():
            record.command(command)
        return records is not None

    def settle_trace(self, name: str) -> None:
        """Wait a moment until running tasks have taken the commands; those of a stopped application take them
        when it starts."""
        end = time.monotonic() + _PATIENCE_S
        while self._application.calls_watched and time.monotonic() < end:
            if not any(record.commanded for record in self.find_trace(name) or ()):
                break
            time.sleep(_MOMENT_S)

    def trace_status(self) -> list[TraceStatus]:
        """All traces."""
        return [self._status(trace) for trace in self._traces.values()]

    def _status(self, trace: _Trace) -> TraceStatus:
        package = self._application.package
        return TraceStatus(
            name=trace.spec.name,
            application=package.application,
            code_id=package.code_id,
            digest=trace.spec.digest,
            author=trace.spec.author,
            downloaded_ns=trace.downloaded_ns,
            records=[
                record.status(package.tasks[record.task].name, _interval(package.tasks[record.task]))
                for record in trace.records
            ],
        )


def _interval(task: TaskSpec) -> int:
    return task.interval_ns if task.kind == "cyclic" else 0
