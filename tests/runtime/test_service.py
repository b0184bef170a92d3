"""The WebSocket service and its client: authentication, requests, events, recorders, hostile frames."""

import asyncio
import contextlib
import struct
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from plc_programs import MS, build, until
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from tappet.iec.task import Task
from tappet.runtime import protocol, service, subscriptions
from tappet.runtime.client import ConnectionLost, Recorder, RuntimeClient, RuntimeEvent, RuntimeRefused
from tappet.runtime.operations import registry
from tappet.runtime.operations.life_cycle import GetInfo, Hello, Reset, Start, Stop
from tappet.runtime.operations.recording import Record
from tappet.runtime.operations.reports import GetException, ReadLog
from tappet.runtime.operations.tasks import ListTasks, ResetStatistics
from tappet.runtime.operations.values import Force, ListForces, Read, Unforce, Write
from tappet.runtime.plc import SoftPlc
from tappet.runtime.service import RuntimeService

TOKEN = "a token of the tests, long enough"
TEXT = """
PROGRAM PLC_PRG
VAR n, copy : DINT; w : WORD; fail : BOOL; pValue : POINTER TO DINT; big : ARRAY [0..20000] OF LINT; END_VAR
n := n + 1;
copy := n;
IF fail THEN pValue^ := 1; END_IF
END_PROGRAM
"""
FAST = (Task("Main", interval_ns=2 * MS, programs=("PLC_PRG",)),)


@asynccontextmanager
async def serving(plc: SoftPlc | None = None) -> AsyncIterator[tuple[str, SoftPlc]]:
    plc = plc or SoftPlc(None)
    server = RuntimeService(plc, TOKEN)
    port = await server.start("127.0.0.1", 0)
    try:
        yield f"ws://127.0.0.1:{port}", plc
    finally:
        await server.close()
        plc.close()


@asynccontextmanager
async def running() -> AsyncIterator[tuple[RuntimeClient, SoftPlc, str]]:
    async with serving() as (url, plc), await RuntimeClient.connect(url, TOKEN) as client:
        await client.download(build(TEXT, FAST).to_bytes())
        await client.call(Start())
        yield client, plc, url


async def test_life_cycle_over_the_wire() -> None:
    async with serving() as (url, _), await RuntimeClient.connect(url, TOKEN) as client:
        events: list[RuntimeEvent] = []
        client.on_event(events.append)
        assert (await client.call(GetInfo())).state == "empty"
        info = await client.download(build(TEXT, FAST).to_bytes())
        assert (info.state, info.application, info.cycle_ns) == ("stop", "App", 2 * MS)
        await client.call(Start())
        assert (await client.call(GetInfo())).state == "run"
        await client.call(Stop())
        await client.call(Reset("cold"))
        await client.call(Reset("origin"))
        assert (await client.call(GetInfo())).application is None
        assert [(e.kind, e.state) for e in events] == [
            ("application", "stop"), ("state", "run"), ("state", "stop"), ("state", "stop"),
            ("application", "empty"),
        ]  # fmt: skip


async def test_values_and_forces() -> None:
    async with running() as (client, _, _):
        symbols = await client.symbols()
        assert symbols is await client.symbols()
        w = symbols.resolve("PLC_PRG.w")
        assert await client.call(Write([(w.offset, b"\x00\x01", None)]))
        bit = symbols.resolve("PLC_PRG.w.3")
        assert await client.call(Write([(bit.offset, b"\1", bit.bit)]))
        assert await client.call(Read([(w.offset, 2)])) == [b"\x08\x01"]
        await client.call(Force([(w.offset, b"\xff\xff", None)]))
        (forced,) = await client.call(ListForces())
        assert (forced.path, forced.data, forced.before) == ("PLC_PRG.w", b"\xff\xff", b"\x08\x01")
        assert await client.call(Unforce([(w.offset, None)], restore=True)) == 1
        await client.call(Write([(symbols.resolve("PLC_PRG.copy").offset, b"\0\0\0\0", None)]))
        assert await client.call(Read([(w.offset, 2)])) == [b"\x08\x01"]


