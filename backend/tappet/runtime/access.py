"""What clients do with a loaded application besides its life cycle: values, forces, recorders, statistics."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Sequence

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime import monitoring
from tappet.runtime.application import LoadedApplication
from tappet.runtime.errors import NoApplicationError, NoTraceError, OtherApplicationError, PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight import FlightRecorder, FlightStatus
from tappet.runtime.flight_holds import ANYBODY
from tappet.runtime.flight_recording import FlightRecording
from tappet.runtime.flight_save import take_recording
from tappet.runtime.forces import NOBODY, Force, Origin, PlacedValue
from tappet.runtime.logbook import Logbook
from tappet.runtime.places import Place, path_at
from tappet.runtime.recorder import Recorder, RecorderSpec
from tappet.runtime.sampled import TraceSpec, TraceStatus
from tappet.runtime.source_archive import SourceInfo, SourceNote, SourceStore
from tappet.runtime.system_events import happened
from tappet.runtime.task_group import TaskError
from tappet.runtime.tasks import TaskHistogram, TaskStatistics
from tappet.runtime.trace_record import Command, TraceFrames

_PATIENCE_S = 0.5
"""How long reading waits for a property that is monitored by a call."""
_MOMENT_S = 0.002


_NAMED = 5
"""So many variables does a line of the log name."""


def _some(symbols: SymbolMap, places: Sequence[Place]) -> str:
    names = [path_at(symbols, place) or f"offset {place.offset}" for place in places[:_NAMED]]
    return ", ".join(names) + (f" (+{len(places) - _NAMED})" if len(places) > _NAMED else "")


class ApplicationAccess:
    """Serialised access to the application, if there is one. All methods may be called from any thread."""

    log: Logbook
    source: SourceStore
    """The life cycle makes them."""

    def __init__(self) -> None:
        self.application: LoadedApplication | None = None
        self._lock = threading.RLock()
        self._load_history = monitoring.LoadHistory()

    @property
    def lock(self) -> threading.RLock:
        """What serialises the calls."""
        return self._lock

    def loaded(self) -> LoadedApplication:
        """The application; NoApplicationError when there is none."""
        return self._need()

    def announce(self, kind: str) -> None:
        """Tell listeners of a change."""
        self._notify(kind)

    def _need(self, code_id: str = "") -> LoadedApplication:
        """The application, which has to be the one that is meant where a code id is given."""
        if self.application is None:
            raise NoApplicationError
        if code_id not in ("", self.application.package.code_id):
            raise OtherApplicationError
        return self.application

    def _notify(self, kind: str) -> None:
        """Something listeners want to know; the life cycle overrides this."""

    # -- values ------------------------------------------------------------------------------------------

    def happen(self, event: str, *, when: bool = True) -> None:
        """A system event that concerns the loaded application, if there is one."""
        with self._lock:
            if when and self.application is not None:
                happened(self.application, event, self.log)

    def symbols(self) -> SymbolMap:
        """Symbol map of the loaded application."""
        return self._need().package.symbols

    def symbols_with_code(self) -> tuple[str, SymbolMap]:
        """Code id and symbol map of the loaded application, of one moment."""
        package = self._need().package
        return package.code_id, package.symbols

    def read(self, places: Sequence[tuple[int, int]], code_id: str = "") -> list[bytes]:
        """Bytes at (offset, size) places of the image; properties that are monitored by a call are as of now
        where the tasks run. OtherApplicationError when `code_id` is that of another application."""
        with self._lock:
            application = self._need(code_id)
            asked = application.watched.lease(places)
        end = time.monotonic() + _PATIENCE_S
        while asked and application.calls_watched and time.monotonic() < end:
            time.sleep(_MOMENT_S)
            with self._lock:
                if self.application is not application or application.watched.arrived(asked):
                    break
        with self._lock:
            return self._need(code_id).read(places)

    def write(self, values: Sequence[PlacedValue], code_id: str = "") -> Callable[[], bool]:
        """Store values together at a cycle begin; the result says, when called, whether it has happened.

        OtherApplicationError when `code_id` is that of another application.
        """
        with self._lock:
            application = self._need(code_id)
            try:
                tickets = application.write(values)
            except TaskError as error:
                raise PlcError(str(error)) from error

        def done() -> bool:
            with self._lock:
                return self.application is not application or application.written(tickets)

        return done

    def force(self, values: Sequence[PlacedValue], origin: Origin = NOBODY, code_id: str = "") -> None:
        """Hold variables at values until released. OtherApplicationError as in `write`."""
        with self._lock:
            application = self._need(code_id)
            application.force(values, origin)
            names = _some(application.package.symbols, [value.place for value in values])
            self.log.add("info", "forces", f"forced by {origin}: {names}")
            self._notify("forces")

    def unforce(
        self, keys: Iterable[tuple[int, int | None]] | None, *, restore: bool = False, code_id: str = ""
    ) -> int:
        """Release forces, all with None; returns how many. OtherApplicationError as in `write`."""
        with self._lock:
            application = self._need(code_id)
            released = application.unforce(keys, restore=restore)
            if released:
                names = _some(application.package.symbols, [force.value.place for force in released])
                self.log.add("info", "forces", f"forces released: {names}")
                self._notify("forces")
            return len(released)

    def forces(self) -> list[tuple[Force, str | None]]:
        """Forced variables and their paths."""
        with self._lock:
            application = self._need()
            symbols = application.package.symbols
            return [(f, path_at(symbols, f.value.place)) for f in application.forces]

    def record(
        self,
        items: Sequence[tuple[int, int]],
        task: str | None,
        divider: int,
        min_interval_ns: int,
        frames: int = 0,
        code_id: str = "",
    ) -> Recorder:
        """Start a recorder at a task, the bus cycle task for None. OtherApplicationError as in `read`."""
        with self._lock:
            application = self._need(code_id)
            number = application.ownership.number(task)
            return application.sampled.record(
                RecorderSpec(tuple(items), number, divider, min_interval_ns, frames)
            )

    def end_record(self, recorder: Recorder) -> None:
        """Stop a recorder; nothing happens when its application is gone."""
        with self._lock:
            application = self.application
            if application is not None and any(recorder in r for r in application.recorders.values()):
                application.sampled.end_record(recorder)

    # -- traces ------------------------------------------------------------------------------------------

    def download_trace(self, spec: TraceSpec, start: bool) -> TraceStatus:
        """Keep a trace, in place of one of its name, and start it."""
        with self._lock:
            found = self._need().sampled.download_trace(spec)
        return self.command_trace(spec.name, "start") if start else found

    def command_trace(self, name: str, command: Command) -> TraceStatus:
        """Start, stop or arm a trace; PlcError when there is none of this name."""
        with self._lock:
            sampled = self._need().sampled
            if not sampled.command_trace(name, command):
                raise self._no_trace(name)
        sampled.settle_trace(name)
        with self._lock:
            return self._trace(name)

    def _trace(self, name: str) -> TraceStatus:
        for status in self._need().sampled.trace_status():
            if status.name.upper() == name.upper():
                return status
        raise self._no_trace(name)

    @staticmethod
    def _no_trace(name: str) -> NoTraceError:
        return NoTraceError(f"there is no trace '{name}'; download it")

    def traces(self) -> list[TraceStatus]:
        """All traces of the application; none without application."""
        with self._lock:
            return self.application.sampled.trace_status() if self.application is not None else []

    def take_trace(self, name: str, record: int, first: int, limit: int) -> TraceFrames:
        """Samples of a record of a trace, by number."""
        with self._lock:
            records = self._need().sampled.find_trace(name)
        if records is None:
            raise self._no_trace(name)
        if not 0 <= record < len(records):
            raise NoTraceError(f"the trace '{name}' has no record number {record}")
        return records[record].take(first, limit)

    def trace_settings(self, name: str) -> bytes:
        """What was downloaded with a trace."""
        with self._lock:
            found = self._need().sampled.trace_settings(name)
        if found is None:
            raise self._no_trace(name)
        return found

    def remove_trace(self, name: str) -> None:
        """End a trace."""
        with self._lock:
            if not self._need().sampled.remove_trace(name):
                raise self._no_trace(name)

    # -- flight recorder ---------------------------------------------------------------------------------

    def _need_flight(self) -> FlightRecorder:
        recorder = self._need().flight
        if recorder is None:
            raise PlcError("the flight recorder is off, or the application has no task that could feed it")
        return recorder

    def flight_status(self) -> FlightStatus:
        """What the flight recorder keeps."""
        with self._lock:
            return self._need_flight().status()

    def flight_history(self) -> list[tuple[int, int]]:
        """(cycle of the bus cycle task, unix time in ns) of every cycle that can be read, oldest first."""
        with self._lock:
            return self._need_flight().history()

    def flight_read(self, cycle: int, places: Sequence[tuple[int, int]], code_id: str = "") -> list[bytes]:
        """Bytes at (offset, size) at the end of a past cycle; FlightError when it is not kept,
        OtherApplicationError as in `read`."""
        with self._lock:
            image = self._need(code_id).image
            recorder = self._need_flight()
            for offset, size in places:
                image.check(offset, size)
            capture = recorder.capture(cycle)
        past = recorder.rebuild(capture)  # takes its time: nobody waits for it
        return [past[offset : offset + size] for offset, size in places]

    def flight_recording(self) -> FlightRecording:
        """What is kept, with all it takes to show and replay it elsewhere."""
        with self._lock:
            return take_recording(self._need(), self.exception())

    def exception(self) -> ExceptionReport | None:
        """Why the application is in the state exception; the life cycle knows it."""
        return None

    def flight_freeze(self, on: bool, owner: str = ANYBODY, lease_s: float | None = None) -> FlightStatus:
        """Keep what is recorded, or record again; an exception freezes until the next start after a reset."""
        with self._lock:
            recorder = self._need_flight()
            recorder.freeze(on, owner, lease_s)
            return recorder.status()

    def flight_renew(self, owner: str, lease_s: float) -> None:
        """Keep it further for an owner; PlcError when it keeps it no more."""
        with self._lock:
            self._need_flight().renew_freeze(owner, lease_s)

    # -- monitoring --------------------------------------------------------------------------------------

    def tasks(self) -> list[TaskStatistics]:
        """Task monitoring."""
        with self._lock:
            return monitoring.statistics(self._need())

    def task_histograms(self) -> list[TaskHistogram]:
        """Execution times and jitters of the tasks in classes."""
        with self._lock:
            return monitoring.histograms(self._need())

    def sample_load(self) -> None:
        """Note how busy tasks and processors were since the last call; a service calls every second."""
        with self._lock:
            self._load_history.sample(self.application)

    def load_since(self, at_ns: int) -> monitoring.Load:
        """How busy tasks and processors were, as far as it was noted after a unix time."""
        return self._load_history.since(at_ns)

    def reset_statistics(self, task: str | None) -> None:
        """Statistics of a task back to 0, of all tasks with None."""
        with self._lock:
            application = self._need()
            if task is None:
                for number in range(len(application.contexts.tasks)):
                    monitoring.reset_statistics(application, number)
            else:
                monitoring.reset_statistics(application, application.ownership.number(task))

    # -- source ------------------------------------------------------------------------------------------

    def keep_source(self, note: SourceNote, data: bytes) -> None:
        """Keep the archive of a project. Raises DiskFullError, PlcError."""
        self.source.put(note, data)
        self.log.add("info", "source", f"{note.stored_by} stored the source of '{note.project}'")

    def source_info(self) -> SourceInfo | None:
        """The source that is kept; None for none."""
        application = self.application
        return self.source.info(application.package.code_id if application is not None else None)

    def remove_source(self) -> None:
        """Delete the source."""
        self.source.remove()
        self.log.add("info", "source", "the source was deleted")
