"""The soft PLC inside the calling process, without wire: `tappet run`, `tappet test`, previews and tests."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import VarRef
from tappet.codegen.values import Value
from tappet.runtime.contexts import STUCK_LIMIT_S, VIRTUAL_FREEWHEEL_NS
from tappet.runtime.errors import PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight import FlightSettings, FlightStatus
from tappet.runtime.forces import PlacedValue
from tappet.runtime.places import Place
from tappet.runtime.plc import SoftPlc
from tappet.runtime.recorder import Recorder
from tappet.runtime.state import ResetKind, State
from tappet.runtime.tasks import TaskStatistics
from tappet.runtime.threads import NORMAL, Scheduling

_WRITE_TIMEOUT_S = 2.0


class ApplicationException(RuntimeError):  # noqa: N818 - the field's term for this state
    """The application went into the state exception; `report` says where and why."""

    def __init__(self, report: ExceptionReport) -> None:
        element = report.place.element if report.place is not None else None
        at = f"line {report.line}" if element is None else f"element {element}"
        place = f" in {report.pou}, {at}" if report.pou else ""
        super().__init__(f"task {report.task}: {report.message}{place}")
        self.report = report


@dataclass(frozen=True, slots=True)
class Sample:
    """Recorded values of one cycle, by expression as it was given."""

    cycle: int
    timestamp_ns: int
    values: Mapping[str, Value]


class Trace:
    """Values recorded at the end of a task's cycles."""

    def __init__(self, runtime: LocalRuntime, recorder: Recorder, refs: Mapping[str, VarRef]) -> None:
        self._runtime = runtime
        self._recorder = recorder
        self._refs = refs
        self.samples: list[Sample] = []

    def collect(self) -> list[Sample]:
        """Take what has been sampled since the last call; all samples are also kept in `samples`."""
        symbols = self._runtime.package.symbols
        fresh = []
        for frame in self._recorder.take():
            values: dict[str, Value] = {}
            at = 0
            for expression, ref in self._refs.items():
                values[expression] = symbols.decode(ref, frame.data[at : at + ref.size])
                at += ref.size
            fresh.append(Sample(frame.cycle, frame.timestamp_ns, values))
        self.samples += fresh
        return fresh

    @property
    def dropped(self) -> int:
        """Samples lost because nobody collected them in time."""
        return self._recorder.dropped

    @property
    def room(self) -> int:
        """Samples that fit between two calls of `collect`."""
        return self._recorder.capacity

    def close(self) -> None:
        """Stop recording."""
        self._runtime.plc.end_record(self._recorder)
        if self in self._runtime.traces:
            self._runtime.traces.remove(self)