async def test_recorder_frames_are_of_one_cycle() -> None:
    async with running() as (client, _, _):
        symbols = await client.symbols()
        places = [(symbols.resolve(f"PLC_PRG.{v}").offset, 4) for v in ("copy", "n")]
        recorder = await client.record(places, task="Main")
        frames = []
        async for frame in recorder:
            frames.append(frame)
            if len(frames) == 100:
                break
        await recorder.close()
        numbers = [struct.unpack("<ii", f.data) for f in frames]
        assert all(a == b for a, b in numbers)
        assert [n for n, _ in numbers] == list(range(numbers[0][0], numbers[0][0] + 100))
        assert [f.cycle - frames[0].cycle for f in frames] == list(range(100))


async def test_exception_reaches_the_client() -> None:
    async with running() as (client, _, _):
        arrived = asyncio.Event()
        client.on_event(lambda e: arrived.set() if e.kind == "exception" else None)
        fail = (await client.symbols()).resolve("PLC_PRG.fail")
        await client.call(Write([(fail.offset, b"\1", None)]))
        await asyncio.wait_for(arrived.wait(), 10)
        report = await client.call(GetException())
        assert report is not None
        assert (report.name, report.pou, report.task) == ("NULL_REFERENCE", "PLC_PRG", "Main")
        assert any(e.severity == "exception" for e in await client.call(ReadLog()))
        with pytest.raises(RuntimeRefused, match="reset it"):
            await client.call(Start())
        await client.call(Reset("warm"))
        await client.call(Start())
        assert await client.call(GetException()) is None


async def has_run(client: RuntimeClient, expected: bool) -> bool:
    return bool((await client.call(ListTasks()))[0].iec_cycles) is expected


async def test_statistics() -> None:
    async with running() as (client, _, _):
        await until(lambda: has_run(client, True))
        (task,) = await client.call(ListTasks())
        assert (task.name, task.status, task.interval_ns) == ("Main", "valid", 2 * MS)
        await client.call(Stop())
        await client.call(ResetStatistics("Main"))
        await until(lambda: has_run(client, False))


async def drain(recorder: Recorder) -> None:
    """Ends when the recorder does."""
    async for _ in recorder:
        pass


async def test_recorders_end_with_their_application() -> None:
    async with running() as (client, _, _):
        recorder = await client.record([(0, 8)])
        await client.download(build(TEXT, FAST).to_bytes())
        await asyncio.wait_for(drain(recorder), 20)


async def test_a_recorder_that_nobody_waits_for_any_more_is_ended() -> None:
    """A browser that goes on to other values before the answer has come; the PLC has 256 a connection."""
    async with running() as (client, plc, _):
        for number in range(subscriptions.MOST_RECORDERS + 50):
            asked = asyncio.create_task(client.record([(0, 8)]))
            for _ in range(number % 6):
                await asyncio.sleep(0)
            asked.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await (await asked).close()

        async def ended() -> bool:
            application = plc.application
            assert application is not None
            return not any(application.recorders.values()) and not client._endings and not client._orphans

        await until(ended)
        await (await client.record([(0, 8)])).close()


async def test_wrong_token_is_refused_and_logged() -> None:
    async with serving() as (url, plc):
        for token in ("", "wrong", TOKEN[:-1]):
            with pytest.raises(ConnectionLost):
                await RuntimeClient.connect(url, token)
        assert any("wrong token" in e.message for e in plc.log.since())


async def test_no_runtime_at_that_address() -> None:
    with pytest.raises(ConnectionLost, match=r"no runtime at .*nothing listens there"):
        await RuntimeClient.connect("ws://127.0.0.1:1", TOKEN)
    with pytest.raises(ConnectionLost, match=r"no runtime at .*(not known|resolution|associated)"):
        await RuntimeClient.connect("ws://no-such-host.invalid:1", TOKEN)


