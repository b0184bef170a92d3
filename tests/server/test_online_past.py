"""The online channel looking back: all subscriptions show one past cycle of the flight recorder."""

from __future__ import annotations

import json
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from fake_plc import FakePlc
from fastapi.testclient import TestClient
from server_clients import SOCKETS
from starlette.testclient import WebSocketTestSession


@contextmanager
def online(client: TestClient, runtime_id: str) -> Iterator[WebSocketTestSession]:
    with client.websocket_connect(f"{SOCKETS}/api/v1/online?runtime={runtime_id}") as socket:
        yield socket


def _message(socket: WebSocketTestSession, op: str) -> dict[str, Any]:
    """The next message of this kind; everything before it is skipped."""
    while True:
        text = socket.receive().get("text")
        if text is not None and (message := json.loads(text))["op"] == op:
            return message


def _past_frame(socket: WebSocketTestSession) -> tuple[int, int, int]:
    """Subscription, cycle and the INT of the next frame of the past; live ones are skipped."""
    while True:
        data = socket.receive().get("bytes")
        if data is not None:
            subscription, flags, cycle, _ = struct.unpack_from("<IIQq", data)
            if flags:
                assert flags == 1
                return subscription, cycle, struct.unpack_from("<h", data, 24)[0]


def _subscribe(socket: WebSocketTestSession, id: int, expression: str) -> None:
    order = {"op": "subscribe", "id": id, "expressions": [expression], "interval_ms": 100}
    socket.send_json(order)
    assert _message(socket, "subscribed")["id"] == id


def _look(socket: WebSocketTestSession, cycle: int | None) -> dict[str, Any]:
    socket.send_json({"op": "look_back", "cycle": cycle})
    return _message(socket, "looked_back")


def _run(plc: FakePlc, cycles: int) -> None:
    for _ in range(cycles):
        plc.set("PLC_PRG.nCount", 100 + plc.cycle + 1)
        plc.run_cycle()


def test_every_subscription_shows_the_cycle(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    _run(plc, 5)
    with online(admin, runtime_id) as socket:
        _subscribe(socket, 1, "PLC_PRG.nCount")
        _subscribe(socket, 2, "plc_prg.ncount")
        for cycle in (3, 2, 5):
            assert _look(socket, cycle) == {"op": "looked_back", "cycle": cycle, "problem": None}
            frames = {_past_frame(socket) for _ in range(2)}
            assert frames == {(1, cycle, 100 + cycle), (2, cycle, 100 + cycle)}
        _subscribe(socket, 3, "PLC_PRG.nCount")
        assert _past_frame(socket) == (3, 5, 105)
        deadline = time.monotonic() + 10  # recorders are closed in the background
        while plc.recorders and time.monotonic() < deadline:
            time.sleep(0.01)
        assert not plc.recorders, "nothing is sampled for a channel that looks back"
        assert _look(socket, None)["cycle"] is None
        plc.set("PLC_PRG.nCount", 7)
        seen: set[int] = set()
        while len(seen) < 3:
            data = socket.receive().get("bytes")
            if data is not None and struct.unpack_from("<II", data)[1] == 0:
                seen.add(struct.unpack_from("<I", data)[0])


def test_a_cycle_that_is_not_kept_changes_nothing(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    _run(plc, 3)
    with online(admin, runtime_id) as socket:
        _subscribe(socket, 1, "PLC_PRG.nCount")
        answer = _look(socket, 99)
        assert answer["cycle"] is None
        assert "cycle 99 is not kept" in answer["problem"]
        assert _look(socket, 2)["cycle"] == 2
        answer = _look(socket, 99)
        assert (answer["cycle"], answer["problem"] is None) == (2, False)
        for wrong in (-1, "x", 1.5, 1 << 60):
            socket.send_json({"op": "look_back", "cycle": wrong})
            assert "cycle" in _message(socket, "error")["detail"]


def test_forces_of_the_past_are_not_known(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    _run(plc, 2)
    url = f"/api/v1/runtimes/{runtime_id}/values/force"
    order = {"values": [{"expression": "PLC_PRG.nCount", "value": "5"}]}
    assert admin.post(url, json=order).status_code < 300
    with online(admin, runtime_id) as socket:
        assert _message(socket, "forces")["expressions"] == ["PLC_PRG.nCount"]
        _look(socket, 1)
        assert _message(socket, "forces")["expressions"] == []
        _look(socket, None)
        assert _message(socket, "forces")["expressions"] == ["PLC_PRG.nCount"]


def test_another_application_ends_the_past(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    _run(plc, 2)
    with online(admin, runtime_id) as socket:
        _subscribe(socket, 1, "PLC_PRG.nCount")
        _look(socket, 1)
        plc.instance_id = "another"
        admin.app.state.loop.call_soon_threadsafe(plc.notify, "application")  # type: ignore[attr-defined]
        assert _message(socket, "looked_back")["cycle"] is None
        assert _message(socket, "subscribed")["renewed"] is True
