"""Imports in a process with limits: what exceeds them ends it, and holds up nobody."""

from __future__ import annotations

import pickle
import sys
from typing import Any

import pytest
from fastapi.testclient import TestClient
from unread_answers import ends_quietly

from tappet.server.exchange import import_process, uploads
from tappet.server.exchange.import_order import ImportOrder
from tappet.server.services import Services

API = "/api/v1"
PUMP = b"FUNCTION_BLOCK FB_Pump\nVAR_INPUT\n  bOn : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n"
FAN = PUMP.replace(b"Pump", b"Fan")
HEAD = b'<project xmlns="http://www.plcopen.org/xml/tc6_0201"><fileHeader/><types><pous>'
TAIL = b"</pous></types></project>"
MANY = HEAD + b"<pou/>" * 300_000 + TAIL
"""1.8 MB that become some 150 MB of objects."""


@pytest.fixture
def always(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """Small imports get a process, too."""
    monkeypatch.setattr(import_process, "SMALL_BYTES", -1)
    return monkeypatch


def preview(client: TestClient, name: str, content: bytes) -> Any:
    return client.post(f"{API}/projects/preview-files", files={"files": (name, content)})


def said(answer: Any) -> Any:
    """An answer without the ids that are new each time."""
    body = answer.json()
    if answer.status_code != 200:
        return answer.status_code, body
    entries = [{**entry, "object_id": None} for entry in body["report"]["entries"]]
    return [node["name"] for node in body["nodes"]], entries


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.st", PUMP),
        ("a.xml", HEAD + b"<pou name='F' pouType='program'/>" + TAIL),
        ("bad.xml", b"<project"),
        ("a.xml", b'<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'),
        ("a.zip", b"no archive"),
    ],
)
def test_a_process_says_the_same(
    admin: TestClient, always: pytest.MonkeyPatch, name: str, content: bytes
) -> None:
    apart = preview(admin, name, content)
    always.undo()
    here = preview(admin, name, content)
    assert said(apart) == said(here)


def test_a_process_fills_a_project(admin: TestClient, always: pytest.MonkeyPatch) -> None:
    project = f"{API}/projects/{admin.post(f'{API}/projects', json={'name': 'Press'}).json()['id']}"
    answer = admin.post(f"{project}/import-files", files={"files": ("a.st", PUMP)})
    assert answer.status_code == 200, answer.text
    assert "FB_Pump" in {item["name"] for item in admin.get(f"{project}/objects").json()}
    made = admin.post(f"{API}/projects/import-files", files={"files": ("a.st", PUMP)}, data={"name": "Pumps"})
    assert made.json()["project"]["name"] == "Pumps"


def test_too_much_memory_ends_the_process_only(admin: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(import_process, "MEMORY_MIB", 150)
    answer = preview(admin, "a.xml", MANY)
    assert (answer.status_code, answer.json()["type"]) == (413, "urn:tappet:problem:import-too-large")
    assert "150 MiB" in answer.json()["detail"]
    assert preview(admin, "a.st", PUMP).status_code == 200


def test_too_much_time_ends_the_process_only(admin: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(import_process, "SECONDS", 1)
    answer = preview(admin, "a.xml", MANY)
    assert (answer.status_code, answer.json()["type"]) == (413, "urn:tappet:problem:import-too-large")


def test_who_waits_too_long_for_others_is_told(admin: TestClient, always: pytest.MonkeyPatch) -> None:
    always.setattr(import_process, "PATIENCE_S", 0.01)
    for _ in range(import_process.MOST_AT_ONCE):
        assert import_process._PLACES.acquire(blocking=False)
    try:
        assert preview(admin, "a.st", PUMP).json()["type"] == "urn:tappet:problem:imports-running"
    finally:
        import_process._PLACES.release(import_process.MOST_AT_ONCE)
    assert preview(admin, "a.st", PUMP).status_code == 200


def test_a_project_may_change_while_files_are_read(
    admin: TestClient, services: Services, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Reading held the database, and with it all who write."""
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    reads = []
    really = uploads.imported

    def imported(*given: Any, **named: Any) -> Any:
        reads.append(1)
        if len(reads) == 1:
            services.store.add(project, "ann", None, "folder", "Meanwhile")
        return really(*given, **named)

    monkeypatch.setattr(uploads, "imported", imported)
    answer = admin.post(f"{API}/projects/{project}/import-files", files={"files": ("a.st", FAN)})
    assert answer.status_code == 200, answer.text
    assert len(reads) == 2
    names = {item["name"] for item in admin.get(f"{API}/projects/{project}/objects").json()}
    assert {"FB_Fan", "Meanwhile"} <= names


def test_a_project_that_never_rests_is_not_overwritten(
    admin: TestClient, services: Services, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    really = uploads.imported
    made: list[str] = []

    def imported(*given: Any, **named: Any) -> Any:
        made.append(services.store.add(project, "ann", None, "folder", f"F{len(made)}").name)
        return really(*given, **named)

    monkeypatch.setattr(uploads, "imported", imported)
    answer = admin.post(f"{API}/projects/{project}/import-files", files={"files": ("a.st", FAN)})
    assert (answer.status_code, answer.json()["type"]) == (409, "urn:tappet:problem:project-busy")
    names = {item["name"] for item in admin.get(f"{API}/projects/{project}/objects").json()}
    assert set(made) <= names
    assert "FB_Fan" not in names


def test_an_import_whose_server_was_killed_ends_quietly() -> None:
    order = ImportOrder({"a.st": PUMP}, None, None, "Pumps", None)
    ends_quietly([sys.executable, "-m", import_process.WORKER, "2048", "60"], pickle.dumps(order))
