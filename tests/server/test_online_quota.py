"""One user who watches too much gets coarser intervals; others get what they asked for."""

from __future__ import annotations

import time
from contextlib import ExitStack
from itertools import permutations

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from server_clients import PASSWORD, browser
from starlette.testclient import WebSocketDenialResponse
from test_online import next_message, online, subscribe

from tappet.server.online import quota
from tappet.server.online.quota import Share, UserQuota

NAMES = (
    "PLC_PRG.nCount",
    "PLC_PRG.rSpeed",
    "PLC_PRG.bStart",
    "PLC_PRG.tDelay",
    "PLC_PRG.eMode",
    "GVL.gCount",
)


def test_five_greedy_sockets_do_not_slow_another_user(
    app: FastAPI, admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    admin.post("/api/v1/users", json={"username": "bob", "password": PASSWORD, "role": "viewer"})
    bob = browser(app)
    bob.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    orders = [list(names) for count in (3, 4) for names in permutations(NAMES, count)]
    with ExitStack() as stack:
        greedy = [stack.enter_context(online(admin, runtime_id)) for _ in range(5)]
        for number, names in enumerate(orders[:250]):
            socket = greedy[number % 5]
            order = {"op": "subscribe", "id": number, "expressions": names, "interval_ms": 10}
            socket.send_json(order)
            while (answer := next_message(socket))["op"] != "subscribed" or answer["id"] != number:
                assert answer["op"] in ("subscribed", "paced"), answer
        assert answer["interval_ms"] == 10 * 32, "25,000 frames a second were asked for"
        other = stack.enter_context(online(bob, runtime_id))
        assert subscribe(other, "PLC_PRG.nCount")["interval_ms"] == 100
        end = time.monotonic() + 60
        while (paces := sorted(one.min_interval_ns // 1_000_000 for one in plc.recorders)) != [100, 320]:
            assert time.monotonic() < end, paces
            time.sleep(0.01)


def test_too_many_sockets_are_refused(
    admin: TestClient, runtime_id: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(quota, "MOST_SOCKETS", 2)
    with online(admin, runtime_id), online(admin, runtime_id):
        with pytest.raises(WebSocketDenialResponse) as refused, online(admin, runtime_id):
            pass
        assert refused.value.status_code == 429
    with online(admin, runtime_id):
        pass


def test_too_many_variables_are_refused(
    admin: TestClient, runtime_id: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(quota, "MOST_EXPRESSIONS", 3)
    with online(admin, runtime_id) as socket:
        subscribe(socket, *NAMES[:2])
        socket.send_json({"op": "subscribe", "id": 2, "expressions": list(NAMES[:2])})
        assert next_message(socket)["detail"] == "One user watches at most 3 variables at a time."
        subscribe(socket, *NAMES[:3])


class Told(Share):
    """Keeps what it was told."""

    now: int


def enter(user: UserQuota, size: int, interval_ms: int) -> Told:
    share = Told(size, interval_ms, 1)
    share.paced = lambda interval: setattr(share, "now", interval)
    share.now = user.enter(share)
    return share


@given(st.lists(st.tuples(st.integers(1, 100_000), st.integers(10, 1000), st.booleans()), max_size=60))
def test_the_quota_holds_and_everybody_knows_the_interval(
    steps: list[tuple[int, int, bool]],
) -> None:
    user, shares = UserQuota(), []
    for size, interval_ms, leaves in steps:
        if leaves and shares:
            user.leave(shares.pop(0))
        else:
            shares.append(enter(user, size, interval_ms))
        frames = sum(1000 / one.now for one in shares)
        assert frames <= quota.FRAMES_PER_S + 1e-6
        assert sum(one.size * 1000 / one.now for one in shares) <= quota.BYTES_PER_S * (1 + 1e-9)
        assert all(one.now == user.interval(one) >= one.interval_ms for one in shares)
    for one in shares[1:]:
        user.leave(one)
    if shares and 1000 / shares[0].interval_ms * shares[0].size < 0.4 * quota.BYTES_PER_S:
        assert shares[0].now == shares[0].interval_ms, "alone it gets what it asked for"


async def test_looking_up_is_paid_from_a_budget() -> None:
    user = UserQuota()
    slept: list[float] = []

    async def sleep(seconds: float) -> None:
        slept.append(seconds)

    patch = pytest.MonkeyPatch()
    patch.setattr(quota.asyncio, "sleep", sleep)
    try:
        for _ in range(10):
            await user.pay(5000)
    finally:
        patch.undo()
    assert len(slept) == 6
    assert 5 < slept[-1] <= 6
