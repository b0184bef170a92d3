"""The disk of the server fills up: nothing is done unrecorded, the machine runs on, and can be stopped.

What begins or changes something is refused; what stops something is done, and recorded in a reserve that
needs no room.
"""

from __future__ import annotations

import errno
import io
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from live_server import RUNTIME, Script, Station, station

MOUNT = ["unshare", "-rm", "sh", "-c", 'mount -t tmpfs -o size=32m tmpfs "$0" && exec "$@"']
"""Runs a command with a small file system of its own."""
PASSWORD = "an old horse eats hay"


@pytest.fixture(scope="module")
def plant(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """A running application on a data folder of 32 MiB."""
    folder = tmp_path_factory.mktemp("full")
    (folder / "data").mkdir()
    wrapped = [*MOUNT, str(folder / "data")]
    try:
        subprocess.run([*wrapped, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no file systems of one's own here")
    with station(folder, wrapped=wrapped) as plant:
        boss = plant.admin
        boss.create_project("Team")
        text = "PROGRAM PLC_PRG\nVAR\n    n : DINT;\n    k : INT;\nEND_VAR"
        boss.save("PLC_PRG", declaration=text, implementation="n := n + 1;")
        boss.download()
        boss.wait_for_state("run")
        yield plant


def _data(plant: Station) -> Path:
    """The data folder, as its process sees it."""
    return Path(f"/proc/{plant.process.pid}/root{plant.log.parent}/data")


def fill(folder: Path) -> Path:
    """Takes all room there is."""
    filler = folder / "filler"
    with filler.open("wb", buffering=0) as file:
        for size in (1 << 16, 1):
            try:
                while True:
                    file.write(bytes(size))
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
    return filler


def until_full(boss: Script) -> None:
    """Uses up what the database has left within its own file."""
    for number in range(2000):
        answer = boss.http.put(f"/me/settings/filler.{number}", json="x" * 3000)
        if answer.status_code != 200:
            assert answer.status_code == 507, answer.text
            return
    raise AssertionError("never full")


def archive() -> bytes:
    """A project of many objects."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as packed:
        for number in range(200):
            packed.writestr(f"F{number}.st", f"FUNCTION F{number} : INT\nEND_FUNCTION\n" + "// x\n" * 2000)
    return out.getvalue()


def test_nobody_else_reads_what_the_server_keeps(plant: Station) -> None:
    data = _data(plant)
    names = {path.name: path for path in data.rglob("*") if path.is_file()}
    secret = (
        "tappet.sqlite",
        "tappet.sqlite-wal",
        "tappet.sqlite-shm",
        "token",
        "retain.live",
        "boot.tappet",
    )
    kept = [names[name] for name in secret if name in names]
    kept += list(data.rglob("*.package")) + [path for path in data.rglob("*") if path.is_dir()]
    assert len(kept) > 8
    assert [path for path in kept if path.stat().st_mode & 0o077] == []


def test_without_room_nothing_is_changed_and_the_machine_runs_until_it_is_stopped(plant: Station) -> None:
    boss = plant.admin
    data = _data(plant)
    boss.force("PLC_PRG.k", 5)
    boss.post("/users", {"username": "ann", "password": PASSWORD, "role": "operator"}, 201)
    page = plant.browser()
    page.post("/auth/login", {"username": "ann", "password": PASSWORD})
    before = boss.read_object("PLC_PRG")
    filler = fill(data)
    until_full(boss)
    value = {"values": [{"expression": "PLC_PRG.k", "value": 7}]}
    refused = [
        boss.post(f"{RUNTIME}/start", None, 507),
        boss.post(f"{RUNTIME}/reset", {"kind": "cold"}, 507),
        boss.post(f"{RUNTIME}/values/write", value, 507),
        boss.post(f"{RUNTIME}/values/force", value, 507),
        boss.post(
            f"{boss.application}/download", {"runtime_id": "local", "mode": "download", "start": True}, 507
        ),
        boss.post("/users", {"username": "late", "password": "correct horse battery", "role": "viewer"}, 507),
        boss.call(
            "PUT",
            f"{boss.project}/objects/{boss.ids['PLC_PRG']}",
            {
                "base_revision": before["revision"],
                "data": {**before["data"], "implementation": "n := 0;" * 999},
            },
            507,
        ),
    ]
    assert {problem["type"] for problem in refused} == {"urn:tappet:problem:disk-full"}
    files = {"files": ("many.zip", archive(), "application/zip")}
    assert boss.http.post("/projects/import-files", files=files).status_code == 507

    state = boss.state()
    assert (state["connected"], state["state"], state["exception"]) == (True, "run", None)
    assert boss.value("PLC_PRG.k") == 5
    first = boss.value("PLC_PRG.n")
    assert boss.value("PLC_PRG.n") >= first
    assert [v["expression"] for v in boss.get(f"{RUNTIME}/forces")["values"]] == ["PLC_PRG.k"]
    assert boss.read_object("PLC_PRG")["revision"] == before["revision"]
    assert boss.http.get(f"{boss.project}/export").status_code == 200
    assert [p["name"] for p in boss.get("/projects")] == ["Team"]

    assert boss.build()["ok"] is True, "its objects are not kept"
    assert boss.get(f"{RUNTIME}/log")
    assert boss.get("/audit?action=force")[0]["subject"] == "PLC_PRG.k"

    assert boss.post(f"{RUNTIME}/values/unforce", {"expressions": None})["values"] == []
    assert boss.post(f"{RUNTIME}/stop")["state"] == "stop"
    page.post("/auth/logout", None, 204)
    assert boss.get("/audit?action=stop") == []

    filler.unlink()
    (entry,) = boss.get("/audit?action=stop")
    assert (entry["result"], entry["subject"]) == ("ok", state["name"])
    newest = [(e["action"], e["username"], e["result"]) for e in boss.get("/audit")[:3]]
    assert newest == [("logout", "ann", "ok"), ("stop", "local", "ok"), ("unforce", "local", "ok")]
    assert boss.post(f"{RUNTIME}/start")["state"] == "run"
    assert boss.save("PLC_PRG", implementation="n := n + 2;")["revision"] > before["revision"]
    assert boss.download("online_change")["state"] == "run"
    assert [path.name for path in data.rglob("*.part")] == []
