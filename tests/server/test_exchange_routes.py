"""Files of other systems over REST: as a new project, into a project, out again as PLCopen XML."""

from __future__ import annotations

import errno
import io
import json
import tempfile
import zipfile

import pytest
from fastapi.testclient import TestClient
from tests.project.archives import archive

from tappet.project.exchange.importing import ARCHIVES, importable

API = "/api/v1"
SOURCE = b"FUNCTION_BLOCK FB_Pump\nVAR_INPUT\n  bOn : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n"


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
        uploads = {"files": ("all.zip", archive(("Lib/Pump.st", SOURCE)))}
        answer = admin.post(f"{project}/import-files", files=uploads)
        assert answer.status_code == 200, answer.text
        objects = {item["name"]: item for item in admin.get(f"{project}/objects").json()}
        assert expected in objects
    application = objects["Application"]["id"]
    placed = admin.post(
        f"{project}/import-files",
        files={"files": ("..\\..\\x.st", b"VAR_GLOBAL\n  n : INT;\nEND_VAR")},
        data={"place": application},
    )
    assert placed.json()["report"]["entries"][0]["source"] == "x.st"
    refused = admin.post(
        f"{project}/import-files", files={"files": ("x.st", SOURCE)}, data={"place": "0" * 32}
    )
    assert refused.status_code == 404


