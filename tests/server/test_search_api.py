"""Search and replace over REST."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

PROJECTS = "/api/v1/projects"


@pytest.fixture
def project(admin: TestClient) -> str:
    url = f"{PROJECTS}/{admin.post(PROJECTS, json={'name': 'Search'}).json()['id']}"
    program = next(item for item in admin.get(f"{url}/objects").json() if item["kind"] == "pou")
    data = {"declaration": "PROGRAM PLC_PRG\nVAR\n    speed : INT;\nEND_VAR", "implementation": "speed := 1;"}
    saved = admin.put(f"{url}/objects/{program['id']}", json={"base_revision": 1, "data": data})
    assert saved.status_code == 200
    return url


def search(client: TestClient, project: str, **order: Any) -> dict[str, Any]:
    answer = client.post(f"{project}/search", json=order)
    assert answer.status_code == 200, answer.text
    report: dict[str, Any] = answer.json()
    return report


def everything(report: dict[str, Any], **changed: Any) -> list[dict[str, Any]]:
    return [
        {
            "object_id": item["object_id"],
            "base_revision": item["revision"],
            "hits": [hit["number"] for hit in item["hits"]],
        }
        | changed
        for item in report["objects"]
    ]


def implementation(client: TestClient, project: str) -> str:
    program = next(item for item in client.get(f"{project}/objects").json() if item["kind"] == "pou")
    text: str = client.get(f"{project}/objects/{program['id']}").json()["data"]["implementation"]
    return text


def test_search_says_where(admin: TestClient, project: str) -> None:
    (item,) = search(admin, project, text="SPEED")["objects"]
    assert (item["name"], item["kind"], item["total"]) == ("PLC_PRG", "pou", 2)
    assert item["path"].endswith("Application/PLC_PRG")
    assert [(hit["part"], hit["line"], hit["column"], hit["after"]) for hit in item["hits"]] == [
        ("declaration", 3, 5, " : INT;"),
        ("implementation", 1, 1, " := 1;"),
    ]


def test_a_replacement_is_one_change_that_can_be_taken_back(admin: TestClient, project: str) -> None:
    query = {"text": "speed"}
    chosen = everything(search(admin, project, **query))
    before = len(admin.get(f"{project}/revisions").json())
    order = {"query": query, "replacement": "velocity", "objects": chosen}
    report = admin.post(f"{project}/replace", json=order).json()
    changes = admin.get(f"{project}/revisions").json()
    assert (report["hits"], report["objects"], len(changes)) == (2, 1, before + 1)
    assert (changes[0]["revision"], changes[0]["action"]) == (report["revision"], "replace")
    assert implementation(admin, project) == "velocity := 1;"
    undone = admin.post(f"{project}/revisions/{report['revision']}/undo")
    assert undone.status_code == 200, undone.text
    assert implementation(admin, project) == "speed := 1;"
    again = admin.post(f"{project}/revisions/{report['revision']}/undo")
    assert (again.status_code, again.json()["type"]) == (409, "urn:tappet:problem:changed-since")
    assert "'PLC_PRG' changed since" in again.json()["detail"]


def test_what_somebody_else_changed_is_not_replaced(admin: TestClient, project: str) -> None:
    query = {"text": "speed"}
    chosen = everything(search(admin, project, **query))
    url = f"{project}/objects/{chosen[0]['object_id']}"
    data = admin.get(url).json()["data"] | {"implementation": "speed := 2;"}
    saved = admin.put(url, json={"base_revision": chosen[0]["base_revision"], "data": data})
    assert saved.status_code == 200
    order = {"query": query, "replacement": "velocity", "objects": chosen}
    refused = admin.post(f"{project}/replace", json=order)
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:tappet:problem:stale-revision")
    assert implementation(admin, project) == "speed := 2;"


def test_all_or_nothing(admin: TestClient, project: str) -> None:
    """A name that cannot be one refuses the texts with it."""
    query = {"text": "PLC_PRG"}
    chosen = everything(search(admin, project, **query))
    order = {"query": query, "replacement": "1 bad", "objects": chosen}
    refused = admin.post(f"{project}/replace", json=order)
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:invalid-name")
    assert len(search(admin, project, **query)["objects"]) == len(chosen) == 2


def test_problems_name_the_field(admin: TestClient, project: str) -> None:
    bad = admin.post(f"{project}/search", json={"text": "(a", "regular_expression": True})
    assert (bad.status_code, bad.json()["type"]) == (422, "urn:tappet:problem:invalid-pattern")
    assert bad.json()["detail"] == "This is no regular expression: missing ): (a"
    order = {"query": {"text": "a", "regular_expression": True}, "replacement": "$1", "objects": []}
    bad = admin.post(f"{project}/replace", json=order)
    assert (bad.status_code, bad.json()["type"]) == (422, "urn:tappet:problem:invalid-replacement")


def test_libraries_are_searched_and_not_changed(admin: TestClient, project: str) -> None:
    first = search(admin, project, text="Q :", libraries=True, limit=5)
    assert {item["library"] for item in first["objects"]} == {"Standard"}
    assert all(not hit["writable"] for item in first["objects"] for hit in item["hits"])
    assert first["next"] is not None
    more = search(admin, project, text="Q :", libraries=True, limit=5, after=first["next"])
    assert not {item["name"] for item in more["objects"]} & {item["name"] for item in first["objects"]}


def test_a_preview_shows_what_would_replace_each_hit(admin: TestClient, project: str) -> None:
    order = {"text": r"sp(e+)d", "regular_expression": True, "replacement": "v$1"}
    (item,) = search(admin, project, **order)["objects"]
    assert [hit["replacement"] for hit in item["hits"]] == ["vee", "vee"]
    assert implementation(admin, project) == "speed := 1;"
    plain = search(admin, project, text="speed")["objects"][0]["hits"]
    assert [hit["replacement"] for hit in plain] == [None, None]


def test_who_may_replace(as_role: dict[str, TestClient], project: str) -> None:
    assert search(as_role["viewer"], project, text="speed")["objects"]
    order = {"query": {"text": "a"}, "replacement": "b", "objects": []}
    assert as_role["operator"].post(f"{project}/replace", json=order).status_code == 403
    answer = as_role["engineer"].post(f"{project}/replace", json=order)
    assert (answer.status_code, answer.json()) == (200, {"hits": 0, "objects": 0, "revision": None})
