"""A browser that does not fetch its frames, over a real socket, gets the newest ones and costs nothing."""

from __future__ import annotations

import asyncio
import json
import os
import socket
from datetime import UTC, datetime

import uvicorn
import websockets
from fake_plc import FakePlc
from sqlalchemy import Connection

from tappet.server.app import create_app
from tappet.server.auth import accounts, tokens
from tappet.server.auth.roles import Role
from tappet.server.settings import ServerSettings

EXPRESSIONS = ["PLC_PRG.sName"] * 4900
FRAMES = 200
BUFFER = 1 << 16
"""Bytes that the sockets of both sides keep: a frame has more."""


def _token(db: Connection) -> str:
    now = datetime.now(UTC)
    account = accounts.create(db, "viewer", None, Role.VIEWER, now)
    return tokens.issue(db, account.id, "t", Role.VIEWER, None, now)[1]


async def test_unfetched_frames_are_replaced(settings: ServerSettings) -> None:
    plc = FakePlc(state="run")
    plc.image[:] = os.urandom(len(plc.image))
    app = create_app(settings, plc.connect)
    listener = socket.create_server(("127.0.0.1", 0))
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
    config = uvicorn.Config(app, log_config=None, ws_per_message_deflate=False)
    server = uvicorn.Server(config)
    serving = asyncio.create_task(server.serve(sockets=[listener]))
    async with asyncio.timeout(60):
        while not server.started:  # noqa: ASYNC110 - uvicorn has no event for it
            await asyncio.sleep(0.02)
        services = app.state.services
        link = services.runtimes.add("plc", "ws://plc", "t")
        token = await services.database.write_async(_token)
        while not link.connected:  # noqa: ASYNC110
            await asyncio.sleep(0.02)
        address = f"ws://127.0.0.1:{listener.getsockname()[1]}/api/v1/online?runtime={link.id}"
        headers = {"Authorization": f"Bearer {token}"}
        connection = socket.socket()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
        connection.connect(listener.getsockname())
        async with websockets.connect(
            address, sock=connection, additional_headers=headers, max_queue=1, compression=None
        ) as browser:
            order = {"op": "subscribe", "id": 1, "expressions": EXPRESSIONS, "interval_ms": 10}
            await browser.send(json.dumps(order))
            for _ in range(3):
                await browser.recv()
            for n in range(FRAMES):
                plc.run_cycle()
                if n % 10 == 0:
                    await asyncio.sleep(0.001)
            (channel,) = services.metrics.online_channels
            while channel.outbox.replaced + channel.outbox.sent < FRAMES - 1:  # one may wait  # noqa: ASYNC110
                await asyncio.sleep(0.02)
            assert channel.outbox.replaced > FRAMES // 2
            assert channel.outbox.sent < FRAMES // 2
            last = 0
            while last < FRAMES:
                frame = await browser.recv()
                cycle = int.from_bytes(frame[8:16], "little")
                assert cycle >= last, "frames come in order"
                last = cycle
        while services.metrics.online_channels:  # noqa: ASYNC110
            await asyncio.sleep(0.02)
        assert services.metrics.frames_replaced > 0
        server.should_exit = True
        await serving
