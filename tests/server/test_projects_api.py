"""Projects and objects over REST, as two browsers and a script use them (seam 6)."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import browser

API = "/api/v1"


@pytest.fixture
def press(admin: TestClient) -> str:
    """Path of a project."""
    answer = admin.post(f"{API}/projects", json={"name": "Press", "description": "line 3"})
    assert answer.status_code == 201, answer.text
    return f"{API}/projects/{answer.json()['id']}"


@pytest.fixture
def second_tab(app: FastAPI, admin: TestClient) -> TestClient:
    """Another browser of the same user."""
    client = browser(app)
    client.cookies = admin.cookies
    return client


def tree(client: TestClient, project: str) -> dict[str, dict[str, Any]]:
    return {item["name"]: item for item in client.get(f"{project}/objects").json()}


def problem(answer: Any, status: int, kind: str) -> dict[str, Any]:
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    body: dict[str, Any] = answer.json()
    assert body["type"] == f"urn:tappet:problem:{kind}"
    return body


def test_projects_begin_as_examples(admin: TestClient) -> None:
    examples = {item["name"]: item for item in admin.get(f"{API}/examples").json()}
    assert {"bottling", "flying_shear", "pick_and_place", "rotary_knife", "winder"} <= examples.keys()
    assert all(item["title"] and item["description"] for item in examples.values())
    made = admin.post(f"{API}/projects", json={"name": "Mine", "example": "flying_shear"}).json()
    assert (made["name"], made["description"]) == ("Mine", examples["flying_shear"]["description"])
    objects = tree(admin, f"{API}/projects/{made['id']}")
    assert {"Web", "Shear", "PLC_PRG", "Machine3D"} <= objects.keys()
    wrong = admin.post(f"{API}/projects", json={"name": "Other", "example": "../bottling"})
    assert "flying_shear" in problem(wrong, 422, "unknown-example")["detail"]
    assert [item["name"] for item in admin.get(f"{API}/projects").json()] == ["Mine"]


def test_projects(admin: TestClient, press: str) -> None:
    listed = admin.get(f"{API}/projects").json()
    assert [(item["name"], item["description"], item["created_by"]) for item in listed] == [
        ("Press", "line 3", "admin")
    ]
    refused = admin.post(f"{API}/projects", json={"name": "PRESS"})
    assert "'PRESS'" in problem(refused, 409, "name-taken")["detail"]
    problem(admin.post(f"{API}/projects", json={"name": " x"}), 422, "invalid-name")
    problem(admin.post(f"{API}/projects", json={"name": "x", "template": "other"}), 422, "invalid-request")
    empty = admin.post(f"{API}/projects", json={"name": "Empty", "template": "empty"}).json()
    assert admin.get(f"{API}/projects/{empty['id']}/objects").json() == []
    motion = admin.post(f"{API}/projects", json={"name": "Motion", "template": "motion"}).json()
    kinds = {item["kind"] for item in admin.get(f"{API}/projects/{motion['id']}/objects").json()}
    assert {"axis_pool", "axis", "pou", "task"} <= kinds
    changed = admin.patch(press, json={"name": "Stamp"}).json()
    assert (changed["name"], changed["description"]) == ("Stamp", "line 3")
    problem(admin.get(f"{API}/projects/{'0' * 32}"), 404, "unknown-project")
    acts = [entry["action"] for entry in admin.get(f"{API}/audit").json()]
    assert acts[:3] == ["project-renamed", "project-created", "project-created"]


def test_a_deleted_project_comes_back(admin: TestClient, press: str) -> None:
    assert admin.delete(press).status_code == 204
    problem(admin.get(f"{press}/objects"), 404, "unknown-project")
    assert [item["name"] for item in admin.get(f"{API}/projects?deleted=true").json()] == ["Press"]
    assert admin.post(f"{press}/restore").json()["name"] == "Press"
    assert "PLC_PRG" in tree(admin, press)


def test_the_tree(admin: TestClient, press: str) -> None:
    found = tree(admin, press)
    assert found["PLC_PRG"] == {
        "id": found["PLC_PRG"]["id"],
        "parent_id": found["Application"]["id"],
        "kind": "pou",
        "subkind": "program",
        "name": "PLC_PRG",
        "index": 1,
        "revision": 1,
        "excluded": False,
    }
    task = admin.get(f"{press}/objects/{found['MainTask']['id']}").json()
    assert task["data"]["pous"] == [{"name": "PLC_PRG", "comment": ""}]
    problem(admin.get(f"{press}/objects/{'0' * 32}"), 404, "unknown-object")


def test_adding_moving_copying_and_deleting(admin: TestClient, press: str) -> None:
    app = tree(admin, press)["Application"]["id"]
    body = {"parent_id": app, "kind": "pou", "name": "FB_Motor", "subkind": "function_block", "index": 0}
    answer = admin.post(f"{press}/objects", json=body)
    assert answer.status_code == 201
    block = answer.json()
    assert (block["index"], block["subkind"], block["revision"]) == (0, "function_block", 1)
    assert block["data"]["declaration"].startswith("FUNCTION_BLOCK FB_Motor\n")
    gvl = admin.post(f"{press}/objects", json={"parent_id": None, "kind": "gvl"}).json()
    assert (gvl["name"], gvl["parent_id"], gvl["index"]) == ("GVL", None, 0)
    task = admin.post(f"{press}/objects", json={"parent_id": app, "kind": "task", "name": "T"})
    assert "belongs below task configuration" in problem(task, 422, "not-placeable")["detail"]
    problem(admin.post(f"{press}/objects", json=body), 409, "name-taken")
    problem(admin.post(f"{press}/objects", json={**body, "name": "IF"}), 422, "invalid-name")
    problem(admin.post(f"{press}/objects", json={**body, "name": "X", "data": {"x": 1}}), 422, "invalid-data")

    url = f"{press}/objects/{block['id']}"
    renamed = admin.patch(url, json={"name": "FB_Pump"}).json()
    assert renamed["data"]["declaration"].startswith("FUNCTION_BLOCK FB_Pump\n")
    assert admin.patch(url, json={"index": 2}).json()["index"] == 2
    moved = admin.patch(url, json={"parent_id": None}).json()
    assert (moved["parent_id"], moved["index"]) == (None, 1)
    problem(admin.patch(url, json={}), 422, "nothing-to-change")
    problem(admin.patch(url, json={"parent_id": moved["id"]}), 422, "not-placeable")
    copied = admin.post(f"{url}/copy", json={"parent_id": app, "index": 0})
    assert copied.status_code == 201
    assert (copied.json()["name"], copied.json()["index"]) == ("FB_Pump", 0)
    assert admin.delete(url).status_code == 204
    assert admin.get(url).status_code == 404
    names = [item["name"] for item in tree(admin, press).values() if item["parent_id"] == app]
    assert names == ["FB_Pump", "Library Manager", "PLC_PRG", "Task Configuration"]


def test_copying_between_projects(admin: TestClient, press: str) -> None:
    source = tree(admin, press)["PLC_PRG"]["id"]
    other = admin.post(f"{API}/projects", json={"name": "Other", "template": "empty"}).json()["id"]
    body = {"parent_id": None, "source_project_id": press.rpartition("/")[2]}
    copied = admin.post(f"{API}/projects/{other}/objects/{source}/copy", json=body).json()
    assert copied["id"] != source
    assert list(tree(admin, f"{API}/projects/{other}")) == ["PLC_PRG"]


def test_of_two_tabs_nothing_is_lost(admin: TestClient, second_tab: TestClient, press: str) -> None:
    """The second save is refused with both versions; saved on top of the first, both texts are there."""
    url = f"{press}/objects/{tree(admin, press)['PLC_PRG']['id']}"
    opened = [client.get(url).json() for client in (admin, second_tab)]
    texts = [
        {**item["data"], "implementation": body}
        for item, body in zip(opened, ("first;", "second;"), strict=True)
    ]
    first = admin.put(url, json={"base_revision": opened[0]["revision"], "data": texts[0]})
    assert first.status_code == 200
    body = {"base_revision": opened[1]["revision"], "data": texts[1]}
    refused = problem(second_tab.put(url, json=body), 409, "stale-revision")
    assert refused["current"] == first.json()
    assert refused["yours"] == body
    assert refused["author"] == "admin"
    assert second_tab.get(url).json() == first.json()
    merged = {**texts[0], "implementation": "first;\nsecond;"}
    body = {"base_revision": refused["current"]["revision"], "data": merged, "comment": "both"}
    saved = second_tab.put(url, json=body).json()
    assert saved["data"]["implementation"] == "first;\nsecond;"
    history = admin.get(f"{url}/revisions").json()
    assert [(item["revision"], item["comment"], item["change"]) for item in history] == [
        (3, "both", "updated"),
        (2, "", "updated"),
        (1, "", "created"),
    ]
    assert admin.get(f"{url}/revisions/2").json()["data"]["implementation"] == "first;"


def test_several_objects_are_saved_together_or_not_at_all(
    admin: TestClient, second_tab: TestClient, press: str
) -> None:
    gvl = admin.post(
        f"{press}/objects", json={"parent_id": tree(admin, press)["Application"]["id"], "kind": "gvl"}
    ).json()
    prg = admin.get(f"{press}/objects/{tree(admin, press)['PLC_PRG']['id']}").json()
    data = [{**gvl["data"], "declaration": "VAR_GLOBAL\n    b : INT;\nEND_VAR"}]
    data.append({**prg["data"], "implementation": "b := 1;"})
    objects = [
        {"object_id": item["id"], "base_revision": item["revision"], "data": wanted}
        for item, wanted in zip((gvl, prg), data, strict=True)
    ]
    saved = admin.put(f"{press}/objects", json={"objects": objects, "comment": "a is b"}).json()
    assert [item["data"] for item in saved] == data
    stale = [{**objects[0], "data": gvl["data"], "base_revision": saved[0]["revision"]}, objects[1]]
    stale[1] = {**stale[1], "data": {**data[1], "implementation": "other;"}}
    refused = problem(second_tab.put(f"{press}/objects", json={"objects": stale}), 409, "stale-revision")
    assert refused["object_id"] == prg["id"]
    assert refused["current"] == saved[1]
    assert [admin.get(f"{press}/objects/{item['id']}").json() for item in saved] == saved


def test_a_save_of_a_deleted_object_is_not_lost_either(admin: TestClient, press: str) -> None:
    url = f"{press}/objects/{tree(admin, press)['PLC_PRG']['id']}"
    opened = admin.get(url).json()
    admin.delete(url)
    body = {"base_revision": 1, "data": {**opened["data"], "implementation": "mine;"}}
    refused = problem(admin.put(url, json=body), 409, "stale-revision")
    assert refused["current"] is None
    assert refused["yours"] == body
    back = admin.post(f"{url}/revert", json={"revision": 1}).json()
    assert (
        admin.put(url, json={**body, "base_revision": back["revision"]}).json()["data"]["implementation"]
        == "mine;"
    )


def test_wrong_data_name_the_field(admin: TestClient, press: str) -> None:
    task = tree(admin, press)["MainTask"]
    url = f"{press}/objects/{task['id']}"
    data = admin.get(url).json()["data"]
    refused = admin.put(url, json={"base_revision": 1, "data": {**data, "interval": "soon"}})
    assert "interval: 'soon' is no time" in problem(refused, 422, "invalid-data")["detail"]
    problem(admin.put(url, json={"base_revision": 1}), 422, "invalid-request")


def test_undo(admin: TestClient, press: str) -> None:
    main = tree(admin, press)["PLC_PRG"]
    url = f"{press}/objects/{main['id']}"
    data = admin.get(url).json()["data"]
    admin.put(url, json={"base_revision": 1, "data": {**data, "implementation": "x;"}, "autosave": True})
    admin.delete(url)
    assert "PLC_PRG" not in tree(admin, press)
    changes = admin.get(f"{press}/revisions").json()
    assert [(item["revision"], item["action"], item["object_name"], item["change"]) for item in changes] == [
        (3, "delete", "PLC_PRG", "deleted"),
        (2, "save", "PLC_PRG", "updated"),
        (1, "create", None, "created"),
    ]
    assert changes[1]["autosave"] is True
    assert changes[2]["object_count"] == 7
    assert admin.post(f"{press}/revert", json={"revision": 1, "comment": "undo"}).json()["revision"] == 4
    assert admin.get(url).json()["data"] == data
    problem(admin.post(f"{press}/revert", json={"revision": 99}), 404, "unknown-revision")
    problem(admin.post(f"{url}/revert", json={"revision": 99}), 404, "unknown-revision")
    assert [item["revision"] for item in admin.get(f"{press}/revisions?limit=2&before=4").json()] == [3, 2]


def test_export_and_import(admin: TestClient, press: str) -> None:
    exported = admin.get(f"{press}/export")
    assert exported.headers["content-type"] == "application/zip"
    assert "Press.zip" in exported.headers["content-disposition"]
    assert "Press/tappet-project.json" in zipfile.ZipFile(io.BytesIO(exported.content)).namelist()
    answer = admin.post(f"{API}/projects/import", files={"file": ("Press.zip", exported.content)})
    assert answer.status_code == 201, answer.text
    copy = answer.json()
    assert (copy["name"], copy["description"]) == ("Press_1", "line 3")
    again = admin.get(f"{API}/projects/{copy['id']}/export")
    packed = [zipfile.ZipFile(io.BytesIO(content)) for content in (exported.content, again.content)]
    files = [{name.partition("/")[2]: one.read(name) for name in one.namelist()} for one in packed]
    for each in files:
        each.pop("tappet-project.json")
    assert files[0] == files[1]
    named = admin.post(f"{API}/projects/import", files={"file": exported.content}, data={"name": "Named"})
    assert named.json()["name"] == "Named"
    then = admin.get(f"{press}/export?revision=1")
    assert then.content == exported.content


def test_bad_archives(admin: TestClient) -> None:
    def send(content: bytes) -> Any:
        return admin.post(f"{API}/projects/import", files={"file": ("x.zip", content)})

    assert "zip file" in problem(send(b"no zip"), 422, "folder-format")["detail"]
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("../../etc/passwd", "x")
    assert "does not stay in the folder" in problem(send(buffer.getvalue()), 422, "folder-format")["detail"]
    assert admin.get(f"{API}/projects").json() == []
    problem(admin.post(f"{API}/projects/import"), 422, "invalid-request")


def test_large_archives_are_taken(admin: TestClient, press: str) -> None:
    """Archives may be larger than other requests."""
    packed = io.BytesIO(admin.get(f"{press}/export").content)
    with zipfile.ZipFile(packed, "a", zipfile.ZIP_STORED) as archive:
        archive.writestr("Press/drawing.bin", bytes(range(256)) * 40_000)
    answer = admin.post(f"{API}/projects/import", files={"file": ("x.zip", packed.getvalue())})
    assert answer.status_code == 201, answer.text
    again = admin.get(f"{API}/projects/{answer.json()['id']}/export").content
    assert len(zipfile.ZipFile(io.BytesIO(again)).read("Press_1/drawing.bin")) == 256 * 40_000


def test_placement_is_the_table(admin: TestClient) -> None:
    rules = {rule["kind"]: rule for rule in admin.get(f"{API}/placement").json()}
    assert rules["task"]["places"] == ["task_configuration.*"]
    assert rules["pou"]["subkinds"] == ["program", "function_block", "function"]
    assert rules["library_manager"]["names"] == ["Library Manager"]


def test_viewers_read_and_do_not_write(as_role: dict[str, TestClient], press: str) -> None:
    viewer = as_role["viewer"]
    main = tree(viewer, press)["PLC_PRG"]
    url = f"{press}/objects/{main['id']}"
    for path in (url, f"{url}/revisions", f"{press}/revisions", f"{press}/export", f"{API}/placement"):
        assert viewer.get(path).status_code == 200, path
    assert viewer.put(url, json={"base_revision": 1, "data": {}}).status_code == 403
    assert as_role["operator"].delete(url).status_code == 403
    saved = as_role["engineer"].put(
        url, json={"base_revision": 1, "data": {"declaration": "PROGRAM PLC_PRG"}}
    )
    assert saved.status_code == 200
