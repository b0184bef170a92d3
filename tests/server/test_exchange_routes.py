"""Files of other systems over REST: as a new project, into a project, out again as PLCopen XML."""

from __future__ import annotations

import io
import zipfile

from fastapi.testclient import TestClient

API = "/api/v1"
SOURCE = b"FUNCTION_BLOCK FB_Pump\nVAR_INPUT\n  bOn : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n"


def archive(**files: bytes) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as target:
        for name, content in files.items():
            target.writestr(name.replace("__", "/").replace("_dot_", "."), content)
    return packed.getvalue()


def test_files_become_a_project_and_go_out_as_plcopen_xml(admin: TestClient) -> None:
    uploads = [("files", ("Pumps.st", SOURCE)), ("files", ("bad.xml", b"<project"))]
    answer = admin.post(f"{API}/projects/import-files", files=uploads, data={"name": "Pumps"})
    assert answer.status_code == 201, answer.text
    body = answer.json()
    assert body["project"]["name"] == "Pumps"
    found = {(entry["object"], entry["outcome"], entry["source"]) for entry in body["report"]["entries"]}
    assert ("FB_Pump", "imported", "Pumps.st") in found
    assert ("", "refused", "bad.xml") in found
    project = f"{API}/projects/{body['project']['id']}"
    exported = admin.get(f"{project}/export/plcopen")
    assert exported.headers["content-type"].startswith("application/xml")
    assert b'<pou name="FB_Pump" pouType="functionBlock">' in exported.content
    again = admin.post(f"{API}/projects/import-files", files={"files": ("x.xml", exported.content)})
    assert again.json()["project"]["name"] == "Pumps_1"


def test_files_go_into_a_project_and_overwrite_nothing(admin: TestClient) -> None:
    project = f"{API}/projects/{admin.post(f'{API}/projects', json={'name': 'Press'}).json()['id']}"
    for expected in ("FB_Pump", "FB_Pump_1"):
        uploads = {"files": ("all.zip", archive(Lib__Pump_dot_st=SOURCE))}
        answer = admin.post(f"{project}/import-files", files=uploads)
        assert answer.status_code == 200, answer.text
        objects = {item["name"]: item for item in admin.get(f"{project}/objects").json()}
        assert expected in objects
    application = objects["Application"]["id"]
    placed = admin.post(
        f"{project}/import-files",
        files={"files": ("..\\..\\x.st", b"VAR_GLOBAL\n  n : INT;\nEND_VAR")},
        data={"application_id": application},
    )
    assert placed.json()["report"]["entries"][0]["source"] == "x.st"
    refused = admin.post(
        f"{project}/import-files", files={"files": ("x.st", SOURCE)}, data={"application_id": "0" * 32}
    )
    assert refused.status_code == 404


def test_what_cannot_be_read_is_said_and_changes_nothing(admin: TestClient) -> None:
    uploads = {"files": ("x.xml", b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>')}
    answer = admin.post(f"{API}/projects/import-files", files=uploads)
    assert answer.status_code == 422
    assert answer.json()["detail"].startswith("x.xml:1: holds a document type declaration")
    empty = admin.post(f"{API}/projects/import-files", files={"files": ("x.zip", archive(a=b"b"))})
    assert (empty.status_code, empty.json()["type"]) == (422, "urn:tappet:problem:folder-format")
    assert admin.get(f"{API}/projects").json() == []
