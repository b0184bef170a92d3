"""Recipes over REST: read, write with limits, compare, import and export; rights and the audit log."""

from __future__ import annotations

from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient

API = "/api/v1"
PATHS = ("PLC_PRG.bStart", "PLC_PRG.nCount", "PLC_PRG.rSpeed", "PLC_PRG.sName", "PLC_PRG.eMode")
VALUES = dict(zip(PATHS, ("TRUE", "500", "1.5", "'a$'b'", "E_Mode.On"), strict=True))


class Kitchen:
    """A project with the definition Bread, and requests about it."""

    def __init__(self, admin: TestClient, runtime_id: str) -> None:
        self.admin = admin
        self.project = admin.post(f"{API}/projects", json={"name": "Bakery"}).json()["id"]
        objects = admin.get(f"{API}/projects/{self.project}/objects").json()
        application = next(item["id"] for item in objects if item["kind"] == "application")
        manager = self.add("recipe_manager", "Recipe Manager", application)
        rows: list[dict[str, Any]] = [{"path": path} for path in PATHS]
        rows[1] |= {"minimum": "-10", "maximum": "100"}
        recipes = [{"name": "Light", "values": VALUES}, {"name": "Dark", "values": {"PLC_PRG.nCount": "-3"}}]
        self.definition = self.add(
            "recipe_definition", "Bread", manager, {"variables": rows, "recipes": recipes}
        )
        self.runtime = f"{API}/runtimes/{runtime_id}/recipes"
        self.files = f"{API}/projects/{self.project}/recipes/{self.definition}"

    def add(self, kind: str, name: str, parent: str, data: Any = None) -> str:
        body = {"kind": kind, "name": name, "parent_id": parent, "data": data}
        made = self.admin.post(f"{API}/projects/{self.project}/objects", json=body)
        assert made.status_code == 201, made.text
        return str(made.json()["id"])

    def order(self, recipe: str | None = None, **more: Any) -> dict[str, Any]:
        named = {} if recipe is None else {"recipe": recipe}
        return {"project_id": self.project, "definition_id": self.definition, **named, **more}

    def present(self, path: str) -> str:
        at = self.runtime.replace("/recipes", "/values/read")
        (value,) = self.admin.post(at, json={"expressions": [path]}).json()["values"]
        return str(value["literal"])

    def values(self, recipe: str) -> dict[str, str]:
        data = self.admin.get(f"{API}/projects/{self.project}/objects/{self.definition}").json()["data"]
        (found,) = (one["values"] for one in data["recipes"] if one["name"] == recipe)
        return dict(found)


@pytest.fixture
def kitchen(admin: TestClient, runtime_id: str) -> Kitchen:
    return Kitchen(admin, runtime_id)


def test_a_recipe_is_written_within_its_limits(admin: TestClient, kitchen: Kitchen, plc: FakePlc) -> None:
    answer = admin.post(f"{kitchen.runtime}/write", json=kitchen.order("light"))
    assert answer.status_code == 200, answer.text
    written = answer.json()
    assert [value["literal"] for value in written["values"]] == ["TRUE", "100", "1.5", "'a$'b'", "On"]
    assert written["limited"] == ["PLC_PRG.nCount"]
    rows = [(r["action"], r["subject"], r["new_value"]) for r in admin.get(f"{API}/audit").json()]
    assert ("recipe-written", "Bread: Light", None) in rows
    assert ("write", "PLC_PRG.nCount", "100") in rows
    assert admin.post(f"{kitchen.runtime}/write", json=kitchen.order("Dark")).json()["limited"] == []
    assert kitchen.present("PLC_PRG.nCount") == "-3"


def test_a_wrong_value_writes_nothing(admin: TestClient, kitchen: Kitchen, plc: FakePlc) -> None:
    text = "PLC_PRG.bStart:=TRUE\nPLC_PRG.nCount:=TRUE\n"
    assert admin.put(f"{kitchen.files}/Bad/file", json={"text": text}).status_code == 200
    answer = admin.post(f"{kitchen.runtime}/write", json=kitchen.order("Bad"))
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["location"] == "PLC_PRG.nCount"
    assert kitchen.present("PLC_PRG.bStart") == "FALSE"


