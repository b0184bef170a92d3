"""Reading, writing and forcing by name."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from fake_plc import FakePlc, symbol_map
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st

from tappet.server.values.service import json_value, suggest, try_resolve

BASE = "/api/v1/runtimes/"


@pytest.fixture
def url(admin: TestClient, runtime_id: str) -> str:
    return BASE + runtime_id


def _read(admin: TestClient, url: str, *expressions: str) -> list[dict]:
    answer = admin.post(f"{url}/values/read", json={"expressions": list(expressions)})
    assert answer.status_code == 200, answer.text
    return answer.json()["values"]


def _write(admin: TestClient, url: str, values: dict, verb: str = "write"):
    body = {"values": [{"expression": e, "value": v} for e, v in values.items()]}
    return admin.post(f"{url}/values/{verb}", json=body)


def test_values_of_all_kinds_read_as_json_and_literal(admin: TestClient, url: str, plc: FakePlc) -> None:
    plc.set("PLC_PRG.bStart", True)
    plc.set("PLC_PRG.nCount", -7)
    plc.set("PLC_PRG.rSpeed", 1.5)
    plc.set("PLC_PRG.tDelay", 1500)
    plc.set("PLC_PRG.sName", "abc")
    plc.set("PLC_PRG.eMode", 1)
    plc.set("PLC_PRG.aValue", [1, 2, 3])
    names = ["bStart", "nCount", "rSpeed", "tDelay", "sName", "eMode", "aValue", "aValue[2]", "nCount.0"]
    values = _read(admin, url, *(f"plc_prg.{name}" for name in names))
    assert [v["value"] for v in values] == [True, -7, 1.5, 1500, "abc", 1, [1, 2, 3], 2, True]
    assert [v["literal"] for v in values] == [
        "TRUE", "-7", "1.5", "T#1s500ms", "'abc'", "On", "[1, 2, 3]", "2", "TRUE",
    ]  # fmt: skip
    assert values[0]["type"] == "BOOL"
    assert [v["kind"] for v in values] == [
        "bool", "int", "real", "time", "string", "enum", "array", "int", "bool",
    ]  # fmt: skip
    assert [v["size"] for v in values[:4]] == [1, 2, 8, 4]
    assert [v["base"] for v in values] == [None] * 5 + ["int"] + [None] * 3
    assert values[5]["enum"]["On"] == 1


def test_a_literal_is_in_the_number_format_of_its_variable(admin: TestClient, url: str, plc: FakePlc) -> None:
    """LPRG-21."""
    plc.set("PLC_PRG.nMask", -2)
    (value,) = _read(admin, url, "PLC_PRG.nMask")
    assert (value["value"], value["literal"]) == (-2, "16#FFFE")


def test_unknown_expression_suggests_and_leaves_the_others(admin: TestClient, url: str) -> None:
    values = _read(admin, url, "PLC_PRG.nCout", "PLC_PRG.nCount", "PLC_PGR.nCount", "PLC_PRG.fbMotor.nSped")
    assert "Did you mean 'PLC_PRG.nCount'" in values[0]["error"]
    assert values[1]["error"] is None
    assert values[1]["value"] == 0
    assert "'PLC_PRG.nCount'" in values[2]["error"]
    assert "'PLC_PRG.fbMotor.nSpeed'" in values[3]["error"]


def test_not_a_number_is_null_with_a_literal(admin: TestClient, url: str, plc: FakePlc) -> None:
    plc.set("PLC_PRG.rSpeed", float("nan"))
    value = _read(admin, url, "PLC_PRG.rSpeed")[0]
    assert (value["value"], value["literal"]) == (None, "NaN")


@pytest.mark.parametrize(
    ("name", "value", "stored"),
    [
        ("bStart", True, True),
        ("bStart", "TRUE", True),
        ("nCount", "16#FF", 255),
        ("tDelay", "T#2s", 2000),
        ("eMode", "On", 1),
        ("sName", "'it$'s'", "it's"),
        ("rSpeed", 3, 3.0),
        ("nCount.3", True, True),
        ("aValue[3]", 9, 9),
    ],
)
def test_writes_take_json_and_literals(
    admin: TestClient, url: str, name: str, value: object, stored: object
) -> None:
    answer = _write(admin, url, {f"PLC_PRG.{name}": value})
    assert answer.status_code == 200, answer.text
    assert answer.json()["values"][0]["value"] == stored


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("nCount", 40000, "-32768..32767"),
        ("nLevel", 11, "0..10"),
        ("nCount", "many", "write for example"),
        ("bStart", "maybe", "TRUE or FALSE"),
        ("eMode", "Sideways", "Off, On"),
        ("nLimit", 1, "constant"),
        ("rOther", 1.0, "refers to another variable"),
        ("sName", "x" * 11, "longer than STRING(10)"),
        ("fbMotor", 1, "members one by one"),
        ("aValue", [1], "3 values"),
        ("nCuont", 1, "Did you mean 'PLC_PRG.nCount'"),
        ("bStart", {"a": 1}, "TRUE or FALSE"),
    ],
)
def test_wrong_values_say_what_is_right(
    admin: TestClient, url: str, plc: FakePlc, name: str, value: object, words: str
) -> None:
    before = bytes(plc.image)
    answer = _write(admin, url, {"PLC_PRG.bStart": True, f"PLC_PRG.{name}": value})
    assert answer.status_code == 422, answer.text
    assert words in answer.json()["errors"][-1]["message"]
    assert bytes(plc.image) == before, "all or none"


def test_writes_are_audited_with_old_and_new_value(admin: TestClient, url: str, plc: FakePlc) -> None:
    plc.set("PLC_PRG.nCount", 5)
    _write(admin, url, {"plc_prg.ncount": 6})
    entry = admin.get("/api/v1/audit").json()[0]
    assert entry["action"] == "write"
    assert (entry["subject"], entry["old_value"], entry["new_value"]) == ("PLC_PRG.nCount", "5", "6")
    assert entry["username"] == "admin"
    assert entry["runtime_id"]


def test_force_and_unforce(admin: TestClient, url: str, plc: FakePlc) -> None:
    answer = _write(admin, url, {"PLC_PRG.nCount": 3, "PLC_PRG.bStart": True, "%QX0.3": True}, "force")
    forced = {v["expression"]: v["literal"] for v in answer.json()["values"]}
    assert forced == {"PLC_PRG.nCount": "3", "PLC_PRG.bStart": "TRUE", "%QX0.3": "TRUE"}
    assert _read(admin, url, "PLC_PRG.nCount")[0]["forced"] is True
    assert _read(admin, url, "PLC_PRG.rSpeed")[0]["forced"] is False
    one = admin.post(f"{url}/values/unforce", json={"expressions": ["plc_prg.ncount"]}).json()["values"]
    assert {v["expression"] for v in one} == {"PLC_PRG.bStart", "%QX0.3"}
    assert admin.post(f"{url}/values/unforce", json={"expressions": None}).json()["values"] == []
    assert admin.get(f"{url}/forces").json()["values"] == []
    entries = [e for e in admin.get("/api/v1/audit").json() if e["action"] == "unforce"]
    assert {e["subject"] for e in entries} == {"PLC_PRG.nCount", "PLC_PRG.bStart", "%QX0.3"}


@pytest.mark.parametrize(
    ("agent", "program"),
    [
        ("curl/8.5.0", "curl/8.5.0"),
        ("line-supervisor/2.1 (shift 3) python-httpx/0.28", "line-supervisor/2.1"),
        ("Robot", "Robot"),
        ("<b>bold</b>", ""),
        ("x" * 300, ""),
        ("", ""),
    ],
)
def test_a_force_says_where_it_comes_from(
    admin: TestClient, as_role: dict[str, TestClient], url: str, plc: FakePlc, agent: str, program: str
) -> None:
    """WAT-08 and more: who, by what, from where, when, and what the variable held before."""
    begun = datetime.now(UTC)
    script = as_role["operator"]
    for client, path, value in ((script, "PLC_PRG.nCount", 77), (admin, "PLC_PRG.bStart", True)):
        order = {"values": [{"expression": path, "value": value}]}
        answer = client.post(f"{url}/values/force", json=order, headers={"User-Agent": agent})
        assert answer.status_code == 200, answer.text
    found = {v["expression"]: v for v in admin.get(f"{url}/forces").json()["values"]}
    (name,) = {v["user"] for v in found.values()}
    assert name in {e["username"] for e in admin.get("/api/v1/audit").json() if e["action"] == "force"}
    by_script, by_browser = found["PLC_PRG.nCount"], found["PLC_PRG.bStart"]
    assert (by_script["source"], by_script["program"]) == ("api", program)
    assert (by_browser["source"], by_browser["program"]) == ("workbench", "")
    assert (by_script["address"], by_browser["address"]) == ("testclient", "127.0.0.1")
    assert by_script["literal"] == "77"
    for value in found.values():
        assert begun <= datetime.fromisoformat(value["at"]) <= datetime.now(UTC)


def test_an_order_does_not_say_itself_where_it_comes_from(admin: TestClient, url: str) -> None:
    order = {"values": [{"expression": "PLC_PRG.nCount", "value": 1}], "source": "workbench"}
    assert admin.post(f"{url}/values/force", json=order).status_code == 422


def test_operators_write_and_viewers_do_not(
    app: FastAPI, admin: TestClient, url: str, as_role: dict[str, TestClient]
) -> None:
    assert _write(as_role["operator"], url, {"PLC_PRG.nCount": 1}).status_code == 200
    for verb in ("write", "force"):
        assert _write(as_role["viewer"], url, {"PLC_PRG.nCount": 1}, verb).status_code == 403
    assert _read(as_role["viewer"], url, "PLC_PRG.nCount")[0]["value"] == 1


def test_without_application_there_are_no_values(admin: TestClient, url: str, plc: FakePlc) -> None:
    admin.post(f"{url}/reset", json={"kind": "origin"})
    answer = admin.post(f"{url}/values/read", json={"expressions": ["a"]})
    assert answer.status_code == 409
    assert answer.json()["type"] == "urn:tappet:problem:no-application"


def test_symbols_browse(admin: TestClient, url: str) -> None:
    roots = admin.get(f"{url}/symbols").json()
    assert [(s["name"], s["leaf"]) for s in roots] == [("GVL", False), ("PLC_PRG", False)]
    inner = admin.get(f"{url}/symbols", params={"path": "plc_prg.fbmotor"}).json()
    assert [s["path"] for s in inner] == ["PLC_PRG.fbMotor.bRun", "PLC_PRG.fbMotor.nSpeed"]
    wrong = admin.get(f"{url}/symbols", params={"path": "PLC_PRG.fbMoter"})
    assert wrong.status_code == 404
    assert "'PLC_PRG.fbMotor'" in wrong.json()["detail"]


@given(st.text(max_size=40))
def test_strange_expressions_end_in_a_sentence(text: str) -> None:
    found = try_resolve(symbol_map(), text)
    assert not isinstance(found, str) or found.endswith((".", "?"))
    suggest(symbol_map(), text)


def test_json_has_no_infinities() -> None:
    assert json_value({"a": [float("inf"), 1.0], "b": float("nan")}) == {"a": [None, 1.0], "b": None}


@pytest.mark.parametrize("act", ["write", "force", "unforce"])
def test_nothing_is_done_to_an_application_that_the_server_does_not_know_yet(
    admin: TestClient, url: str, plc: FakePlc, act: str
) -> None:
    """Places of one application are other variables of the next one."""
    _write(admin, url, {"PLC_PRG.nCount": 5})
    plc.code_id = "code2"  # changed by somebody else a moment ago
    values = {"values": [{"expression": "PLC_PRG.nCount", "value": 7}]}
    body = {"expressions": ["PLC_PRG.nCount"]} if act == "unforce" else values
    answer = admin.post(f"{url}/values/{act}", json=body)
    assert answer.status_code == 409
    assert "the application was changed meanwhile; nothing was done, try again" in answer.json()["detail"]
    plc.code_id = "code1"
    assert _read(admin, url, "PLC_PRG.nCount")[0]["value"] == 5
    assert (plc.forced, admin.get("/api/v1/audit").json()[0]["result"]) == ({}, "refused")
