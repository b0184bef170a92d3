"""SIGKILL of a server in the middle of its work, over and over: what was answered is there, all is whole.

Each round starts a server on the same folder, looks at what the last one has left, lets users edit, save, log
in, download, force and start, and kills it. `TAPPET_KILLS` is the number of kills of the long version.
"""

from __future__ import annotations

import os
import random
import signal
import sqlite3
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
import pytest
from live_server import RUNTIME, Script, Station, process, station, until

FEW, MANY = 2, int(os.environ.get("TAPPET_KILLS", "500"))
PASSWORD = "an old horse eats hay"
DECLARATION = """PROGRAM PLC_PRG
VAR RETAIN count, twin : LINT; END_VAR
VAR n, torn, k : LINT; END_VAR"""
BODY = """IF n = 0 AND count <> twin THEN torn := 1; END_IF
n := n + 1; count := count + 1; twin := count;"""
KILLS_OF_USER = 10
GOES = 40.0
"""Seconds in which what a killed server leaves running ends by itself."""


@dataclass
class Known:
    """What the servers have answered so far."""

    script: Script | None = None
    edits: dict[str, tuple[int, int]] = field(default_factory=dict)
    """Revision and number of the newest stored text, by object."""
    objects: set[str] = field(default_factory=set)
    """Names of added objects."""
    acts: Counter[str] = field(default_factory=Counter)
    """Answered acts by their name in the audit log."""
    tried: Counter[str] = field(default_factory=Counter)
    cookies: list[tuple[str, str]] = field(default_factory=list)
    """Users and sessions of finished logins."""
    count: int = 0
    """Remanent counter that was seen last."""
    rounds: Counter[str] = field(default_factory=Counter)

    @property
    def answered_loads(self) -> int:
        return self.acts["download"] + self.acts["online-change"]


class Users:
    """Threads that work until the server is gone; each one remembers what was answered."""

    def __init__(self, plant: Station, known: Known) -> None:
        self.plant, self.known = plant, known
        self.page = plant.browser()
        self.name = user_of(known.rounds["kills"])
        self.problems: list[str] = []
        self.ready = threading.Barrier(6)
        tasks = (self._edit, self._add, self._log_in, self._load, self._operate)
        self.threads = [threading.Thread(target=self._until_gone, args=(task,)) for task in tasks]

    def begin(self) -> None:
        for thread in self.threads:
            thread.start()
        self.ready.wait(60)

    def wait_for_download(self) -> None:
        before = self.known.answered_loads
        until(lambda: self.known.answered_loads > before or self.problems, "a download")

    def end(self) -> None:
        for thread in self.threads:
            thread.join(60)
            assert not thread.is_alive()
        assert self.problems == []

    def _until_gone(self, task: Callable[[Script, int], None]) -> None:
        secret = str(self.plant.admin.http.headers["Authorization"]).removeprefix("Bearer ")
        script = self.plant.script(secret)
        take_over(script, self.known)
        self.ready.wait(60)  # clients take long to make
        number = 0
        try:
            while True:
                number += 1
                task(script, number)
        except httpx.TransportError:
            pass  # killed
        except Exception as error:
            self.problems.append(f"{task.__name__}: {type(error).__name__}: {error}")

    def _edit(self, script: Script, number: int) -> None:
        name = "PLC_PRG" if number % 5 == 0 else "Text"
        now = script.read_object(name)
        _, last = self.known.edits.get(name, (0, 0))
        text = f"{BODY}\n// {last + 1}" if name == "PLC_PRG" else f"// {last + 1}\n" * 50
        saved = script.save(name, implementation=text)
        assert saved["revision"] > now["revision"]
        self.known.edits[name] = (saved["revision"], last + 1)

    def _add(self, script: Script, number: int) -> None:
        name = f"F_{self.known.rounds['kills']}_{number}"
        script.add("pou", name, subkind="function")
        self.known.objects.add(name)
        time.sleep(0.05)

    def _log_in(self, script: Script, number: int) -> None:
        page = self.page
        page.http.cookies.clear()
        self.known.tried["login"] += 1
        answer = page.http.post("/auth/login", json={"username": self.name, "password": PASSWORD})
        if answer.status_code == 429:  # logins that were killed count as failed: a crash forgives no guesses
            self.known.rounds["locked out"] += 1
            time.sleep(0.5)
            return
        assert answer.status_code == 200, answer.text
        self.known.acts["login"] += 1
        self.known.cookies.append((self.name, page.http.cookies["tappet_session"]))
        time.sleep(0.1)

    def _load(self, script: Script, number: int) -> None:
        mode = "download" if number % 2 else "online_change"
        self.known.tried[mode] += 1
        if mode == "download":
            self.known.count = 0  # RETAIN variables begin anew
        order = {"runtime_id": "local", "mode": mode, "start": True}
        answer = script.http.post(f"{script.application}/download", json=order)
        if answer.status_code == 200:
            self.known.acts[mode.replace("_", "-")] += 1
        else:
            assert answer.status_code in (409, 422, 503), answer.text
        time.sleep(0.05)

    def _operate(self, script: Script, number: int) -> None:
        value = {"values": [{"expression": "PLC_PRG.k", "value": number}]}
        for act, path, body in (
            ("write", "values/write", value),
            ("force", "values/force", value),
            ("unforce", "values/unforce", {"expressions": None}),
            ("start", "start", None),
        ):
            self.known.tried[act] += 1
            answer = script.http.post(f"{RUNTIME}/{path}", json=body)
            assert answer.status_code in (200, 409, 422, 503), answer.text
            self.known.acts[act] += answer.status_code == 200


