"""Replays a recording of the flight recorder on virtual time: with what came from outside, cycle by cycle.

The recorded code is loaded, the image of the first kept cycle put into place, and each further cycle gets the
inputs, writes, forces and the time that it had. With equal code the images are compared cycle by cycle. With
other code (today's, as an online change of the recorded one) the variables that both have are compared, but
the end counts: whether it fails.

Not recorded, and so not replayed: memory of `__NEW`, files, the moments inside a cycle at which a program
reads the clock, and when other tasks than the bus cycle task ran between two cycles of that one; they are
taken by their intervals and priorities. docs/flight-recorder.md tells users.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

from tappet.codegen.faults import Fault
from tappet.codegen.package import CodePackage
from tappet.iec.memory import MAX_IMAGE
from tappet.runtime.application import LoadedApplication
from tappet.runtime.errors import PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.executive.records import Record
from tappet.runtime.flight import LEAST_MEMORY, FlightSettings
from tappet.runtime.flight_past import RecordedPast
from tappet.runtime.flight_recording import (
    FlightRecording,
    RecordedCycle,
    RecordedTask,
    RecordedValue,
    RecordingError,
)
from tappet.runtime.forces import NOBODY, PlacedValue, ValueList
from tappet.runtime.local import LocalRuntime
from tappet.runtime.online_change import OnlineChangeError
from tappet.runtime.places import Place, find_again, name_at
from tappet.runtime.pointers import moved_image, pointer_places
from tappet.runtime.replay_comparison import (
    MOST_DIFFERENCES,
    AcrossPrograms,
    Comparison,
    Difference,
    SameProgram,
)

_ENTRIES = 6
"""Images of which the flight recorder of a replay has room: it tells what was at the end of a cycle of the
bus cycle task, though other tasks come behind it."""


class ReplayError(PlcError):
    """The recording cannot be replayed."""


@dataclass(frozen=True, slots=True)
class Replayed:
    """What came of a replay."""

    cycles: int
    """Cycles that were run."""
    last_cycle: int
    recorded: ExceptionReport | None
    fault: ExceptionReport | None
    difference: Difference | None = None
    """On other code of the variables that both have: what its changes came to, no fault of the replay."""
    notes: tuple[str, ...] = ()
    """What could not be replayed as it was."""
    values: dict[str, str] = field(default_factory=dict)
    """What was asked for, as IEC literals after the last cycle."""

    @property
    def same_fault(self) -> bool:
        """Whether it ended as the recorded run did: with an exception of that kind at that place, or with
        none."""
        if self.recorded is None or self.fault is None:
            return self.recorded is self.fault
        return _what(self.recorded) == _what(self.fault)


def _what(report: ExceptionReport) -> tuple[object, ...]:
    """What makes a fault the same one. Where a cycle was that took too long is a matter of time."""
    if report.name == Fault.WATCHDOG.name:
        return report.name, report.task.upper()
    return report.name, report.pou.upper(), report.line, report.task.upper()


def replay(
    recording: FlightRecording,
    *,
    code: CodePackage | None = None,
    show: Sequence[str] = (),
    until: int | None = None,
) -> Replayed:
    """Runs the recording again, up to the cycle `until` where one is given. `code` is an online change of
    the recorded code: it runs in its place. Raises RecordingError, ReplayError, and SymbolError for what
    cannot be shown."""
    if recording.bus is None:
        raise ReplayError("the recording has no bus cycle task, so it has no cycles to run")
    if recording.period != 1:
        raise ReplayError(f"the recording has every {recording.period}th cycle only; all of them are needed")
    if recording.parts != 1:
        raise ReplayError("the recorded image is so large that each cycle holds a part of it only")
    package = recording.code()
    largest = max(package.image_size, code.image_size if code is not None else 0)
    room = FlightSettings(memory=LEAST_MEMORY + _ENTRIES * largest, scan_limit=MAX_IMAGE)
    with LocalRuntime(package, start=False, flight=room, image_address=recording.image_address) as runtime:
        for expression in show:
            (code or package).symbols.resolve(expression)
        return _Replay(recording, package, runtime).run(code, show, until)


class _Replay:
    def __init__(self, recording: FlightRecording, package: CodePackage, runtime: LocalRuntime) -> None:
        self.recording = recording
        self.package = package
        self.runtime = runtime
        assert recording.bus is not None
        self.bus = recording.bus
        if [task.name for task in recording.tasks] != [task.name for task in package.tasks]:
            raise RecordingError("the tasks of the recording are not those of its code")
        self.written = sorted(recording.writes, key=lambda write: write.cycle)
        self.forces = list(recording.forces)
        self.pointers = list(pointer_places(package.symbols))
        self.notes: list[str] = []
        self.comparison: Comparison = SameProgram(
            package.symbols, self.pointers, recording.image_address, self.application.image.address
        )
        self.place: Callable[[Place], Place | None] = lambda place: place

    @property
    def application(self) -> LoadedApplication:
        application = self.runtime.plc.application
        assert application is not None
        return application

    def run(self, code: CodePackage | None, show: Sequence[str], until: int | None) -> Replayed:
        images = RecordedPast(self.recording).forward()
        self._restore(next(images))
        if code is not None:
            self._change(code)
        self.application.run()
        self._force(self.recording.cycles[0].cycle)
        self._run_due()  # tasks that come behind the bus cycle task in the moment of the first cycle
        number = 0
        difference = None
        faulted = False
        ended = islice(zip(self.recording.cycles[1:], images, strict=True), self._count(until))
        for one, image in ended:
            self._set_clock(one.timestamp_ns, one.due_ns)
            self._feed(one.cycle, image)
            self._run_due()
            number += 1
            faulted = self.runtime.state == "exception"
            if faulted:
                break
            if difference is None and not self._cut_short(one):
                difference = self._compare(one.cycle, image)
        if not faulted and until is None and self.recording.exception is not None:
            faulted = self._run_out()  # of a task that fails between two cycles of the bus cycle task
        if difference is not None and code is None and not self.recording.virtual and self._tasks_beside():
            self.notes.append(
                f"several tasks ran in real time, and in which order is not recorded: from cycle"
                f" {difference.cycle} on the replay may differ for that alone"
            )
        values = {expression: self.runtime.literal(expression) for expression in show}
        return Replayed(
            cycles=number,
            last_cycle=self.recording.cycles[number].cycle,
            recorded=self.recording.exception,
            fault=self.runtime.exception if faulted else None,
            difference=difference,
            notes=tuple(self.notes),
            values=values,
        )

    def _tasks_beside(self) -> bool:
        """Whether other tasks than the bus cycle task run programs."""
        return any(task.programs for number, task in enumerate(self.package.tasks) if number != self.bus)

    def _count(self, until: int | None) -> int:
        cycles = self.recording.cycles[1:]
        return len(cycles) if until is None else sum(1 for one in cycles if one.cycle <= until)

    # -- the beginning -----------------------------------------------------------------------------------

    def _restore(self, image: bytes) -> None:
        """Variables, clocks and tasks as they were at the end of the first recorded cycle."""
        application, recording = self.application, self.recording
        size = self.package.image_size
        fresh = application.image.read(0, size)
        data, elsewhere = moved_image(
            self.pointers, image[:size], recording.image_address, application.image.address, fresh
        )
        if elsewhere:
            names = sorted({name_at(self.package.symbols, at) for at in elsewhere})
            named = ", ".join(names[:MOST_DIFFERENCES]) + (" ..." if len(names) > MOST_DIFFERENCES else "")
            self.notes.append(
                f"these point to memory that is not recorded (of __NEW or of a call) and begin as they were"
                f" initialised: {named}"
            )
        application.image.write(0, data)
        clock = application.contexts.application
        clock["epochOffset"] = recording.epoch_ns + recording.start_ns
        first, last = recording.cycles[0], recording.cycles[-1]
        clock["virtualNow"] = self._now(first.timestamp_ns)
        clock["nextScan"] = clock["virtualNow"] + 1
        specs = application.package.tasks
        for number, (spec, task, was) in enumerate(
            zip(specs, application.contexts.tasks, recording.tasks, strict=True)
        ):
            task["started"] = 1
            if spec.event_offset is not None:
                byte = data[spec.event_offset]
                task["eventLast"] = byte if spec.event_bit is None else byte >> spec.event_bit & 1
            if number == self.bus:
                task["cycle"] = first.cycle
                task["programCycles"] = max(was.program_cycles - (last.cycle - first.cycle), 0)
                task["due"] = self._due(first.due_ns) + (spec.interval_ns or 1)
            elif spec.interval_ns and spec.kind == "cyclic":
                self._place_task(task, was, spec.interval_ns, self._comes_later(number))

    def _place_task(self, task: Record, was: RecordedTask, interval: int, later: bool) -> None:
        """The next start of another cyclic task on its grid, and its counters there. One that comes behind
        the bus cycle task in the same moment has still to run in it."""
        at = self._due(self.recording.cycles[0].due_ns)
        end = self._due(self.recording.cycles[-1].due_ns)
        due = self._due(was.due_ns)
        first = at + (due - at) % interval
        if first == at and not later:
            first += interval
        task["due"] = first
        task["cycle"] = max(was.cycle - max((due - first) // interval, 0), 0)
        task["programCycles"] = max(was.program_cycles - max((end - first) // interval + 1, 0), 0)

    def _comes_later(self, number: int) -> bool:
        specs = self.application.package.tasks
        mine, bus = specs[number], specs[self.bus]
        return (mine.priority, number) > (bus.priority, self.bus)

    def _now(self, timestamp_ns: int) -> int:
        """Time of the application at a moment."""
        return max(timestamp_ns - self.recording.epoch_ns - self.recording.start_ns, 0)

    def _due(self, due_ns: int) -> int:
        return due_ns - self.recording.start_ns

    def _change(self, code: CodePackage) -> None:
        """Other code takes over what the recorded one has left; places of what comes from outside follow."""
        if code.online_change is None or code.online_change.base_code_id != self.package.code_id:
            raise ReplayError("the code is no online change of the recorded one")
        if code.code_id == self.package.code_id:
            return
        try:
            self.runtime.plc.change(code)
        except (OnlineChangeError, PlcError) as error:
            raise ReplayError(f"today's program cannot take over the recorded variables: {error}") from error
        old, new = self.package.symbols, code.symbols
        self.place = lambda place: find_again(old, new, place)
        self.comparison = AcrossPrograms(self.package, code, self.pointers)

    # -- one cycle ---------------------------------------------------------------------------------------

    def _feed(self, cycle: int, image: bytes) -> None:
        """What the next cycle of the bus cycle task gets from outside."""
        application = self.application
        inputs = self.package.data_objects.get("tappet.area.I")
        if inputs is not None and inputs.size:
            data = image[inputs.offset : inputs.offset + inputs.size]
            application.put_inputs(0, data[: application.area("I")[1]])
        self._force(cycle)
        waiting = []
        for write in self.written:
            task = application.contexts.tasks[write.task]
            if write.cycle > task["cycle"] + 1 or not self._runs_now(write.task):
                waiting.append(write)
            elif write.cycle == task["cycle"] + 1:
                values = list(self._placed(write.values))
                batch = ValueList(application.executive.layouts, application.image.address, values)
                application.executive.apply_values(batch.address)
        self.written = waiting

    def _force(self, cycle: int) -> None:
        """The forces that were valid in a cycle of the bus cycle task."""
        application = self.application
        while self.forces and self.forces[0].cycle <= cycle:
            application.forces.release(None)
            for value in self._placed(self.forces.pop(0).values):
                application.forces.set(value, b"", NOBODY)
            application.publish_forces()

    def _runs_now(self, number: int) -> bool:
        """Whether a task comes with the next cycle of the bus cycle task."""
        contexts = self.application.contexts
        spec = self.application.package.tasks[number]
        return spec.kind != "cyclic" or contexts.tasks[number]["due"] <= contexts.application["virtualNow"]

    def _placed(self, values: Iterable[RecordedValue]) -> Iterator[PlacedValue]:
        for value in values:
            size = 1 if value.bit is not None else len(value.data)
            place = self.place(Place(value.offset, size, value.bit))
            if place is not None:
                yield PlacedValue(place, value.data)

    def _set_clock(self, timestamp_ns: int, due_ns: int) -> None:
        """The time of a cycle of the bus cycle task."""
        application = self.application
        clock, task = application.contexts.application, application.contexts.tasks[self.bus]
        interval = application.package.tasks[self.bus].interval_ns
        due = self._due(due_ns)
        now = max(self._now(timestamp_ns), due)
        if interval:
            now = min(now, due + interval - 1)
        task["due"] = due
        clock["virtualNow"] = max(now, clock["virtualNow"])

    def _run_due(self) -> None:
        """One cycle of the bus cycle task, and of what else is due."""
        application = self.application
        application.tasks.run_virtual(application.contexts.application["virtualNow"] + 1)
        application.tasks.collect()

    def _run_out(self) -> bool:
        """The rest of the time until another task failed, one interval of the slowest task at the most."""
        application = self.application
        clock = application.contexts.application
        intervals = [task.interval_ns for task in application.package.tasks if task.interval_ns]
        application.contexts.tasks[self.bus]["due"] = 1 << 62
        application.tasks.run_virtual(clock["virtualNow"] + max(intervals, default=1))
        application.tasks.collect()
        return self.runtime.state == "exception"

    def _cut_short(self, one: RecordedCycle) -> bool:
        """Whether the recorded cycle ended in its fault, where other code goes on."""
        last = self.recording.exception is not None and one is self.recording.cycles[-1]
        return last and isinstance(self.comparison, AcrossPrograms)

    def _compare(self, cycle: int, image: bytes) -> Difference | None:
        recorder = self.application.flight
        if recorder is None or recorder.parts != 1:
            return None
        return self.comparison.difference(cycle, image, recorder.newest())
