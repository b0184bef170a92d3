"""What the server needs of a connection to a runtime; `runtime.client.RuntimeClient` is the real one."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable, Iterable, Sequence
from typing import Literal, Protocol

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.client import ForcedValue, RuntimeEvent
from tappet.runtime.faults import ExceptionReport
from tappet.runtime.flight import FlightStatus
from tappet.runtime.logbook import LogEntry
from tappet.runtime.plc import RuntimeInfo
from tappet.runtime.recorder import Frame
from tappet.runtime.tasks import TaskStatistics

ResetKind = Literal["warm", "cold", "origin"]
LoadMode = Literal["download", "online_change"]


class Recorder(Protocol):
    """Frames of one set of values."""

    def __aiter__(self) -> AsyncIterator[Frame]: ...

    async def close(self) -> None:
        """Ends the recording."""


class PlcClient(Protocol):
    """A connection to a runtime. Calls raise ConnectionError when it is lost,
    RuntimeRefused when the runtime cannot do what is asked."""

    async def info(self) -> RuntimeInfo:
        """Who the runtime is and what it runs."""

    async def symbols(self) -> SymbolMap:
        """Symbols of the loaded application."""

    async def download(self, package: bytes, mode: LoadMode) -> RuntimeInfo:
        """Loads a code package."""

    async def start(self) -> None:
        """Runs the programs."""

    async def stop(self) -> None:
        """Stops them."""

    async def single_cycle(self) -> None:
        """Runs one cycle of the programs of a stopped application."""

    async def reset(self, kind: ResetKind) -> None:
        """Back to initial values."""

    async def read(self, places: Sequence[tuple[int, int]]) -> list[bytes]:
        """Bytes at (offset, size)."""

    async def write(self, values: Sequence[tuple[int, bytes, int | None]]) -> bool:
        """Stores (offset, bytes, bit) together at a cycle begin."""

    async def force(self, values: Sequence[tuple[int, bytes, int | None]]) -> None:
        """Holds (offset, bytes, bit) until released."""

    async def unforce(self, keys: Iterable[tuple[int, int | None]] | None, *, restore: bool = False) -> int:
        """Releases (offset, bit), all with None."""

    async def forces(self) -> list[ForcedValue]:
        """All that is forced."""

    async def record(
        self, items: Sequence[tuple[int, int]], task: str | None, divider: int, min_interval_ns: int
    ) -> Recorder:
        """Samples (offset, size) at the end of the cycles of a task."""

    async def flight_status(self) -> FlightStatus:
        """What the flight recorder keeps."""

    async def flight_history(self) -> list[tuple[int, int]]:
        """(cycle, unix time in ns) of what it keeps."""

    async def flight_read(self, cycle: int, places: Sequence[tuple[int, int]]) -> list[bytes]:
        """Bytes at (offset, size) at the end of a past cycle."""

    async def flight_freeze(self, on: bool) -> FlightStatus:
        """Stops the recording, or goes on."""

    async def tasks(self) -> list[TaskStatistics]:
        """Statistics."""

    async def reset_statistics(self, task: str) -> None:
        """Statistics of a task back to 0."""

    async def exception(self) -> ExceptionReport | None:
        """Why the application stopped."""

    async def log(self, since: int) -> list[LogEntry]:
        """Log entries after a number."""

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        """Calls back with `state`, `exception`, `forces`, `lost` ... in the event loop."""

    async def close(self) -> None:
        """Ends the connection."""


Connect = Callable[[str, str], Awaitable[PlcClient]]
"""Opens a connection from URL and token."""
