"""Native threads of tasks: own stacks below 4 GiB with guard pages, real-time priority where permitted."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace

from tappet.codegen.package import TaskSpec
from tappet.iec.memory import STACK_SIZE
from tappet.runtime.executive.records import Record
from tappet.runtime.posix import (
    PAGE,
    WATCHDOG_SIGNAL,
    Mapping,
    ThreadOptions,
    create_thread,
    join_thread,
    map_memory,
    signal_thread,
    symbol_address,
)

GUARD_SIZE = 1 << 20
"""Large, because a function with a big frame may jump over a single guard page."""
SIGNAL_STACK_SIZE = 64 << 10


class TaskStack:
    """Stack of one native thread, guard pages below it, and the stack its signal handler runs on.

    It begins at a multiple of its size: instrumented code finds its lowest word, where it keeps the innermost
    frame, from any address in it.
    """

    def __init__(self) -> None:
        self._room: Mapping = map_memory(GUARD_SIZE + 2 * STACK_SIZE, low=True)
        low = -(-(self._room.address + GUARD_SIZE) // STACK_SIZE) * STACK_SIZE
        self.mapping = Mapping(low - GUARD_SIZE, GUARD_SIZE + STACK_SIZE)
        self.mapping.protect(0, GUARD_SIZE, accessible=False)
        self.signal_stack: Mapping = map_memory(SIGNAL_STACK_SIZE)

    @property
    def low(self) -> bool:
        """Whether the stack lies below 4 GiB."""
        return self._room.low

    def describe(self, task: Record) -> None:
        """Set the bounds of the stack in a task context."""
        task["guardLow"] = self.mapping.address
        task["stackLow"] = self.mapping.address + GUARD_SIZE
        task["stackHigh"] = self.mapping.address + self.mapping.size
        task["pSignalStack"] = self.signal_stack.address
        task["signalStackSize"] = self.signal_stack.size

    def close(self) -> None:
        """Release it; the thread must have ended."""
        self._room.close()
        self.signal_stack.close()


@dataclass(frozen=True, slots=True)
class Scheduling:
    """How the threads of the runtime are scheduled, and what has to be said about it in the log."""

    realtime: bool
    cpus: frozenset[int] | None = None
    notes: tuple[str, ...] = ()

    def task_options(self, name: str, priority: int, *, freewheeling: bool) -> ThreadOptions:
        """Priority 0 becomes SCHED_FIFO 80, 31 becomes 49. A freewheeling task never pauses, so at real-time
        priority it would take its processor from everything else; it always runs at normal priority."""
        if not self.realtime or freewheeling:
            return ThreadOptions(name)
        return ThreadOptions(name, 80 - priority, self.cpus)

    def options_of(self, spec: TaskSpec) -> ThreadOptions:
        """The same, with what the task group says: its processors, as far as they are there, and policy."""
        options = self.task_options(spec.name, spec.priority, freewheeling=spec.kind == "freewheeling")
        there = available_processors() & set(spec.processors)
        if spec.policy == "normal":
            options = ThreadOptions(options.name)
        return replace(
            options,
            cpus=frozenset(there) if there else options.cpus,
            round_robin=options.fifo is not None and spec.policy == "round_robin",
        )

    def shortage(self, spec: TaskSpec) -> list[str]:
        """What the log has to say where the host has fewer processors than the group of a task names."""
        there = available_processors()
        lacking = sorted(set(spec.processors) - there)
        if not lacking:
            return []
        kept = sorted(set(spec.processors) & there)
        instead = f"processor {_listed(kept)}" if kept else "the processors that tasks without group run on"
        return [
            f"task {spec.name} runs on {instead}: its task group names processor {_listed(lacking)}, "
            f"and this host has {_listed(sorted(there))}"
        ]

    def scheduler_options(self) -> ThreadOptions:
        """The thread of events and watchdogs stands above all tasks."""
        return ThreadOptions("scheduler", 81 if self.realtime else None)


def available_processors() -> set[int]:
    """Processors of the host that this process may use."""
    return os.sched_getaffinity(0)


def _listed(numbers: list[int]) -> str:
    return ", ".join(str(number) for number in numbers)


NORMAL = Scheduling(False)
"""Without real-time priority: virtual time, tests, previews."""


def real_time_scheduling(*, pin: bool = True) -> Scheduling:
    """Real-time scheduling as far as this host permits it.

    With `pin` all tasks share one processor: then exactly one runs at a time, the one of highest priority, as
    TASK-41 to TASK-44 demand, and the services of the process have the other processors.
    """
    stack = TaskStack()
    try:
        # a thread that ends at once shows whether the priority is permitted
        thread = create_thread(
            symbol_address("sched_yield"), 0, stack.mapping, GUARD_SIZE, ThreadOptions("probe", 49)
        )
        join_thread(thread, 5)
    except PermissionError:
        return Scheduling(
            False,
            notes=(
                "tasks run at normal priority: this host does not permit SCHED_FIFO "
                "(grant CAP_SYS_NICE or an rtprio limit of 81)",
            ),
        )
    finally:
        stack.close()
    available = sorted(os.sched_getaffinity(0))
    if not pin or len(available) < 2:
        return Scheduling(True, notes=("tasks run at SCHED_FIFO 80 (priority 0) to 49 (priority 31)",))
    cpu = available[-1]
    return Scheduling(
        True,
        frozenset((cpu,)),
        (f"tasks run at SCHED_FIFO 80 (priority 0) to 49 (priority 31) on processor {cpu}",),
    )


def wait_waking(ended: Callable[[float], bool], wake: Callable[[], None], timeout_s: float) -> bool:
    """Wait for what a thread is to do, waking it again and again; `ended` waits for so many seconds at most.
    False when it has not ended after `timeout_s`."""
    step_s, waited_s = 0.01, 0.0
    while not ended(step_s):
        if waited_s >= timeout_s:
            return False
        waited_s += step_s
        wake()
    return True


class NativeThread:
    """A running native thread; it must be joined before its stack is released."""

    def __init__(self, entry: int, argument: int, stack: TaskStack, options: ThreadOptions) -> None:
        self.options = options
        self._handle = create_thread(entry, argument, stack.mapping, GUARD_SIZE, options)
        self._joined = False

    def wake(self) -> None:
        """Interrupt a sleep of the thread (the watchdog signal does nothing else outside programs)."""
        if not self._joined:
            signal_thread(self._handle, WATCHDOG_SIGNAL)

    def join(self, timeout_s: float, *, waker: Callable[[], None] | None = None) -> bool:
        """Wait for its end, waking it again and again; False when it still runs after `timeout_s`."""
        if not self._joined:
            self._joined = wait_waking(
                lambda step_s: join_thread(self._handle, step_s), waker or self.wake, timeout_s
            )
        return self._joined


assert GUARD_SIZE % PAGE == 0