def test_present_values_are_read_into_a_recipe(admin: TestClient, kitchen: Kitchen, plc: FakePlc) -> None:
    plc.set("PLC_PRG.nCount", 42)
    plc.set("PLC_PRG.eMode", 1)
    for name in ("Dark", "New"):
        answer = admin.post(f"{kitchen.runtime}/read", json=kitchen.order(name))
        assert answer.status_code == 200, answer.text
        want = dict(zip(PATHS, ("FALSE", "42", "0.0", "''", "E_Mode.On"), strict=True))
        assert kitchen.values(name) == want
    assert kitchen.values("Light") == VALUES


def test_recipes_beside_the_controller(admin: TestClient, kitchen: Kitchen, plc: FakePlc) -> None:
    plc.set("PLC_PRG.nCount", -3)
    plc.set("PLC_PRG.bStart", True)
    rows = admin.post(f"{kitchen.runtime}/compare", json=kitchen.order()).json()["values"]
    assert [(row["path"], row["present"], row["differing"]) for row in rows] == [
        ("PLC_PRG.bStart", "TRUE", []),
        ("PLC_PRG.nCount", "-3", ["Light"]),
        ("PLC_PRG.rSpeed", "0.0", ["Light"]),
        ("PLC_PRG.sName", "''", ["Light"]),
        ("PLC_PRG.eMode", "Off", ["Light"]),
    ]
    assert [row["type"] for row in rows][:2] == ["BOOL", "INT"]


def test_files(admin: TestClient, kitchen: Kitchen) -> None:
    answer = admin.get(f"{kitchen.files}/Light/file")
    assert answer.text.splitlines() == [f"{path}:={value}" for path, value in VALUES.items()]
    assert "Light.Bread.txtrecipe" in answer.headers["content-disposition"]
    text = "plc_prg.ncount:=9\nPLC_PRG.nOther:=1\n"
    parsed = admin.post(f"{kitchen.files}/file", json={"text": text}).json()
    assert parsed["values"] == {"PLC_PRG.nCount": "9"}
    assert parsed["unknown"] == ["PLC_PRG.nOther"]
    assert len(parsed["missing"]) == 4
    assert admin.put(f"{kitchen.files}/Light/file", json={"text": text}).status_code == 200
    assert kitchen.values("Light") == VALUES | {"PLC_PRG.nCount": "9"}
    wrong = admin.put(f"{kitchen.files}/Light/file", json={"text": "\nPLC_PRG.nCount 5"})
    assert wrong.status_code == 422
    assert wrong.json()["detail"].startswith("line 2: there are 1 of 2 columns")


def test_what_is_not_there(admin: TestClient, kitchen: Kitchen, plc: FakePlc) -> None:
    missing = admin.post(f"{kitchen.runtime}/write", json=kitchen.order("None"))
    assert (missing.status_code, missing.json()["type"]) == (404, "urn:tappet:problem:no-such-recipe")
    objects = admin.get(f"{API}/projects/{kitchen.project}/objects").json()
    program = next(item["id"] for item in objects if item["kind"] == "pou")
    no = admin.post(f"{kitchen.runtime}/write", json=kitchen.order("Light", definition_id=program))
    assert (no.status_code, no.json()["type"]) == (404, "urn:tappet:problem:no-recipe-definition")
    assert admin.put(f"{kitchen.files}/Empty/file", json={"text": ""}).status_code == 200
    empty = admin.post(f"{kitchen.runtime}/write", json=kitchen.order("Empty"))
    assert (empty.status_code, empty.json()["type"]) == (422, "urn:tappet:problem:empty-recipe")
    at = f"{API}/projects/{kitchen.project}/objects/{kitchen.definition}"
    item = admin.get(at).json()
    item["data"]["variables"].append({"path": "PLC_PRG.nNone"})
    body = {"base_revision": item["revision"], "data": item["data"]}
    assert admin.put(at, json=body).status_code == 200
    bad = admin.post(f"{kitchen.runtime}/read", json=kitchen.order("Light"))
    assert bad.status_code == 422
    assert "PLC_PRG.nNone" in bad.json()["detail"]