async def test_a_silent_client_is_disconnected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(protocol, "HELLO_TIMEOUT_S", 0.1)
    async with serving() as (url, _), connect(url) as socket:
        with pytest.raises(ConnectionClosed):
            await asyncio.wait_for(socket.recv(), 10)
        assert socket.close_code == protocol.CLOSE_HELLO


async def test_requests_before_hello_are_refused() -> None:
    async with serving() as (url, _), connect(url) as socket:
        await socket.send(protocol.pack_request(1, GetInfo()))
        with pytest.raises(ConnectionClosed):
            await asyncio.wait_for(socket.recv(), 10)


async def test_a_client_of_another_version_hears_both_versions() -> None:
    async with serving() as (url, _), connect(url) as socket:
        await socket.send(msgspec.msgpack.encode({"v": 1, "id": 1, "op": "hello", "token": TOKEN}))
        with pytest.raises(ConnectionClosed):
            await asyncio.wait_for(socket.recv(), 10)
        assert socket.close_code == protocol.CLOSE_HELLO
        assert socket.close_reason == "expected hello: protocol version 1 is not 2"


async def test_a_runtime_of_another_version_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    async with serving() as (url, _):
        monkeypatch.setattr(protocol, "pack_request", lambda n, o: msgspec.msgpack.encode({"v": 3, "id": n}))
        with pytest.raises(ConnectionLost, match="protocol version 3 is not 2"):
            await RuntimeClient.connect(url, TOKEN)


async def test_wrong_arguments_are_refused_by_operation_and_field() -> None:
    async with running() as (client, _, _):
        with pytest.raises(RuntimeRefused, match=r"read: 'places\[0\]\[1\]': expected 'int' >= 1") as caught:
            await client.call(Read([(0, 0)]))
        assert caught.value.code == "bad_request"
        with pytest.raises(RuntimeRefused, match=r"reset: 'kind': invalid enum value 'hot'"):
            await client.call(Reset("hot"))
        with pytest.raises(RuntimeRefused, match="there is no task 'Slow'; there are Main") as caught:
            await client.call(ResetStatistics("Slow"))
        assert caught.value.code == "not_found"


async def test_pages_of_a_browser_are_refused() -> None:
    async with serving() as (url, _):
        with pytest.raises(InvalidStatus):
            await connect(url, origin="http://127.0.0.1:8080")  # type: ignore[arg-type]


async def test_clients_over_the_limit_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "MOST_CONNECTIONS", 2)
    async with serving() as (url, _):
        clients = [await RuntimeClient.connect(url, TOKEN) for _ in range(2)]
        with pytest.raises(ConnectionLost):
            await RuntimeClient.connect(url, TOKEN)
        await clients[0].close()

        async def connected() -> bool:
            try:
                clients[0] = await RuntimeClient.connect(url, TOKEN)
            except ConnectionLost:
                return False
            return True

        await until(connected)
        for client in clients:
            await client.close()


async def hello(url: str):
    socket = await connect(url, max_size=None)
    await socket.send(protocol.pack_request(0, Hello(TOKEN)))
    await socket.recv()
    return socket


FIELDS = sorted({name for kind in registry.known().values() for name in kind.__struct_fields__})
scalars = (
    st.none()
    | st.booleans()
    | st.integers(-(1 << 63), (1 << 63) - 1)
    | st.text(max_size=5)
    | st.binary(max_size=9)
)
arguments = st.dictionaries(
    st.sampled_from(FIELDS),
    scalars | st.lists(st.lists(scalars, max_size=3), max_size=3),
    max_size=4,
)
messages = st.binary(max_size=60) | st.tuples(st.sampled_from(sorted(registry.known())), arguments)


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(messages, min_size=1, max_size=30))
def test_every_message_is_answered_or_the_connection_closed(batch: list[object]) -> None:
    """Fuzz: nothing a client sends ends the service or the application."""

    async def scenario() -> None:
        async with serving() as (url, plc):
            plc.load(build(TEXT, FAST))
            socket = await hello(url)
            for number, message in enumerate(batch, 1):
                data = message
                if isinstance(message, tuple):
                    data = protocol.pack({"id": number, "op": message[0], "args": message[1]})
                try:
                    await socket.send(data)
                    answered = False
                    while not answered:
                        reply = await asyncio.wait_for(socket.recv(), 20)
                        answered = not protocol.is_frames(reply) and "id" in msgspec.msgpack.decode(reply)
                except ConnectionClosed:
                    break
            await socket.close()
            async with await RuntimeClient.connect(url, TOKEN) as client:
                assert (await client.call(GetInfo())).version

    asyncio.run(scenario())


