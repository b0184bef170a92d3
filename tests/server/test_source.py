"""Source download and upload over REST: rights, the setting of the application, the audit log."""

from __future__ import annotations

from typing import Any

from fake_plc import FakePlc
from fastapi.testclient import TestClient

from tappet.project.folder import write_zip
from tappet.project.new_project import new_project
from tappet.runtime.source_archive import SourceNote

API = "/api/v1"


def made(admin: TestClient, **data: Any) -> tuple[str, str]:
    """A project and its application with these data."""
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    objects = admin.get(f"{API}/projects/{project}/objects").json()
    application = next(item for item in objects if item["kind"] == "application")
    if data:
        at = f"{API}/projects/{project}/objects/{application['id']}"
        body = {"base_revision": application["revision"], "data": data}
        assert admin.put(at, json=body).status_code == 200
    return project, application["id"]


def rows(admin: TestClient) -> list[tuple[str, str, str]]:
    found = admin.get(f"{API}/audit").json()
    return [
        (row["action"], row["subject"], row["result"]) for row in found if row["action"].startswith("source")
    ]


def test_a_source_is_stored_on_demand_and_comes_back_as_a_project(
    admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    project, application = made(admin)
    at = f"{API}/projects/{project}/applications/{application}"
    runtime = f"{API}/runtimes/{runtime_id}"
    assert admin.get(f"{runtime}/source").json() is None
    missing = admin.post(f"{runtime}/source-upload", json={})
    assert (missing.status_code, missing.json()["type"]) == (404, "urn:tappet:problem:no-source")
    stored = admin.post(f"{at}/source-download", json={"runtime_id": runtime_id})
    assert stored.status_code == 200, stored.text
    assert (stored.json()["project"], stored.json()["current"]) == ("Press", False)
    info = admin.get(f"{runtime}/source").json()
    assert (info["project"], info["stored_by"], info["size"]) == ("Press", "admin", stored.json()["size"])
    done = admin.post(f"{runtime}/source-upload", json={"name": "Found"})
    assert done.status_code == 201, done.text
    names = {item["name"] for item in admin.get(f"{API}/projects/{done.json()['id']}/objects").json()}
    assert "PLC_PRG" in names
    assert admin.post(f"{runtime}/source-upload", json={}).json()["name"] == "Press_1"
    assert admin.delete(f"{runtime}/source").status_code == 204
    assert admin.get(f"{runtime}/source").json() is None
    assert sorted(rows(admin)) == sorted(
        [
            ("source-upload", "", "refused"),
            ("source-download", "Application", "ok"),
            ("source-upload", "Found", "ok"),
            ("source-upload", "Press_1", "ok"),
            ("source-deleted", "test stand", "ok"),
        ]
    )


def test_engineers_only(
    admin: TestClient, as_role: dict[str, TestClient], runtime_id: str, plc: FakePlc
) -> None:
    project, application = made(admin)
    plc.keep_source(SourceNote("p", "me", 0, ""), write_zip(new_project("p")))
    for role in ("viewer", "operator"):
        client = as_role[role]
        assert client.get(f"{API}/runtimes/{runtime_id}/source").status_code == 200
        for answer in (
            client.post(
                f"{API}/projects/{project}/applications/{application}/source-download",
                json={"runtime_id": runtime_id},
            ),
            client.post(f"{API}/runtimes/{runtime_id}/source-upload", json={}),
            client.delete(f"{API}/runtimes/{runtime_id}/source"),
        ):
            assert answer.status_code == 403
    assert as_role["engineer"].post(f"{API}/runtimes/{runtime_id}/source-upload", json={}).status_code == 201


def test_an_application_can_forbid_it(admin: TestClient, runtime_id: str, plc: FakePlc) -> None:
    project, application = made(admin, source_download="never")
    at = f"{API}/projects/{project}/applications/{application}"
    refused = admin.post(f"{at}/source-download", json={"runtime_id": runtime_id})
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:tappet:problem:source-never")
    body = {"runtime_id": runtime_id, "mode": "download", "start": False, "source": True}
    assert admin.post(f"{at}/download", json=body).status_code == 409
    assert plc.downloads == []
    assert plc.source_info() is None


def test_what_the_controller_holds_is_checked_like_an_upload(
    admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    plc.keep_source(SourceNote("p", "me", 0, ""), b"no archive")
    answer = admin.post(f"{API}/runtimes/{runtime_id}/source-upload", json={})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:folder-format")
    assert "The source in 'test stand' cannot be read" in answer.json()["detail"]
    assert admin.get(f"{API}/projects").json() == []