def test_operators_write_and_engineers_change(
    admin: TestClient, kitchen: Kitchen, as_role: dict[str, TestClient], plc: FakePlc
) -> None:
    assert as_role["viewer"].post(f"{kitchen.runtime}/write", json=kitchen.order("Light")).status_code == 403
    assert (
        as_role["operator"].post(f"{kitchen.runtime}/write", json=kitchen.order("Light")).status_code == 200
    )
    assert as_role["operator"].post(f"{kitchen.runtime}/read", json=kitchen.order("Light")).status_code == 403
    assert as_role["viewer"].post(f"{kitchen.runtime}/compare", json=kitchen.order()).status_code == 200
    assert as_role["viewer"].put(f"{kitchen.files}/Light/file", json={"text": ""}).status_code == 403


def test_variables_that_a_recipe_can_have(admin: TestClient, kitchen: Kitchen) -> None:
    objects = admin.get(f"{API}/projects/{kitchen.project}/objects").json()
    program = next(item for item in objects if item["kind"] == "pou")
    application = next(item["id"] for item in objects if item["kind"] == "application")
    modes = {"declaration": "TYPE E_Mode : (Off, On); END_TYPE"}
    kitchen.add("dut", "E_Mode", application, modes)
    text = """PROGRAM PLC_PRG
VAR
    bStart : BOOL; nCount : INT; rSpeed : LREAL; sName : STRING(10); eMode : E_Mode;
    fbDelay : TON; aStep : ARRAY[1..2] OF INT; pAny : POINTER TO INT;
END_VAR
VAR CONSTANT cLimit : INT := 5; END_VAR"""
    body = {
        "base_revision": program["revision"],
        "data": {"declaration": text, "implementation": "fbDelay();"},
    }
    saved = admin.put(f"{API}/projects/{kitchen.project}/objects/{program['id']}", json=body)
    assert saved.status_code == 200, saved.text
    answer = admin.get(f"{kitchen.files}/variables")
    assert answer.status_code == 200, answer.text
    paths = {row["path"]: row["type"] for row in answer.json()["found"]}
    assert {
        "PLC_PRG.fbDelay.PT": "TIME",
        "PLC_PRG.aStep[2]": "INT",
        "PLC_PRG.rSpeed": "LREAL",
    }.items() <= paths.items()
    assert not {"PLC_PRG.pAny", "PLC_PRG.cLimit", "PLC_PRG.aStep", "PLC_PRG.fbDelay"} & set(paths)
    assert answer.json()["types"]["PLC_PRG.sName"] == "STRING(10)"
    some = admin.get(f"{kitchen.files}/variables", params={"query": "plc STEP"}).json()
    assert [row["path"] for row in some["found"]] == ["PLC_PRG.aStep[1]", "PLC_PRG.aStep[2]"]
    assert [row["path"] for row in some["wholes"]] == ["PLC_PRG.aStep"]
    assert some["more"] is False
    for whole, members in (("PLC_PRG.fbDelay", ["ET", "IN", "PT", "Q"]), ("PLC_PRG.aStep", None)):
        below = admin.get(f"{kitchen.files}/variables", params={"below": whole}).json()["found"]
        names = sorted(row["path"].removeprefix(f"{whole}.") for row in below)
        expected = members or ["PLC_PRG.aStep[1]", "PLC_PRG.aStep[2]"]
        assert [name for name in names if name in expected] == expected
    assert admin.get(f"{kitchen.files}/variables", params={"below": "PLC_PRG.none"}).json()["found"] == []
    at = f"{API}/projects/{kitchen.project}/objects/{program['id']}"
    body = {"base_revision": saved.json()["revision"], "data": body["data"] | {"implementation": "wrong"}}
    assert admin.put(at, json=body).status_code == 200
    refused = admin.get(f"{kitchen.files}/variables")
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:tappet:problem:build-errors")
