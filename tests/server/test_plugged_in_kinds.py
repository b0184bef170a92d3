"""Kinds of objects from an installed package, from the tree over files and exchange to a running program, and
without the package (CON-03). The package is the example of docs/extending.md."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from tests.plugins.installing import PLUGINS, installed

from tappet.project import edit, kind_registry
from tappet.project.data import UnknownData
from tappet.project.errors import InvalidDataError
from tappet.project.exchange.importing import import_files
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.folder import decode, encode, load, save, write_zip
from tappet.project.folder.archive import read_zip
from tappet.project.model import Project, ProjectObject, new_id
from tappet.project.new_project import new_project
from tappet.project.objects import make_object
from tappet.project.sources import application_sources, libraries
from tappet.server import openapi
from tappet.server.settings import ServerSettings

API = "/api/v1"
NOTE = {"about": "Counter", "text": "# Boxes\n\nTen pieces fill a box.\n"}
PROGRAM = """PROGRAM PLC_PRG
VAR
    fbCounter : Counter;
END_VAR"""


@pytest.fixture
def toy(tmp_path: Path) -> Iterator[list[str]]:
    with installed("toy_kinds", tmp_path / "site") as paths:
        yield paths


def counting() -> Project:
    """A project whose program counts pieces with a counter, and a note about it."""
    project = new_project("Boxes")
    (application,) = project.applications()
    project, _ = edit.add_object(project, application.id, "piece_counter", data={"box": 4})
    project, folder = edit.add_object(project, application.id, "folder", "Notes")
    project, _ = edit.add_object(project, folder.id, "machine_note", "How it counts", data=NOTE)
    (program,) = project.find_kind("pou")
    body = "fbCounter(bPiece := NOT fbCounter.bPiece);"
    return edit.change_data(project, program.id, {"declaration": PROGRAM, "implementation": body})


def one(project: Project, kind: str) -> ProjectObject:
    (found,) = project.find_kind(kind)
    return found


def content(project: Project) -> list[tuple[Any, ...]]:
    return [(i.id, i.parent_id, i.kind, i.name, i.index, i.data.model_dump()) for i in project.walk()]


def test_over_rest_from_the_rules_to_references_that_follow(admin: TestClient, toy: list[str]) -> None:
    rules = {rule["kind"]: rule for rule in admin.get(f"{API}/placement").json()}
    assert rules["machine_note"]["places"] == ["application.*", "application.*/"]
    assert rules["piece_counter"]["proposal"] == "Counter"
    project = f"{API}/projects/{admin.post(f'{API}/projects', json={'name': 'Boxes'}).json()['id']}"
    tree = {item["kind"]: item["id"] for item in admin.get(f"{project}/objects").json()}

    def add(parent: str, kind: str, **fields: Any) -> Any:
        return admin.post(f"{project}/objects", json={"parent_id": parent, "kind": kind, **fields})

    counter = add(tree["application"], "piece_counter").json()
    assert counter["name"] == "Counter"
    assert counter["data"] == {"box": 10}
    note = add(tree["application"], "machine_note", data=NOTE).json()
    assert note["name"] == "Note"
    assert "A note cannot be below" in add(tree["pou"], "machine_note").json()["detail"]
    assert "box: Input should be" in add(tree["application"], "piece_counter", data={"box": 0}).text
    renamed = admin.patch(f"{project}/objects/{counter['id']}", json={"name": "Pieces"})
    assert renamed.status_code == 200, renamed.text
    followed = admin.get(f"{project}/objects/{note['id']}").json()
    assert followed["data"] == {**NOTE, "about": "Pieces"}
    assert followed["revision"] == 2
    archive = admin.get(f"{project}/export").content
    with zipfile.ZipFile(io.BytesIO(archive)) as held:
        names = {name.rpartition("/")[2] for name in held.namelist()}
    assert {"Pieces.piece_counter.json", "Note.machine_note.json", "Note.md"} <= names
    again = admin.post(f"{API}/projects/import", files={"file": ("boxes.zip", archive)}).json()
    copy = read_zip(admin.get(f"{API}/projects/{again['id']}/export").content)
    assert content(copy) == content(read_zip(archive))


def test_folder_and_archive_are_stable(toy: list[str], tmp_path: Path) -> None:
    project = counting()
    files = encode(project)
    path = "Devices/Tappet Soft PLC/PLC Logic/Application/Notes/How it counts"
    assert files[f"{path}.md"].decode() == NOTE["text"]
    assert files[f"{path}.machine_note.json"] == b'{\n  "about": "Counter"\n}\n'
    assert content(decode(files).project) == content(project)
    assert encode(decode(files).project) == files
    save(project, tmp_path / "folder")
    assert content(load(tmp_path / "folder")) == content(project)
    other = edit.rename_object(project, one(project, "machine_note").id, "Counting")
    save(other, tmp_path / "folder")
    assert not (tmp_path / "folder" / f"{path}.md").exists()
    assert load(tmp_path / "folder") == other
    assert write_zip(read_zip(write_zip(project))) == write_zip(project)


def test_plcopen_export_and_import(toy: list[str]) -> None:
    project = counting()
    exported = write_plcopen(project)
    imported = import_files({"boxes.xml": exported}).project
    assert content(imported) == content(project)
    assert write_plcopen(imported) == exported
    into, report = (lambda done: (done.project, done.report))(
        import_files({"boxes.xml": exported}, into=project)
    )
    assert [item.name for item in into.find_kind("piece_counter")] == ["Counter", "Counter_1"]
    assert ("imported", "Counter_1") in {(entry.outcome, entry.object) for entry in report.entries}


def test_the_compiler_gets_the_text_and_the_library(toy: list[str]) -> None:
    project = counting()
    (application,) = project.applications()
    counter = one(project, "piece_counter")
    text = next(text for text in application_sources(project, application.id) if text.uri == "Counter")
    assert text.map.segment_at(0).object_id == counter.id
    assert "nPieces / 4" in text.text
    assert [reference.name for reference in libraries(project, application.id)] == ["Standard"]
    alone = edit.delete_object(project, one(project, "library_manager").id)
    (needed,) = libraries(alone, application.id)
    assert (needed.name, needed.place) == ("Standard", alone.path_of(counter.id))
    left_out = edit.exclude_object(project, counter.id, True)
    assert "Counter" not in [text.uri for text in application_sources(left_out, application.id)]


def test_it_builds_and_runs(toy: list[str], tmp_path: Path) -> None:
    save(counting(), tmp_path / "boxes")
    done = subprocess.run(
        [
            *(sys.executable, "-m", "tappet", "run", str(tmp_path / "boxes"), "--virtual", "--cycles", "20"),
            *("--print", "PLC_PRG.fbCounter.nPieces", "--print", "PLC_PRG.fbCounter.nBoxes"),
        ],
        env={**os.environ, "PYTHONPATH": os.pathsep.join([*toy, os.environ.get("PYTHONPATH", "")])},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.stdout.splitlines() == [
        "PLC_PRG.fbCounter.nPieces = 10",
        "PLC_PRG.fbCounter.nBoxes = 2",
    ], done.stderr


def test_without_the_package_everything_is_kept(tmp_path: Path) -> None:
    with installed("toy_kinds", tmp_path / "site"):
        project = counting()
        files, exported, archive = encode(project), write_plcopen(project), write_zip(project)
        save(project, tmp_path / "folder")
    assert "machine_note" not in kind_registry.kinds()
    unknown = decode(files).project
    assert isinstance(one(unknown, "machine_note").data, UnknownData)
    assert encode(unknown) == files
    assert write_zip(read_zip(archive)) == archive
    loaded = load(tmp_path / "folder")
    moved = edit.rename_object(loaded, one(loaded, "machine_note").id, "Kept")
    save(moved, tmp_path / "folder")
    assert next((tmp_path / "folder").rglob("Kept.md")).read_text() == NOTE["text"]
    again = import_files({"boxes.xml": exported}).project
    assert one(again, "piece_counter").data.model_dump() == {"box": 4}
    assert write_plcopen(again) == exported
    (application,) = unknown.applications()
    assert {text.uri for text in application_sources(unknown, application.id)} == {"PLC_PRG"}
    with installed("toy_kinds", tmp_path / "site again"):
        back = load(tmp_path / "folder")
        assert one(back, "machine_note").data.model_dump() == NOTE
        assert encode(decode(files).project) == files


def test_stored_objects_are_validated_when_the_package_comes(admin: TestClient, tmp_path: Path) -> None:
    """Also those that do not fit any more: the project opens, what uses them says what is wrong, a save mends
    it."""
    project = new_project("Boxes")
    (application,) = project.applications()
    for name, data in (("Good", {"box": 3}), ("Bad", {"box": "many"})):
        item = make_object(
            id=new_id(), parent_id=application.id, kind="piece_counter", name=name, index=9, data=data
        )
        project = Project(project.name, objects={**project.objects, item.id: item})
    url = f"{API}/projects"
    done = admin.post(f"{url}/import", files={"file": ("x.zip", write_zip(project))}).json()["id"]
    ids = {item["name"]: item["id"] for item in admin.get(f"{url}/{done}/objects").json()}

    def read(name: str) -> Any:
        return admin.get(f"{url}/{done}/objects/{ids[name]}").json()

    assert read("Bad")["data"] == {"box": "many"}
    with installed("toy_kinds", tmp_path / "site"):
        assert read("Good")["data"] == {"box": 3}
        assert read("Bad")["data"] == {"box": "many"}
        built = admin.post(f"{url}/{done}/applications/{ids['Application']}/build")
        assert "piece_counter 'Bad': box: Input should be a valid integer" in built.json()["detail"]
        mended = admin.put(
            f"{url}/{done}/objects/{ids['Bad']}",
            json={"base_revision": read("Bad")["revision"], "data": {"box": 5}},
        )
        assert mended.json()["data"] == {"box": 5}
        with pytest.raises(InvalidDataError, match="box"):
            make_object(id=new_id(), kind="piece_counter", name="x", data={"box": "many"})


def test_the_api_document_holds_the_shape(toy: list[str]) -> None:
    from tappet.server.app import create_app

    schemas = openapi.document(create_app(ServerSettings()))["components"]["schemas"]
    assert schemas["MachineNoteData"]["properties"]["about"]
    assert "PieceCounterObject" in str(schemas["ObjectDetail"])


def test_a_package_that_breaks_the_contract_is_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    broken = tmp_path / "broken_kinds"
    broken.mkdir()
    (broken / "pyproject.toml").write_text(
        '[project]\nname = "broken"\nversion = "1"\n[project.entry-points."tappet.kinds"]\n'
        'taken = "broken_kinds:TAKEN"\nmissing = "broken_kinds:MISSING"\nno_kind = "broken_kinds:os"\n'
    )
    (broken / "broken_kinds.py").write_text(
        "import os\nfrom dataclasses import replace\n"
        "from tappet.project.kinds.scene import SCENE\nTAKEN = replace(SCENE)\n"
    )
    monkeypatch.setattr("tests.plugins.installing.PLUGINS", tmp_path)
    with installed("broken_kinds", tmp_path / "site"):
        assert "scene" in kind_registry.kinds()
        assert "a kind named 'scene' exists already" in caplog.text
        assert "the plug-in missing of broken_kinds:MISSING cannot be loaded" in caplog.text
        assert "is no ObjectKind but a module" in caplog.text


def test_the_package_is_the_one_that_the_documentation_shows() -> None:
    text = (PLUGINS.parents[1] / "docs" / "extending.md").read_text(encoding="utf-8")
    folder = PLUGINS / "toy_kinds"
    for file in ("pyproject.toml", "toy_kinds/machine_note.py", "toy_kinds/piece_counter.py"):
        shown = (folder / file).read_text(encoding="utf-8").strip()
        assert shown in text, f"docs/extending.md shows another {file}"
