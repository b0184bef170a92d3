"""A runtime in memory, for tests of what the server does with one."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn, TypeVar

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import Root, SymbolMap
from tappet.codegen.symbol_types import MemberInfo, TypeInfo
from tappet.iec import places as iec_places
from tappet.runtime import protocol
from tappet.runtime.client import RuntimeEvent, RuntimeRefused
from tappet.runtime.errors import NoApplicationError, NoTraceError, OtherApplicationError, PlcError
from tappet.runtime.exception_report import CallFrame, ExceptionReport
from tappet.runtime.flight import FlightStatus
from tappet.runtime.flight_recording import FlightRecording
from tappet.runtime.forces import NOBODY, Force, Origin, PlacedValue
from tappet.runtime.image import ImageMemory
from tappet.runtime.logbook import LogEntry
from tappet.runtime.monitoring import Load, LoadHistory
from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import Reply, WireOperation
from tappet.runtime.operations.symbols import GetSymbols
from tappet.runtime.places import Place, path_at
from tappet.runtime.recorder import Frame
from tappet.runtime.sampled import TraceStatus
from tappet.runtime.service import refusal_code
from tappet.runtime.source_archive import SourceInfo, SourceNote, SourceStore
from tappet.runtime.source_transfer import send_source
from tappet.runtime.state import RuntimeInfo
from tappet.runtime.tasks import TaskStatistics

IMAGE_SIZE = 256
T = TypeVar("T")


def symbol_map() -> SymbolMap:
    """PLC_PRG with one variable of many kinds, GVL with two."""
    types = [
        TypeInfo("BOOL", "bool", 1),
        TypeInfo("INT", "int", 2),
        TypeInfo("LREAL", "real", 8),
        TypeInfo("TIME", "time", 4),
        TypeInfo("STRING(10)", "string", 11, length=10),
        TypeInfo("E_Mode", "enum", 2, values=(("Off", 0), ("On", 1)), base="int"),
        TypeInfo("INT(0..10)", "int", 2, range=(0, 10)),
        TypeInfo("ARRAY [1..3] OF INT", "array", 6, elem=1, bounds=((1, 3),)),
        TypeInfo("FB_Motor", "fb", 4, members=(MemberInfo("bRun", 0, 0), MemberInfo("nSpeed", 1, 2))),
        TypeInfo(
            "PLC_PRG",
            "program",
            64,
            members=(
                MemberInfo("bStart", 0, 0),
                MemberInfo("nCount", 1, 2),
                MemberInfo("rSpeed", 2, 8),
                MemberInfo("tDelay", 3, 16),
                MemberInfo("sName", 4, 20),
                MemberInfo("eMode", 5, 32),
                MemberInfo("nLevel", 6, 34),
                MemberInfo("aValue", 7, 36),
                MemberInfo("fbMotor", 8, 44),
                MemberInfo("nLimit", 1, 48, flags=("CONSTANT",)),
                MemberInfo("nMask", 1, 50, flags=("DISPLAY_HEX",)),
                MemberInfo("rOther", 2, 56, section="VAR_IN_OUT"),
            ),
        ),
        TypeInfo("GVL", "gvl", 8, members=(MemberInfo("gCount", 1, 0), MemberInfo("gStart", 0, 2))),
    ]
    roots = {"PLC_PRG": Root("PLC_PRG", "program", 0, 9), "GVL": Root("GVL", "gvl", 64, 10)}
    return SymbolMap(types, roots, {"GCOUNT": "GVL", "GSTART": "GVL"}, {"Q": (128, 8)})


@dataclass
class FakePlc:
    """State that outlives connections, with the methods of a PLC that operations use."""

    down: bool = False
    state: str = "stop"
    cycles: int = 0
    """Single cycles that were ordered."""
    boots: int = 0
    """How often the application was made the boot application."""
    application: str | None = "Application"
    code_id: str | None = "code1"
    data_id: str | None = "data1"
    instance_id: str = "instance1"
    symbol_map: SymbolMap | None = field(default_factory=symbol_map)
    image: bytearray = field(default_factory=lambda: bytearray(IMAGE_SIZE))
    forced: dict[tuple[int, int | None], bytes] = field(default_factory=dict)
    origins: dict[tuple[int, int | None], Origin] = field(default_factory=dict)
    report: ExceptionReport | None = None
    folder: Path | None = None
    """Of the files of the application."""
    downloads: list[tuple[bytes, str]] = field(default_factory=list)
    clients: list[FakeClient] = field(default_factory=list)
    recorders: list[FakeRecorder] = field(default_factory=list)
    refuses_recorders: bool = False
    size: int = 0
    reserved: int = 1 << 20
    """Bytes for online changes."""
    cycle: int = 0
    past: dict[int, bytes] = field(default_factory=dict)
    frozen: bool = False
    recording: FlightRecording | None = None
    source: SourceStore = field(default_factory=lambda: SourceStore(None))

    @property
    def debugger(self) -> NoReturn:
        raise PlcError("this one runs no code, so there is nothing to debug")

    async def connect(self, url: str, token: str) -> FakeClient:
        if self.down:
            raise ConnectionRefusedError("Connection refused")
        client = FakeClient(self)
        self.clients.append(client)
        return client

    def notify(self, kind: str) -> None:
        for client in self.clients:
            for callback in client.callbacks:
                callback(RuntimeEvent(kind, self.state))

    def lose(self) -> None:
        """The process dies."""
        self.down = True
        for recorder in self.recorders:
            recorder.end()
        self.notify("lost")
        self.clients.clear()

    def image_memory(self) -> ImageMemory | None:
        return ImageMemory(self.size, self.size, self.size + self.reserved) if self.downloads else None

    def symbols(self) -> SymbolMap:
        if self.symbol_map is None:
            raise PlcError("no application is loaded")
        return self.symbol_map

    def set(self, path: str, value: Any) -> None:
        assert self.symbol_map is not None
        ref = self.symbol_map.resolve(path)
        data = self.symbol_map.encode(ref, value)
        self.image[ref.offset : ref.offset + len(data)] = data

    def run_cycle(self) -> None:
        """One cycle: recorders sample."""
        self.cycle += 1
        if not self.frozen:
            self.past[self.cycle] = bytes(self.image)
        for recorder in self.recorders:
            recorder.sample()

    # -- what operations call ----------------------------------------------------------------------------

    def loaded(self) -> SimpleNamespace:
        self._need()
        return SimpleNamespace(files=SimpleNamespace(folder=self.folder, open=lambda: None))

    def _need(self) -> SymbolMap:
        if self.symbol_map is None:
            raise NoApplicationError
        return self.symbol_map

    def info(self) -> RuntimeInfo:
        return RuntimeInfo(
            "0.1.0", self.instance_id, self.state, self.application, self.code_id, self.data_id, ("normal",)
        )

    def symbols_with_code(self) -> tuple[str, SymbolMap]:
        symbols = self._need()
        return str(self.code_id), symbols

    def keep_source(self, note: SourceNote, data: bytes) -> None:
        self.source.put(note, data)

    def source_info(self) -> SourceInfo | None:
        return self.source.info(self.code_id)

    def remove_source(self) -> None:
        self.source.remove()

    def start(self) -> None:
        self._need()
        if self.state == "exception":
            raise PlcError("the application is in the state exception; reset it before starting")
        self.state = "run"
        self.notify("state")

    def stop(self) -> None:
        self._need()
        self.state = "stop"
        self.notify("state")

    def create_boot_application(self) -> None:
        self._need()
        self.boots += 1

    def single_cycle(self) -> None:
        self._need()
        if self.state != "stop":
            raise PlcError("a single cycle needs a stopped application")
        self.cycles += 1

    def reset(self, kind: str) -> None:
        self._need()
        self.image[:] = bytes(len(self.image))
        self.state = "stop"
        if kind == "origin":
            self.state, self.application = "empty", None
            self.code_id = self.data_id = self.symbol_map = None
        self.notify("state")

    def _check(self, code_id: str) -> None:
        if code_id not in ("", self.code_id):
            raise OtherApplicationError

    def read(self, places: Sequence[tuple[int, int]], code_id: str = "") -> list[bytes]:
        self._check(code_id)
        return [bytes(self.image[offset : offset + size]) for offset, size in places]

    def write(self, values: Sequence[PlacedValue], code_id: str = "") -> Callable[[], bool]:
        self._check(code_id)
        for value in values:
            offset, bit = value.place.offset, value.place.bit
            if bit is None:
                self.image[offset : offset + len(value.data)] = value.data
            elif value.data[0]:
                self.image[offset] |= 1 << bit
            else:
                self.image[offset] &= ~(1 << bit)
        return lambda: True

    def force(self, values: Sequence[PlacedValue], origin: Origin = NOBODY, code_id: str = "") -> None:
        self.write(values, code_id)
        self.forced |= {(value.place.offset, value.place.bit): value.data for value in values}
        self.origins |= {(value.place.offset, value.place.bit): origin for value in values}
        self.notify("forces")

    def unforce(
        self, keys: Iterable[tuple[int, int | None]] | None, *, restore: bool = False, code_id: str = ""
    ) -> int:
        self._check(code_id)
        released = [self.forced.pop(key, None) for key in (list(self.forced) if keys is None else keys)]
        self.notify("forces")
        return sum(data is not None for data in released)

    def forces(self) -> list[tuple[Force, str | None]]:
        symbols = self._need()
        places = [Place(offset, len(data), bit) for (offset, bit), data in self.forced.items()]
        return [
            (
                Force(PlacedValue(place, data), data, self.origins[place.offset, place.bit]),
                path_at(symbols, place),
            )
            for place, data in zip(places, self.forced.values(), strict=True)
        ]

    def load_since(self, at_ns: int) -> Load:
        return LoadHistory().since(at_ns)

    def traces(self) -> list[TraceStatus]:
        return []

    def no_trace(self, *given: object) -> NoReturn:
        raise NoTraceError("there is no trace")

    download_trace = command_trace = remove_trace = take_trace = trace_settings = no_trace

    def flight_status(self) -> FlightStatus:
        self._need()
        cycles = sorted(self.past)
        ends = (
            (cycles[0], cycles[0] * 10_000_000, cycles[-1], cycles[-1] * 10_000_000) if cycles else [None] * 4
        )
        by = "exception" if self.state == "exception" else "request" if self.frozen else None
        return FlightStatus(by is not None, by, len(cycles), *ends, 1, 1, 16 << 20, 48 * len(cycles))

    def flight_history(self) -> list[tuple[int, int]]:
        self._need()
        return [(cycle, cycle * 10_000_000) for cycle in sorted(self.past)]

    def flight_read(self, cycle: int, places: Sequence[tuple[int, int]], code_id: str = "") -> list[bytes]:
        if cycle not in self.past:
            raise ValueError(f"cycle {cycle} is not kept")
        return [self.past[cycle][offset : offset + size] for offset, size in places]

    def flight_recording(self) -> FlightRecording:
        if self.recording is None:
            raise PlcError("the flight recorder holds no cycle: the application has not run")
        return self.recording

    def flight_freeze(self, on: bool, owner: str = "", lease_s: float | None = None) -> FlightStatus:
        self.frozen = on
        return self.flight_status()

    def flight_renew(self, owner: str, lease_s: float) -> None:
        if not self.frozen:
            raise PlcError("the flight recorder is not frozen any more by who wants to keep it so")

    def tasks(self) -> list[TaskStatistics]:
        times = (7, 8, 1500, 1400, 1000, 2000, *[1] * 4, 0, 0, 2048)
        return [TaskStatistics("MainTask", "cyclic", 1, 10_000_000, "valid", *times)]

    def reset_statistics(self, task: str | None) -> None:
        self._need()

    def exception(self) -> ExceptionReport | None:
        return self.report

    @property
    def log(self) -> FakePlc:
        return self

    def since(self, number: int) -> list[LogEntry]:
        at = 1_700_000_000_000_000_000
        entries = [LogEntry(n, at, "info", "application", f"entry {n}") for n in (1, 2)]
        entries.append(LogEntry(3, at, "exception", "application", "division by zero, line 7"))
        return [entry for entry in entries if entry.number > number]


@dataclass
class FakeRecorder:
    plc: FakePlc
    items: Sequence[tuple[int, int]]
    min_interval_ns: int
    frames: asyncio.Queue[Frame | None] = field(default_factory=asyncio.Queue)

    def sample(self) -> None:
        data = b"".join(bytes(self.plc.image[o : o + s]) for o, s in self.items)
        self.frames.put_nowait(Frame(self.plc.cycle, time.time_ns(), data))

    def end(self) -> None:
        self.frames.put_nowait(None)

    async def __aiter__(self) -> AsyncIterator[Frame]:
        while (frame := await self.frames.get()) is not None:
            yield frame

    async def close(self) -> None:
        if self in self.plc.recorders:
            self.plc.recorders.remove(self)


@dataclass
class FakeClient:
    """A connection whose messages are packed, checked and served like real ones, without a socket."""

    plc: FakePlc
    callbacks: list[Callable[[RuntimeEvent], None]] = field(default_factory=list)

    kept: dict[type[Any], Any] = field(default_factory=dict)

    def own(self, kind: type[T]) -> T:
        state: T = self.kept.setdefault(kind, kind())
        return state

    async def store_source(
        self, archive: bytes, *, project: str, stored_by: str, code_id: str
    ) -> SourceInfo | None:
        return await send_source(self, archive, project=project, stored_by=stored_by, code_id=code_id)

    def _alive(self) -> None:
        if self.plc.down:
            raise ConnectionResetError("gone")

    async def call(self, operation: WireOperation[Reply]) -> Reply:
        self._alive()
        request = protocol.parse_request(protocol.pack_request(1, operation))
        try:
            order = protocol.parse_arguments(request, registry.known())
            reply = await order.serve(self)  # type: ignore[arg-type]
        except (PlcError, ValueError) as error:
            raise RuntimeRefused(refusal_code(error), str(error)) from error
        message = protocol.parse_message(protocol.pack_result(1, reply))
        return protocol.parse_result(type(operation), message.result)

    async def symbols(self) -> SymbolMap:
        return (await self.call(GetSymbols())).symbols

    async def download(self, package: bytes, mode: str = "download") -> RuntimeInfo:
        self._alive()
        parsed = CodePackage.from_bytes(package)
        plc = self.plc
        plc.downloads.append((package, mode))
        plc.application, plc.symbol_map = parsed.application, parsed.symbols
        plc.code_id, plc.data_id = parsed.code_id, parsed.data_id
        plc.image = bytearray(parsed.initial_image.ljust(IMAGE_SIZE, b"\0"))
        if mode == "download":
            plc.state = "stop"
            plc.size = parsed.image_size
        plc.notify("application")
        return plc.info()

    async def record(
        self,
        items: Sequence[tuple[int, int]],
        task: str | None,
        divider: int,
        min_interval_ns: int,
        *,
        code_id: str = "",
    ) -> FakeRecorder:
        self._alive()
        if self.plc.refuses_recorders:
            raise RuntimeRefused("refused", "no more than 64 recorders per task")
        recorder = FakeRecorder(self.plc, items, min_interval_ns)
        self.plc.recorders.append(recorder)
        return recorder

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        self.callbacks.append(callback)

    async def close(self) -> None:
        self.callbacks.clear()


def division_by_zero() -> ExceptionReport:
    """What a runtime reports of a fault."""
    place = iec_places.Place("motor", "implementation", iec_places.Span(3, 0, 3, 0))
    frames = (CallFrame("FB_Motor", "FB_Motor", 12, place), CallFrame("TON", "Standard/TON", 7))
    return ExceptionReport(
        1, "DIV_ZERO", "division by zero", "MainTask", "FB_Motor", "FB_Motor", 12, 99, 1, frames, {}, place
    )
