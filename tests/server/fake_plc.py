"""A runtime in memory, for tests of what the server does with one."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import MemberInfo, Root, SymbolMap, TypeInfo
from tappet.runtime.client import ForcedValue, RuntimeEvent, RuntimeRefused
from tappet.runtime.faults import CallFrame, ExceptionReport
from tappet.runtime.flight import FlightStatus
from tappet.runtime.logbook import LogEntry
from tappet.runtime.places import Place, path_at
from tappet.runtime.plc import RuntimeInfo
from tappet.runtime.recorder import Frame
from tappet.runtime.tasks import TaskStatistics

IMAGE_SIZE = 256


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
                MemberInfo("nLimit", 1, 48, flags="CONSTANT"),
                MemberInfo("rOther", 2, 56, section="VAR_IN_OUT"),
            ),
        ),
        TypeInfo("GVL", "gvl", 8, members=(MemberInfo("gCount", 1, 0), MemberInfo("gStart", 0, 2))),
    ]
    roots = {"PLC_PRG": Root("PLC_PRG", "program", 0, 9), "GVL": Root("GVL", "gvl", 64, 10)}
    return SymbolMap(types, roots, {"GCOUNT": "GVL", "GSTART": "GVL"}, {"Q": (128, 8)})


@dataclass
class FakePlc:
    """State that outlives connections."""

    down: bool = False
    state: str = "stop"
    cycles: int = 0
    """Single cycles that were ordered."""
    application: str | None = "Application"
    code_id: str | None = "code1"
    data_id: str | None = "data1"
    instance_id: str = "instance1"
    symbols: SymbolMap | None = field(default_factory=symbol_map)
    image: bytearray = field(default_factory=lambda: bytearray(IMAGE_SIZE))
    forced: dict[tuple[int, int | None], bytes] = field(default_factory=dict)
    report: ExceptionReport | None = None
    downloads: list[tuple[bytes, str]] = field(default_factory=list)
    clients: list[FakeClient] = field(default_factory=list)
    recorders: list[FakeRecorder] = field(default_factory=list)
    refuses_recorders: bool = False
    cycle: int = 0
    past: dict[int, bytes] = field(default_factory=dict)
    frozen: bool = False

    async def connect(self, url: str, token: str) -> FakeClient:
        if self.down:
            raise ConnectionRefusedError("Connection refused")
        client = FakeClient(self)
        self.clients.append(client)
        return client

    def tell(self, kind: str) -> None:
        for client in self.clients:
            for callback in client.callbacks:
                callback(RuntimeEvent(kind, self.state))

    def lose(self) -> None:
        """The process dies."""
        self.down = True
        for recorder in self.recorders:
            recorder.end()
        self.tell("lost")
        self.clients.clear()

    def set(self, path: str, value: Any) -> None:
        assert self.symbols is not None
        ref = self.symbols.resolve(path)
        data = self.symbols.encode(ref, value)
        self.image[ref.offset : ref.offset + len(data)] = data

    def run_cycle(self) -> None:
        """One cycle: recorders sample."""
        self.cycle += 1
        if not self.frozen:
            self.past[self.cycle] = bytes(self.image)
        for recorder in self.recorders:
            recorder.sample()


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
    plc: FakePlc
    callbacks: list[Callable[[RuntimeEvent], None]] = field(default_factory=list)

    def _alive(self) -> None:
        if self.plc.down:
            raise ConnectionResetError("gone")

    async def info(self) -> RuntimeInfo:
        self._alive()
        p = self.plc
        return RuntimeInfo("0.1.0", p.instance_id, p.state, p.application, p.code_id, p.data_id, ("normal",))

    async def symbols(self) -> SymbolMap:
        self._alive()
        if self.plc.symbols is None:
            raise RuntimeRefused("refused", "no application is loaded")
        return self.plc.symbols

    async def download(self, package: bytes, mode: str = "download") -> RuntimeInfo:
        self._alive()
        parsed = CodePackage.from_bytes(package)
        self.plc.downloads.append((package, mode))
        self.plc.application = parsed.application
        self.plc.code_id, self.plc.data_id, self.plc.symbols = parsed.code_id, parsed.data_id, parsed.symbols
        self.plc.image = bytearray(parsed.initial_image.ljust(IMAGE_SIZE, b"\0"))
        if mode == "download":
            self.plc.state = "stop"
        self.plc.tell("application")
        return await self.info()

    async def start(self) -> None:
        if self.plc.state == "exception":
            raise RuntimeRefused(
                "refused", "the application is in the state exception; reset it before starting"
            )
        self.plc.state = "run"
        self.plc.tell("state")

    async def stop(self) -> None:
        self.plc.state = "stop"
        self.plc.tell("state")

    async def single_cycle(self) -> None:
        if self.plc.state != "stop":
            raise RuntimeRefused("refused", "a single cycle needs a stopped application")
        self.plc.cycles += 1

    async def reset(self, kind: str) -> None:
        self.plc.image[:] = bytes(len(self.plc.image))
        self.plc.state = "stop"
        if kind == "origin":
            self.plc.state, self.plc.application = "empty", None
            self.plc.code_id = self.plc.data_id = self.plc.symbols = None
        self.plc.tell("state")

    async def read(self, places: Sequence[tuple[int, int]]) -> list[bytes]:
        self._alive()
        return [bytes(self.plc.image[offset : offset + size]) for offset, size in places]

    async def write(self, values: Sequence[tuple[int, bytes, int | None]]) -> bool:
        self._alive()
        for offset, data, bit in values:
            if bit is None:
                self.plc.image[offset : offset + len(data)] = data
            elif data[0]:
                self.plc.image[offset] |= 1 << bit
            else:
                self.plc.image[offset] &= ~(1 << bit)
        return True

    async def force(self, values: Sequence[tuple[int, bytes, int | None]]) -> None:
        await self.write(values)
        self.plc.forced |= {(offset, bit): data for offset, data, bit in values}
        self.plc.tell("forces")

    async def unforce(self, keys: Iterable[tuple[int, int | None]] | None, *, restore: bool = False) -> int:
        for place in list(self.plc.forced) if keys is None else keys:
            self.plc.forced.pop(place, None)
        self.plc.tell("forces")
        return 1

    async def forces(self) -> list[ForcedValue]:
        self._alive()
        symbols = self.plc.symbols or SymbolMap()
        return [
            ForcedValue(offset, bit, data, data, path_at(symbols, Place(offset, len(data), bit)))
            for (offset, bit), data in self.plc.forced.items()
        ]

    async def record(
        self, items: Sequence[tuple[int, int]], task: str | None, divider: int, min_interval_ns: int
    ) -> FakeRecorder:
        self._alive()
        if self.plc.refuses_recorders:
            raise RuntimeRefused("refused", "no more than 64 recorders per task")
        recorder = FakeRecorder(self.plc, items, min_interval_ns)
        self.plc.recorders.append(recorder)
        return recorder

    async def flight_status(self) -> FlightStatus:
        self._alive()
        cycles = sorted(self.plc.past)
        ends = (
            (cycles[0], cycles[0] * 10_000_000, cycles[-1], cycles[-1] * 10_000_000) if cycles else [None] * 4
        )
        by = "exception" if self.plc.state == "exception" else "request" if self.plc.frozen else None
        return FlightStatus(by is not None, by, len(cycles), *ends, 1, 1, 16 << 20, 48 * len(cycles))

    async def flight_history(self) -> list[tuple[int, int]]:
        self._alive()
        return [(cycle, cycle * 10_000_000) for cycle in sorted(self.plc.past)]

    async def flight_read(self, cycle: int, places: Sequence[tuple[int, int]]) -> list[bytes]:
        self._alive()
        if cycle not in self.plc.past:
            raise RuntimeRefused("bad_request", f"cycle {cycle} is not kept")
        return [self.plc.past[cycle][offset : offset + size] for offset, size in places]

    async def flight_freeze(self, on: bool) -> FlightStatus:
        self.plc.frozen = on
        return await self.flight_status()

    async def tasks(self) -> list[TaskStatistics]:
        self._alive()
        return [
            TaskStatistics(
                "MainTask",
                "cyclic",
                1,
                10_000_000,
                "valid",
                7,
                8,
                1500,
                1400,
                1000,
                2000,
                *[1] * 4,
                0,
                0,
                2048,
            )
        ]

    async def reset_statistics(self, task: str) -> None:
        self._alive()

    async def exception(self) -> ExceptionReport | None:
        return self.plc.report

    async def log(self, since: int) -> list[LogEntry]:
        entries = [
            LogEntry(n, 1_700_000_000_000_000_000, "info", "application", f"entry {n}") for n in (1, 2)
        ]
        at = 1_700_000_000_000_000_000
        entries.append(LogEntry(3, at, "exception", "application", "division by zero", "Library/F", 7))
        return [entry for entry in entries if entry.number > since]

    def on_event(self, callback: Callable[[RuntimeEvent], None]) -> None:
        self.callbacks.append(callback)

    async def close(self) -> None:
        self.callbacks.clear()


def division_by_zero() -> ExceptionReport:
    """What a runtime tells about a fault."""
    frame = CallFrame("FB_Motor", "FB_Motor", 12)
    return ExceptionReport(
        1, "DIV_ZERO", "division by zero", "MainTask", "FB_Motor", "FB_Motor", 12, 99, 1, (frame,), {}
    )
