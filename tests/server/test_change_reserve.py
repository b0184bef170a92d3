"""The memory for online changes: set in the project, kept by the runtime, told of at login."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient
from test_build import Stored, project

from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.memory import MAX_IMAGE, ChangeReserve
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.errors import PlcError
from tappet.runtime.image import Image
from tappet.runtime.local import LocalRuntime

__all__ = ["project"]
PAGE = 4096


@pytest.mark.parametrize(
    ("reserve", "size", "room"),
    [
        (ChangeReserve(), 10, 1 << 20),
        (ChangeReserve(), 3 << 20, 3 << 20),
        (ChangeReserve(25, 0), 4000, 1000),
        (ChangeReserve(0, 0), 4000, 0),
        (ChangeReserve(0, 500), 4000, 500),
        (ChangeReserve(1000, 0), MAX_IMAGE - 10, 10),
    ],
)
def test_how_much_is_set_aside(reserve: ChangeReserve, size: int, room: int) -> None:
    assert reserve.room(size) == room


def test_an_image_grows_into_its_reserve() -> None:
    image = Image(PAGE, ChangeReserve(0, PAGE))
    image.resize(PAGE + 100)
    memory = image.memory()
    assert (memory.size, memory.downloaded, memory.capacity) == (PAGE + 100, PAGE, 2 * PAGE)
    with pytest.raises(RuntimeError, match=f"needs {2 * PAGE + 1} bytes"):
        image.resize(2 * PAGE + 1)
    image.close()


def _built(variables: str, previous: CodePackage | None = None) -> CodePackage:
    text = f"PROGRAM PLC_PRG\nVAR {variables} END_VAR\nEND_PROGRAM"
    tasks = [Task("T", programs=("PLC_PRG",))]
    options = BuildOptions(reserve=ChangeReserve(0, PAGE))
    package = build_application([Source("PLC_PRG", text)], tasks, options, previous).package
    assert package is not None
    return package


def test_a_change_beyond_the_reserve_is_refused_and_changes_nothing() -> None:
    with LocalRuntime(_built("n : INT := 3;")) as runtime:
        large = _built("n : INT := 3; a : ARRAY [1..50000] OF BYTE;", runtime.package)
        with pytest.raises(PlcError, match=re.escape(f"needs {large.image_size} bytes")):
            runtime.plc.download(large.to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 3
        small = _built("n : INT := 3; a : ARRAY [1..500] OF BYTE;", runtime.package)
        runtime.plc.download(small.to_bytes(), "online_change")
        assert runtime.read("PLC_PRG.a[500]") == 0


def test_login_says_how_much_is_needed(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc, tmp_path: Path
) -> None:
    body = {"runtime_id": runtime_id}
    assert admin.post(f"{project.url}/download", json={**body, "mode": "download"}).status_code == 200
    assert CodePackage.from_bytes(plc.downloads[-1][0]).facts.reserve == (100, 1 << 20)
    plc.reserved = 1000
    project.edit("PROGRAM PLC_PRG\nVAR\n  a : ARRAY [1..5000] OF BYTE;\nEND_VAR", "")
    answer = admin.post(f"{project.url}/login", json=body).json()
    assert answer["relation"] == "download"
    assert answer["reserve"]["needed"] > 4000
    assert "which has 1000" in answer["reasons"][0]
    plc.reserved = 10_000
    answer = admin.post(f"{project.url}/login", json=body).json()
    assert (answer["relation"], answer["reserve"]["used"]) == ("online_change", 0)


def test_the_setting_comes_into_the_package(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    item = f"/api/v1/projects/{project.id}/objects/{project.application_id}"
    stored = admin.get(item).json()
    assert "change_reserve" not in stored["data"]
    change = {
        "base_revision": stored["revision"],
        "data": {"change_reserve": {"percent": 20, "least_kib": 8}},
    }
    assert admin.put(item, json=change).status_code == 200
    order = {"runtime_id": runtime_id, "mode": "download"}
    assert admin.post(f"{project.url}/download", json=order).status_code == 200
    assert CodePackage.from_bytes(plc.downloads[-1][0]).facts.reserve == (20, 8 << 10)
    change = {
        "base_revision": admin.get(item).json()["revision"],
        "data": {"change_reserve": {"percent": -1}},
    }
    assert admin.put(item, json=change).status_code == 422
