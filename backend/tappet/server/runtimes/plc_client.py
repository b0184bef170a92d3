"""What the server needs of a connection to a runtime; `runtime.client.RuntimeClient` is the real one."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from typing import Literal, Protocol

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.client import RuntimeEvent
from tappet.runtime.debugger.shapes import DebugState
from tappet.runtime.operations.declaration import Reply, WireOperation
from tappet.runtime.recorder import Frame
from tappet.runtime.source_archive import SourceInfo
from tappet.runtime.state import RuntimeInfo

LoadMode = Literal["download", "online_change"]


class Recorder(Protocol):
    """Frames of one set of values."""

    def __aiter__(self) -> AsyncIterator[Frame]: ...

    async def close(self) -> None:
        """Ends the recording."""


class PlcClient(Protocol):
    """A connection to a runtime. Calls raise ConnectionError when it is lost,
    RuntimeRefused when the runtime cannot do what is asked."""

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        """The reply to an operation."""

    async def symbols(self) -> SymbolMap:
        """Symbols of the loaded application."""

    async def download(self, package: bytes, mode: LoadMode) -> RuntimeInfo:
        """Loads a code package."""

    async def load_variant(self, variant: bytes) -> DebugState:
        """Loads the instrumented variant of the application."""

    async def store_source(
        self, archive: bytes, *, project: str, stored_by: str, code_id: str
    ) -> SourceInfo | None:
        """Keeps the archive of a project in the controller."""

    async def record(
        self,
        items: Sequence[tuple[int, int]],
        task: str | None,
        divider: int,
        min_interval_ns: int,
        *,
        code_id: str = "",
    ) -> Recorder:
        """Samples (offset, size) at the end of the cycles of a task; refused where the places are those of
        another application than the loaded one."""

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        """Calls back with `state`, `exception`, `forces`, `lost` ... in the event loop."""

    async def close(self) -> None:
        """Ends the connection."""


Connect = Callable[[str, str], Awaitable[PlcClient]]
"""Opens a connection from URL and token."""
