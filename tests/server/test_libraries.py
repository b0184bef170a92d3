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


def test_comments_come_in_the_language_of_the_request(admin: TestClient) -> None:
    def move(language: str) -> dict[str, str]:
        library = admin.get(f"{URL}/SM3_Basic", headers={"Accept-Language": language}).json()
        item = next(item for item in library["items"] if item["name"] == "MC_MoveAbsolute")
        pins = {pin["name"]: pin["comment"] for pin in item["inputs"] + item["outputs"]}
        return {"summary": item["summary"], "Position": pins["Position"]}

    assert move("zh-CN") == {"summary": "使轴运动到一个位置。", "Position": "目标位置 [u]"}
    assert move("en")["Position"] == "Target [u]"
    standard = admin.get(f"{URL}/Standard", headers={"Accept-Language": "zh"}).json()
    assert next(item for item in standard["items"] if item["name"] == "TON")["summary"].isascii()


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


def test_a_library_goes_out_as_the_file_that_can_be_installed(admin: TestClient) -> None:
    facts = archive.manifest("Plant", "1.0.0.0", company="Works")
    data = archive.pack(facts, {"Twice": "FUNCTION Twice : INT\nEND_FUNCTION\n"})
    assert admin.post(URL, files={"file": ("plant.tappetlib", data)}).status_code == 201
    answer = admin.get(f"{URL}/Plant/1.0.0.0/file")
    assert answer.content == data
    assert "Plant%201.0.0.0.tappetlib" in answer.headers["content-disposition"]


def test_bad_library_files_and_those_of_the_product(admin: TestClient) -> None:
    answer = admin.post(URL, files={"file": ("x.tappetlib", b"no zip")})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:library-file")
    version = admin.get(f"{URL}/Util").json()["version"]
    assert admin.delete(f"{URL}/Util/{version}").status_code == 409
    assert admin.delete(f"{URL}/Nothing/1.0").status_code == 404


def test_who_uses_a_version_and_what_a_library_needs(admin: TestClient) -> None:
    for version in ("1.0.0.0", "1.1.0.0"):
        needed = {"name": "Util", "parameters": [{"list": "GVL", "name": "cMax", "value": "3"}]}
        facts = archive.manifest("Plant", version, requires=[needed])
        data = archive.pack(facts, {"Twice": "FUNCTION Twice : INT\nEND_FUNCTION\n"})
        assert admin.post(URL, files={"file": ("plant.tappetlib", data)}).status_code == 201
    listed = {(item["name"], item["version"]): item for item in admin.get(URL).json()}
    values = [{"list": "GVL", "name": "cMax", "value": "3"}]
    assert listed["Plant", "1.0.0.0"]["requires"] == [
        {"name": "Util", "version": "*", "namespace": "", "qualified_only": False, "parameters": values}
    ]
    assert (
        "Tc2_Standard" in next(item for (name, _), item in listed.items() if name == "Standard")["replaces"]
    )

    def uses(version: str) -> list[tuple[str, str]]:
        found = admin.get(f"{URL}/Plant/{version}/projects").json()
        return [(use["project_name"], use["version"]) for use in found]

    for name, asked in (("Fixed", "1.0.0.0"), ("Newest", "*")):
        project = admin.post("/api/v1/projects", json={"name": name}).json()["id"]
        objects = f"/api/v1/projects/{project}/objects"
        manager = next(o for o in admin.get(objects).json() if o["kind"] == "library_manager")
        references = [
            {"name": "Plant", "version": asked},
            {"name": "plant", "version": "1.1.0.0", "namespace": "P2"},
        ]
        data = {"references": references[: 1 if asked == "*" else 2]}
        saved = admin.put(f"{objects}/{manager['id']}", json={"base_revision": 1, "data": data})
        assert saved.status_code == 200, saved.text
    assert uses("1.0.0.0") == [("Fixed", "1.0.0.0")]
    assert uses("1.1.0.0") == [("Fixed", "1.1.0.0"), ("Newest", "*")]
    assert admin.get(f"{URL}/Plant/9/projects").status_code == 404


def test_a_project_with_errors_becomes_no_library(admin: TestClient) -> None:
    maker = admin.post("/api/v1/projects", json={"name": "Faulty", "template": "empty"}).json()["id"]
    data = {"declaration": "FUNCTION Twice : INT", "implementation": "Twice := unknown;"}
    body = {"parent_id": None, "kind": "pou", "name": "Twice", "data": data}
    item = admin.post(f"/api/v1/projects/{maker}/objects", json=body).json()
    answer = admin.post(f"/api/v1/projects/{maker}/library", json={"version": "1.0.0.0"})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:library-errors")
    error = next(d for d in answer.json()["diagnostics"] if d["severity"] == "error")
    assert (error["object_id"], error["part"], error["line"]) == (item["id"], "implementation", 1)
    assert admin.get(f"{URL}/Faulty").status_code == 404
    admin.patch(f"/api/v1/projects/{maker}/objects/{item['id']}", json={"excluded": True})
    good = {"declaration": "FUNCTION Thrice : INT", "implementation": "Thrice := 3;"}
    body = {"parent_id": None, "kind": "pou", "name": "Thrice", "data": good}
    assert admin.post(f"/api/v1/projects/{maker}/objects", json=body).status_code == 201
    answer = admin.post(f"/api/v1/projects/{maker}/library", json={"version": "1.0.0.0"})
    assert answer.status_code == 201, answer.text
    assert [item["name"] for item in admin.get(f"{URL}/Faulty").json()["items"]] == ["Thrice"]


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


def test_a_library_is_saved_with_qualified_access_only(admin: TestClient) -> None:
    maker = admin.post("/api/v1/projects", json={"name": "Strict", "template": "empty"}).json()["id"]
    data = {"declaration": "FUNCTION Twice : INT", "implementation": "Twice := 2;"}
    body = {"parent_id": None, "kind": "pou", "name": "Twice", "data": data}
    assert admin.post(f"/api/v1/projects/{maker}/objects", json=body).status_code == 201
    facts = {"version": "1.0.0.0", "qualified_only": True}
    saved = admin.post(f"/api/v1/projects/{maker}/library", json=facts)
    assert saved.json()["qualified_only"] is True
    assert admin.get(f"{URL}/Strict").json()["qualified_only"] is True
    assert admin.get(f"{URL}/Standard").json()["qualified_only"] is False
