"""One loaded application: its image, linked code and tasks, and what may change while they run."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from pathlib import Path

from tappet.codegen.constants import constants_within
from tappet.codegen.package import EXIT_SYMBOL, INIT_SYMBOL, CodePackage
from tappet.iec.memory import ChangeReserve
from tappet.runtime.application_code import ApplicationCode
from tappet.runtime.contexts import FAULTED, RUNNING, STUCK_LIMIT_S, Contexts, IoBuffers, queue_slot
from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Block
from tappet.runtime.faults import RawFault
from tappet.runtime.files import ApplicationFiles
from tappet.runtime.flight import FlightSettings, make_flight
from tappet.runtime.forces import Force, ForceTable, Origin, PlacedValue, ValueList
from tappet.runtime.heap import ApplicationHeap
from tappet.runtime.image import Image
from tappet.runtime.logbook import Logbook
from tappet.runtime.outside_values import OutsideValues
from tappet.runtime.places import Place, path_at
from tappet.runtime.program_log import ProgramLog
from tappet.runtime.retain import (
    LIVE,
    Kept,
    KeptValue,
    Remanent,
    RetainFile,
    matching,
)
from tappet.runtime.retain_groups import by_task, remanent_of
from tappet.runtime.sampled import Sampled
from tappet.runtime.task_group import TaskError, TaskGroup
from tappet.runtime.tasks import TaskOwnership
from tappet.runtime.threads import NORMAL, Scheduling
from tappet.runtime.watched import WatchedProperties

QUEUE_LENGTH = 256
_READ_TRIES = 50


class LoadedApplication(ApplicationCode):
    """A code package in memory. Its owner serialises the calls; the tasks run beside them."""

    def __init__(
        self,
        executive: Executive,
        package: CodePackage,
        *,
        virtual: bool = False,
        scheduling: Scheduling = NORMAL,
        stuck_limit_s: float = STUCK_LIMIT_S,
        flight: FlightSettings | None = None,
        folder: Path | None = None,
        image_address: int = 0,
    ) -> None:
        """`folder` holds the data of the runtime, its files among them; at `image_address` the image is put
        where that is free."""
        self.executive = executive
        self.package = package
        self.virtual = virtual
        self.stuck_limit_s = stuck_limit_s
        self.image = Image(package.image_size, ChangeReserve(*package.facts.reserve), image_address)
        self.heap = ApplicationHeap(executive, package.facts.heap_limit, poison=package.facts.heap_poison)
        try:
            self.code = self.link(package)
        except BaseException:
            self.heap.close()
            self.image.close()
            raise
        self.contexts = Contexts(
            executive, package, self.image.address, virtual=virtual, stuck_limit_s=stuck_limit_s
        )
        self.tasks = TaskGroup(executive, self.contexts, scheduling)
        self.log = ProgramLog(executive)
        self.files = ApplicationFiles(executive, folder)
        self.contexts.application["pLog"] = self.log.address
        self.contexts.application["pFiles"] = self.files.address
        self.contexts.application["pHeap"] = self.heap.address
        self.ownership = TaskOwnership(package)
        self.forces = ForceTable()
        self.sampled = Sampled(self)
        self.recorders = self.sampled.recorders
        self.called = ""
        """What was called last beside the tasks."""
        self.watched = WatchedProperties(self.image)
        self.watched.load(package)
        self.retain_file: RetainFile | None = None
        self._rarely_kept: list[tuple[int, int]] = []
        """Remanent bytes of tasks that may not run for long, from and to."""
        self.variant = None
        self.buffers = IoBuffers(Block(self.area("I")[1]), Block(self.area("Q")[1]), Block(8))
        self.outside = OutsideValues()
        self._batches: list[list[tuple[int, ValueList]]] = [[] for _ in package.tasks]
        self.connect_code(self.code)
        self.connect_io()
        self.flight = make_flight(self, flight or FlightSettings())
        self.connect_flight()

    def connect_flight(self) -> None:
        """Let the bus cycle task record the image as it is now; what was kept is dropped. While no task
        runs."""
        if self.flight is None:
            return
        self.flight.relocate()
        for i, task in enumerate(self.contexts.tasks):
            address = self.flight.address if i == self.ownership.bus else 0
            self.executive.store(task.place("pFlight"), address)

    def run(self) -> None:
        """State RUNNING, with the flight recorder beginning first."""
        if self.flight is not None:
            self.flight.begin()
        self.tasks.set_state(RUNNING)

    def area(self, name: str) -> tuple[int, int]:
        """Offset and size of the area I, Q or M; (0, 0) when the application has none."""
        place = self.package.data_objects.get(f"tappet.area.{name}")
        return (place.offset, place.size) if place else (0, 0)

    def count_change(self) -> None:
        """What programs are told of the package that the application has become by an online change."""
        context = self.contexts.application
        context["onlineChanges"] = context["onlineChanges"] + 1
        self.contexts.identify(self.package)

    def connect_io(self) -> None:
        """The bus cycle task moves both areas between the image and the drivers' buffers."""
        bus = self.ownership.bus
        if bus is None:
            return
        areas = {name: self.area(name) for name in "IQ"}
        block = self.contexts.io_list(self.image.address, areas, self.buffers)
        self.tasks.publish(self.contexts.tasks[bus].place("pIo"), block.address, block)

    # -- initial values ----------------------------------------------------------------------------------

    def initialise(self, kept: Kept, *, keep_no_init: bool = False) -> RawFault | None:
        """Initial image, initialisers, then the kept values; only while no task runs.

        Returns the fault when an initialiser raised one; the application is then in the state FAULTED.
        """
        saved = [(o, self.image.read(o, n)) for o, n in self.package.no_init] if keep_no_init else []
        self.image.write(0, self.package.initial_image)
        self.files.reset()
        self.heap.reset()
        for task in self.contexts.tasks:
            task["started"] = 0
            task["eventLast"] = 0
            task["pending"] = 0
            task["raisedLast"] = task["raised"]
            task["programCycles"] = task["progress"] = 0
            self.contexts.watchdog(task)["overruns"] = 0
            self.contexts.clear_statistics(task)
        self.contexts.application["pFaulted"] = 0
        if self.flight is not None:
            self.flight.renew()
        self.sampled.restart()
        if self.virtual:
            self.contexts.application["virtualNow"] = 0
            self.contexts.application["nextScan"] = 0
            for task in self.contexts.tasks:
                task["due"] = 0
        else:
            self.contexts.application["startNs"] = time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        fault = self.call_beside("initialisation", self.code[INIT_SYMBOL])
        for offset, data in saved:
            self.image.write(offset, data)
        self._restore(kept)
        if fault is not None:
            self.mark_faulted()
        return fault

    def hold(self, kept: Kept) -> None:
        """State FAULTED with initial and kept values, but no code was called; only while no task runs."""
        self.image.write(0, self.package.initial_image)
        self._restore(kept)
        self.mark_faulted()

    def _restore(self, kept: Kept) -> None:
        """Kept values take their places; constants among them have the values that they are declared with."""
        remanent = self.remanent()
        restored = matching(kept, remanent)[0]
        persistent = {r.variable.path for r in remanent if r.persistent}
        found = len(persistent.intersection(variable.path for variable, _ in restored))
        self.contexts.application["persistence"] = found and (1 if found == len(persistent) else 2)
        if not restored:
            return
        places = [(variable.offset, variable.size) for variable, _ in restored]
        declared = [(o, self.image.read(o, n)) for o, n in constants_within(self.package.symbols, places)]
        for variable, data in restored:
            self.image.write(variable.offset, data)
        for offset, data in declared:
            self.image.write(offset, data)

    def call_beside(self, what: str, code: int) -> RawFault | None:
        """Call code that belongs to no task; an exception in it is told with `what`."""
        self.called = what
        return self.tasks.call(code)

    def mark_faulted(self) -> None:
        """State FAULTED because of code that belongs to no task."""
        self.contexts.application["pFaulted"] = self.contexts.service.address
        self.tasks.set_state(FAULTED)

    def run_exit(self) -> RawFault | None:
        """FB_Exit of all instances (LDEC-105); only while no task runs."""
        if EXIT_SYMBOL not in self.package.exports:
            return None
        return self.call_beside("FB_Exit", self.code[EXIT_SYMBOL])

    # -- remanence ---------------------------------------------------------------------------------------

    def remanent(self) -> list[Remanent]:
        """All RETAIN and PERSISTENT variables."""
        return remanent_of(self.package)

    def kept_values(self, *, retain: bool) -> Kept:
        """Present values of the persistent variables, of the retained ones if asked for; only while no task
        runs."""
        return {
            r.variable.path.upper(): KeptValue(
                r.variable.type_signature, self.image.read(r.variable.offset, r.variable.size), r.persistent
            )
            for r in self.remanent()
            if r.persistent or retain
        }

    def open_retain_file(self, folder: Path) -> None:
        """Let the tasks keep their remanent variables in `folder`; only while no task runs."""
        self.close_retain_file()
        variables = self.remanent()
        if not variables:
            return
        groups = by_task(variables, self.ownership)
        file = RetainFile(self.executive, folder / LIVE, list(groups.values()), self.image.address)
        self.retain_file = file
        for task, group in zip(groups, file.groups, strict=True):
            if task is None or self.package.tasks[task].kind not in ("cyclic", "freewheeling"):
                kept = [r.variable for r in groups[task]]
                self._rarely_kept += [(v.offset, v.offset + v.size) for v in kept]
            if task is not None:
                self.executive.store(self.contexts.tasks[task].place("pRetain"), group.address)

    def close_retain_file(self) -> None:
        """Save nothing any more; only while no task runs."""
        for task in self.contexts.tasks:
            self.executive.store(task.place("pRetain"), 0)
        if self.retain_file is not None:
            self.retain_file.close()
            self.retain_file = None
        self._rarely_kept = []

    def save_retain(self) -> None:
        """Everything remanent to disk, complete; only while no task runs."""
        if self.retain_file is not None:
            self._keep()
            self.retain_file.save()

    def _keep(self) -> None:
        """Everything remanent into the mapped file, as the end of a cycle does; only while no task runs."""
        if self.retain_file is not None:
            for group in self.retain_file.groups:
                self.executive.save_retain(group.address)

    # -- values ------------------------------------------------------------------------------------------

    def read(self, places: Sequence[tuple[int, int]]) -> list[bytes]:
        """Bytes of the image, all between two cycles of the task that owns the first, if it pauses."""
        for offset, size in places:
            self.image.check(offset, size)
        owner = self.ownership.of(places[0][0]) if places else None
        if owner is None:
            return [self.image.read(*place) for place in places]
        cell = self.contexts.tasks[owner].place("sequence")
        values: list[bytes] = []
        for _ in range(_READ_TRIES):
            before = self.executive.load(cell)
            values = [self.image.read(*place) for place in places]
            if before % 2 == 0 and self.executive.load(cell) == before:
                break
            time.sleep(0)
        return values

    def write(self, values: Sequence[PlacedValue]) -> list[tuple[int, int]]:
        """Queue values for the begin of a cycle of the task that owns them; all of one call for one task are
        stored together. Returns tickets for `written`. TaskError when the queue of a task is full."""
        for value in values:
            self._check(value.place)
        self._simulate_inputs(values)
        by_task: dict[int | None, list[PlacedValue]] = {}
        for value in values:
            by_task.setdefault(self._writer(value.place.offset), []).append(value)
        if len(by_task) > 1 and None not in by_task:
            # one task's cycle is one moment for all of them: the bus cycle task takes the batch
            by_task = {self.ownership.bus: list(values)}
        tickets = []
        for task, batch in by_task.items():
            values_list = ValueList(self.executive.layouts, self.image.address, batch)
            if self.halted:
                self.executive.apply_values(values_list.address)
            elif task is None or self.virtual:
                with self.tasks.standing():
                    self.executive.apply_values(values_list.address)
                    self._keep()
                    values_list.cycle = self._next_cycle()
                self.outside.wrote(None, values_list, batch)
            else:
                tickets.append((task, self._queue(task, values_list)))
                self.outside.wrote(task, values_list, batch)
        return tickets

    def _writer(self, offset: int) -> int | None:
        """Task that stores a written value; None when all tasks are to stand for it.

        What the task that keeps it may not save for long is saved at once.
        """
        if any(start <= offset < end for start, end in self._rarely_kept):
            return None
        return self.ownership.regular(offset)

    def _next_cycle(self) -> int:
        """Number of the next cycle of the bus cycle task."""
        bus = self.ownership.bus
        return 0 if bus is None else self.contexts.tasks[bus]["cycle"] + 1

    def _queue(self, task: int, batch: ValueList) -> int:
        queue = self.contexts.queues[task]
        taken = self.executive.load(queue.place("taken"))
        self._batches[task] = [b for b in self._batches[task] if b[0] >= taken]
        number = queue["written"]
        if number - taken >= QUEUE_LENGTH:
            name = self.package.tasks[task].name
            raise TaskError(
                f"{QUEUE_LENGTH} writes wait for a cycle of task {name}; it does not run often enough"
            )
        self._batches[task].append((number, batch))
        self.executive.store(queue_slot(queue, number), batch.address)
        self.executive.store(queue.place("written"), number + 1)
        return number

    def written(self, tickets: Iterable[tuple[int, int]]) -> bool:
        """Whether the writes behind these tickets have been stored."""
        return all(self.executive.load(self.contexts.queues[t].place("taken")) > n for t, n in tickets)

    # -- I/O ---------------------------------------------------------------------------------------------

    def put_inputs(self, offset: int, data: bytes) -> None:
        """A driver's input bytes; the bus cycle task takes over either all of them or none."""
        if offset < 0 or offset + len(data) > self.area("I")[1]:
            raise ValueError(f"{len(data)} bytes at {offset} lie outside the input area")
        cell = self.buffers.sequence.address
        number = self.executive.load(cell)
        self.executive.store(cell, number + 1)
        self.buffers.inputs.view()[offset : offset + len(data)] = data
        self.executive.store(cell, number + 2)

    def outputs(self) -> bytes:
        """What drivers are to send now."""
        return bytes(self.buffers.outputs.view()[: self.area("Q")[1]])

    def _simulate_inputs(self, values: Sequence[PlacedValue]) -> None:
        """Without a driver nothing else fills the inputs: a written input stays."""
        start, size = self.area("I")
        for value in values:
            offset = value.place.offset - start
            if not 0 <= offset < size:
                continue
            data = value.data
            if value.place.bit is not None:
                mask = 1 << value.place.bit
                old = self.buffers.inputs.view()[offset]
                data = bytes([old | mask if data[0] & 1 else old & ~mask])
            self.put_inputs(offset, data[: size - offset])

    def _check(self, place: Place) -> None:
        self.image.check(place.offset, place.size)

    # -- forces ------------------------------------------------------------------------------------------

    def force(self, values: Sequence[PlacedValue], origin: Origin) -> None:
        """Hold variables at values, at begin and end of every cycle, until released."""
        for value in values:
            self._check(value.place)
        for value in values:
            self.forces.set(value, self._present(value.place), origin)
        self.publish_forces()

    def _present(self, place: Place) -> bytes:
        data = self.image.read(place.offset, place.size)
        return data if place.bit is None else bytes([data[0] >> place.bit & 1])

    def unforce(self, keys: Iterable[tuple[int, int | None]] | None, *, restore: bool = False) -> list[Force]:
        """Release forces, all with None; with `restore` the variables get back what they held before
        (WAT-09).
        """
        released = self.forces.release(keys)
        self.publish_forces()
        if restore and released:
            self.write([PlacedValue(f.value.place, f.before) for f in released])
        return released

    def publish_forces(self) -> None:
        """Hand the table to the tasks; without tasks the values are stored once."""
        cell = self.contexts.application.place("pForces")
        self.outside.forced(self._next_cycle(), self.forces.values)
        if not len(self.forces):
            self.tasks.publish(cell, 0, None)
            return
        values = ValueList(self.executive.layouts, self.image.address, self.forces.values)
        self.tasks.publish(cell, values.address, values)
        if not self.contexts.tasks or self.halted:
            self.executive.apply_values(values.address)

    def look_after(self, log: Logbook) -> None:
        """What is due beside the cycles; called some times a second."""
        self.log.collect(log)
        self._log_failed_monitoring(log)
        if self.flight is not None:
            self.flight.let_go()

    def _log_failed_monitoring(self, log: Logbook) -> None:
        """Note the watched properties whose Get has ended in an exception; the application runs on."""
        self.sampled.ask_for_watched()
        for offset, size in self.watched.failed():
            name = path_at(self.package.symbols, Place(offset, size)) or f"offset {offset}"
            text = f"monitoring '{name}' ended in an exception of its Get, which is called no more"
            log.add("warning", "monitoring", text)

    @property
    def calls_watched(self) -> bool:
        """Whether cycles run by themselves, so that it is worth waiting for a value."""
        return not self.virtual and self.tasks.state == RUNNING

    # -- end ---------------------------------------------------------------------------------------------

    def close(self) -> None:
        """End the threads and release everything."""
        self.tasks.halt()
        if self.flight is not None:
            self.flight.close()
        self.files.close()
        self.log.close()
        self.close_retain_file()
        if self.variant is not None:
            self.variant.close()
        self.code.close()
        self.tasks.close()
        self.heap.close()
        self.image.close()