class LocalRuntime:
    """One application, on virtual time (deterministic, as fast as possible) or in real time.

    Use it as a context manager. Variables are addressed by path, values are Python values or IEC literals.
    """

    def __init__(
        self,
        package: CodePackage,
        *,
        virtual: bool = True,
        folder: Path | None = None,
        scheduling: Scheduling = NORMAL,
        cycle_limit_s: float = STUCK_LIMIT_S,
        start: bool = True,
        flight: FlightSettings | None = None,
        image_address: int = 0,
    ) -> None:
        """Load and, with `start`, run. `cycle_limit_s` of wall time ends a cycle that never comes to its
        end.
        """
        self.plc = SoftPlc(
            folder,
            virtual=virtual,
            scheduling=scheduling,
            stuck_limit_s=cycle_limit_s,
            flight=flight,
            image_address=image_address,
        )
        self.virtual = virtual
        self.traces: list[Trace] = []
        self.plc.load(package)
        if start and self.state == "stop":
            self.plc.start()

    def __enter__(self) -> LocalRuntime:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def package(self) -> CodePackage:
        """The package that runs now."""
        if self.plc.application is None:
            raise PlcError("no application is loaded")
        return self.plc.application.package

    @property
    def state(self) -> State:
        """empty, stop, run or exception."""
        return self.plc.state

    # -- running -----------------------------------------------------------------------------------------

    @property
    def now_ns(self) -> int:
        """Clock of the application: time since it was loaded or reset."""
        application = self.plc.application
        if application is None:
            return 0
        context = application.contexts.application
        if self.virtual:
            return context["virtualNow"]
        return time.clock_gettime_ns(time.CLOCK_MONOTONIC) - context["startNs"]

    @property
    def cycle_ns(self) -> int:
        """Length of a cycle of the bus cycle task, which `run(cycles=...)` counts."""
        application = self.plc.application
        if application is None or application.ownership.bus is None:
            return VIRTUAL_FREEWHEEL_NS
        return application.package.tasks[application.ownership.bus].interval_ns or VIRTUAL_FREEWHEEL_NS

    def run(self, cycles: int | None = None, *, time_ns: int | None = None) -> None:
        """Run for so many cycles of the bus cycle task, or for a time; raises ApplicationException.

        In virtual time exactly what is due before the end runs, so two runs of one cycle equal one of two.
        In real time the call waits until the task has completed so many cycles, or so long.
        """
        if (cycles is None) == (time_ns is None):
            raise ValueError("give either cycles or time_ns")
        if self.state == "stop":
            raise PlcError("the application is stopped; start it before running")
        self._raise()
        if self.virtual:
            self._run_virtual(self.now_ns + (cycles * self.cycle_ns if cycles is not None else time_ns or 0))
        else:
            self._run_real(cycles, time_ns)
        self._raise()

    def _run_virtual(self, until_ns: int) -> None:
        application = self.plc.application
        assert application is not None
        step = self._trace_step()
        while self.state == "run" and self.now_ns < until_ns:
            application.tasks.run_virtual(min(until_ns, self.now_ns + step) if step else until_ns)
            for trace in self.traces:
                trace.collect()
        application.tasks.collect()

    def _trace_step(self) -> int:
        """Virtual time after which the fullest trace has to be collected; 0 without traces."""
        if not self.traces:
            return 0
        intervals = [t.interval_ns for t in self.package.tasks if t.interval_ns] + [VIRTUAL_FREEWHEEL_NS]
        return max(1, min(t.room for t in self.traces) - 1) * min(intervals)

    def _run_real(self, cycles: int | None, time_ns: int | None) -> None:
        if time_ns is not None:
            self._wait(lambda: False, time_ns / 1e9)
            return
        application = self.plc.application
        assert application is not None
        bus = application.ownership.bus
        if bus is None:
            return
        statistics = application.contexts.statistics(application.contexts.tasks[bus])
        wanted = statistics["iecCycles"] + (cycles or 0)
        self._wait(lambda: statistics["iecCycles"] >= wanted, None)

    def _wait(self, done: Callable[[], bool], timeout_s: float | None) -> None:
        due = None if timeout_s is None else time.monotonic() + timeout_s
        while self.state == "run" and not done() and (due is None or time.monotonic() < due):
            time.sleep(0.001 if due is None else min(0.01, max(0.0, due - time.monotonic())))
            for trace in self.traces:
                trace.collect()

    def _raise(self) -> None:
        report = self.plc.exception()
        if report is not None:
            raise ApplicationException(report)

    @property
    def exception(self) -> ExceptionReport | None:
        """Why the application is in the state exception."""
        return self.plc.exception()

    def start(self) -> None:
        """Run the programs."""
        self.plc.start()

    def stop(self) -> None:
        """Stop the programs; values stay."""
        self.plc.stop()

    def reset(self, kind: ResetKind = "cold") -> None:
        """Initial values again; the application is stopped (and with origin removed)."""
        self.plc.reset(kind)

    # -- values ------------------------------------------------------------------------------------------

    def read(self, path: str) -> Value:
        """Value of a variable; SymbolError when there is none of this name."""
        ref = self.package.symbols.resolve(path)
        return self.package.symbols.decode(ref, self.plc.read([(ref.offset, ref.size)])[0])

    def literal(self, path: str) -> str:
        """Value of a variable as IEC literal."""
        return self.package.symbols.format_literal(self.package.symbols.resolve(path), self.read(path))

    def _placed(self, path: str, value: Value) -> PlacedValue:
        symbols = self.package.symbols
        ref = symbols.resolve(path)
        return PlacedValue(Place(ref.offset, ref.size, ref.bit), symbols.encode(ref, value))

    def write(self, path: str, value: Value) -> None:
        """Set a variable; in real time at the begin of the next cycle, for which the call waits."""
        self.write_all({path: value})

    def write_all(self, values: Mapping[str, Value]) -> None:
        """Set several variables together."""
        done = self.plc.write([self._placed(path, value) for path, value in values.items()])
        due = time.monotonic() + _WRITE_TIMEOUT_S
        while not done() and time.monotonic() < due:
            time.sleep(0.0005)

    def force(self, path: str, value: Value) -> None:
        """Hold a variable at a value."""
        self.plc.force([self._placed(path, value)])

    def unforce(self, path: str | None = None, *, restore: bool = False) -> None:
        """Release one variable, or all with None."""
        if path is None:
            self.plc.unforce(None, restore=restore)
            return
        ref = self.package.symbols.resolve(path)
        self.plc.unforce([(ref.offset, ref.bit)], restore=restore)

    # -- traces ------------------------------------------------------------------------------------------

    def trace(
        self,
        expressions: Sequence[str],
        *,
        task: str | None = None,
        divider: int = 1,
        min_interval_ns: int = 0,
    ) -> Trace:
        """Record variables at the end of the cycles of a task (the bus cycle task by default)."""
        refs = {expression: self.package.symbols.resolve(expression) for expression in expressions}
        items = [(ref.offset, ref.size) for ref in refs.values()]
        trace = Trace(self, self.plc.record(items, task, divider, min_interval_ns), refs)
        self.traces.append(trace)
        return trace

    # -- flight recorder ---------------------------------------------------------------------------------

    def flight_status(self) -> FlightStatus:
        """What the flight recorder keeps."""
        return self.plc.flight_status()

    def flight_history(self) -> list[tuple[int, int]]:
        """(cycle of the bus cycle task, unix time in ns) of every cycle that can be read, oldest first."""
        return self.plc.flight_history()

    def flight_read(self, cycle: int, path: str) -> Value:
        """Value of a variable at the end of a past cycle; FlightError when it is not kept."""
        ref = self.package.symbols.resolve(path)
        return self.package.symbols.decode(ref, self.plc.flight_read(cycle, [(ref.offset, ref.size)])[0])

    def flight_freeze(self, on: bool, owner: str = "", lease_s: float | None = None) -> FlightStatus:
        """Keep what is recorded, or record again."""
        return self.plc.flight_freeze(on, owner, lease_s)

    def statistics(self) -> list[TaskStatistics]:
        """Task monitoring."""
        return self.plc.tasks()

    # -- end ---------------------------------------------------------------------------------------------

    def close(self) -> None:
        """End the application and release its memory."""
        self.plc.close()


@contextmanager
def running(package: CodePackage, *, virtual: bool = True) -> Iterator[LocalRuntime]:
    """A started application that is closed at the end."""
    with LocalRuntime(package, virtual=virtual) as runtime:
        yield runtime