def _below(pid: int) -> dict[int, str]:
    """Processes that a process has started, and those that these have, with when they began."""
    parents: dict[int, list[int]] = {}
    begun: dict[int, str] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        number = int(stat.parent.name)
        parents.setdefault(int(fields[1]), []).append(number)
        begun[number] = fields[19]
    found: dict[int, str] = {}
    waiting = list(parents.get(pid, []))
    while waiting:
        one = waiting.pop()
        found[one] = begun[one]
        waiting += parents.get(one, [])
    return found


def _alive(process: tuple[int, str]) -> bool:
    pid, begun = process
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return False
    return fields[19] == begun and fields[0] != "Z"


def kill(plant: Station) -> None:
    """SIGKILL of the server alone; all that it had started has to end by itself."""
    assert plant.process.poll() is None, plant.log.read_text()[-2000:]
    below = _below(plant.process.pid)
    plant.process.kill()
    assert plant.process.wait() == -signal.SIGKILL
    ended(below)


def ended(processes: dict[int, str]) -> None:
    """Waits for the end of processes that nobody tells to end."""
    until(lambda: not [one for one in processes.items() if _alive(one)], "the end of its processes", GOES)


def look_at_database(file: Path, known: Known) -> None:
    """While no server has it open."""
    with closing(sqlite3.connect(f"file:{file}?mode=rw", uri=True)) as db:
        assert db.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        assert db.execute("PRAGMA foreign_key_check").fetchall() == []
        rows = db.execute("SELECT action, result, SUM(count) FROM audit GROUP BY action, result").fetchall()
    stored: Counter[str] = Counter()
    everything: Counter[str] = Counter()
    for action, result, number in rows:
        assert result in ("begun", "ok", "refused", "failed"), result
        stored[action] += number if result == "ok" else 0
        everything[action] += number
    for act, number in known.acts.items():
        assert stored[act] >= number, (act, number, rows)
    assert stored["force"] <= known.tried["force"]
    assert everything["write"] <= known.tried["write"]


def take_over(script: Script, known: Known) -> None:
    """The project of this run becomes the current one."""
    last = known.script
    assert last is not None
    script.project_id, script.application_id, script.ids = last.project_id, last.application_id, last.ids


