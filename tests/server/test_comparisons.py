"""Comparing projects over REST, taking differences over, undoing them."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient
from test_projects_api import API, problem, tree

from tappet.project import edit, folder
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.server.services import Services


@pytest.fixture
def press(admin: TestClient) -> str:
    """Path of a project with a list of variables."""
    answer = admin.post(f"{API}/projects", json={"name": "Press"})
    path = f"{API}/projects/{answer.json()['id']}"
    application = tree(admin, path)["Application"]["id"]
    admin.post(f"{path}/objects", json={"parent_id": application, "kind": "gvl", "name": "GVL_Speeds"})
    return path


def write(client: TestClient, project: str, name: str, **texts: str) -> None:
    item = tree(client, project)[name]
    data = client.get(f"{project}/objects/{item['id']}").json()["data"]
    body = {"base_revision": item["revision"], "data": data | texts}
    assert client.put(f"{project}/objects/{item['id']}", json=body).status_code == 200


def found(answer: Any) -> dict[str, tuple[str, list[str]]]:
    assert answer.status_code in (200, 201), answer.text
    return {
        (one["new"] or one["old"])["name"]: (one["state"], one["fields"])
        for one in answer.json()["differences"]
    }


def key_of(answer: Any, name: str) -> str:
    (key,) = [
        one["key"] for one in answer.json()["differences"] if (one["new"] or one["old"])["name"] == name
    ]
    return str(key)


def with_revision(project: str, revision: int) -> dict[str, Any]:
    return {"old": {"kind": "project", "project_id": project.rpartition("/")[2], "revision": revision}}


def test_a_project_and_its_own_revision(admin: TestClient, press: str) -> None:
    before = admin.get(press).json()["revision"]
    write(admin, press, "PLC_PRG", implementation="x := 1; // one")
    admin.delete(f"{press}/objects/{tree(admin, press)['GVL_Speeds']['id']}")
    after = tree(admin, press)
    opened = admin.post(f"{press}/comparisons", json=with_revision(press, before))
    assert found(opened) == {"PLC_PRG": ("changed", ["implementation"]), "GVL_Speeds": ("removed", [])}
    comparison = f"{press}/comparisons/{opened.json()['id']}"
    sides = admin.get(f"{comparison}/objects/{key_of(opened, 'PLC_PRG')}").json()
    assert (sides["old"]["implementation"], sides["new"]["implementation"]) == ("", "x := 1; // one")
    everything = [{"key": one["key"]} for one in opened.json()["differences"]]
    merged = admin.post(f"{comparison}/merge", json={"take": everything})
    assert merged.status_code == 200, merged.text
    assert set(merged.json()["touched"]) == {
        after["PLC_PRG"]["id"],
        key_of(opened, "GVL_Speeds").removeprefix("-"),
    }
    assert found(admin.get(comparison)) == {}
    (last, *_) = admin.get(f"{press}/revisions").json()
    assert (last["action"], last["object_count"], last["comment"]) == ("merge", 2, f"Press ({before})")
    (act, *_) = admin.get(f"{API}/audit").json()
    assert (act["action"], act["result"], act["new_value"]) == (
        "project-merged",
        "ok",
        f"2 of Press ({before})",
    )
    undone = admin.post(f"{press}/undo").json()
    assert undone["done"]["action"] == "merge"
    assert {name: item["id"] for name, item in tree(admin, press).items()} == {
        name: item["id"] for name, item in after.items()
    }
    assert admin.delete(comparison).status_code == 204
    problem(admin.get(comparison), 404, "not-found")


def test_parts_are_taken_from_another_project(admin: TestClient, press: str, services: Services) -> None:
    other = admin.post(f"{API}/projects", json={"name": "Other"}).json()["id"]
    write(admin, f"{API}/projects/{other}", "PLC_PRG", implementation="x := 1;\ny := 2;")
    write(admin, press, "PLC_PRG", declaration="PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR")
    opened = admin.post(f"{press}/comparisons", json={"old": {"kind": "project", "project_id": other}})
    assert found(opened) == {
        "PLC_PRG": ("changed", ["declaration", "implementation"]),
        "GVL_Speeds": ("added", []),
    }
    comparison, key = f"{press}/comparisons/{opened.json()['id']}", key_of(opened, "PLC_PRG")
    taken = {"key": key, "whole": False, "texts": {"implementation": "y := 2;"}, "base_revision": 2}
    assert admin.post(f"{comparison}/merge", json={"take": [taken]}).status_code == 200
    data = admin.get(f"{press}/objects/{key}").json()["data"]
    assert (data["implementation"], "n : INT" in data["declaration"]) == ("y := 2;", True)
    # somebody else was faster
    refused = admin.post(f"{comparison}/merge", json={"take": [taken]})
    assert "'PLC_PRG' was changed" in problem(refused, 409, "changed-since")["detail"]
    wrong = {"key": key, "whole": False, "fields": ["speed"]}
    problem(admin.post(f"{comparison}/merge", json={"take": [wrong]}), 409, "unknown-difference")
    assert admin.get(f"{API}/audit").json()[0]["result"] == "refused"
    flags = {"ignore_white_space": True}
    write(admin, press, "PLC_PRG", implementation="x:=1;y:=2;", declaration="PROGRAM PLC_PRG\nVAR\nEND_VAR")
    assert found(admin.get(comparison, params=flags)) == {"GVL_Speeds": ("added", [])}


def test_files_are_compared(admin: TestClient, press: str, services: Services) -> None:
    project = services.store.load(press.rpartition("/")[2])
    for name, content in (("a.zip", folder.write_zip(project)), ("a.xml", write_plcopen(project))):
        answer = admin.post(f"{press}/comparisons/files", files={"files": (name, content)})
        assert found(answer) == {}
        assert answer.json()["title"] == name
    lists = project.find_kind("gvl")
    changed = edit.rename_object(project, lists[0].id, "GVL_Fast")
    answer = admin.post(f"{press}/comparisons/files", files={"files": ("a.zip", folder.write_zip(changed))})
    assert [one["renamed"] for one in answer.json()["differences"]] == [True]
    problem(admin.post(f"{press}/comparisons/files", files={"files": ("a.project", b"PK")}), 422, "exchange")


def test_viewers_compare_and_do_not_merge(
    admin: TestClient, press: str, as_role: dict[str, TestClient]
) -> None:
    viewer = as_role["viewer"]
    opened = viewer.post(f"{press}/comparisons", json=with_revision(press, 1))
    assert found(opened) == {"GVL_Speeds": ("added", [])}
    comparison = f"{press}/comparisons/{opened.json()['id']}"
    problem(viewer.post(f"{comparison}/merge", json={"take": [{"key": "x"}]}), 403, "role-too-low")
    other = admin.post(f"{API}/projects", json={"name": "Other"}).json()["id"]
    problem(admin.get(f"{API}/projects/{other}/comparisons/{opened.json()['id']}"), 404, "not-found")
    back = admin.post(f"{press}/comparisons", json=with_revision(press, 2) | {"revision": 1})
    assert (found(back), back.json()["can_merge"]) == ({"GVL_Speeds": ("removed", [])}, False)
    earlier = f"{press}/comparisons/{back.json()['id']}/merge"
    problem(admin.post(earlier, json={"take": [{"key": "x"}]}), 409, "earlier-revision")


def test_what_runs_is_compared(admin: TestClient, press: str, runtime_id: str, services: Services) -> None:
    order = {"old": {"kind": "runtime", "runtime_id": runtime_id}}
    problem(admin.post(f"{press}/comparisons", json=order), 409, "no-source")  # of another server
    application = tree(admin, press)["Application"]["id"]
    write(
        admin,
        press,
        "PLC_PRG",
        declaration="PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR",
        implementation="n := 1;",
    )
    loaded = admin.post(
        f"{press}/applications/{application}/download",
        json={"runtime_id": runtime_id, "mode": "download", "start": True},
    )
    assert loaded.status_code == 200, loaded.text
    write(admin, press, "PLC_PRG", implementation="n := 2;")
    opened = admin.post(f"{press}/comparisons", json=order)
    assert found(opened) == {"PLC_PRG": ("changed", ["implementation"])}
    assert opened.json()["at"] is not None
    sides = admin.get(f"{press}/comparisons/{opened.json()['id']}/objects/{key_of(opened, 'PLC_PRG')}").json()
    assert sides["old"]["implementation"] == "n := 1;"
    for source in (services.settings.data_dir / "packages").glob("*.source"):
        source.unlink()
    problem(admin.post(f"{press}/comparisons", json=order), 409, "no-source")


def test_undo_and_deleted_objects(admin: TestClient, press: str, as_role: dict[str, TestClient]) -> None:
    before = tree(admin, press)
    ids = [before["GVL_Speeds"]["id"], before["PLC_PRG"]["id"]]
    assert admin.post(f"{press}/objects/delete", json={"object_ids": ids}).status_code == 204
    deleted = admin.get(f"{press}/deleted-objects").json()
    assert {(one["name"], one["author"], one["below"]) for one in deleted} == {
        ("GVL_Speeds", "admin", 0),
        ("PLC_PRG", "admin", 0),
    }
    steps = admin.get(f"{press}/undo").json()
    assert (steps["undo"]["action"], steps["redo"]) == ("delete", None)
    problem(admin.post(f"{press}/redo"), 409, "not-undoable")
    problem(as_role["viewer"].post(f"{press}/undo"), 403, "role-too-low")
    done = admin.post(f"{press}/undo").json()
    assert sorted(done["touched"]) == sorted(ids)
    assert done["steps"]["redo"]["action"] == "delete"
    assert tree(admin, press).keys() == before.keys()
    assert admin.get(f"{press}/deleted-objects").json() == []
    assert admin.post(f"{press}/redo").status_code == 200
    (one, _) = admin.get(f"{press}/deleted-objects").json()
    url = f"{press}/objects/{one['id']}"
    assert admin.post(f"{url}/revert", json={"revision": one["revision"]}).status_code == 200
    assert [state["action"] for state in admin.get(f"{url}/revisions").json()][:3] == [
        "revert",
        "redo",
        "undo",
    ]