def test_what_cannot_be_read_is_said_and_changes_nothing(admin: TestClient) -> None:
    uploads = {"files": ("x.xml", b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>')}
    answer = admin.post(f"{API}/projects/import-files", files=uploads)
    assert answer.status_code == 422
    assert answer.json()["detail"].startswith("x.xml:1: holds a document type declaration")
    empty = admin.post(f"{API}/projects/import-files", files={"files": ("x.zip", archive(("a", b"b")))})
    assert (empty.status_code, empty.json()["type"]) == (422, "urn:tappet:problem:folder-format")
    assert admin.get(f"{API}/projects").json() == []


def test_a_preview_shows_what_would_come_and_changes_nothing(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Shown"}).json()["id"]
    both = SOURCE + b"FUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n"
    upload = {"files": ("Pumps.st", both)}
    before = admin.get(f"{API}/projects/{project}/objects").json()
    shown = admin.post(f"{API}/projects/preview-files", files=upload, data={"project_id": project})
    assert shown.status_code == 200, shown.text
    nodes = {node["name"]: node for node in shown.json()["nodes"]}
    assert (nodes["FB_Pump"]["kind"], nodes["FB_Pump"]["subkind"]) == ("pou", "function_block")
    assert [e["outcome"] for e in shown.json()["report"]["entries"]] == ["imported", "imported"]
    assert admin.get(f"{API}/projects/{project}/objects").json() == before
    form = {"place": "pous", "chosen": json.dumps([nodes["FB_Valve"]["key"]])}
    done = admin.post(f"{API}/projects/{project}/import-files", files=upload, data=form)
    assert done.status_code == 200, done.text
    (entry,) = done.json()["report"]["entries"]
    objects = {item["id"]: item for item in admin.get(f"{API}/projects/{project}/objects").json()}
    assert (objects[entry["object_id"]]["name"], objects[entry["object_id"]]["parent_id"]) == (
        "FB_Valve",
        None,
    )
    assert "FB_Pump" not in {item["name"] for item in objects.values()}
    made = admin.post(
        f"{API}/projects/import-files", files=upload, data={"chosen": json.dumps([nodes["FB_Pump"]["key"]])}
    ).json()["project"]["id"]
    names = {item["name"] for item in admin.get(f"{API}/projects/{made}/objects").json()}
    assert "FB_Pump" in names
    assert "FB_Valve" not in names
    wrong = admin.post(f"{API}/projects/{project}/import-files", files=upload, data={"chosen": "all"})
    assert wrong.status_code == 422


def test_parts_go_out_as_xml_st_and_archive(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Parts"}).json()["id"]
    upload = {"files": ("Pumps.st", SOURCE + b"TYPE E_State : (Idle, Busy); END_TYPE\n")}
    assert admin.post(f"{API}/projects/{project}/import-files", files=upload).status_code == 200
    ids = {item["name"]: item["id"] for item in admin.get(f"{API}/projects/{project}/objects").json()}
    export = f"{API}/projects/{project}/export"
    one = admin.get(f"{export}/st", params={"object": ids["FB_Pump"]})
    assert one.text.startswith("FUNCTION_BLOCK FB_Pump")
    assert "FB_Pump.st" in one.headers["content-disposition"]
    with zipfile.ZipFile(io.BytesIO(admin.get(f"{export}/st").content)) as packed:
        assert sorted(name.rpartition("/")[2] for name in packed.namelist()) == [
            "E_State.st",
            "FB_Pump.st",
            "PLC_PRG.st",
        ]
    xml = admin.get(f"{export}/plcopen", params={"object": ids["E_State"]}).content
    assert b"E_State" in xml
    assert b"FB_Pump" not in xml
    part = admin.get(export, params={"object": [ids["E_State"], ids["FB_Pump"]]}).content
    again = admin.post(f"{API}/projects/import-files", files={"files": ("part.zip", part)}).json()
    names = {item["name"] for item in admin.get(f"{API}/projects/{again['project']['id']}/objects").json()}
    assert {"E_State", "FB_Pump"} <= names
    assert "PLC_PRG" not in names
    assert admin.get(f"{export}/st", params={"object": "0" * 32}).status_code == 404
    rest = admin.get(f"{export}/st", params={"without": [ids["E_State"], ids["PLC_PRG"]]})
    assert rest.text.startswith("FUNCTION_BLOCK FB_Pump")
    without = {"object": ids["Application"], "without": ids["FB_Pump"]}
    assert b"FB_Pump" not in admin.get(f"{export}/plcopen", params=without).content
    with zipfile.ZipFile(io.BytesIO(admin.get(export, params=without).content)) as packed:
        stems = {name.rpartition("/")[2].partition(".")[0] for name in packed.namelist()}
        assert "E_State" in stems
        assert "FB_Pump" not in stems


def test_what_is_taken_of_a_folder_is_what_is_taken_of_an_archive(admin: TestClient) -> None:
    formats = admin.get(f"{API}/import-formats").json()
    assert {".st", ".iecst", ".tctleo", ".export", ".tsproj", ".zip", ".tpzip"} <= set(formats["endings"])
    assert formats["project_file"] == "tappet-project.json"
    files = {f"Pumps/{number}{ending}": b"" for number, ending in enumerate(formats["endings"])}
    assert set(importable(files)) == {path for path in files if not path.endswith(ARCHIVES)}
    packed = archive(("Pumps.iecst", SOURCE), ("Pumps.png", b""))
    answer = admin.post(f"{API}/projects/import-files", files={"files": ("Pumps.zip", packed)})
    assert answer.status_code == 201, answer.text
    assert [entry["object"] for entry in answer.json()["report"]["entries"]][:1] == ["FB_Pump"]


def test_an_upload_without_room_for_it_says_so(admin: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(tempfile.SpooledTemporaryFile, "rollover", full)
    answer = admin.post(f"{API}/projects/preview-files", files={"files": ("x.st", b"// x\n" * 1_000_000)})
    assert (answer.status_code, answer.json()["type"]) == (507, "urn:tappet:problem:disk-full")


def test_what_exists_is_overwritten_renamed_merged_or_skipped_as_one_change(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Known"}).json()["id"]
    at = f"{API}/projects/{project}"
    assert admin.post(f"{at}/import-files", files={"files": ("a.st", SOURCE)}).status_code == 200
    pump = next(item for item in admin.get(f"{at}/objects").json() if item["name"] == "FB_Pump")
    changed = {"files": ("a.st", SOURCE.replace(b"bOn : BOOL;", b"bOn : BOOL;\n  nMore : INT;"))}
    nodes = admin.post(f"{API}/projects/preview-files", files=changed, data={"project_id": project}).json()[
        "nodes"
    ]
    assert nodes[0]["existing"]["object_id"] == pump["id"]
    compared = admin.post(f"{at}/compare-import", files=changed, data={"key": nodes[0]["key"]})
    assert compared.status_code == 200, compared.text
    assert "nMore" in compared.json()["texts"][0]["merged"]
    assert admin.post(f"{at}/compare-import", files=changed, data={"key": "x"}).status_code == 404

    def bring(**decisions: object) -> dict[str, str]:
        done = admin.post(f"{at}/import-files", files=changed, data={"existing": json.dumps(decisions)})
        assert done.status_code == 200, done.text
        return {entry["object"]: entry["outcome"] for entry in done.json()["report"]["entries"]}

    revision = admin.get(at).json()["revision"]
    assert bring(all="skip") == {"FB_Pump": "skipped"}
    assert bring(all="merge") == {"FB_Pump": "merged"}
    merged = admin.get(f"{at}/objects/{pump['id']}").json()
    assert "nMore" in merged["data"]["declaration"]
    assert bring(all="overwrite") == {"FB_Pump": "overwritten"}
    assert bring(objects={nodes[0]["key"]: {"act": "rename", "name": "FB_Other"}}) == {
        "FB_Pump": "changed",
        "FB_Other": "imported",
    }
    assert {"FB_Pump", "FB_Other"} <= {item["name"] for item in admin.get(f"{at}/objects").json()}
    back = admin.post(f"{at}/revert", json={"revision": revision})
    assert back.status_code == 200, back.text
    again = admin.get(f"{at}/objects/{pump['id']}").json()
    assert "nMore" not in again["data"]["declaration"]
    for wrong, status in (
        ("all", 422),
        ('{"all": "destroy"}', 422),
        (json.dumps({"objects": {nodes[0]["key"]: {"act": "rename", "name": "FB_Pump"}}}), 409),
    ):
        answer = admin.post(f"{at}/import-files", files=changed, data={"existing": wrong})
        assert answer.status_code == status, answer.text


def test_versions_with_a_common_past_are_joined_from_it(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Both"}).json()["id"]
    at = f"{API}/projects/{project}"
    program = next(item for item in admin.get(f"{at}/objects").json() if item["name"] == "PLC_PRG")

    def save(text: str) -> None:
        now = admin.get(f"{at}/objects/{program['id']}").json()
        body = {"base_revision": now["revision"], "data": now["data"] | {"implementation": text}}
        assert admin.put(f"{at}/objects/{program['id']}", json=body).status_code == 200

    save("a();\nb();\nc();\nd();")
    save("theirs();\nb();\nc();\nd();")
    away = admin.get(f"{at}/export").content
    save("a();\nb();\nc();\nd();")
    save("a();\nb();\nc();\nours();")
    # what went away was a state of the project: nothing was changed since on the other side
    done = admin.post(
        f"{at}/import-files",
        files={"files": ("p.zip", away)},
        data={"existing": json.dumps({"all": "merge"})},
    )
    assert done.status_code == 200, done.text
    now = admin.get(f"{at}/objects/{program['id']}").json()
    assert now["data"]["implementation"] == "a();\nb();\nc();\nours();"
    with zipfile.ZipFile(io.BytesIO(away)) as packed:
        files = {name: packed.read(name) for name in packed.namelist()}
    files = {
        name: text.replace(b"theirs();", b"a();").replace(b"b();", b"b(2);") for name, text in files.items()
    }
    done = admin.post(
        f"{at}/import-files",
        files={"files": ("p.zip", archive(*files.items()))},
        data={"existing": json.dumps({"all": "merge"})},
    )
    assert done.status_code == 200, done.text
    now = admin.get(f"{at}/objects/{program['id']}").json()
    assert now["data"]["implementation"] == "a();\nb(2);\nc();\nours();"
