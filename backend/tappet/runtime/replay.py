"""Replays a recording of the flight recorder on virtual time: with what came from outside, cycle by cycle.

The recorded code is loaded, the image of the first kept cycle put into place, and each further cycle gets the
inputs, writes, forces and the time that it had. With equal code the images are compared cycle by cycle. With
other code (today's, as an online change of the recorded one) the variables that both have are compared, but
the end counts: whether it fails.

Other tasks run where they ran: with each cycle of the bus cycle task it is recorded how many cycles of them
had ended. Not recorded, and so not replayed: memory of `__NEW`, files, the moments inside a cycle at which a
program reads the clock, and what tasks that ran at the same time have seen of each other; the one that ended
first runs first. docs/flight-recorder.md tells users.
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
from tappet.runtime.flight import LEAST_MEMORY, FlightSettings
from tappet.runtime.flight_past import RecordedPast
from tappet.runtime.flight_recording import (
    FlightRecording,
    RecordedCycle,
    RecordedValue,
    RecordedWrite,
    RecordingError,
)
from tappet.runtime.flight_tasks import TaskProgress
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
from tappet.runtime.tasks import EVENT_DRIVEN

_NEVER = 1 << 62
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


_COUNTERS = ("cycle", "programCycles", "progress", "due", "pending")


@dataclass(frozen=True, slots=True)
class _Moment:
    """What a cycle changes of a replay, before it."""

    image: bytes
    now: int
    tasks: list[dict[str, int]]
    written: list[RecordedWrite]
    done: list[int]


class _Replay:
    def __init__(self, recording: FlightRecording, package: CodePackage, runtime: LocalRuntime) -> None:
        self.recording = recording
        self.package = package
        self.runtime = runtime
        assert recording.bus is not None
        self.bus = recording.bus
        if [task.name for task in recording.tasks] != [task.name for task in package.tasks]:
            raise RecordingError("the tasks of the recording are not those of its code")
        alone = (not self._met(one) for one in recording.cycles)
        self.skipped = next((number for number, found in enumerate(alone) if found), 0)
        """A replay begins behind a cycle that met none of another task: its image is of cycles that ended."""
        self.cycles = recording.cycles[self.skipped :]
        self.done = [task.completed for task in self.cycles[0].tasks]
        """Cycles that have been run of each task, of all since its initialisation."""
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
        first = next(islice(images, self.skipped, None))
        self._restore(first)
        if code is not None:
            self._change(code)
        self.application.run()
        self._force(self.cycles[0].cycle)
        number = 0
        difference = None
        faulted = False
        ended = islice(zip(self.cycles[1:], images, strict=True), self._count(until))
        for one, image in ended:
            compared = difference is None and not self._cut_short(one)
            found = self._cycle(one, image, compared=compared)
            faulted = self._failed
            if self.application.contexts.tasks[self.bus]["cycle"] == one.cycle:
                number += 1
            if faulted:
                break
            difference = difference or found
        if not faulted and until is None:
            faulted = self._run_out()
        if difference is not None:
            self._note_overlap(difference.cycle)
        values = {expression: self.runtime.literal(expression) for expression in show}
        return Replayed(
            cycles=number,
            last_cycle=self.cycles[number].cycle,
            recorded=self.recording.exception,
            fault=self.runtime.exception if faulted else None,
            difference=difference,
            notes=tuple(self.notes),
            values=values,
        )

    def _run_out(self) -> bool:
        """What other tasks ran behind the last cycle of the bus cycle task; whether one of them failed."""
        end = [task.end for task in self.recording.tasks]
        if end[self.bus].completed != self.cycles[-1].tasks[self.bus].completed:
            return False  # recording had been stopped before
        return self._run_others(end, [task.completed for task in end])

    def _met(self, one: RecordedCycle) -> bool:
        """Whether other tasks ran at the same time as a cycle of the bus cycle task."""
        return any(task.beside for number, task in enumerate(one.tasks) if number != self.bus)

    def _note_overlap(self, cycle: int) -> None:
        """That a difference in a cycle may come of tasks that ran at the same time."""
        since = next((one.cycle for one in self.cycles if self._met(one)), None)
        if since is not None and since <= cycle:
            self.notes.append(
                f"from cycle {since} on, tasks ran at the same time, and what each has seen of the other is"
                f" not recorded: from cycle {cycle} on the replay may differ for that alone"
            )

    def _count(self, until: int | None) -> int:
        cycles = self.cycles[1:]
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
        tasks = self.cycles[0].tasks
        clock["virtualNow"] = self._due(tasks[self.bus].started_ns)
        clock["nextScan"] = _NEVER  # what started the tasks of events is recorded
        for task, was in zip(application.contexts.tasks, tasks, strict=True):
            task["started"] = 1
            task["due"], task["pending"] = _NEVER, 0
            task["cycle"], task["programCycles"], task["progress"] = (
                was.cycle,
                was.completed,
                2 * was.completed,
            )

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

    def _cycle(self, one: RecordedCycle, image: bytes, *, compared: bool) -> Difference | None:
        """One cycle of the bus cycle task and those of others that ended since the one before.

        Of tasks that ran at the same time the order is taken that leads to the recorded image, which may have
        in it what a cycle did that was to end a moment later.
        """
        ended, begun = [t.after // 2 for t in one.tasks], [(t.after + 1) // 2 for t in one.tasks]
        orders = [(ended, True)]
        if compared and self._same_program and self._met(one):
            orders += [(ended, False), *((begun, first) for first in (True, False) if begun != ended)]
        kept = self._keep() if len(orders) > 1 else None
        found = None
        for done, others_first in orders:
            if found is not None and kept is not None:
                self._take_back(kept)
            difference = self._attempt(one, image, done, others_first)
            if difference is None or self._failed or not compared:
                return None
            found = found or difference
        return found

    def _attempt(
        self, one: RecordedCycle, image: bytes, done: Sequence[int], others_first: bool
    ) -> Difference | None:
        if others_first and self._run_others(one.tasks, done, one.cycle):
            return None
        self._run_bus(one, image)
        difference = self._compare(one.cycle, image)
        if others_first or self._run_others(one.tasks, done) or difference is None:
            return difference
        now = self.application.image.read(0, self.application.image.size)
        return self.comparison.difference(one.cycle, image, now)

    def _keep(self) -> _Moment:
        application = self.application
        tasks = [{name: task[name] for name in _COUNTERS} for task in application.contexts.tasks]
        now = application.contexts.application["virtualNow"]
        return _Moment(application.image.read(0, application.image.size), now, tasks, self.written, self.done)

    def _take_back(self, kept: _Moment) -> None:
        application = self.application
        application.image.write(0, kept.image)
        application.contexts.application["virtualNow"] = kept.now
        for task, counters in zip(application.contexts.tasks, kept.tasks, strict=True):
            for name, value in counters.items():
                task[name] = value
        self.written, self.done = kept.written, kept.done

    def _run_bus(self, one: RecordedCycle, image: bytes) -> None:
        """A cycle of the bus cycle task, with what it got from outside."""
        inputs = self.package.data_objects.get("tappet.area.I")
        if inputs is not None and inputs.size:
            data = image[inputs.offset : inputs.offset + inputs.size]
            self.application.put_inputs(0, data[: self.application.area("I")[1]])
        self._force(one.cycle)
        self._run(self.bus, one.tasks[self.bus].started_ns, one.due_ns)

    def _run_others(
        self, tasks: Sequence[TaskProgress], done: Sequence[int], cycle: int | None = None
    ) -> bool:
        """The cycles of other tasks up to a number of each, in the order in which they began, before a cycle
        of the bus cycle task; whether one of them failed."""
        starts = []
        for number, (task, until) in enumerate(zip(tasks, done, strict=True)):
            if number == self.bus:
                continue
            spec = self.application.package.tasks[number]
            ahead = (task.after + 1) // 2 - until  # what is known of its last start is about a later cycle
            for back in range(ahead, ahead + until - self.done[number]):
                since = back * spec.interval_ns
                starts.append((task.started_ns - since, spec.priority, number, task.requested_ns - since))
        self.done = list(done)
        for started, _, number, requested in sorted(starts):
            if cycle is not None and self.recording.virtual and started >= tasks[self.bus].started_ns:
                self._force(cycle)  # came when the time before had passed, also for what is due at the same
                self._write(self.bus, cycle)
            self._run(number, started, requested)
            if self._failed:
                return True
        return False

    @property
    def _same_program(self) -> bool:
        return isinstance(self.comparison, SameProgram)

    @property
    def _failed(self) -> bool:
        return self.runtime.state == "exception"

    def _run(self, number: int, started_ns: int, requested_ns: int) -> None:
        """One cycle of a task, at a moment."""
        application = self.application
        spec, task = application.package.tasks[number], application.contexts.tasks[number]
        clock = application.contexts.application
        now = clock["virtualNow"] = max(self._due(started_ns), clock["virtualNow"])
        self._write(number, task["cycle"] + 1)
        # a cycle that began later than the next one was due would be followed by that at once
        task["due"] = min(now, max(self._due(requested_ns), now - spec.interval_ns + 1))
        task["pending"] = int(spec.kind in EVENT_DRIVEN)
        application.tasks.run_virtual(now + 1)
        application.tasks.collect()
        task["due"], task["pending"] = _NEVER, 0

    def _write(self, number: int, cycle: int) -> None:
        """What was written at the begin of a cycle of a task."""
        application = self.application
        for write in self.written:
            if (write.task, write.cycle) == (number, cycle):
                values = list(self._placed(write.values))
                batch = ValueList(application.executive.layouts, application.image.address, values)
                application.executive.apply_values(batch.address)
        self.written = [w for w in self.written if w.task != number or w.cycle > cycle]

    def _force(self, cycle: int) -> None:
        """The forces that were valid in a cycle of the bus cycle task."""
        application = self.application
        while self.forces and self.forces[0].cycle <= cycle:
            application.forces.release(None)
            for value in self._placed(self.forces.pop(0).values):
                application.forces.set(value, b"", NOBODY)
            application.publish_forces()

    def _placed(self, values: Iterable[RecordedValue]) -> Iterator[PlacedValue]:
        for value in values:
            size = 1 if value.bit is not None else len(value.data)
            place = self.place(Place(value.offset, size, value.bit))
            if place is not None:
                yield PlacedValue(place, value.data)

    def _cut_short(self, one: RecordedCycle) -> bool:
        """Whether the recorded cycle ended in its fault, where other code goes on."""
        last = self.recording.exception is not None and one is self.cycles[-1]
        return last and not self._same_program

    def _compare(self, cycle: int, image: bytes) -> Difference | None:
        recorder = self.application.flight
        if recorder is None or recorder.parts != 1:
            return None
        return self.comparison.difference(cycle, image, recorder.newest())
