"""The native thread that runs all tasks of an application on virtual time, as often as it is asked to."""

from __future__ import annotations

from tappet.runtime.contexts import Contexts
from tappet.runtime.executive.loader import Executive
from tappet.runtime.posix import ThreadOptions, libc, take_semaphore
from tappet.runtime.threads import NativeThread, wait_waking


class VirtualWorker:
    """Lives as long as the contexts of its application. Calls are serialised by its owner."""

    def __init__(self, executive: Executive, contexts: Contexts, options: ThreadOptions) -> None:
        application = contexts.application
        self._executive = executive
        self._order, self._done = application.place("virtualOrder"), application.place("virtualDone")
        self._end = application.place("virtualEnd")
        for semaphore in (self._order, self._done):
            libc.sem_init(semaphore, 0, 0)
        self._thread = NativeThread(
            executive.entries["tappet_virtual_thread"], application.address, contexts.stacks[0], options
        )
        self._runs = False

    def begin(self) -> None:
        """Let it run what is due before `virtualUntil`."""
        self._runs = True
        libc.sem_post(self._order)

    def done(self, timeout_s: float) -> bool:
        """Wait until it has, waking it to look at its watchdog; False when it still runs."""
        if self._runs:
            self._runs = not wait_waking(
                lambda step_s: take_semaphore(self._done, step_s), self._thread.wake, timeout_s
            )
        return not self._runs

    def end(self, timeout_s: float) -> bool:
        """End the thread; False when it still runs."""
        self._executive.store_flag(self._end, 1)
        libc.sem_post(self._order)
        return self._thread.join(timeout_s)
