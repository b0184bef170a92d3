"""The native contexts of one application: filled here, read by its threads."""

from __future__ import annotations

import struct
import time
from dataclasses import dataclass

from tappet.codegen.package import CodePackage, Facts, TaskSpec
from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Arena, Block, Record
from tappet.runtime.faults import RawFault
from tappet.runtime.posix import WATCHDOG_SIGNAL, libc, read_memory, write_memory
from tappet.runtime.tasks import EVENT_DRIVEN, KINDS, watchdog_threshold
from tappet.runtime.threads import TaskStack

STOPPED, RUNNING, FAULTED = 0, 1, 2
"""APPLICATION_STATE of types.st."""
SCAN_NS = 1_000_000
"""Event variables, status variables and watchdogs are looked at every millisecond."""
IDLE_SCAN_NS = 10_000_000
"""Without any of them the scheduler thread only watches for stuck tasks."""
VIRTUAL_FREEWHEEL_NS = 1_000_000
"""In virtual time a cycle takes no time, so a freewheeling task needs a pace."""
STUCK_LIMIT_S = 10.0
"""A cycle of a task without watchdog may take this long, or ten of its intervals if that is more."""


@dataclass(slots=True)
class IoBuffers:
    """What the I/O drivers see: inputs they fill, outputs they send; `sequence` is odd while they write."""

    inputs: Block
    outputs: Block
    sequence: Block


