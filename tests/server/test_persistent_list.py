"""Add All Instance Paths: the list of persistent variables names those of programs and blocks (PERS-07)."""

from __future__ import annotations

from typing import Any

from fastapi.testclient import TestClient

from tappet.server.persistent.service import with_paths

API = "/api/v1"
BLOCK = """FUNCTION_BLOCK FB_Motor
VAR PERSISTENT RETAIN nHours : UDINT; END_VAR
VAR n : INT; END_VAR"""
PROGRAM = """PROGRAM PLC_PRG
VAR fbLeft, fbRight : FB_Motor; aMotors : ARRAY[1..2] OF FB_Motor; END_VAR
VAR PERSISTENT sName : STRING(20); END_VAR"""
LIST = """VAR_GLOBAL PERSISTENT RETAIN
    nPieces : UDINT; // PLC_PRG.sName : STRING(20);
    plc_prg.fbleft.nHours : UDINT;
END_VAR"""


def test_paths_of_instances_are_added_behind_what_is_there(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Hours"}).json()["id"]
    at = f"{API}/projects/{project}/objects"
    objects = admin.get(at).json()
    application = next(item["id"] for item in objects if item["kind"] == "application")

    def add(kind: str, name: str, **data: Any) -> dict[str, Any]:
        body = {"kind": kind, "name": name, "parent_id": application, "data": data or None}
        answer = admin.post(at, json=body)
        assert answer.status_code == 201, answer.text
        return dict(answer.json())

    add("pou", "FB_Motor", declaration=BLOCK)
    program = next(item for item in objects if item["kind"] == "pou")
    body = {
        "base_revision": program["revision"],
        "data": {"declaration": PROGRAM, "implementation": "fbLeft();"},
    }
    assert admin.put(f"{at}/{program['id']}", json=body).status_code == 200
    persistent = add("persistent", "Kept", declaration=LIST)
    answer = admin.post(f"{at}/{persistent['id']}/instance-paths")
    assert answer.status_code == 200, answer.text
    added = (
        "    // Instance paths\n    PLC_PRG.fbRight.nHours : UDINT;\n    PLC_PRG.sName : STRING(20);\nEND_VAR"
    )
    assert answer.json()["data"]["declaration"] == LIST.replace("END_VAR", added)
    again = admin.post(f"{at}/{persistent['id']}/instance-paths").json()
    assert again["revision"] == answer.json()["revision"], "there is nothing more to add"
    build = admin.post(f"{API}/projects/{project}/applications/{application}/build").json()
    assert [d for d in build["diagnostics"] if d["severity"] == "error"] == []
    refused = admin.post(f"{at}/{program['id']}/instance-paths")
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:no-persistent-list")


def test_where_the_paths_are_put() -> None:
    paths = [("P.a", "INT")]
    row = "    // Instance paths\n    P.a : INT;\n"
    assert with_paths("VAR_GLOBAL PERSISTENT\nEND_VAR", paths) == f"VAR_GLOBAL PERSISTENT\n{row}END_VAR"
    assert with_paths("VAR_GLOBAL PERSISTENT x : INT; end_var", paths) == (
        f"VAR_GLOBAL PERSISTENT x : INT; \n{row}end_var"
    )
    assert with_paths("", paths) == f"VAR_GLOBAL PERSISTENT RETAIN\n{row}END_VAR"
    assert with_paths(with_paths("VAR_GLOBAL\nEND_VAR", paths), [("P.b", "INT")]) == (
        f"VAR_GLOBAL\n{row}    P.b : INT;\nEND_VAR"
    )
