"""Connections that say nothing, too little or too slowly, and too many of them."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

import pytest
import uvicorn
from uvicorn.server import Server

from tappet.log_rate import RateLimit
from tappet.server.connection_limits import DESCRIPTORS_KEPT, ConnectionLimits
from tappet.server.connections import LimitedProtocol

ANSWER = 64 << 20
"""More than all buffers on the way take."""
GET = b"GET /%s HTTP/1.1\r\nHost: x\r\n\r\n"


async def application(scope: Any, receive: Any, send: Any) -> None:
    """Reads what it is sent; answers shortly, or with a lot."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.accept"})
        await receive()
        return
    while (await receive()).get("more_body"):
        pass
    size = ANSWER if scope["path"] == "/large" else 2
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"%d" % size)]})
    await send({"type": "http.response.body", "body": bytes(size)})


class Impatient(LimitedProtocol):
    """With short times."""

    limits = ConnectionLimits(total=12, of_address=8)
    head_s = 0.3
    silence_s = 1.0


async def until(condition: Callable[[], bool]) -> None:
    """Waits for what must happen."""
    for _ in range(3000):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise TimeoutError


@asynccontextmanager
async def served() -> AsyncIterator[tuple[Server, int]]:
    """A server on a free port."""
    config = uvicorn.Config(
        application, http=Impatient, host="127.0.0.1", port=0, log_config=None, lifespan="off"
    )
    server = Server(config)
    task = asyncio.create_task(server._serve())
    await until(lambda: server.started)
    try:
        yield server, server.servers[0].sockets[0].getsockname()[1]
    finally:
        server.should_exit = True
        await task


async def connect(port: int, address: str = "127.0.0.1") -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    """A connection from an address of this machine."""
    return await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))


async def ended(reader: asyncio.StreamReader) -> bytes:
    """What comes until the server closes."""
    found = b""
    try:
        async with asyncio.timeout(30):
            while piece := await reader.read(1 << 16):
                found += piece
    except ConnectionError:
        pass
    return found


async def test_a_silent_connection_is_closed() -> None:
    async with served() as (_, port):
        reader, _ = await connect(port)
        assert await ended(reader) == b""


async def test_pieces_of_a_head_do_not_prolong_its_time() -> None:
    async with served() as (_, port):
        reader, writer = await connect(port)
        over = asyncio.create_task(ended(reader))
        writer.write(b"GET / HTTP/1.1\r\n")
        for number in range(600):
            if over.done():
                break
            writer.write(b"X-%d: 1\r\n" % number)
            await asyncio.sleep(0.05)
        assert over.done()
        assert await over == b""


async def test_nor_those_of_a_second_request() -> None:
    async with served() as (_, port):
        reader, writer = await connect(port)
        writer.write(GET % b"")
        assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 200")
        await reader.readexactly(2)
        writer.write(b"GET / HT")
        assert await ended(reader) == b""


async def test_a_body_that_does_not_come_is_not_waited_for() -> None:
    async with served() as (_, port):
        reader, writer = await connect(port)
        writer.write(b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\nabc")
        assert await ended(reader) == b""


async def test_an_answer_that_is_not_taken_is_given_up() -> None:
    async with served() as (server, port):
        _, writer = await connect(port)
        writer.write(GET % b"large")
        await until(lambda: bool(server.server_state.connections))
        await until(lambda: not server.server_state.connections)


async def test_what_is_complete_is_answered_however_long_it_takes() -> None:
    async with served() as (_, port):
        reader, writer = await connect(port)
        writer.write(b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 12\r\n\r\n")
        for _ in range(12):
            await asyncio.sleep(0.1)  # more than the time of one silence in all
            writer.write(b"x")
        assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 200")


async def test_one_address_does_not_take_the_places_of_others(caplog: pytest.LogCaptureFixture) -> None:
    async with served() as (server, port):
        mine = [await connect(port) for _ in range(20)]
        others, writer = await connect(port, "127.0.0.2")
        writer.write(GET % b"")
        assert (await others.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 200")
        assert len(server.server_state.connections) <= 9
        refused = [text for text in caplog.messages if "127.0.0.1 was refused: 8 are open" in text]
        assert len(refused) == 12
        for _, theirs in mine:
            theirs.close()


async def test_sockets_count_and_are_left_alone() -> None:
    import websockets

    async with served() as (server, port):
        sockets = [await websockets.connect(f"ws://127.0.0.1:{port}/", proxy=None) for _ in range(8)]
        reader, _ = await connect(port)
        assert await ended(reader) == b""
        await asyncio.sleep(1)
        assert len(server.server_state.connections) == 8
        assert [socket.close_code for socket in sockets] == [None] * 8
        for socket in sockets:
            await socket.close()


def test_limits_keep_descriptors_for_the_server_itself() -> None:
    assert ConnectionLimits(2000, 500).within(1024) == ConnectionLimits(1024 - DESCRIPTORS_KEPT, 384)
    assert ConnectionLimits(2000, 500).within(8192) == ConnectionLimits(2000, 500)


def test_a_line_that_comes_too_often_is_counted_instead() -> None:
    now = [0.0]
    limit = RateLimit(most=3, seconds=10.0, clock=lambda: now[0])

    def line(text: str, *values: object) -> logging.LogRecord:
        return logging.LogRecord("tappet", logging.WARNING, "a.py", 7, text, values, None)

    assert [limit.filter(line("%s failed", n)) for n in range(1000)] == [True] * 3 + [False] * 997
    assert limit.filter(line("another")), "others are not held back"
    now[0] = 10.0
    told = line("%s failed", 1000)
    assert limit.filter(told)
    assert told.getMessage() == "1000 failed (997 lines like this were left out)"