class Contexts:
    """APPLICATION_CONTEXT and the TASK_CONTEXTs of a package, with their stacks and write queues."""

    def __init__(
        self, executive: Executive, package: CodePackage, image: int, *, virtual: bool, stuck_limit_s: float
    ) -> None:
        self.executive = executive
        self.tasks_specs = package.tasks
        layouts = executive.layouts
        task_size = layouts["TASK_CONTEXT"].size
        count = len(package.tasks)
        queue_size = layouts["WRITE_QUEUE"].size
        # one context more than tasks: for initialisers and FB_Exit, which run like a cycle of no task
        self._arena = Arena(4096 + task_size * (count + 1) + (queue_size + 64) * count)
        self.application = Record(
            layouts["APPLICATION_CONTEXT"], self._arena.take(layouts["APPLICATION_CONTEXT"].size)
        )
        first = self._arena.take(task_size * (count + 1))
        self.tasks = [Record(layouts["TASK_CONTEXT"], first + i * task_size) for i in range(count)]
        self.service = Record(layouts["TASK_CONTEXT"], first + count * task_size)
        self.queues = [Record(layouts["WRITE_QUEUE"], self._arena.take(queue_size)) for _ in range(count)]
        # in virtual time all tasks share one thread, so they share its stack
        stacks = [TaskStack()] if virtual else [TaskStack() for _ in range(count)]
        self.service_stack, self.scheduler_stack, self.file_stack = TaskStack(), TaskStack(), TaskStack()
        self.stacks = stacks
        self._fill_application(first, count, virtual, package.facts)
        self.identify(package)
        for i, (spec, task) in enumerate(zip(package.tasks, self.tasks, strict=True)):
            self.fill_task(spec, task, image, stuck_limit_s)
            task["pWrites"] = self.queues[i].address
            task["startedDue"] = -1
            libc.sem_init(task.place("wake"), 0, 0)
            stacks[0 if virtual else i].describe(task)
        self.service["pApplication"] = self.application.address
        self.watchdog(self.service)["stuckLimit"] = int(stuck_limit_s * 1e9)
        self.service_stack.describe(self.service)

    def _fill_application(self, first: int, count: int, virtual: bool, facts: Facts) -> None:
        """`facts` of the package: update_io_in_stop (PLC-02), outputs_in_stop keep|default (PLC-03)."""
        application = self.application
        application["virtual"] = int(virtual)
        application["ioInStop"] = int(facts.update_io_in_stop)
        application["safeOutputs"] = int(facts.outputs_in_stop == "default")
        application["startNs"] = 0 if virtual else time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        application["virtualFreewheel"] = VIRTUAL_FREEWHEEL_NS
        application["taskCount"] = count
        application["pTasks"] = first
        application["watchdogSignal"] = WATCHDOG_SIGNAL
        watched = any(t.watchdog or t.kind in EVENT_DRIVEN for t in self.tasks_specs)
        application["scanInterval"] = SCAN_NS if watched or virtual else IDLE_SCAN_NS

    def identify(self, package: CodePackage) -> None:
        """What programs may ask of the application: its names, and when it was built."""
        self.application["compiled"] = package.facts.compiled
        _store_name(self.application, "name", package.application)
        _store_name(self.application, "project", package.facts.project)

    def fill_task(self, spec: TaskSpec, task: Record, image: int, stuck_limit_s: float) -> None:
        """What the configuration says about a task; while it runs only at a cycle boundary."""
        task["pApplication"] = self.application.address
        _store_name(task, "name", spec.name)
        task["kind"] = KINDS[spec.kind]
        task["priority"] = spec.priority
        task["interval"] = spec.interval_ns if spec.kind == "cyclic" else 0
        if spec.event_offset is not None:
            task["pEvent"] = image + spec.event_offset
            task["eventMask"] = 0xFF if spec.event_bit is None else 1 << spec.event_bit
        watchdog = self.watchdog(task)
        watchdog["stuckLimit"] = max(int(stuck_limit_s * 1e9), 10 * task["interval"])
        watchdog["limit"] = spec.watchdog.time_ns if spec.watchdog else 0
        sensitivity = spec.watchdog.sensitivity if spec.watchdog else 0
        watchdog["factor"] = max(1, sensitivity)
        watchdog["threshold"] = watchdog_threshold(sensitivity)

    def watchdog(self, task: Record) -> Record:
        """WATCHDOG_STATE of a task."""
        return task.part("watchdog", self.executive.layouts["WATCHDOG_STATE"])

    def statistics(self, task: Record) -> Record:
        """TASK_STATISTICS of a task."""
        return task.part("statistics", self.executive.layouts["TASK_STATISTICS"])

    def clear_statistics(self, task: Record) -> None:
        """All zero, at once; only while the task does not run."""
        layout = self.executive.layouts["TASK_STATISTICS"]
        write_memory(self.statistics(task).address, bytes(layout.size))

    def fault(self, task: Record) -> RawFault:
        """Copy of the fault record of a task."""
        record = task.part("fault", self.executive.layouts["FAULT_RECORD"])
        return RawFault.read(record, read_memory(record.place("frames"), record.size_of("frames")))

    def faulted_task(self) -> int | None:
        """Index of the task that ended the application, -1 for initialisation code, None when none has."""
        address = self.executive.load(self.application.place("pFaulted"))
        if not address:
            return None
        for i, task in enumerate(self.tasks):
            if task.address == address:
                return i
        return -1

    def sequences(self) -> list[int]:
        """Cycle sequences of all tasks; odd means inside a cycle."""
        load = self.executive.load
        return [load(task.place("sequence")) for task in self.tasks]

    @staticmethod
    def wall_offset() -> int:
        """Unix time of the begin of the monotonic clock, which tasks live by in real time."""
        return time.time_ns() - time.clock_gettime_ns(time.CLOCK_MONOTONIC)

    @property
    def low(self) -> bool:
        """Whether all task stacks lie below 4 GiB."""
        return all(s.low for s in self.stacks)

    def io_list(self, image: int, areas: dict[str, tuple[int, int]], buffers: IoBuffers) -> Block:
        """IO_LIST of the bus cycle task: both areas as a whole."""
        layouts = self.executive.layouts
        head, entry = layouts["IO_LIST"], layouts["IO_RANGE"]
        block = Block(head.size + 2 * entry.size)
        record = Record(head, block.address)
        record["pSequence"] = buffers.sequence.address
        for i, (area, buffer, pointer, counter) in enumerate(
            (
                ("I", buffers.inputs, "pInputs", "inputCount"),
                ("Q", buffers.outputs, "pOutputs", "outputCount"),
            )
        ):
            offset, size = areas.get(area, (0, 0))
            item = Record(entry, block.address + head.size + i * entry.size)
            item["pImage"] = image + offset
            item["pBuffer"] = buffer.address
            item["size"] = min(size, buffer.size)
            record[pointer] = item.address
            record[counter] = 1 if size else 0
        return block

    def close(self) -> None:
        """Release stacks and contexts; all threads must have ended."""
        for stack in (*self.stacks, self.service_stack, self.scheduler_stack, self.file_stack):
            stack.close()
        self._arena.close()


def queue_slot(queue: Record, number: int) -> int:
    """Address of the place of write batch `number` in a queue of 256."""
    return queue.place("batches") + struct.calcsize("Q") * (number % 256)


def _store_name(record: Record, member: str, name: str) -> None:
    """A name as programs read it: UTF-8, cut to the member behind a whole character, zeros up to its end."""
    size = record.size_of(member)
    data = name.encode()[: size - 1].decode(errors="ignore").encode()
    write_memory(record.place(member), data.ljust(size, b"\0"))