def look_at_server(plant: Station, known: Known) -> None:
    """What was answered before is there; the boot application is there and its values are whole."""
    script = plant.admin
    take_over(script, known)
    for name, (revision, number) in known.edits.items():
        now = script.read_object(name)
        stored = int(now["data"]["implementation"].rpartition("// ")[2])
        assert (now["revision"] >= revision, stored >= number) == (True, True), (name, now, revision, number)
        known.edits[name] = (now["revision"], stored)
    names = {item["name"] for item in script.get(f"{script.project}/objects")}
    assert known.objects <= names, known.objects - names
    page = plant.browser()
    for name, cookie in known.cookies[-3:]:
        page.http.cookies.set("tappet_session", cookie)
        assert page.get("/auth/me")["username"] == name
        page.http.cookies.clear()
    state = until(
        lambda: (s := script.state())["connected"] and s["application"] and s, "the boot application"
    )
    if state["state"] == "exception":
        assert state["exception"]["name"] == "PROCESS_ENDED", state
    if state["state"] != "run":
        script.post(f"{RUNTIME}/start")
        known.rounds["waited for a start"] += 1
    until(lambda: script.value("PLC_PRG.n") > 0, "a cycle")
    assert script.value("PLC_PRG.torn") == 0
    count = script.value("PLC_PRG.count")
    assert count >= known.count, (count, known.count)
    known.count = count


def prepare(plant: Station, known: Known) -> None:
    """Project, application and user."""
    script = known.script = plant.admin
    script.create_project("Killed")
    script.save("PLC_PRG", declaration=DECLARATION, implementation=f"{BODY}\n// 0")
    script.add("pou", "Text", subkind="function")
    script.save("Text", declaration="FUNCTION Text : INT", implementation="// 0")
    script.download()
    script.wait_for_state("run")


def user_of(kills: int) -> str:
    """Who logs in after this many kills: one user would be locked out when logins in a row are killed."""
    return f"engineer{kills // KILLS_OF_USER}"


def left_over(folder: Path) -> list[str]:
    """Files that nobody needs any more."""
    unfinished = [str(path) for pattern in ("*.part", "*.new") for path in (folder / "data").rglob(pattern)]
    return unfinished + [str(path) for path in (folder / "tmp").rglob("*") if not path.is_dir()]


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    (tmp_path / "tmp").mkdir()
    yield tmp_path
    for log in tmp_path.glob("*.log"):
        print(log.read_text()[-3000:])


def opened(folder: Path) -> Any:
    return station(folder, TMPDIR=str(folder / "tmp"))


@pytest.mark.parametrize("kills", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
def test_a_killed_server_has_kept_all_it_answered(folder: Path, kills: int) -> None:
    known = Known()
    with opened(folder) as plant:
        prepare(plant, known)
    chance = random.Random(kills)
    for _ in range(kills):
        with opened(folder) as plant:
            look_at_server(plant, known)
            if known.rounds["kills"] % KILLS_OF_USER == 0:
                user = {"username": user_of(known.rounds["kills"]), "password": PASSWORD, "role": "engineer"}
                plant.admin.post("/users", user, 201)
            users = Users(plant, known)
            users.begin()
            if chance.random() < 0.25:  # a download takes longer than most rounds on a busy machine
                users.wait_for_download()
            time.sleep(chance.uniform(0, 2.0))
            kill(plant)
            known.rounds["kills"] += 1
            users.end()
        look_at_database(folder / "data" / "tappet.sqlite", known)
        print(dict(known.rounds), dict(known.acts), known.edits, flush=True)
        if chance.random() < 0.3:
            killed_at_its_start(folder, chance.uniform(0, 2.5))
            known.rounds["killed at the start"] += 1
    with opened(folder) as plant:
        look_at_server(plant, known)
    assert left_over(folder) == []


def killed_at_its_start(folder: Path, seconds: float) -> None:
    """A server that is killed before it is up, or hardly."""
    command = ["serve", "--port", "0", "--data", str(folder / "data")]
    with process(command, folder / "short.log", TMPDIR=str(folder / "tmp")) as started:
        time.sleep(seconds)
        below = _below(started.pid)
        started.kill()
        assert started.wait() == -signal.SIGKILL
    ended(below)
