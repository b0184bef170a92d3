"""Coding rules of an application: chosen in its data, run with each build or on demand."""

from __future__ import annotations

from typing import Any

from fastapi.testclient import TestClient

PROJECTS = "/api/v1/projects"


def _application(client: TestClient) -> tuple[str, str]:
    """URLs of the objects and of the application of a project whose PLC_PRG has a number without a name."""
    project = client.post(PROJECTS, json={"name": "Rules"}).json()["id"]
    objects = f"{PROJECTS}/{project}/objects"
    found = {item["kind"]: item for item in client.get(objects).json()}
    data = {"declaration": "PROGRAM PLC_PRG\nVAR\n    n : INT;\nEND_VAR", "implementation": "n := 4711;"}
    program = f"{objects}/{found['pou']['id']}"
    assert client.put(program, json={"base_revision": 1, "data": data}).status_code == 200
    return f"{objects}/{found['application']['id']}", (
        f"{PROJECTS}/{project}/applications/{found['application']['id']}"
    )


def _choose(client: TestClient, url: str, chosen: dict[str, Any]) -> None:
    revision = client.get(url).json()["revision"]
    body = {"base_revision": revision, "data": {"static_analysis": chosen}}
    saved = client.put(url, json=body)
    assert saved.status_code == 200, saved.text


def _found(report: dict[str, Any]) -> list[tuple[str, str]]:
    return [(d["code"], d["severity"]) for d in report["diagnostics"] if d["code"].startswith("S")]


def test_rules_with_their_settings(admin: TestClient) -> None:
    rules = {rule["code"]: rule for rule in admin.get("/api/v1/static-analysis/rules").json()}
    assert len(rules) > 50
    assert rules["S1001"]["prefixes"]["FUNCTION_BLOCK"] == "FB_"
    assert rules["S1301"]["limits"] == {"nesting": 4}
    assert rules["S1211"]["prefixes"] == rules["S1211"]["limits"] == {}
    assert rules["S1244"]["numbers"] == ["SA0041"]


def test_rules_are_described_in_the_language_of_the_reader(admin: TestClient) -> None:
    url = "/api/v1/static-analysis/rules"
    english, chinese = (
        {rule["code"]: rule["message"] for rule in admin.get(url, params={"language": language}).json()}
        for language in ("en", "zh")
    )
    assert set(english) == set(chinese)
    assert not [code for code, text in chinese.items() if text.isascii()]
    assert english["S1208"] == "The number of turns of a WHILE loop is not bounded"
    assert admin.get(url, params={"language": "xx"}).status_code == 422


def test_rules_run_with_the_build_or_on_demand(admin: TestClient) -> None:
    item, application = _application(admin)
    assert _found(admin.post(f"{application}/build").json()) == []
    _choose(admin, item, {"rules": {"S1211": "warning", "S1006": "warning"}, "limits": {"shortest_name": 1}})
    built = admin.post(f"{application}/build").json()
    assert (built["ok"], _found(built)) == (True, [("S1211", "warning")])
    _choose(admin, item, {"rules": {"S1211": "error"}})
    built = admin.post(f"{application}/build").json()
    assert (built["ok"], _found(built)) == (False, [("S1211", "error")])
    _choose(admin, item, {"rules": {"S1211": "error"}, "with_build": False})
    built = admin.post(f"{application}/build").json()
    assert (built["ok"], _found(built)) == (True, [])
    checked = admin.post(f"{application}/static-analysis").json()
    assert (checked["ok"], _found(checked)) == (False, [("S1211", "error")])
    place = next(d for d in checked["diagnostics"] if d["code"] == "S1211")
    assert (place["part"], place["line"]) == ("implementation", 1)


def test_wrong_choices_are_refused(admin: TestClient) -> None:
    item, _ = _application(admin)
    for chosen in (
        {"rules": {"W1001": "error"}},
        {"rules": {"S1211": "fatal"}},
        {"prefixes": {"BOOL": "a b"}},
    ):
        body = {"base_revision": 1, "data": {"static_analysis": chosen}}
        assert admin.put(item, json=body).status_code == 422


def test_an_object_is_excluded_from_the_build(admin: TestClient) -> None:
    item, application = _application(admin)
    objects = item.rpartition("/")[0]
    logic = admin.get(item).json()
    body = {
        "parent_id": logic["id"],
        "kind": "pou",
        "name": "Old",
        "data": {"declaration": "FUNCTION Old : INT", "implementation": "Old := gone;"},
    }
    old = admin.post(objects, json=body).json()
    assert not admin.post(f"{application}/build").json()["ok"]
    url = f"{objects}/{old['id']}"
    assert admin.patch(url, json={"excluded": True}).json()["excluded"] is True
    assert {o["name"]: o["excluded"] for o in admin.get(objects).json()}["Old"] is True
    assert admin.post(f"{application}/build").json()["ok"]
    edited = {"declaration": "FUNCTION Old : INT", "implementation": "Old := 1;"}
    kept = admin.put(url, json={"base_revision": 1, "data": edited})
    assert (kept.status_code, kept.json()["excluded"]) == (200, True), "an editor that knew nothing of it"
    assert admin.patch(url, json={"excluded": False}).json()["excluded"] is False
    assert "exclude_from_build" not in admin.get(url).json()["data"]
    refused = admin.patch(item, json={"excluded": True})
    assert (refused.status_code, "not compiled" in refused.json()["detail"]) == (422, True)


def test_single_warnings_of_the_compiler_are_switched_off(admin: TestClient) -> None:
    item, application = _application(admin)
    program = {o["kind"]: o for o in admin.get(item.rpartition("/")[0]).json()}["pou"]["id"]
    url = f"{item.rpartition('/')[0]}/{program}"
    declaration = "PROGRAM PLC_PRG\nVAR\n    a, b : REAL;\n    x : BOOL;\nEND_VAR"

    def write(body: str) -> None:
        data = {"declaration": declaration, "implementation": body}
        base = admin.get(url).json()["revision"]
        assert admin.put(url, json={"base_revision": base, "data": data}).status_code == 200

    def choose(codes: list[str]) -> dict[str, Any]:
        data = admin.get(item).json()
        body = {"base_revision": data["revision"], "data": {**data["data"], "disabled_warnings": codes}}
        saved = admin.put(item, json=body)
        assert saved.status_code == 200, saved.text
        return dict(saved.json()["data"])

    def codes() -> set[str]:
        return {d["code"] for d in admin.post(f"{application}/build").json()["diagnostics"]}

    write("x := a = b;")
    assert "W1122" in codes()
    assert choose(["W1122", "W1001", "W1122"])["disabled_warnings"] == ["W1001", "W1122"]
    assert "W1122" not in codes()
    write("x := a = b; nope := 1;")
    assert codes() == {"E0201"}
    choose([])
    assert {"W1122", "E0201"} <= codes()
    listed = {one["code"]: one for one in admin.get("/api/v1/compiler-warnings").json()}
    assert (listed["W1122"]["severity"], "SA0054" in listed["W1122"]["numbers"]) == ("warning", True)
    assert not [code for code in listed if not code.startswith("W")]


def test_only_warnings_of_the_compiler_can_be_switched_off(admin: TestClient) -> None:
    item, _ = _application(admin)
    for code in ("E0201", "S1211", "W1", "w1122"):
        body = {"base_revision": 1, "data": {"disabled_warnings": [code]}}
        assert admin.put(item, json=body).status_code == 422, code
