"""Floods of connections, and readers that do not read, at each door.

Others are served meanwhile; log and memory stay small.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import ExitStack, suppress

import httpx
import pytest
from door_client import TEXT, Connection, Door, DoorError, frame
from live_server import RUNTIME, until
from live_team import Team, team

from tappet.runtime import protocol
from tappet.runtime.operations.life_cycle import Hello
from tappet.runtime.operations.recording import Record
from tappet.runtime.operations.symbols import GetSymbols
from tappet.server.connection_limits import raise_descriptor_limit

pytestmark = pytest.mark.slow
FLOOD = 1100
"""Connections from one address."""
FLOODER, READER = "127.0.0.3", "127.0.0.4"
LOG_BYTES = 100_000
GROWTH_MIB = 300
SOCKETS = ("online", "events", "lsp", "view")
UNREAD = 400
"""Questions whose answers nobody reads."""


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Team]:
    raise_descriptor_limit()
    with team(tmp_path_factory.mktemp("flooded")) as found:
        yield found


@pytest.fixture
def calm(plant: Team) -> Iterator[Team]:
    """Looks after the attack: others are served, little is written, memory is bounded, the PLC runs."""
    memory, log = plant.memory_mib(), plant.plant.log.stat().st_size
    yield plant
    plant.check_running()
    now = plant.memory_mib()
    assert max(now[name] - memory[name] for name in now) < GROWTH_MIB, (memory, now)
    assert plant.plant.log.stat().st_size - log < LOG_BYTES


def paths(found: Team) -> dict[str, str]:
    boss = found.boss
    scene = next(one["id"] for one in boss.get(f"{boss.project}/objects") if one["kind"] == "scene")
    return {
        "online": "/api/v1/online?runtime=local",
        "events": f"/api/v1/events?project={found.project_id}",
        "lsp": f"/api/v1/lsp?project={found.project_id}",
        "view": boss.post(f"{boss.project}/objects/{scene}/view", {})["path"],
    }


def door(found: Team, path: str, source: str) -> Door:
    host, _, port = found.plant.origin.removeprefix("http://").rpartition(":")
    return Door(host, int(port), path, {"Authorization": f"Bearer {found.tokens['viewer']}"}, source)


def runtime_door(found: Team) -> Door:
    host, _, port = found.boss.state()["url"].removeprefix("ws://").rpartition(":")
    return Door(host, int(port), "/")


def others_are_served(found: Team) -> None:
    """Somebody at another address."""
    transport = httpx.HTTPTransport(local_address="127.0.0.2")
    with httpx.Client(transport=transport, timeout=60) as client:
        for _ in range(10):
            assert client.get(f"{found.plant.base}/health").status_code == 200
            assert found.boss.state()["state"] == "run"


def opened(where: Door, count: int, *, asks: bool = True) -> list[Connection]:
    """As many connections as are let in."""
    found = []
    for _ in range(count):
        with suppress(DoorError, OSError):
            found.append(Connection(where, asks=asks))
    return found


HEADS = {
    "silent": b"",
    "half a head": b"GET / HT",
    "half a body": b"POST /api/v1/auth/login HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 1000000\r\n"
    b"Content-Type: application/json\r\nX-Tappet-Client: 1\r\n\r\n{",
    "half an upload": b"POST /api/v1/projects/import HTTP/1.1\r\nHost: 127.0.0.1\r\n"
    b"Content-Length: 99999999\r\nContent-Type: multipart/form-data; boundary=b\r\n\r\n--b\r\n",
    "answers not read": b"GET /api/v1/openapi.json HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: %s\r\n\r\n"
    * 10,
}


@pytest.mark.parametrize("kind", HEADS)
def test_a_flood_of_connections_stops_nobody_else(calm: Team, kind: str) -> None:
    where = door(calm, "/", FLOODER)
    flood = opened(where, FLOOD, asks=False)
    sent = HEADS[kind].replace(b"%s", where.headers["Authorization"].encode())
    try:
        assert len(flood) > FLOOD // 4
        for connection in flood:
            with suppress(DoorError, OSError):
                connection.push(sent)
        others_are_served(calm)
    finally:
        for connection in flood:
            connection.close()


@pytest.mark.parametrize("name", SOCKETS)
def test_a_flood_of_sockets_stops_nobody_else(calm: Team, name: str) -> None:
    with ExitStack() as stack:
        for connection in opened(door(calm, paths(calm)[name], FLOODER), FLOOD):
            stack.callback(connection.close)
        others_are_served(calm)
        mine = Connection(door(calm, paths(calm)["events"], "127.0.0.2"))
        assert mine.answers()
        mine.close()


def test_a_flood_of_connections_to_the_soft_plc_stops_nobody_else(calm: Team) -> None:
    flood = opened(runtime_door(calm), FLOOD, asks=False)
    try:
        others_are_served(calm)
        calm.check_running()
    finally:
        for connection in flood:
            connection.close()
    token = (calm.plant.log.parent / "data" / "runtime" / "token").read_text().strip()

    def let_in() -> bool:
        with suppress(DoorError, OSError):
            mine = Connection(runtime_door(calm))
            mine.send(frame(2, protocol.pack_request(1, Hello(token))))
            came = mine.until(b"application")
            mine.close()
            return came
        return False

    until(let_in, "the soft PLC takes connections again", 60)


def orders(found: Team, name: str) -> Iterator[bytes]:
    """Messages with long answers."""
    names = [
        variable["path"]
        for program in found.boss.get(f"{RUNTIME}/symbols")
        for variable in found.boss.get(f"{RUNTIME}/symbols?path={program['path']}")
    ]
    for number in range(UNREAD):
        match name:
            case "online":
                yield json.dumps(
                    {"op": "subscribe", "id": number % 50, "expressions": names * 10, "interval_ms": 10}
                ).encode()
            case "events":
                yield json.dumps({"op": "open", "object_id": str(number)}).encode()
            case _ if number == 0:
                params = {"processId": None, "rootUri": None, "capabilities": {}}
                yield json.dumps(
                    {"jsonrpc": "2.0", "id": 0, "method": "initialize", "params": params}
                ).encode()
            case _:
                params = {"query": ""}
                yield json.dumps(
                    {"jsonrpc": "2.0", "id": number, "method": "workspace/symbol", "params": params}
                ).encode()


@pytest.mark.parametrize("name", SOCKETS)
def test_readers_that_do_not_read_cost_little(calm: Team, name: str) -> None:
    where = door(calm, paths(calm)[name], READER)
    with ExitStack() as stack:
        for _ in range(10):
            connection = Connection(where)
            stack.callback(connection.close)
            if name != "view":  # is sent pictures without a question
                for order in orders(calm, name):
                    if not connection.push(frame(TEXT, order)):
                        break
        for _ in range(5):
            others_are_served(calm)
            time.sleep(0.5)


def test_a_reader_of_the_soft_plc_that_does_not_read_costs_little(calm: Team) -> None:
    token = (calm.plant.log.parent / "data" / "runtime" / "token").read_text().strip()
    with ExitStack() as stack:
        for _ in range(8):
            connection = Connection(runtime_door(calm))
            stack.callback(connection.close)
            connection.push(frame(2, protocol.pack_request(0, Hello(token))))
            for number in range(1, UNREAD):
                order = GetSymbols() if number % 8 else Record([(0, 4096)], None, 1)
                if not connection.push(frame(2, protocol.pack_request(number, order))):
                    break
        for _ in range(5):
            others_are_served(calm)
            time.sleep(0.5)