async def test_too_many_malformed_messages_end_the_connection() -> None:
    async with serving() as (url, _):
        socket = await hello(url)
        for _ in range(10):
            await socket.send(b"\xc1 not a message")
            await asyncio.wait_for(socket.recv(), 10)
        with pytest.raises(ConnectionClosed):
            await asyncio.wait_for(socket.recv(), 10)
        assert socket.close_code == protocol.CLOSE_PROTOCOL


async def test_oversized_messages_end_the_connection() -> None:
    async with serving() as (url, _):
        socket = await hello(url)
        with contextlib.suppress(ConnectionClosed):
            await socket.send(b"\0" * (protocol.MAX_MESSAGE + 1))
        with pytest.raises(ConnectionClosed):
            await asyncio.wait_for(socket.recv(), 10)
        assert socket.close_code == 1009


async def test_a_slow_client_gets_the_newest_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subscriptions, "PENDING_BYTES", 1 << 20)
    async with running() as (client, _, url):
        symbols = await client.symbols()
        socket = await hello(url)
        big = symbols.resolve("PLC_PRG.big")
        n = symbols.resolve("PLC_PRG.n")
        items = [(n.offset, 4), (big.offset, big.size)]
        await socket.send(protocol.pack_request(1, Record(items, frames=16)))
        start = struct.unpack("<i", (await client.call(Read([(n.offset, 4)])))[0])[0]

        async def filled() -> bool:
            """So many frames of 160 kB fit into no buffer between runtime and client."""
            return struct.unpack("<i", (await client.call(Read([(n.offset, 4)])))[0])[0] > start + 500

        await until(filled)
        before = struct.unpack("<i", (await client.call(Read([(n.offset, 4)])))[0])[0]
        numbers, dropped = [], 0
        while not numbers or numbers[-1] < before:
            reply = await asyncio.wait_for(socket.recv(), 20)
            if protocol.is_frames(reply):
                batch = protocol.unpack_frames(reply)
                dropped = batch.dropped
                numbers += [struct.unpack_from("<i", f.data)[0] for f in batch.frames(4 + big.size)]
        assert numbers == sorted(numbers)
        assert dropped > 0
        await socket.close()


async def test_a_lost_runtime_ends_waiting_calls() -> None:
    events: list[str] = []
    async with serving() as (url, plc):
        client = await RuntimeClient.connect(url, TOKEN)
        client.on_event(lambda e: events.append(e.kind))
        plc.load(build(TEXT, FAST))
        recorder = await client.record([(0, 8)])
    await asyncio.wait_for(drain(recorder), 20)
    with pytest.raises(ConnectionLost):
        await client.call(GetInfo())
    assert events[-1] == "lost"
    await client.close()


async def test_connections_that_never_say_hello_do_not_pile_up(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(service, "MOST_OPEN", 8)
    monkeypatch.setattr(protocol, "HELLO_TIMEOUT_S", 0.5)
    async with running() as (client, _, url):
        port = int(url.rpartition(":")[2])
        silent = [await asyncio.open_connection("127.0.0.1", port) for _ in range(100)]
        assert (await client.call(GetInfo())).state == "run"
        ended = [await asyncio.wait_for(reader.read(), 30) for reader, _ in silent]
        assert ended == [b""] * 100

        async def connected() -> bool:
            with contextlib.suppress(ConnectionError, OSError):
                async with await RuntimeClient.connect(url, TOKEN) as another:
                    return (await another.call(GetInfo())).state == "run"
            return False

        await until(connected)
        assert len(caplog.records) <= 25
        for _, writer in silent:
            writer.close()
