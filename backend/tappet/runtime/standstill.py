"""The controlled stop of the axes of an application before it stops (motion_semantics INF-08).

It asks the programs of `axis_programs` for it. The programs of the user run on until the axes stand: what
they command is refused. A task that runs no cycles any more is not waited for longer than `LONGEST_NS`.
Behind a fault the executive brings them to standstill (`cycle.st`).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from threading import RLock

from tappet.codegen.symbol_map import SymbolMap, VarRef
from tappet.runtime.application import LoadedApplication
from tappet.runtime.axis_programs import ends_of
from tappet.runtime.contexts import RUNNING
from tappet.runtime.forces import PlacedValue
from tappet.runtime.logbook import Logbook
from tappet.runtime.places import Place

LONGEST_NS = 10_000_000_000
"""The stop of an application does not wait longer for its axes."""
_STEP_NS = 1_000_000
_CYCLES = 3
"""A command of the cycle in which the stop is asked for moves the axis for the first time in the next one."""


def stop_axes(current: Callable[[], LoadedApplication | None], lock: RLock, log: Logbook) -> None:
    """Bring all axes to standstill and stop the application, if it runs and has axes.

    `lock` is held for moments only, so that others are served while the axes brake; what `current` says is
    looked at each time.
    """
    with lock:
        application = current()
        if application is None or application.tasks.state != RUNNING:
            return
        standstill = Standstill(application)
        if not standstill:
            return
        standstill.ask(True)
        application.tasks.release(wanted=True)
    reached = _await(standstill, lambda: current() is application, lock)
    with lock:
        if current() is application:
            if not reached and application.tasks.state == RUNNING:
                log.add("warning", "application", "stopped although not all axes stand")
            application.tasks.stop()
            standstill.ask(False)


def _await(standstill: Standstill, there: Callable[[], bool], lock: RLock) -> bool:
    """Whether all axes stand, after at most `LONGEST_NS` by the clock of the application."""
    end = time.monotonic_ns() + LONGEST_NS
    application = standstill.application
    begun = application.contexts.application["virtualNow"]
    while time.monotonic_ns() < end:
        with lock:
            if not there() or application.tasks.state != RUNNING:
                return False
            if standstill.reached:
                return True
            if application.virtual:
                now = application.contexts.application["virtualNow"]
                if now - begun > LONGEST_NS:
                    return False
                application.tasks.run_virtual(now + _STEP_NS)
        if not application.virtual:
            time.sleep(_STEP_NS / 1e9)
    return False


class Standstill:
    """One controlled stop."""

    def __init__(self, application: LoadedApplication) -> None:
        symbols = application.package.symbols
        ends = ends_of(application.package)
        self.application = application
        self._asked = _members(symbols, ends, "xStop")
        self._stood = _members(symbols, ends, "udiStood")

    def __bool__(self) -> bool:
        """Whether there are axes."""
        return bool(self._asked)

    def ask(self, wanted: bool) -> None:
        """Have the axes brake, or let them go."""
        flags = [PlacedValue(_place(ref), bytes([wanted])) for ref in self._asked]
        counts = [PlacedValue(_place(ref), bytes(ref.size)) for ref in self._stood]
        self.application.write([*flags, *counts])

    @property
    def reached(self) -> bool:
        """All axes of all tasks stand."""
        counts = self.application.read([(ref.offset, ref.size) for ref in self._stood])
        return all(int.from_bytes(count, "little") >= _CYCLES for count in counts)


def _members(symbols: SymbolMap, programs: Sequence[str], name: str) -> list[VarRef]:
    return [symbols.resolve(f"{program}.{name}") for program in programs]


def _place(ref: VarRef) -> Place:
    return Place(ref.offset, ref.size, None)
