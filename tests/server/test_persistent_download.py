"""What becomes of persistent variables at a download, told beforehand (PERS-05), with a real runtime."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from fastapi.testclient import TestClient
from test_real_runtime import RUNTIME, _value, app, engineer

from tappet.server.settings import LOCAL_RUNTIME

__all__ = ["app", "engineer"]
TARGET = {"runtime_id": LOCAL_RUNTIME}


class Plant:
    """An application with a list of persistent variables, and what a script asks about it."""

    def __init__(self, client: TestClient) -> None:
        self.client = client
        project = client.post("/api/v1/projects", json={"name": "Plant"}).json()["id"]
        self.objects = f"/api/v1/projects/{project}/objects"
        application = next(o["id"] for o in client.get(self.objects).json() if o["kind"] == "application")
        order = {"kind": "persistent", "name": "Kept", "parent_id": application}
        made = client.post(self.objects, json=order)
        assert made.status_code == 201, made.text
        self.item = made.json()
        self.url = f"/api/v1/projects/{project}/applications/{application}"

    def declare(self, variables: str) -> None:
        text = f"VAR_GLOBAL PERSISTENT RETAIN\n{variables}\nEND_VAR"
        body = {"base_revision": self.item["revision"], "data": {"declaration": text}}
        saved = self.client.put(f"{self.objects}/{self.item['id']}", json=body)
        assert saved.status_code == 200, saved.text
        self.item = saved.json()

    def login(self) -> dict[str, Any]:
        answer = self.client.post(f"{self.url}/login", json=TARGET)
        assert answer.status_code == 200, answer.text
        return dict(answer.json())

    def differing(self) -> list[tuple[str, str]]:
        return [(row["path"], row["reason"]) for row in self.login()["persistent"]]

    def download(self, **more: Any) -> str:
        """Code of what was loaded."""
        order = {**TARGET, "mode": "download", "start": True, **more}
        done = self.client.post(f"{self.url}/download", json=order)
        assert done.status_code == 200, done.text
        return str(done.json()["code_id"])

    def write(self, **values: int) -> None:
        rows = [{"expression": f"Kept.{name}", "value": value} for name, value in values.items()]
        assert self.client.post(f"{RUNTIME}/values/write", json={"values": rows}).status_code == 200

    def values(self, *names: str) -> list[Any]:
        return [_value(self.client, f"Kept.{name}") for name in names]


def test_what_a_download_cannot_keep_is_told_and_all_can_begin_anew(
    app: FastAPI, engineer: TestClient
) -> None:
    plant = Plant(engineer)
    plant.declare("a : DINT := 1; b : DINT := 2; c : DINT := 3;")
    plant.download()
    plant.write(a=11, b=12, c=13)

    plant.declare("a : DINT := 1; b : DINT := 2; c : DINT := 3; d : DINT := 4;")
    assert plant.differing() == [], "what is appended keeps the others"
    plant.download()
    assert plant.values("a", "b", "c", "d") == [11, 12, 13, 4]

    plant.declare("a : DINT := 1; bb : DINT := 2; c : LINT := 3; d : DINT := 4;")
    assert plant.differing() == [("Kept.b", "removed"), ("Kept.c", "type_changed")]
    plant.download()
    assert plant.values("a", "bb", "c", "d") == [11, 2, 3, 4]
    assert plant.differing() == []

    plant.declare("a : DINT := 1; e : DINT := 5;")
    plant.download(initialise_persistent=True)
    assert plant.values("a", "e") == [1, 5]
    acts = [row["action"] for row in engineer.get("/api/v1/audit").json()]
    assert acts.count("reset-origin") == 1


def test_back_to_a_version_tells_it_too(app: FastAPI, engineer: TestClient) -> None:
    plant = Plant(engineer)
    plant.declare("a : DINT := 1; b : DINT := 2; c : DINT := 3;")
    first = plant.download()
    plant.declare("a : DINT := 1; b : LINT := 2; cc : DINT := 3;")
    plant.download()
    plant.write(a=11, b=12, cc=13)

    version = f"{plant.url}/versions/{first}"
    costs = engineer.post(f"{version}/compare", json=TARGET).json()
    told = [(row["path"], row["reason"]) for row in costs["persistent"]]
    assert told == [("Kept.b", "type_changed"), ("Kept.cc", "removed")]
    order = {**TARGET, "mode": "download"}
    assert engineer.post(f"{version}/restore", json=order).json()["code_id"] == first
    assert plant.values("a", "b", "c") == [11, 2, 3]

    plant.write(b=22)
    second = plant.download()
    assert plant.differing() == []
    plant.write(a=31)
    done = engineer.post(f"{version}/restore", json={**order, "initialise_persistent": True})
    assert done.status_code == 200, done.text
    assert plant.values("a", "b", "c") == [1, 2, 3]
    assert second != first
    acts = [row["action"] for row in engineer.get("/api/v1/audit").json()]
    assert acts.count("reset-origin") == 1


def test_a_login_says_whether_the_retain_file_is_written_anew(app: FastAPI, engineer: TestClient) -> None:
    """It holds path, size and type of each variable (`runtime/retain.py`)."""
    plant = Plant(engineer)
    first = "a : DINT := 1; b : DINT := 2;"
    plant.declare(first)
    plant.download()
    for text, anew in (
        ("a : DINT := 7; b : DINT := 2;", False),  # another initial value only
        ("a : DINT := 1; b : DINT := 2; c : DINT := 3;", True),
        ("a : DINT := 1;", True),
        ("a : DINT := 1; b : UDINT := 2;", True),
    ):
        plant.declare(text)
        assert plant.login()["retain_layout_changes"] is anew, text
    plant.declare(first)
    assert plant.login()["relation"] == "same"
