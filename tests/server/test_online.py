"""The online channel: subscriptions, frames, states, and what a bad client can do to it."""

from __future__ import annotations

import asyncio
import json
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as profile
from hypothesis import strategies as st
from server_clients import SOCKETS, bare
from starlette.testclient import WebSocketDenialResponse, WebSocketTestSession

from tappet.server.online.layout import lay_out
from tappet.server.online.outbox import Outbox


@contextmanager
def online(client: TestClient, runtime_id: str) -> Iterator[WebSocketTestSession]:
    with client.websocket_connect(f"{SOCKETS}/api/v1/online?runtime={runtime_id}") as socket:
        assert socket.receive_json()["op"] == "state"
        assert socket.receive_json()["op"] == "forces"
        yield socket


def subscribe(socket: WebSocketTestSession, *expressions: str, id: int = 1, interval_ms: int = 100) -> dict:
    order = {"op": "subscribe", "id": id, "expressions": list(expressions), "interval_ms": interval_ms}
    socket.send_json(order)
    answer = next_message(socket)
    assert answer["op"] == "subscribed", answer
    assert answer["id"] == id
    return answer


def refusal(client: TestClient, runtime_id: str) -> int:
    """Status with which the server refuses the socket."""
    with (
        pytest.raises(WebSocketDenialResponse) as caught,
        client.websocket_connect(f"{SOCKETS}/api/v1/online?runtime={runtime_id}"),
    ):
        pass
    return caught.value.status_code


def next_message(socket: WebSocketTestSession) -> dict[str, Any]:
    """The next text message; frames before it are skipped."""
    while True:
        message = socket.receive()
        if message.get("text") is not None:
            return json.loads(message["text"])


def next_frame(socket: WebSocketTestSession) -> tuple[int, int, int, bytes]:
    """Subscription, cycle, time and values of the next frame; messages before it are skipped."""
    while True:
        data = socket.receive().get("bytes")
        if data is not None:
            subscription, flags, cycle, timestamp = struct.unpack_from("<IIQq", data)
            assert flags == 0
            return subscription, cycle, timestamp, data[24:]


