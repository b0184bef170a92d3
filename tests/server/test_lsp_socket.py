"""The language server of a stored project, over its WebSocket."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from server_clients import SOCKETS, bare
from starlette.testclient import WebSocketDenialResponse
from starlette.websockets import WebSocketDisconnect

from tappet.project.model import Project
from tappet.project.store import Store
from tappet.server.lsp import rpc
from tappet.server.lsp.project_programs import ProjectPrograms, parse_part_uri, part_uri
from tappet.server.services import Services


def objects_of(client: TestClient, project: str) -> dict[str, str]:
    """Object ids by name."""
    return {item["name"]: item["id"] for item in client.get(f"/api/v1/projects/{project}/objects").json()}


@pytest.fixture
def project(as_role: dict[str, TestClient]) -> str:
    answer = as_role["engineer"].post("/api/v1/projects", json={"name": "Press"})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


class Socket:
    def __init__(self, socket: Any) -> None:
        self.socket = socket
        self.number = 0
        self.published: dict[str, list[dict[str, Any]]] = {}

    def notify(self, method: str, params: Any) -> None:
        self.socket.send_text(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    def ask(self, method: str, params: Any) -> Any:
        self.number += 1
        message = {"jsonrpc": "2.0", "id": self.number, "method": method, "params": params}
        self.socket.send_text(json.dumps(message))
        while True:
            answer = self.hear()
            if answer.get("id") == self.number:
                assert "error" not in answer, answer
                return answer["result"]

    def hear(self) -> dict[str, Any]:
        message: dict[str, Any] = json.loads(self.socket.receive_text())
        if message.get("method") == "textDocument/publishDiagnostics":
            self.published[message["params"]["uri"]] = message["params"]["diagnostics"]
        return message

    def wait_for(self, document: str, codes: list[str]) -> None:
        while [d["code"] for d in self.published.get(document, [])] != codes:
            self.hear()

    def start(self) -> None:
        self.ask("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.notify("initialized", {})


def test_edit_and_navigate_a_stored_project(as_role: dict[str, TestClient], project: str) -> None:
    engineer = as_role["engineer"]
    base = f"/api/v1/projects/{project}/objects"
    objects = objects_of(engineer, project)
    application = objects["Application"]
    answer = engineer.post(
        base, json={"parent_id": application, "kind": "pou", "name": "FB_Motor", "subkind": "function_block"}
    )
    assert answer.status_code == 201, answer.text
    motor = answer.json()["id"]
    with engineer.websocket_connect(f"{SOCKETS}/api/v1/lsp?project={project}") as raw:
        socket = Socket(raw)
        socket.start()
        head = part_uri(project, objects["PLC_PRG"], "declaration")
        body = part_uri(project, objects["PLC_PRG"], "implementation")
        text = "PROGRAM PLC_PRG\nVAR\n    m : FB_Motor;\nEND_VAR"
        item = {"uri": head, "languageId": "iec-st", "version": 1, "text": text}
        socket.notify("textDocument/didOpen", {"textDocument": item})
        item = {"uri": body, "languageId": "iec-st", "version": 1, "text": "m(xOn := TRUE);"}
        socket.notify("textDocument/didOpen", {"textDocument": item})
        socket.wait_for(body, ["E0502"])

        # somebody else adds the input and stores it
        current = engineer.get(f"{base}/{motor}").json()
        declaration = "FUNCTION_BLOCK FB_Motor\nVAR_INPUT\n    xOn : BOOL;\nEND_VAR"
        data = {**current["data"], "declaration": declaration, "implementation": ""}
        answer = engineer.put(f"{base}/{motor}", json={"base_revision": current["revision"], "data": data})
        assert answer.status_code == 200, answer.text
        socket.wait_for(body, [])

        params = {"textDocument": {"uri": body}, "position": {"line": 0, "character": 3}}
        found = socket.ask("textDocument/definition", params)
        assert found["uri"] == part_uri(project, motor, "declaration")
        assert found["range"]["start"] == {"line": 2, "character": 4}


def test_binary_frames_end_the_connection(as_role: dict[str, TestClient], project: str) -> None:
    with as_role["viewer"].websocket_connect(f"{SOCKETS}/api/v1/lsp?project={project}") as socket:
        socket.send_bytes(b"\x00")
        with pytest.raises(WebSocketDisconnect) as closed:
            socket.receive_text()
        assert closed.value.code == 1003


def test_half_of_a_character_is_answered_and_ends_nothing(
    as_role: dict[str, TestClient], project: str
) -> None:
    with as_role["viewer"].websocket_connect(f"{SOCKETS}/api/v1/lsp?project={project}") as raw:
        socket = Socket(raw)
        socket.start()
        for method in ("\\ud800", "\ud800"):  # as an escape of JSON, and as it is
            raw.send_text('{"jsonrpc": "2.0", "id": 7, "method": "' + method + '"}')
            assert socket.hear()["error"]["code"] in (rpc.PARSE_ERROR, rpc.METHOD_NOT_FOUND)
        assert socket.ask("workspace/symbol", {"query": "PLC_PRG"}) is not None


def test_unknown_projects_and_strangers_are_refused(
    app: Any, as_role: dict[str, TestClient], project: str
) -> None:
    url = f"{SOCKETS}/api/v1/lsp?project="
    with (
        pytest.raises(WebSocketDenialResponse) as refused,
        as_role["viewer"].websocket_connect(url + "0" * 32),
    ):
        pass
    assert refused.value.status_code == 404
    with pytest.raises(WebSocketDenialResponse) as refused, bare(app).websocket_connect(url + project):
        pass
    assert refused.value.status_code == 401


def test_documents_of_a_project(services: Services) -> None:
    store: Store = services.store
    info = store.create_project("Mill", "tester")
    programs = ProjectPrograms(info.id, lambda: store.load(info.id))
    (program,) = programs({})
    project = store.load(info.id)
    main = next(item for item in project.walk() if item.name == "PLC_PRG")
    head, body = part_uri(info.id, main.id, "declaration"), part_uri(info.id, main.id, "implementation")
    text = next(t for t in program.texts if t.source.uri == "PLC_PRG")
    assert [segment.document for segment in text.segments] == [head, body]
    assert any(t.read_only for t in program.texts)
    (program,) = programs(
        {head: "PROGRAM PLC_PRG\nVAR\n  a : INT;\nEND_VAR", body: "a := 1;\na := 2;", "tappet:/x": ""}
    )
    text = next(t for t in program.texts if t.source.uri == "PLC_PRG")
    assert text.source.text == "PROGRAM PLC_PRG\nVAR\n  a : INT;\nEND_VAR\na := 1;\na := 2;\nEND_PROGRAM"
    assert [(s.line, s.count) for s in text.segments] == [(0, 4), (4, 2)]
    store.delete(info.id, "tester", main.id)
    assert any(
        t.source.uri == "PLC_PRG" for t in programs({head: "PROGRAM PLC_PRG"})[0].texts
    )  # not published yet
    programs.changed()
    assert not any(t.source.uri == "PLC_PRG" for t in programs({head: "PROGRAM PLC_PRG"})[0].texts)


def test_a_change_while_the_project_is_read_is_not_lost(services: Services) -> None:
    store: Store = services.store
    info = store.create_project("Mill", "tester")
    main = next(item for item in store.load(info.id).walk() if item.name == "PLC_PRG")

    def read() -> Project:
        before = store.load(info.id)
        if any(item.id == main.id for item in before.walk()):
            store.delete(info.id, "tester", main.id)  # too late for this reading
            programs.changed()
        return before

    programs = ProjectPrograms(info.id, read)
    assert any(t.source.uri == "PLC_PRG" for t in programs({})[0].texts)
    assert not any(t.source.uri == "PLC_PRG" for t in programs({})[0].texts)


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("tappet:/p/o/declaration", ("o", "declaration")),
        ("tappet:/p/o/implementation", ("o", "implementation")),
        ("tappet:/p/o/other", None),
        ("tappet:/q/o/declaration", None),
        ("tappet:/p/o", None),
        ("file:///p/o/declaration", None),
        ("", None),
    ],
)
def test_part_uris(uri: str, expected: tuple[str, str] | None) -> None:
    assert parse_part_uri(uri, "p") == expected
