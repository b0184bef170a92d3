"""The threads of an application: started, paused at cycle boundaries, ended; and lists exchanged beside
them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tappet.codegen.package import TaskSpec
from tappet.runtime.contexts import RUNNING, STOPPED, Contexts
from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Record
from tappet.runtime.faults import RawFault
from tappet.runtime.posix import libc
from tappet.runtime.tasks import KINDS
from tappet.runtime.threads import NativeThread, Scheduling
from tappet.runtime.virtual_worker import VirtualWorker

BOUNDARY_TIMEOUT_S = 5.0
"""A task that does not reach its cycle boundary within this time is taken out of its programs."""
_FIRST_START_NS = 5_000_000
_SELF_STARTING = (KINDS["cyclic"], KINDS["freewheeling"])


class TaskError(RuntimeError):
    """A task could not be brought to its cycle boundary or to its end."""


class TaskGroup:
    """All threads of one application. Its owner serialises the calls."""

    def __init__(self, executive: Executive, contexts: Contexts, scheduling: Scheduling) -> None:
        self.executive = executive
        self.contexts = contexts
        self.scheduling = scheduling
        self._threads: list[NativeThread] = []
        self._virtual: VirtualWorker | None = None
        self._wake_files: Callable[[], None] | None = None
        self._published: dict[int, object] = {}
        self._retired: list[tuple[list[int], object, Callable[[], None] | None]] = []

    # -- threads ---------------------------------------------------------------------------------------

    def launch(self, specs: list[TaskSpec]) -> list[str]:
        """Start the task threads; returns what has to be said about them in the log."""
        contexts, entries, notes = self.contexts, self.executive.entries, []
        start = time.clock_gettime_ns(time.CLOCK_MONOTONIC) + _FIRST_START_NS
        for task in contexts.tasks:
            task["due"] = start
        for spec, task, stack in zip(specs, contexts.tasks, contexts.stacks, strict=True):
            options = self.scheduling.options_of(spec)
            notes += self.scheduling.shortage(spec)
            self._threads.append(NativeThread(entries["tappet_task_thread"], task.address, stack, options))
            if self.scheduling.realtime and spec.kind == "freewheeling":
                notes.append(f"task {spec.name} is freewheeling and runs at normal priority")
        self._threads.append(
            NativeThread(
                entries["tappet_scheduler_thread"],
                contexts.application.address,
                contexts.scheduler_stack,
                self.scheduling.scheduler_options(),
            )
        )
        return notes

    def launch_files(self, wake: Callable[[], None]) -> None:
        """Start the thread that serves requests for files; `wake` lets it look whether it is to end."""
        self._wake_files = wake
        self._threads.append(
            NativeThread(
                self.executive.entries["tappet_file_thread"],
                self.contexts.application.address,
                self.contexts.file_stack,
                self.scheduling.task_options("files", 31, freewheeling=True),
            )
        )

    def halt(self) -> None:
        """End all threads; TaskError when one does not even end by force."""
        self.executive.store_flag(self.contexts.application.place("quit"), 1)
        if not self._join(BOUNDARY_TIMEOUT_S):
            self._abort_tasks()
            if not self._join(BOUNDARY_TIMEOUT_S):
                raise TaskError("a task does not end; the runtime process has to be restarted")
        self._threads.clear()

    def _join(self, timeout_s: float) -> bool:
        due = time.monotonic() + timeout_s
        if self._virtual is not None and not self._virtual.end(timeout_s):
            return False
        return all(t.join(max(0.0, due - time.monotonic()), waker=self._wake_all) for t in self._threads)

    def _wake_all(self) -> None:
        for thread in self._threads:
            thread.wake()
        for task in self.contexts.tasks:
            libc.sem_post(task.place("wake"))
        if self._wake_files is not None:
            self._wake_files()

    def _abort_tasks(self) -> None:
        for task in self.contexts.tasks:
            self.executive.store_flag(task.place("abort"), 1)
        self._wake_all()

    @contextmanager
    def standing(self) -> Iterator[None]:
        """All tasks at a cycle boundary, for as long as the block runs; halted ones complete their cycle."""
        cell = self.contexts.application.place("pause")
        self.executive.store_flag(cell, 1)
        self.release(wanted=True)
        try:
            self._await_boundary()
            yield
        finally:
            self.release(wanted=False)
            self.executive.store_flag(cell, 0)

    def release(self, *, wanted: bool) -> None:
        """Whether tasks pass all breakpoints, and halted ones go on."""
        debug = self.contexts.application["pDebug"]
        if debug:
            context = Record(self.executive.layouts["DEBUG_CONTEXT"], debug)
            self.executive.store_flag(context.place("released"), int(wanted))
            for task in self._debugged():
                task["pause"] = task["mode"] = 0  # what was to halt has come to its end

    @property
    def halted(self) -> bool:
        """Whether a task stands at a statement."""
        return any(task["halted"] for task in self._debugged())

    def _debugged(self) -> list[Record]:
        """The debugger's parts of the tasks; none without an instrumented variant."""
        layout = self.executive.layouts["DEBUG_TASK"]
        return [Record(layout, task["pDebug"]) for task in self.contexts.tasks if task["pDebug"]]

    def _await_boundary(self) -> None:
        due = time.monotonic() + BOUNDARY_TIMEOUT_S
        aborted = False
        while any(s % 2 for s in self.contexts.sequences()):
            if time.monotonic() > due:
                if aborted:
                    raise TaskError("a task does not reach the end of its cycle")
                aborted = True
                due = time.monotonic() + BOUNDARY_TIMEOUT_S
                self._abort_tasks()
            time.sleep(0.0001)
        if aborted:
            for task in self.contexts.tasks:
                self.executive.store_flag(task.place("abort"), 0)

    # -- state -----------------------------------------------------------------------------------------

    @property
    def state(self) -> int:
        """STOPPED, RUNNING or FAULTED."""
        return self.contexts.application["state"]

    def set_state(self, state: int) -> None:
        """Stop or start the programs; a cycle that has begun is completed."""
        self.executive.store_flag(self.contexts.application.place("state"), state)

    def stop(self) -> None:
        """STOPPED if it was running, with every task at the end of its cycle."""
        if self.state == RUNNING:
            self.set_state(STOPPED)
        with self.standing():
            pass

    def single_cycle(self) -> None:
        """Run the programs of every cyclic and freewheeling task once although the application is stopped.

        Returns when all have run, one has raised an exception, or after `BOUNDARY_TIMEOUT_S`: a task with
        a longer interval runs its cycle when it is due.
        """
        waiting = [t for t in self.contexts.tasks if t["kind"] in _SELF_STARTING]
        if not waiting:
            raise TaskError("a single cycle needs a cyclic or freewheeling task; the others wait for events")
        for task in waiting:
            self.executive.store_flag(task.place("singleCycle"), 1)
        due = time.monotonic() + BOUNDARY_TIMEOUT_S
        while self.state == STOPPED and time.monotonic() < due and any(t["singleCycle"] for t in waiting):
            if self.halted:
                return
            time.sleep(0.0005)
        with self.standing():
            pass

    # -- code that is no cycle ---------------------------------------------------------------------------

    def call(self, code: int) -> RawFault | None:
        """Run the function at `code` guarded, on a thread of its own; the fault that ended it, or None."""
        service = self.contexts.service
        service["pCode"] = code
        thread = NativeThread(
            self.executive.entries["tappet_call_thread"],
            service.address,
            self.contexts.service_stack,
            self.scheduling.task_options("initialise", 31, freewheeling=True),
        )
        self._await(thread.join, service.place("abort"))
        fault = self.contexts.fault(service)
        return fault if fault.code else None

    def run_virtual(self, until_ns: int) -> None:
        """Virtual time: run everything that is due before `until_ns`, as fast as possible."""
        application = self.contexts.application
        application["virtualUntil"] = until_ns
        if not self.contexts.tasks:
            application["virtualNow"] = max(until_ns, application["virtualNow"])
            return
        if self._virtual is None:
            options = self.scheduling.task_options("virtual", 31, freewheeling=True)
            self._virtual = VirtualWorker(self.executive, self.contexts, options)
        if not self._virtual.done(BOUNDARY_TIMEOUT_S):
            raise TaskError("a task on virtual time does not end its cycle")
        self._virtual.begin()
        self._await(self._virtual.done, application.place("quit"))

    def _await(self, ended: Callable[[float], bool], stop_flag: int) -> None:
        """Wait for a thread, which is woken to look whether its cycle has taken too long. An interrupt ends
        what it runs."""
        try:
            while not ended(1.0):
                pass
        except BaseException:
            self.executive.store_flag(stop_flag, 1)
            for task in (*self.contexts.tasks, self.contexts.service):
                self.executive.store_flag(task.place("abort"), 1)
            ended(BOUNDARY_TIMEOUT_S)
            for task in (*self.contexts.tasks, self.contexts.service):
                self.executive.store_flag(task.place("abort"), 0)
            self.executive.store_flag(stop_flag, 0)
            raise

    # -- lists that running tasks read -------------------------------------------------------------------

    def publish(self, cell: int, address: int, owner: object) -> None:
        """Exchange a pointer that tasks follow. The owner of the new list is kept; the old one is dropped
        once no task can be using it."""
        old = self._published.get(cell)
        self._published[cell] = owner
        self.executive.store(cell, address)
        if old is not None:
            self.retire(old)

    def retire(self, owner: object, release: Callable[[], None] | None = None) -> None:
        """Keep `owner` until every cycle that may use it has ended, then call `release`."""
        self._retired.append((self.contexts.sequences(), owner, release))
        self.collect()

    def collect(self) -> None:
        """Let go of what is no longer in use."""
        now = self.contexts.sequences() if self._retired else []
        waiting = []
        for then, owner, release in self._retired:
            if all(a % 2 == 0 or a != b for a, b in zip(then, now, strict=True)):
                if release is not None:
                    release()
            else:
                waiting.append((then, owner, release))
        self._retired = waiting

    def close(self) -> None:
        """After `halt`: release everything."""
        for _, _, release in self._retired:
            if release is not None:
                release()
        self._retired.clear()
        self._published.clear()
        self.contexts.close()
