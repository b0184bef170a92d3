"""The events socket: changes of others and who is here (seam 6)."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import SOCKETS, browser
from starlette.testclient import WebSocketDenialResponse
from starlette.websockets import WebSocketDisconnect

from tappet.server import sockets
from tappet.server.events import service as project_events

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
        assert socket.receive_json() == {
            "op": "presence",
            "users": [{"username": "admin", "object_id": None}],
        }
        elsewhere.receive_json()
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


def test_presence(admin: TestClient, as_role: dict[str, TestClient], pid: str) -> None:
    with connect(admin, pid) as first:
        first.receive_json()
        with connect(as_role["viewer"], pid) as second:
            both = [{"username": "admin", "object_id": None}] * 2
            assert first.receive_json()["users"] == second.receive_json()["users"] == both
            second.send_json({"op": "open", "object_id": "abc"})
            assert first.receive_json()["users"][1] == {"username": "admin", "object_id": "abc"}
        assert first.receive_json()["users"] == both[:1]


@pytest.mark.parametrize("text", ["", "[]", '{"op": "close"}', '{"op": "open"}', "{"])
def test_messages_that_are_not_understood_close_the_socket(admin: TestClient, pid: str, text: str) -> None:
    with connect(admin, pid) as socket:
        socket.receive_json()
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
        socket.receive_json()
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
        socket.receive_json()
        leaving = browser(app)
        leaving.cookies = admin.cookies
        assert leaving.post(f"{API}/auth/logout").status_code in (200, 204)
        with pytest.raises(WebSocketDisconnect) as closed:
            socket.receive_json()
    assert closed.value.code == sockets.SESSION_ENDED
