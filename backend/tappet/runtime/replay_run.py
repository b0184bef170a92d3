"""One run of a replay: the recorded image, then cycle by cycle what came from outside.

`replay` tells what is replayed; here it is put into an application on virtual time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from tappet.codegen.package import CodePackage
from tappet.runtime.application import LoadedApplication
from tappet.runtime.errors import PlcError
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
from tappet.runtime.replay_orders import MOST_AVOIDED, FoundOrders, Order, orders_differ, possible_orders
from tappet.runtime.replay_result import Replayed, ReplayError
from tappet.runtime.tasks import EVENT_DRIVEN

_NEVER = 1 << 62
_FAR = 1 << 62
"""Nearest is an order in which the recorded fault comes."""


_COUNTERS = ("cycle", "programCycles", "progress", "due", "pending")


@dataclass(frozen=True, slots=True)
class _Moment:
    """What a cycle changes of a replay, before it."""

    image: bytes
    now: int
    tasks: list[dict[str, int]]
    written: list[RecordedWrite]
    done: list[int]


class ReplayRun:
    """A recording in a fresh application."""

    def __init__(
        self,
        recording: FlightRecording,
        package: CodePackage,
        runtime: LocalRuntime,
        orders: FoundOrders,
    ) -> None:
        self.recording = recording
        self.package = package
        self.runtime = runtime
        self.orders = orders
        assert recording.bus is not None
        self.bus = recording.bus
        if [task.name for task in recording.tasks] != [task.name for task in package.tasks]:
            raise RecordingError("the tasks of the recording are not those of its code")
        self._met = orders_differ(self.bus)
        self._possible: list[Order] = []
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
            package.symbols, self.pointers, recording.image_address, self._application.image.address
        )
        self.place: Callable[[Place], Place | None] = lambda place: place

    @property
    def _application(self) -> LoadedApplication:
        application = self.runtime.plc.application
        assert application is not None
        return application

    def run(self, code: CodePackage | None, show: Sequence[str], until: int | None) -> Replayed | None:
        """What came of it; None: an order of tasks is now known to be wrong, another run is needed."""
        images = RecordedPast(self.recording).forward()
        first = next(islice(images, self.skipped, None))
        self._restore(first)
        if code is not None:
            self._change(code)
        self._application.run()
        self._force(self.cycles[0].cycle)
        number = 0
        difference = None
        faulted = False
        ended = islice(zip(self.cycles[1:], images, strict=True), self._count(until))
        for one, image in ended:
            compared = difference is None and not self._cut_short(one)
            found = self._cycle(one, image, compared=compared)
            if self._astray(one):
                return None
            faulted = self._failed
            if self._application.contexts.tasks[self.bus]["cycle"] == one.cycle:
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
        application, recording = self._application, self.recording
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
        """One cycle of the bus cycle task and those of others that ended since the one before, in the order
        of tasks that leads nearest to the recorded image."""
        self._possible = possible_orders(one.tasks, self.bus, self.done)
        orders = self.orders.of(one.cycle, self._possible)
        nearest, least = orders[0], None
        if len(orders) > 1:
            kept = self._keep()
            for order in orders:
                self.orders.chosen[one.cycle] = order
                difference, distance = self._attempt(one, image, order)
                if self._failed:
                    return None
                if distance == 0:
                    return difference
                if least is None or distance < least:
                    nearest, least = order, distance
                self._take_back(kept)
        if self.orders.searching:
            self.orders.chosen[one.cycle] = nearest
        difference, _ = self._attempt(one, image, nearest, compared=compared)
        return None if self._failed else difference

    def _attempt(
        self, one: RecordedCycle, image: bytes, order: Order, *, compared: bool = True
    ) -> tuple[Difference | None, int]:
        """A cycle in an order of the tasks; what differs, and how many variables that are."""
        if self._run_others(one.tasks, order.before, one.cycle):
            return None, 0
        self._run_bus(one, image)
        difference, distance = self._compare(one, image, self._newest()) if compared else (None, 0)
        if order.behind != order.before and not self._run_others(one.tasks, order.behind) and difference:
            # the recorded image may have in it what a cycle did that was to end a moment later
            later = self._compare(one, image, self._application.image.read(0, self._application.image.size))
            difference, distance = min((difference, distance), later, key=lambda found: found[1])
        return difference, _FAR if self._without_fault else distance

    def _compare(self, one: RecordedCycle, image: bytes, now: bytes | None) -> tuple[Difference | None, int]:
        difference = None if now is None else self.comparison.difference(one.cycle, image, now)
        if difference is None or now is None:
            return None, 0
        return difference, self.comparison.distance(image, now) if self._met(one) else 1

    @property
    def _without_fault(self) -> bool:
        """Whether a task has ended the cycle in which it failed in the recording."""
        fault = self.recording.exception
        if fault is None or self._failed:
            return False
        tasks = zip(self.package.tasks, self._application.contexts.tasks, strict=True)
        return any(spec.name == fault.task and task["cycle"] >= fault.cycle for spec, task in tasks)

    def _astray(self, one: RecordedCycle) -> bool:
        """Whether it failed otherwise than the recorded code, and another order can still be tried."""
        recorded, fault = self.recording.exception, self.runtime.exception
        chosen, avoided = self.orders.chosen.get(one.cycle), self.orders.avoided
        if not (self._failed and self.orders.searching) or chosen is None or fault is None:
            return False
        if recorded is not None and (recorded.task, recorded.cycle) == (fault.task, fault.cycle):
            return False
        avoided.add((one.cycle, chosen))
        left = any((one.cycle, order) not in avoided for order in self._possible)
        return left and len(avoided) < MOST_AVOIDED

    def _keep(self) -> _Moment:
        application = self._application
        tasks = [{name: task[name] for name in _COUNTERS} for task in application.contexts.tasks]
        now = application.contexts.application["virtualNow"]
        return _Moment(application.image.read(0, application.image.size), now, tasks, self.written, self.done)

    def _take_back(self, kept: _Moment) -> None:
        application = self._application
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
            self._application.put_inputs(0, data[: self._application.area("I")[1]])
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
            spec = self._application.package.tasks[number]
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
    def _failed(self) -> bool:
        return self.runtime.state == "exception"

    def _run(self, number: int, started_ns: int, requested_ns: int) -> None:
        """One cycle of a task, at a moment."""
        application = self._application
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
        application = self._application
        for write in self.written:
            if (write.task, write.cycle) == (number, cycle):
                values = list(self._placed(write.values))
                batch = ValueList(application.executive.layouts, application.image.address, values)
                application.executive.apply_values(batch.address)
        self.written = [w for w in self.written if w.task != number or w.cycle > cycle]

    def _force(self, cycle: int) -> None:
        """The forces that were valid in a cycle of the bus cycle task."""
        application = self._application
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
        return last and not isinstance(self.comparison, SameProgram)

    def _newest(self) -> bytes | None:
        """The image at the end of the last cycle of the bus cycle task."""
        recorder = self._application.flight
        return recorder.newest() if recorder is not None and recorder.parts == 1 else None
