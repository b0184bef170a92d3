"""Unit tests of a stored application over REST."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

PROJECTS = "/api/v1/projects"


@pytest.fixture
def project(admin: TestClient) -> dict[str, str]:
    """A project with one suite; the ids of what is in it by name."""
    project_id = admin.post(PROJECTS, json={"name": "Tested"}).json()["id"]
    objects = admin.get(f"{PROJECTS}/{project_id}/objects").json()
    application = next(item["id"] for item in objects if item["kind"] == "application")
    suite = _add(
        admin,
        project_id,
        application,
        "pou",
        "FB_Sum_Test",
        "FUNCTION_BLOCK FB_Sum_Test EXTENDS TcUnit.FB_TestSuite",
        "Good();\nBad();\nWorse();",
    )
    ids = {"project": project_id, "application": application, "suite": suite}
    bodies = {
        "Good": "TEST('Good');\nAssertEquals_INT(2, 1 + 1, 'sum');\nTEST_FINISHED();",
        "Bad": "TEST('Bad');\nAssertEquals_INT(3, 1 + 1, 'sum');\nTEST_FINISHED();",
        "Worse": "TEST('Worse');\nzero := 1 / zero;\nTEST_FINISHED();",
    }
    for name, body in bodies.items():
        declaration = f"METHOD PRIVATE {name}\nVAR\n    zero : INT;\nEND_VAR"
        ids[name] = _add(admin, project_id, suite, "method", name, declaration, body)
    return ids


def _add(client: TestClient, project_id: str, parent: str, kind: str, name: str, head: str, body: str) -> str:
    data = {"declaration": head, "implementation": body}
    new = {"parent_id": parent, "kind": kind, "name": name, "data": data}
    answer = client.post(f"{PROJECTS}/{project_id}/objects", json=new)
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def run(
    client: TestClient, ids: dict[str, str], test_filter: str = "", only: tuple[str, ...] = ()
) -> dict[str, Any]:
    url = f"{PROJECTS}/{ids['project']}/applications/{ids['application']}/tests"
    answer = client.post(url, json={"filter": test_filter, "only": only})
    assert answer.status_code == 200, answer.text
    report: dict[str, Any] = answer.json()
    return report


def test_the_results_tree_leads_to_the_places(admin: TestClient, project: dict[str, str]) -> None:
    report = run(admin, project)
    assert (report["problem"], report["diagnostics"]) == (None, [])
    assert {key: report[key] for key in ("ok", "total", "passed", "failed", "error")} == {
        "ok": False,
        "total": 3,
        "passed": 1,
        "failed": 1,
        "error": 1,
    }
    (suite,) = report["suites"]
    assert (suite["name"], suite["object_id"]) == ("FB_Sum_Test", project["suite"])
    tests = {test["name"]: test for test in suite["tests"]}
    (failure,) = tests["Bad"]["failures"]
    assert (failure["expected"], failure["actual"]) == ("3", "2")
    assert (failure["object_id"], failure["part"], failure["line"]) == (project["Bad"], "implementation", 2)
    (failure,) = tests["Worse"]["failures"]
    assert (failure["code"], failure["object_id"], failure["line"]) == (1, project["Worse"], 2)
    assert failure["call_stack"] == ["FB_Sum_Test, line 4"]
    report = run(admin, project, "good")
    assert (report["ok"], report["passed"], report["skipped"]) == (True, 1, 2)


def test_tests_are_chosen_by_their_names(admin: TestClient, project: dict[str, str]) -> None:
    report = run(admin, project, only=("FB_Sum_Test.Bad", "FB_Sum_Test.Worse"))
    (suite,) = report["suites"]
    assert {test["name"]: test["outcome"] for test in suite["tests"]} == {
        "Good": "skipped",
        "Bad": "failed",
        "Worse": "error",
    }


def test_errors_of_the_program_are_diagnostics(admin: TestClient, project: dict[str, str]) -> None:
    _add(admin, project["project"], project["suite"], "method", "Wrong", "METHOD Wrong", "TEST('x'); y := 1;")
    report = run(admin, project)
    assert not report["ok"]
    found = [(d["code"], d["part"], d["line"], d["column"]) for d in report["diagnostics"]]
    assert found == [("E0201", "implementation", 1, 12)]


def test_a_test_with_an_exception_leads_to_its_place(admin: TestClient, project: dict[str, str]) -> None:
    head = "FUNCTION_BLOCK FB_Kill_Test EXTENDS TcUnit.FB_TestSuite\nVAR\n    place : POINTER TO DINT;\n"
    head += "    nowhere : DINT;\nEND_VAR"
    body = "TEST('Kills');\nplace := ADR(nowhere);\n__DELETE(place);\nTEST_FINISHED();"
    suite_id = _add(admin, project["project"], project["application"], "pou", "FB_Kill_Test", head, body)
    report = run(admin, project)
    assert (report["problem"], report["diagnostics"]) == (None, [])
    killing = next(suite for suite in report["suites"] if suite["name"] == "FB_Kill_Test")
    (test,) = killing["tests"]
    (failure,) = test["failures"]
    assert (test["outcome"], failure["message"].split(" 16#")[0]) == ("error", "__DELETE of address")
    assert (failure["object_id"], failure["part"], failure["line"]) == (suite_id, "implementation", 3)
    assert (report["passed"], report["failed"], report["error"]) == (1, 1, 2)


def test_tests_that_do_not_run_cannot_be_cancelled(admin: TestClient, project: dict[str, str]) -> None:
    url = f"{PROJECTS}/{project['project']}/applications/{project['application']}/tests"
    assert admin.delete(url).status_code == 404


def last_run(client: TestClient, ids: dict[str, str]) -> dict[str, Any] | None:
    url = f"{PROJECTS}/{ids['project']}/applications/{ids['application']}/tests"
    answer = client.get(url)
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] | None = answer.json()
    return found


def test_the_last_run_is_kept(admin: TestClient, project: dict[str, str]) -> None:
    assert last_run(admin, project) is None
    report = run(admin, project)
    kept = last_run(admin, project)
    assert kept is not None
    revision = admin.get(f"{PROJECTS}/{project['project']}").json()["revision"]
    assert (kept["report"], kept["outdated"], kept["revision"]) == (report, False, revision)
    assert kept["username"] == "admin"


def test_the_last_run_is_outdated_once_what_it_tested_has_changed(
    admin: TestClient, project: dict[str, str]
) -> None:
    run(admin, project)
    url = f"{PROJECTS}/{project['project']}"
    admin.patch(url, json={"description": "no text of the program"}).raise_for_status()
    kept = last_run(admin, project)
    assert kept is not None
    assert not kept["outdated"]
    good = admin.get(f"{url}/objects/{project['Good']}").json()
    data = good["data"] | {"implementation": good["data"]["implementation"].replace("2, 1", "3, 1")}
    change = {"base_revision": good["revision"], "data": data}
    admin.put(f"{url}/objects/{project['Good']}", json=change).raise_for_status()
    kept = last_run(admin, project)
    assert kept is not None
    assert kept["outdated"]


def test_a_run_of_some_tests_keeps_the_results_of_the_others(
    admin: TestClient, project: dict[str, str]
) -> None:
    run(admin, project)
    run(admin, project, only=("FB_Sum_Test.Bad",))
    kept = last_run(admin, project)
    assert kept is not None
    (suite,) = kept["report"]["suites"]
    outcomes = {test["name"]: test["outcome"] for test in suite["tests"]}
    assert outcomes == {"Good": "passed", "Bad": "failed", "Worse": "error"}
    counts = {key: kept["report"][key] for key in ("total", "passed", "failed", "error", "skipped")}
    assert counts == {"total": 3, "passed": 1, "failed": 1, "error": 1, "skipped": 0}
    assert not kept["report"]["ok"]


def test_errors_of_the_program_replace_the_results(admin: TestClient, project: dict[str, str]) -> None:
    run(admin, project)
    _add(admin, project["project"], project["suite"], "method", "Wrong", "METHOD Wrong", "TEST('x'); y := 1;")
    report = run(admin, project, only=("FB_Sum_Test.Bad",))
    kept = last_run(admin, project)
    assert kept is not None
    assert (kept["report"], kept["report"]["suites"]) == (report, [])
