"""The events socket: changes of others and who is here."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import SOCKETS, browser
from starlette.testclient import WebSocketDenialResponse
from starlette.websockets import WebSocketDisconnect

from tappet.server import sockets
from tappet.server.events import presence
from tappet.server.events import service as project_events
from tappet.server.events.presence import ProjectPresence
from tappet.server.events.shapes import Presence, PresenceChanged

API = "/api/v1"


@pytest.fixture
def pid(admin: TestClient) -> str:
    answer = admin.post(f"{API}/projects", json={"name": "Press"})
    return str(answer.json()["id"])


def connect(client: TestClient, pid: str) -> Any:
    return client.websocket_connect(f"{SOCKETS}{API}/events?project={pid}")


def test_changes_reach_all_who_have_the_project_open(
    admin: TestClient, as_role: dict[str, TestClient], pid: str
) -> None:
    objects = f"{API}/projects/{pid}/objects"
    main = next(item for item in admin.get(objects).json() if item["name"] == "PLC_PRG")
    other = admin.post(f"{API}/projects", json={"name": "Other"}).json()["id"]
    with connect(admin, pid) as socket, connect(as_role["viewer"], other) as elsewhere:
        data = {"declaration": "PROGRAM PLC_PRG", "implementation": "x;"}
        saved = (
            as_role["engineer"].put(f"{objects}/{main['id']}", json={"base_revision": 1, "data": data}).json()
        )
        summary = {key: value for key, value in saved.items() if key != "data"}
        assert socket.receive_json() == {
            "op": "object",
            "change": "updated",
            "object": summary,
            "author": "admin",
        }
        admin.patch(f"{objects}/{main['id']}", json={"index": 0})
        moved = socket.receive_json()
        assert (moved["change"], moved["object"]["index"]) == ("moved", 0)
        block = admin.post(objects, json={"parent_id": main["parent_id"], "kind": "property", "name": "X"})
        assert block.status_code == 422
        body = {"parent_id": main["parent_id"], "kind": "pou", "name": "FB", "subkind": "function_block"}
        block = admin.post(objects, json=body).json()
        assert socket.receive_json()["object"]["id"] == block["id"]
        admin.post(objects, json={"parent_id": block["id"], "kind": "property", "name": "Speed"})
        created = [socket.receive_json() for _ in range(3)]
        assert [(message["change"], message["object"]["name"]) for message in created] == [
            ("created", "Speed"),
            ("created", "Get"),
            ("created", "Set"),
        ]
        admin.delete(f"{objects}/{main['id']}")
        assert socket.receive_json()["change"] == "deleted"
        elsewhere.send_json({"op": "open", "object_id": "a"})
        assert elsewhere.receive_json()["op"] == "presence"


def look(socket: Any, object_id: str | None = None) -> None:
    socket.send_json({"op": "open", "object_id": object_id})


def test_presence(admin: TestClient, as_role: dict[str, TestClient], pid: str) -> None:
    with connect(admin, pid) as first:
        look(first)
        (me,) = first.receive_json()["users"]
        assert (me["username"], me["object_id"]) == ("admin", None)
        with connect(as_role["viewer"], pid) as second:
            look(second, "abc")
            both = second.receive_json()
            assert both["op"] == "presence"
            assert [user["object_id"] for user in both["users"]] == [None, "abc"]
            assert both["users"][0] == me
            other = both["users"][1]["id"]
            came = first.receive_json()
            assert came["op"] == "presence_changed"
            seen = {user["id"]: user["object_id"] for user in came["present"]}
            if seen != {other: "abc"}:  # the connection and what it opens were two batches
                assert seen == {other: None}
                assert first.receive_json()["present"][0]["object_id"] == "abc"
        assert first.receive_json() == {"op": "presence_changed", "present": [], "left": [other]}


def test_who_has_not_asked_hears_nothing_of_others(
    admin: TestClient, as_role: dict[str, TestClient], pid: str
) -> None:
    with connect(admin, pid) as silent, connect(as_role["viewer"], pid) as asking:
        look(asking)
        assert len(asking.receive_json()["users"]) == 2
        admin.post(
            f"{API}/projects/{pid}/objects", json={"parent_id": None, "kind": "device", "name": "Second"}
        )
        assert silent.receive_json()["op"] == "object"


class Counted:
    """Presence that counts what it would send to each socket."""

    def __init__(self) -> None:
        self.sent: dict[int, list[Presence | PresenceChanged]] = {}
        self.presence = ProjectPresence(self._deliver)

    def _deliver(self, numbers: Iterable[int], message: Presence | PresenceChanged) -> None:
        for number in numbers:
            self.sent.setdefault(number, []).append(message)

    def enter(self, numbers: Iterable[int]) -> None:
        for number in numbers:
            self.presence.enter(number, f"user {number}")
            self.presence.look(number, None)

    async def messages(self) -> int:
        """How many are sent in all, once the loop has nothing left to do."""
        for _ in range(3):
            await asyncio.sleep(0)
        return sum(map(len, self.sent.values()))


async def test_many_that_come_and_go_at_once_are_one_message_for_each_that_stays() -> None:
    counted = Counted()
    counted.enter([1])
    assert await counted.messages() == 1
    counted.presence._earliest = 0.0  # the time between two batches is over
    counted.enter(range(2, 502))
    for number in range(2, 502):
        for seen in "abc":
            counted.presence.look(number, seen)
    assert await counted.messages() == 1 + 501, "the list to each that came, one change to the first"
    counted.presence._earliest = 0.0
    for number in range(2, 301):
        counted.presence.leave(number)
    counted.presence.enter(999, "short")
    counted.presence.leave(999)
    assert await counted.messages() == 502 + 202
    (list_, came, left) = counted.sent[1]
    assert isinstance(list_, Presence)
    assert isinstance(came, PresenceChanged)
    assert isinstance(left, PresenceChanged)
    assert [user.object_id for user in came.present] == ["c"] * 500
    assert (left.present, left.left) == ([], list(range(2, 301)))


async def test_batches_keep_their_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(presence, "BATCHES_PER_S", 1 / 3600)
    counted = Counted()
    counted.enter([1])
    assert await counted.messages() == 1
    for number in range(2, 50):
        counted.enter([number])
        assert await counted.messages() == 1, "the next batch is due in an hour"
    for number in range(2, 50):
        counted.presence.leave(number)
    assert await counted.messages() == 1
    counted.presence.close()


@pytest.mark.parametrize("text", ["", "[]", '{"op": "close"}', '{"op": "open"}', "{"])
def test_messages_that_are_not_understood_close_the_socket(admin: TestClient, pid: str, text: str) -> None:
    with connect(admin, pid) as socket:
        socket.send_text(text)
        with pytest.raises(WebSocketDisconnect) as closed:
            socket.receive_json()
    assert closed.value.code == project_events.NOT_UNDERSTOOD


def test_unknown_projects_are_refused(admin: TestClient) -> None:
    with pytest.raises(WebSocketDenialResponse) as refused, connect(admin, "0" * 32):
        pass
    assert refused.value.status_code == 404


def test_a_socket_that_cannot_follow_is_closed(
    admin: TestClient, pid: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(project_events, "LONGEST_QUEUE", 3)
    with connect(admin, pid) as socket:
        admin.post(
            f"{API}/projects/{pid}/objects", json={"parent_id": None, "kind": "device", "name": "Second"}
        )
        with pytest.raises(WebSocketDisconnect) as closed:
            list(iter(socket.receive_json, None))
    assert closed.value.code == project_events.TOO_SLOW


def test_the_end_of_the_session_closes_the_socket(
    app: FastAPI, admin: TestClient, pid: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sockets, "CHECK_EVERY_S", 0.02)
    with connect(admin, pid) as socket:
        leaving = browser(app)
        leaving.cookies = admin.cookies
        assert leaving.post(f"{API}/auth/logout").status_code in (200, 204)
        with pytest.raises(WebSocketDisconnect) as closed:
            socket.receive_json()
    assert closed.value.code == sockets.SESSION_ENDED
