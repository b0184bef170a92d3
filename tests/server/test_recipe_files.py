"""Recipe files in the controller over REST: listed, read, written, deleted, and nothing else reached."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient
from test_recipes_api import API, Kitchen

TEXT = "PLC_PRG.nCount:=7\r\nPLC_PRG.bStart:=TRUE\r\n"


@pytest.fixture
def folder(plc: FakePlc, tmp_path: Path) -> Path:
    plc.folder = tmp_path / "controller" / "files"
    return plc.folder


@pytest.fixture
def kitchen(admin: TestClient, runtime_id: str, folder: Path) -> Kitchen:
    return Kitchen(admin, runtime_id)


def _send(
    kitchen: Kitchen, method: str, recipe: str = "", client: TestClient | None = None, **body: Any
) -> Any:
    at = f"{kitchen.runtime}/files" + (f"/{quote(recipe, safe='')}" if recipe else "")
    more = {"json": body} if body else {}
    return (client or kitchen.admin).request(method, at, params=kitchen.order(), **more)


def test_files_are_written_listed_read_and_deleted(kitchen: Kitchen, folder: Path) -> None:
    assert _send(kitchen, "GET").json() == {"folder": "", "files": []}
    assert _send(kitchen, "PUT", "Rye", text=TEXT).status_code == 204
    assert (folder / "Rye.Bread.txtrecipe").read_bytes() == TEXT.encode()
    (folder / "Rye.Cake.txtrecipe").write_text("of another definition")
    (folder / ".Bread.txtrecipe").write_text("of no recipe")
    raw = bytes(range(256))
    assert _send(kitchen, "PUT", "Früh 2", base64=base64.b64encode(raw).decode()).status_code == 204
    listed = _send(kitchen, "GET").json()["files"]
    assert [(one["recipe"], one["size"]) for one in listed] == [("Früh 2", 256), ("Rye", len(TEXT))]
    assert _send(kitchen, "GET", "Früh 2").content == raw
    answer = _send(kitchen, "GET", "Rye")
    assert answer.content == TEXT.encode()
    assert answer.headers["content-disposition"] == "attachment; filename*=UTF-8''Rye.Bread.txtrecipe"
    assert _send(kitchen, "DELETE", "Rye").status_code == 204
    assert not (folder / "Rye.Bread.txtrecipe").exists()
    for method in ("GET", "DELETE"):
        gone = _send(kitchen, method, "Rye")
        assert (gone.status_code, gone.json()["type"]) == (404, "urn:tappet:problem:not-found")
    acts = [
        (row["action"], row["subject"], row["result"]) for row in kitchen.admin.get(f"{API}/audit").json()
    ]
    assert ("recipe-file-written", "Rye.Bread.txtrecipe", "ok") in acts
    assert ("recipe-file-deleted", "Rye.Bread.txtrecipe", "ok") in acts


@pytest.mark.parametrize("recipe", ["../../secret", "..", "a\0b", "x" * 81, "/etc/passwd"])
def test_no_name_leads_out_of_the_folder(kitchen: Kitchen, folder: Path, recipe: str) -> None:
    folder.mkdir(parents=True)
    secret = folder.parent / "secret.Bread.txtrecipe"
    secret.write_text("of the controller")
    for method, body in (("GET", {}), ("PUT", {"text": "x"}), ("DELETE", {})):
        assert _send(kitchen, method, recipe, **body).status_code in (404, 405, 409, 422), method
    assert secret.read_text() == "of the controller"
    assert [path for path in folder.rglob("*") if path.is_file()] == []


def test_what_a_file_is_to_hold_is_checked(kitchen: Kitchen, folder: Path) -> None:
    for body in ({"text": "a", "base64": "YQ=="}, {"base64": "not base64"}, {"more": 1}):
        assert _send(kitchen, "PUT", "Rye", **body).status_code == 422
    assert not folder.exists()


def test_who_may_do_what(kitchen: Kitchen, folder: Path, as_role: dict[str, TestClient]) -> None:
    assert _send(kitchen, "PUT", "Rye", as_role["operator"], text=TEXT).status_code == 204
    viewer = as_role["viewer"]
    assert len(_send(kitchen, "GET", client=viewer).json()["files"]) == 1
    assert _send(kitchen, "GET", "Rye", viewer).status_code == 200
    assert _send(kitchen, "PUT", "Rye", viewer, text="").status_code == 403
    assert _send(kitchen, "DELETE", "Rye", viewer).status_code == 403
    assert (folder / "Rye.Bread.txtrecipe").read_bytes() == TEXT.encode()
