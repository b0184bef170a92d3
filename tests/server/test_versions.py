"""Versions that a runtime had: who brought them, what going back costs, and going back."""

from __future__ import annotations

from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import PASSWORD, browser
from test_build import Stored, project

from tappet.codegen.package import CodePackage

__all__ = ["project"]
FIRST = "PROGRAM PLC_PRG\nVAR\n  n : INT := 5;\nEND_VAR"
SECOND = "PROGRAM PLC_PRG\nVAR\n  n : INT := 5;\n  m : DINT;\nEND_VAR"


def loaded(admin: TestClient, project: Stored, runtime_id: str, mode: str = "download") -> str:
    answer = admin.post(f"{project.url}/download", json={"runtime_id": runtime_id, "mode": mode})
    assert answer.status_code == 200, answer.text
    return str(answer.json()["code_id"])


def test_back_to_the_version_before(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    first = loaded(admin, project, runtime_id)
    project.edit(SECOND, "n := n + 2;")
    second = loaded(admin, project, runtime_id, "online_change")
    of_runtime = {"runtime_id": runtime_id}
    found = admin.get(f"{project.url}/versions", params=of_runtime).json()
    assert [(v["code_id"], v["how"], v["username"], v["runs"], v["kept"]) for v in found] == [
        (second, "online-change", "admin", True, True),
        (first, "download", "admin", False, True),
    ]

    costs = admin.post(f"{project.url}/versions/{first}/compare", json=of_runtime).json()
    assert costs["relation"] == "online_change"
    assert [(v["path"], v["effect"]) for v in costs["changes"]] == [
        ("PLC_PRG.n", "moved"),
        ("PLC_PRG.m", "lost"),
    ]

    back = admin.post(f"{project.url}/versions/{first}/restore", json={**of_runtime, "mode": "online_change"})
    assert back.status_code == 200, back.text
    package = CodePackage.from_bytes(plc.downloads[-1][0])
    assert plc.downloads[-1][1] == "online_change"
    assert [c.name for c in package.symbols.children("PLC_PRG")] == ["n"]
    assert project.find("PLC_PRG").data.declaration == SECOND  # type: ignore[attr-defined]
    newest = admin.get(f"{project.url}/versions", params=of_runtime).json()[0]
    assert (newest["code_id"], newest["runs"]) == (back.json()["code_id"], True)
    relation = admin.post(f"{project.url}/login", json=of_runtime).json()["relation"]
    assert relation == "online_change"


def test_back_by_a_download(admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc) -> None:
    first = loaded(admin, project, runtime_id)
    project.edit(SECOND, "n := n + 2;")
    loaded(admin, project, runtime_id)
    back = admin.post(
        f"{project.url}/versions/{first}/restore", json={"runtime_id": runtime_id, "mode": "download"}
    )
    assert (back.status_code, back.json()["state"]) == (200, "run")
    assert plc.downloads[-1][1] == "download"
    assert back.json()["code_id"]


def test_a_version_without_source_is_refused(admin: TestClient, project: Stored, runtime_id: str) -> None:
    loaded(admin, project, runtime_id)
    for act in ("compare", "restore"):
        body = {"runtime_id": runtime_id} | ({"mode": "download"} if act == "restore" else {})
        answer = admin.post(f"{project.url}/versions/abc/{act}", json=body)
        assert answer.status_code == 409
        assert "source" in answer.json()["detail"]


def test_who_may_only_look_brings_nothing_back(
    app: FastAPI, admin: TestClient, project: Stored, runtime_id: str
) -> None:
    admin.post("/api/v1/users", json={"username": "bob", "password": PASSWORD, "role": "viewer"})
    viewer = browser(app)
    viewer.post("/api/v1/auth/login", json={"username": "bob", "password": PASSWORD})
    first = loaded(admin, project, runtime_id)
    assert viewer.get(f"{project.url}/versions", params={"runtime_id": runtime_id}).status_code == 200
    order = {"runtime_id": runtime_id, "mode": "download"}
    assert viewer.post(f"{project.url}/versions/{first}/restore", json=order).status_code == 403
