"""The debug adapter on the WebSocket of the server, with compiler and runtime as processes of their own."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import PAGE, SOCKETS
from starlette.testclient import WebSocketTestSession
from starlette.websockets import WebSocketDisconnect
from test_debugging import app, engineer  # noqa: F401 - fixtures

from tappet.server.settings import LOCAL_RUNTIME

URL = f"{SOCKETS}/api/v1/dap?runtime={LOCAL_RUNTIME}"
DECLARATION = "PROGRAM PLC_PRG\nVAR\n  n : DINT;\nEND_VAR\nVAR_TEMP\n  t : DINT;\nEND_VAR"
BODY = "t := n + 1;\nn := t;"


class Socket:
    """Speaks the protocol over a socket, one answer after the other."""

    def __init__(self, socket: WebSocketTestSession) -> None:
        self._socket = socket
        self._number = 0
        self.events: list[dict[str, Any]] = []
        self.told: list[dict[str, Any]] = []
        """Events that were looked at."""

    def ask(self, command: str, **arguments: Any) -> dict[str, Any]:
        self._number += 1
        message = {"seq": self._number, "type": "request", "command": command, "arguments": arguments}
        self._socket.send_text(json.dumps(message))
        while True:
            answer: dict[str, Any] = json.loads(self._socket.receive_text())
            if answer["type"] == "response":
                return answer
            self.events.append(answer)

    def body(self, command: str, **arguments: Any) -> Any:
        answer = self.ask(command, **arguments)
        assert answer["success"], answer
        return answer.get("body")

    def event(self, name: str) -> Any:
        while not any(event["event"] == name for event in self.events):
            self.events.append(json.loads(self._socket.receive_text()))
        found = next(event for event in self.events if event["event"] == name)
        at = self.events.index(found)
        self.told, self.events = [*self.told, *self.events[: at + 1]], self.events[at + 1 :]
        return found["body"]


def test_a_session_on_what_was_downloaded(app: FastAPI, engineer: TestClient) -> None:  # noqa: F811
    store = app.state.services.store
    info = store.create_project("Debugged", "ann")
    item = next(o for o in store.load(info.id).objects.values() if o.name == "PLC_PRG")
    application = store.load(info.id).applications()[0]
    texts = {"declaration": DECLARATION, "implementation": BODY}
    store.save(info.id, item.id, store.load(info.id).objects[item.id].revision, texts, "ann")
    with engineer.websocket_connect(URL, headers=PAGE) as socket:
        client = Socket(socket)
        client.body("initialize", adapterID="tappet")
        assert "download" in client.ask("attach")["message"]
        assert "send attach" in client.ask("launch", program="/x")["message"]
    order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
    url = f"/api/v1/projects/{info.id}/applications/{application.id}/download"
    assert engineer.post(url, json=order).status_code == 200
    document = f"tappet:/{info.id}/{item.id}/implementation"
    with engineer.websocket_connect(URL, headers=PAGE) as socket:
        client = Socket(socket)
        client.body("initialize", adapterID="tappet")
        client.body("attach")
        client.event("initialized")
        found = client.body("setBreakpoints", source={"path": document}, breakpoints=[{"line": 2}])
        assert found["breakpoints"][0]["verified"], found
        client.body("configurationDone")
        assert client.event("stopped")["reason"] == "breakpoint"
        (frame,) = client.body("stackTrace", threadId=1)["stackFrames"]
        assert (frame["source"]["path"], frame["line"]) == (document, 2)
        assert frame["source"]["name"].endswith("PLC_PRG")
        text = client.body("source", sourceReference=frame["source"]["sourceReference"])
        assert text["content"] == BODY
        client.body("evaluate", expression="n := 41", frameId=frame["id"], context="repl")
        local = client.body("scopes", frameId=frame["id"])["scopes"][0]["variablesReference"]
        values = {
            v["name"]: v["value"] for v in client.body("variables", variablesReference=local)["variables"]
        }
        assert values["n"] == "41"
        client.body("setVariable", variablesReference=local, name="t", value="7")
        client.body("next", threadId=1)
        client.event("stopped")
        (frame,) = client.body("stackTrace", threadId=1)["stackFrames"]
        assert client.body("evaluate", expression="n", frameId=frame["id"])["result"] == "7"
        client.body("disconnect")
    rows = engineer.get("/api/v1/audit", params={"limit": 100}).json()
    acts = {(row["action"], row["subject"]) for row in rows}
    assert {"breakpoint-added", "debug-step-over", "write"} <= {action for action, _ in acts}
    assert ("write", "PLC_PRG.n") in acts
    state = engineer.get(f"/api/v1/runtimes/{LOCAL_RUNTIME}/debug").json()
    assert (state["halted"], state["breakpoints"]) == ([], [])
    with engineer.websocket_connect(URL, headers=PAGE) as socket:
        client = Socket(socket)
        client.body("initialize", adapterID="tappet")
        client.body("attach")
        client.body("configurationDone")
        item = store.load(info.id).objects[item.id]
        store.save(info.id, item.id, item.revision, {**texts, "implementation": f"{BODY}\nn := 0;"}, "ann")
        assert engineer.post(url, json={**order, "mode": "online_change"}).status_code == 200
        client.event("terminated")
        assert "another application now: attach again" in str(client.told)
        assert (
            "attach first" in client.ask("evaluate", expression="PLC_PRG.n := 3", context="repl")["message"]
        )


def test_who_may_only_look_may_not_debug(app: FastAPI, engineer: TestClient) -> None:  # noqa: F811
    from server_clients import browser

    stranger = browser(app)
    with pytest.raises(WebSocketDisconnect), stranger.websocket_connect(URL, headers=PAGE):
        pass