def test_frames_carry_raw_bytes_at_the_told_offsets(
    app: FastAPI, admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    plc.set("PLC_PRG.nCount", 42)
    plc.set("PLC_PRG.rSpeed", 2.5)
    with online(admin, runtime_id) as socket:
        answer = subscribe(
            socket, "PLC_PRG.nCount", "plc_prg.rspeed", "PLC_PRG.eMode", "PLC_PRG.nope", "PLC_PRG.nCount.3"
        )
        count, speed, mode, wrong, bit = answer["items"]
        assert (count["offset"], count["size"], count["kind"], count["type"]) == (0, 2, "int", "INT")
        assert (speed["offset"], speed["size"], speed["kind"]) == (2, 8, "real")
        assert (mode["enum"], mode["base"]) == ({"Off": 0, "On": 1}, "int")
        assert wrong["kind"] == "error"
        assert "nope" in wrong["error"]
        assert (bit["kind"], bit["bit"], bit["size"]) == ("bool", 3, 1)
        subscription, cycle, timestamp, values = next_frame(socket)
        assert subscription == 1
        assert abs(timestamp / 1e9 - time.time()) < 60
        assert struct.unpack_from("<h", values, count["offset"]) == (42,)
        assert struct.unpack_from("<d", values, speed["offset"]) == (2.5,)
        assert values[bit["offset"]] >> bit["bit"] & 1 == 1
        app.state.loop.call_soon_threadsafe(lambda: (plc.set("PLC_PRG.nCount", 43), plc.run_cycle()))
        while cycle == 0:
            _, cycle, _, values = next_frame(socket)
        assert struct.unpack_from("<h", values, 0) == (43,)


def test_structures_have_no_bytes_of_their_own(admin: TestClient, runtime_id: str) -> None:
    with online(admin, runtime_id) as socket:
        motor, after = subscribe(socket, "PLC_PRG.fbMotor", "PLC_PRG.nCount")["items"]
        assert (motor["kind"], motor["size"], motor["error"]) == ("fb", 0, None)
        assert after["offset"] == 0


def test_values_show_while_nothing_runs(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    """No cycle ever runs: values are read instead."""
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount")
        next_frame(socket)
        plc.set("PLC_PRG.nCount", 9)
        assert any(next_frame(socket)[3] == b"\x09\x00" for _ in range(3))


def test_equal_wishes_share_one_recorder(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    with online(admin, runtime_id) as first, online(admin, runtime_id) as second:
        subscribe(first, "PLC_PRG.nCount", id=1)
        subscribe(second, "plc_prg.NCOUNT", id=77)
        assert next_frame(first)[0] == 1
        assert next_frame(second)[0] == 77
        subscribe(first, "PLC_PRG.nCount", id=2, interval_ms=200)
        next_frame(first)
        assert len(plc.recorders) == 2
        assert {r.min_interval_ns for r in plc.recorders} == {100_000_000, 200_000_000}
    _wait(lambda: not plc.recorders)


def test_a_runtime_without_free_recorders_is_read(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    plc.refuses_recorders = True
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount", interval_ms=20)
        next_frame(socket)
        plc.set("PLC_PRG.nCount", 5)
        assert any(next_frame(socket)[3] == b"\x05\x00" for _ in range(20))


def test_unsubscribe_ends_the_recorder(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount", id=5)
        next_frame(socket)
        _wait(lambda: len(plc.recorders) == 1)
        socket.send_json({"op": "unsubscribe", "id": 5})
        _wait(lambda: not plc.recorders)


def test_states_and_forces_are_told(admin: TestClient, runtime_id: str) -> None:
    with online(admin, runtime_id) as socket:
        admin.post(f"/api/v1/runtimes/{runtime_id}/start")
        assert next_message(socket)["state"] == "run"
        body = {"values": [{"expression": "PLC_PRG.nCount", "value": 1}]}
        admin.post(f"/api/v1/runtimes/{runtime_id}/values/force", json=body)
        message = next_message(socket)
        assert message["expressions"] == ["PLC_PRG.nCount"]
        item = subscribe(socket, "PLC_PRG.nCount")["items"][0]
        assert message["places"] == [item["place"]]


def test_lost_runtime_is_told_and_subscriptions_come_back(
    admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount", id=3)
        next_frame(socket)
        plc.set("PLC_PRG.nCount", 11)
        _in_loop(admin, plc.lose)
        message = next_message(socket)
        while message.get("connected") is not False:
            message = next_message(socket)
        assert message["op"] == "state"
        assert message["since"]
        plc.down = False
        message = next_message(socket)
        while message["op"] != "subscribed":
            message = next_message(socket)
        assert (message["id"], message["renewed"]) == (3, True)
        assert next_frame(socket)[3] == b"\x0b\x00"


def test_download_renews_the_layout(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount", id=3)
        next_frame(socket)

        def another_application() -> None:
            plc.state, plc.code_id, plc.data_id = "empty", None, None
            plc.notify("application")

        _in_loop(admin, another_application)
        message = next_message(socket)
        while message["op"] != "subscribed":
            message = next_message(socket)
        assert message["renewed"]
        assert message["items"][0]["kind"] == "error"


@pytest.mark.parametrize(
    "text",
    [
        "", "nonsense", "[]", "null", "1", '"subscribe"', "{}", '{"op":"fly"}', '{"op":"subscribe"}',
        '{"op":"subscribe","id":-1,"expressions":[],"interval_ms":100}',
        '{"op":"subscribe","id":1.5,"expressions":[],"interval_ms":100}',
        '{"op":"subscribe","id":4294967296,"expressions":[],"interval_ms":100}',
        '{"op":"subscribe","id":1,"expressions":"x","interval_ms":100}',
        '{"op":"subscribe","id":1,"expressions":[],"interval_ms":1}',
        '{"op":"subscribe","id":1,"expressions":[1],"interval_ms":100}',
        '{"op":"subscribe","id":1,"expressions":[],"more":1}',
        '{"op":"unsubscribe"}',
        "[" * 5000,
    ],
)  # fmt: skip
def test_bad_messages_are_answered(admin: TestClient, runtime_id: str, text: str) -> None:
    with online(admin, runtime_id) as socket:
        socket.send_text(text)
        answer = next_message(socket)
        assert answer["op"] == "error"
        assert answer["detail"]
        subscribe(socket, "PLC_PRG.nCount")


def test_binary_messages_are_answered(admin: TestClient, runtime_id: str) -> None:
    with online(admin, runtime_id) as socket:
        socket.send_bytes(b"\x00\xff")
        assert next_message(socket)["op"] == "error"
        subscribe(socket, "PLC_PRG.nCount")


@profile(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=20),
        lambda inner: (
            st.lists(inner, max_size=4)
            | st.dictionaries(
                st.sampled_from(["op", "id", "expressions", "interval_ms"]) | st.text(max_size=5),
                inner | st.sampled_from(["subscribe", "unsubscribe"]),
                max_size=5,
            )
        ),
        max_leaves=12,
    )
)
def test_any_json_leaves_the_channel_alive(admin: TestClient, runtime_id: str, message: Any) -> None:
    with online(admin, runtime_id) as socket:
        socket.send_json(message)
        socket.send_json({"op": "subscribe", "id": 9, "expressions": ["GVL.gCount"], "interval_ms": 100})
        while True:
            answer = next_message(socket)
            if answer["op"] == "subscribed" and answer["id"] == 9:
                break


def test_too_many_subscriptions_are_refused(admin: TestClient, runtime_id: str) -> None:
    with online(admin, runtime_id) as socket:
        for id in range(101):
            socket.send_json({"op": "subscribe", "id": id, "expressions": [], "interval_ms": 100})
        answers = [next_message(socket)["op"] for _ in range(101)]
        assert answers == ["subscribed"] * 100 + ["error"]


def test_a_socket_ends_with_its_session(
    admin: TestClient, runtime_id: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tappet.server.sockets.CHECK_EVERY_S", 0.05)
    with online(admin, runtime_id) as socket:
        subscribe(socket, "PLC_PRG.nCount")
        assert admin.post("/api/v1/auth/logout").status_code == 204
        message = socket.receive()
        while message["type"] != "websocket.close":
            message = socket.receive()
        assert message["code"] == 4401


def test_foreign_pages_and_strangers_get_no_socket(app: FastAPI, admin: TestClient, runtime_id: str) -> None:
    foreign = bare(app, headers={"Origin": "http://evil.example"})
    foreign.cookies.set("tappet_session", admin.cookies["tappet_session"])
    for client in (foreign, bare(app)):
        assert refusal(client, runtime_id) in (401, 403)


def test_unknown_runtime_gets_no_socket(admin: TestClient) -> None:
    assert refusal(admin, "none") == 404


def test_only_the_newest_frame_of_a_subscription_waits() -> None:
    outbox = Outbox()

    async def take_all() -> list[Any]:
        outbox.put_frame(1, b"old")
        outbox.put_frame(2, b"other")
        outbox.put_frame(1, b"new")
        outbox.put_message("first")
        return [await outbox.take() for _ in range(3)]

    assert asyncio.run(take_all()) == ["first", b"other", b"new"]
    assert outbox.replaced == 1


def test_a_reader_that_does_not_take_its_answers_is_not_read_on() -> None:
    async def fill() -> bool:
        outbox = Outbox()
        for _ in range(300):
            outbox.put_message("x")
        waiting = asyncio.create_task(outbox.wait_for_room())
        await asyncio.sleep(0)
        blocked = not waiting.done()
        while outbox._messages:
            await outbox.take()
        await asyncio.wait_for(waiting, 60)
        return blocked

    assert asyncio.run(fill())


def test_large_layouts_are_refused(plc: FakePlc) -> None:
    assert plc.symbol_map is not None
    with pytest.raises(ValueError, match="at most 1048576"):
        lay_out(plc.symbol_map, ["PLC_PRG.sName"] * 100_000)


def _wait(condition) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, "did not happen"
        time.sleep(0.01)


def _in_loop(admin: TestClient, work) -> None:
    admin.app.state.loop.call_soon_threadsafe(work)
