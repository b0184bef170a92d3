"""A recording in place of a runtime: it answers what can be asked of a soft PLC that stands still.

So everything that shows values (channel, tables, call stack, time bar) shows those of a recording without
knowing of it. What would change something is refused.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, cast

from tappet import __version__
from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.client import RuntimeEvent, RuntimeRefused
from tappet.runtime.debugger.shapes import DebugState
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.flight import FlightStatus
from tappet.runtime.flight_deltas import FlightError
from tappet.runtime.flight_past import RecordedPast
from tappet.runtime.flight_recording import FlightRecording
from tappet.runtime.operations.declaration import Operation, Reply, WireOperation
from tappet.runtime.source_archive import SourceInfo
from tappet.runtime.state import RuntimeInfo, State
from tappet.server.runtimes.plc_client import LoadMode, Recorder

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

_REFUSAL = "this is a recording: its values can be looked at, nothing in it runs or can be written"


class RecordedApplication:
    """What operations that only read call of a soft PLC."""

    def __init__(self, recording: FlightRecording, package: CodePackage) -> None:
        self.recording = recording
        self.package = package
        self._past = RecordedPast(recording)

    def info(self) -> RuntimeInfo:
        """It stands still, in the state in which it was taken."""
        recording = self.recording
        state: State = "exception" if recording.exception is not None else "stop"
        interval = 0 if recording.bus is None else self.package.tasks[recording.bus].interval_ns
        return RuntimeInfo(
            __version__,
            recording.code_id,
            state,
            recording.application,
            recording.code_id,
            recording.data_id,
            (),
            interval,
        )

    def exception(self) -> ExceptionReport | None:
        """The one that ended the recording."""
        return self.recording.exception

    def forces(self) -> list[object]:
        """None is in force any more."""
        return []

    def read(self, places: Sequence[tuple[int, int]], _code_id: str = "") -> list[bytes]:
        """Of the end of the recording."""
        return _parts(self.recording.base, places)

    def flight_status(self) -> FlightStatus:
        """All of it is kept for good."""
        cycles = self.recording.cycles
        size = sum(len(one.delta) for one in cycles)
        return FlightStatus(
            frozen=True,
            frozen_by="exception",
            count=len(cycles),
            first_cycle=cycles[0].cycle,
            first_timestamp_ns=cycles[0].timestamp_ns,
            last_cycle=cycles[-1].cycle,
            last_timestamp_ns=cycles[-1].timestamp_ns,
            period=self.recording.period,
            parts=self.recording.parts,
            memory=size,
            used=size,
        )

    def flight_history(self) -> list[tuple[int, int]]:
        """Cycle and unix time in ns, oldest first."""
        return [(one.cycle, one.timestamp_ns) for one in self.recording.cycles]

    def flight_read(self, cycle: int, places: Sequence[tuple[int, int]], _code_id: str = "") -> list[bytes]:
        """Of the end of a cycle."""
        return _parts(self._past.image(self._past.index_of(cycle)), places)


def _parts(image: bytes, places: Sequence[tuple[int, int]]) -> list[bytes]:
    for offset, size in places:
        if offset + size > len(image):
            raise FlightError(f"{size} bytes at offset {offset} lie outside the recorded image")
    return [image[offset : offset + size] for offset, size in places]


class RecordedPlc:
    """A connection to a recording; see `PlcClient`."""

    def __init__(self, application: RecordedApplication) -> None:
        self._application = application
        self._one = asyncio.Lock()

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        """The reply to an operation that reads; RuntimeRefused for all others."""
        if not operation.of_recordings:
            raise RuntimeRefused("refused", _REFUSAL)
        reading = cast("Operation[Reply]", operation)
        plc = cast("SoftPlc", self._application)
        async with self._one:
            try:
                return await asyncio.to_thread(reading.run, plc)
            except FlightError as error:
                raise RuntimeRefused("refused", str(error)) from error

    async def symbols(self) -> SymbolMap:
        """Symbols of the recorded application."""
        return self._application.package.symbols

    async def download(self, package: bytes, mode: LoadMode) -> RuntimeInfo:
        """Never."""
        raise RuntimeRefused("refused", _REFUSAL)

    async def load_variant(self, variant: bytes) -> DebugState:
        """Never."""
        raise RuntimeRefused("refused", _REFUSAL)

    async def store_source(self, archive: bytes, **_: Any) -> SourceInfo | None:
        """Never."""
        raise RuntimeRefused("refused", _REFUSAL)

    async def record(
        self,
        items: Sequence[tuple[int, int]],
        task: str | None,
        divider: int,
        min_interval_ns: int,
        *,
        code_id: str = "",
    ) -> Recorder:
        """Never: no task runs."""
        raise RuntimeRefused("refused", _REFUSAL)

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        """Nothing happens in a recording."""

    async def close(self) -> None:
        """Nothing to let go of."""
