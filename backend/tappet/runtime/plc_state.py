"""What a soft PLC is at the moment, and who hears when that changes."""

from __future__ import annotations

import contextlib
import uuid
from collections.abc import Callable
from pathlib import Path

from tappet import __version__
from tappet.runtime.access import ApplicationAccess
from tappet.runtime.contexts import FAULTED, RUNNING, STOPPED, STUCK_LIMIT_S
from tappet.runtime.crash import Crash, RunningMark
from tappet.runtime.debugger.debugger import Debugger
from tappet.runtime.exception_report import ExceptionReport, summary
from tappet.runtime.executive.loader import Executive
from tappet.runtime.flight import FlightSettings
from tappet.runtime.image import ImageMemory
from tappet.runtime.logbook import Logbook
from tappet.runtime.reports import build_report
from tappet.runtime.source_archive import SourceStore
from tappet.runtime.state import Event, RuntimeInfo, State
from tappet.runtime.threads import NORMAL, Scheduling

_STATES: dict[int, State] = {STOPPED: "stop", RUNNING: "run", FAULTED: "exception"}


class PlcState(ApplicationAccess):
    """State, identity, exception and remanent values of one PLC; `SoftPlc` is its life cycle."""

    def __init__(
        self,
        folder: Path | None,
        *,
        virtual: bool = False,
        scheduling: Scheduling = NORMAL,
        stuck_limit_s: float = STUCK_LIMIT_S,
        logbook: Logbook | None = None,
        flight: FlightSettings | None = None,
        image_address: int = 0,
    ) -> None:
        """`image_address`: where the image of an application is put if that is free."""
        super().__init__()
        self.executive = Executive.shared()
        self.folder = folder
        self.virtual = virtual
        self.scheduling = scheduling
        self.stuck_limit_s = stuck_limit_s
        self.flight = flight or FlightSettings()
        self.image_address = image_address
        self.log = logbook or Logbook()
        self.instance_id = uuid.uuid4().hex
        self.on_event: Callable[[Event], None] | None = None
        self._report: ExceptionReport | None = None
        self._seen_state: State = "empty"
        self.debugger = Debugger(self)
        self._mark = RunningMark(self.executive, folder, self.log)
        self._crash: Crash | None = None
        """Why the application waits to be started by somebody."""
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        self.source = SourceStore(folder)
        for note in scheduling.notes:
            self.log.add("info", "scheduler", note)

    # -- state -------------------------------------------------------------------------------------------

    @property
    def state(self) -> State:
        """Present state."""
        application = self.application
        return "empty" if application is None else _STATES[application.tasks.state]

    def image_memory(self) -> ImageMemory | None:
        """How full the memory of the variables is; None without an application."""
        return self.application.image.memory() if self.application is not None else None

    def info(self) -> RuntimeInfo:
        """Identity, state and application."""
        with self._lock:
            application = self.application
            package = application.package if application else None
            cycle = 0
            if application is not None and application.ownership.bus is not None:
                cycle = application.package.tasks[application.ownership.bus].interval_ns
            return RuntimeInfo(
                __version__,
                self.instance_id,
                self.state,
                package.application if package else None,
                package.code_id if package else None,
                package.data_id if package else None,
                self._notes(),
                cycle,
                self.debugger.halted_tasks(),
                self.debugger.sequence,
            )

    def _notes(self) -> tuple[str, ...]:
        notes = list(self.scheduling.notes)
        if self.application is not None and not (
            self.application.image.low and self.application.contexts.low
        ):
            notes.append("application data lie above 4 GiB: code that keeps pointers in DWORD will fail")
        return tuple(notes)

    def poll(self) -> None:
        """Look for a change that came from the tasks, notify listeners, release what is no longer used.

        A service calls this some 20 times a second.
        """
        with self._lock:
            if self.application is not None:
                self.application.tasks.collect()
                self.application.look_after(self.log)
            self.debugger.poll()
            state = self.state
            if state == "run":
                self._mark.look()
            if state == "exception" and self._report is None:
                report = self._report = build_report(self._need(), self.log)
                self.log.add("exception", "application", summary(report))
                self.happen("Exception")
            if state != self._seen_state:
                self._notify("exception" if state == "exception" else "state")

    def _notify(self, kind: str) -> None:
        self._seen_state = self.state
        if self.on_event is not None:
            self.on_event(Event(kind, self.state))

    def exception(self) -> ExceptionReport | None:
        """Why the application is in the state exception; None when it is not."""
        with self._lock:
            self.poll()
            return self._report

    # -- remanent values ---------------------------------------------------------------------------------

    def sync_retain(self) -> None:
        """Bring the live retain file to the disk; blocks, so a service thread calls it every second or so."""
        application = self.application
        file = application.retain_file if application else None
        if file is not None:
            with contextlib.suppress(FileNotFoundError):
                file.sync()

    def _save_retain(self) -> None:
        application = self.application
        if application is None or application.retain_file is None:
            return
        try:
            with application.tasks.standing():
                application.save_retain()
        except OSError as error:
            self.log.add("error", "retain", f"remanent variables could not be saved: {error}")
