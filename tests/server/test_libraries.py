"""The library catalogue."""

from __future__ import annotations

from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from tappet.libraries import archive, repository

URL = "/api/v1/libraries"


def test_list_and_items(admin: TestClient) -> None:
    names = [library["name"] for library in admin.get(URL).json()]
    assert "Standard" in names
    library = admin.get(f"{URL}/standard").json()
    ton = next(item for item in library["items"] if item["name"] == "TON")
    assert ton["kind"] == "function_block"
    assert [(pin["name"], pin["type"]) for pin in ton["inputs"]] == [("IN", "BOOL"), ("PT", "TIME")]


def test_sources_are_open(admin: TestClient) -> None:
    assert "FUNCTION_BLOCK TON" in admin.get(f"{URL}/Standard/sources/ton").json()["text"]
    assert admin.get(f"{URL}/Standard/sources/..%2F..%2Fsecret").status_code == 404


def test_unknown_library_names_the_installed_ones(admin: TestClient) -> None:
    answer = admin.get(f"{URL}/Standart")
    assert answer.status_code == 404
    assert "Standard" in answer.json()["detail"]


@pytest.fixture(autouse=True)
def library_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(tmp_path / "libraries"))


def test_a_library_file_is_installed_shown_and_removed(admin: TestClient) -> None:
    for version in ("1.0.0.0", "1.1.0.0"):
        facts = archive.manifest("Plant", version, company="Works", description=f"Version {version}")
        data = archive.pack(facts, {"Twice": f"(* {version} *)\nFUNCTION Twice : INT\nEND_FUNCTION\n"})
        answer = admin.post(URL, files={"file": ("plant.tappetlib", data)})
        assert answer.status_code == 201, answer.text
        assert answer.json()["removable"] is True
    found = [library for library in admin.get(URL).json() if library["name"] == "Plant"]
    assert [library["version"] for library in found] == ["1.1.0.0", "1.0.0.0"]
    assert admin.get(f"{URL}/Plant").json()["items"][0]["summary"] == "1.1.0.0"
    assert admin.get(f"{URL}/Plant", params={"version": "1.0.0.0"}).json()["items"][0]["summary"] == "1.0.0.0"
    assert admin.delete(f"{URL}/Plant/1.1.0.0").status_code == 204
    assert admin.get(f"{URL}/Plant").json()["version"] == "1.0.0.0"


def test_bad_library_files_and_those_of_the_product(admin: TestClient) -> None:
    answer = admin.post(URL, files={"file": ("x.tappetlib", b"no zip")})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:library-file")
    version = admin.get(f"{URL}/Util").json()["version"]
    assert admin.delete(f"{URL}/Util/{version}").status_code == 409
    assert admin.delete(f"{URL}/Nothing/1.0").status_code == 404


def test_a_project_is_saved_as_library_and_used_by_another(admin: TestClient) -> None:
    maker = admin.post("/api/v1/projects", json={"name": "Maker", "template": "empty"}).json()["id"]
    body = {
        "parent_id": None,
        "kind": "pou",
        "name": "Twice",
        "data": {
            "declaration": "FUNCTION Twice : INT\nVAR_INPUT\n    n : INT; (* Number *)\nEND_VAR",
            "implementation": "Twice := 2 * n;",
        },
    }
    assert admin.post(f"/api/v1/projects/{maker}/objects", json=body).status_code == 201
    url = f"/api/v1/projects/{maker}/library"
    assert admin.post(url, json={"version": "one"}).status_code == 422
    saved = admin.post(url, json={"version": "1.0.0.0", "company": "Works"})
    assert saved.status_code == 201, saved.text
    assert saved.json()["namespace"] == "Maker"
    item = admin.get(f"{URL}/Maker").json()["items"][0]
    assert (item["name"], item["inputs"][0]["comment"]) == ("Twice", "Number")
    empty = admin.post("/api/v1/projects", json={"name": "Nothing", "template": "empty"}).json()["id"]
    refused = admin.post(f"/api/v1/projects/{empty}/library", json={"version": "1.0"})
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:no-library")
