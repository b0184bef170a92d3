"""A running server with a project and an application that runs, and one person of every role."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from live_server import RUNTIME, Script, Station, station, until

PASSWORD = "correct horse battery"
OFFICE = "127.0.0.9"
"""Where people log in: attacks from elsewhere lock nobody out there."""
RETRIES = 4
ROLES = ("viewer", "operator", "engineer", "admin")


@dataclass
class Team:
    """What the people find: `plant` is the server, `boss` an administrator who takes no part."""

    plant: Station
    project_id: str
    application_id: str
    revision: int
    """The one that `restore` goes back to."""
    tokens: dict[str, str] = field(default_factory=dict)
    """Secrets by role."""
    _made: int = 0

    @property
    def boss(self) -> Script:
        return self.plant.admin

    def login(self, role: str) -> None:
        """A new user of a role, with a token."""
        self._made += 1
        name = {"username": f"{role}.{self._made}", "password": PASSWORD}
        self.boss.post("/users", {**name, "role": role}, 201)
        page = self.plant.browser(OFFICE)
        page.post("/auth/login", name)
        self.tokens[role] = page.post("/auth/tokens", {"name": role, "role": role}, 201)["secret"]

    def is_in(self, role: str) -> bool:
        """Whether the token of a role is still good, for as much as it was."""
        answer = self.plant.script(self.tokens[role]).http.get("/auth/me")
        return answer.status_code == 200 and answer.json()["role"] == role

    def restore(self) -> None:
        """The project as it was, its application running: whatever was, and is being, done to them."""
        for _ in range(RETRIES):
            with suppress(AssertionError):
                return self._restore()
        return self._restore()

    def _restore(self) -> None:
        if self.boss.http.get(self.boss.project).status_code == 404:
            self.boss.post(f"{self.boss.project}/restore")
        if self.boss.get(self.boss.project)["revision"] != self.revision:
            self.boss.post(f"{self.boss.project}/revert", {"revision": self.revision})
            self.revision = self.boss.get(self.boss.project)["revision"]
        if self.boss.http.get(RUNTIME).status_code == 404:
            raise AssertionError("the local runtime was removed")
        until(lambda: self.boss.state()["connected"], "the local runtime is there")
        until(self._runs_unforced, "the application runs again", 120)

    def _runs_unforced(self) -> bool:
        """What the server knows of the state may be older than the last reset: then the PLC refuses."""
        if self.boss.state()["state"] != "run":
            self.boss.download()
            self.boss.wait_for_state("run")
        everything = {"expressions": None}
        return self.boss.http.post(f"{RUNTIME}/values/unforce", json=everything).status_code == 200

    def check_running(self) -> None:
        """The process of the server lives, and tasks of the application run their cycles."""
        assert self.plant.process.poll() is None, self.plant.log.read_text()[-3000:]
        before = self._cycles()
        until(lambda: self._cycles() > before, "the application runs its cycles", 20)

    def _cycles(self) -> int:
        return sum(int(task["iec_cycles"]) for task in self.boss.get(f"{RUNTIME}/tasks"))

    def memory_mib(self) -> dict[str, int]:
        """Resident memory of the server and of its soft PLC."""
        found = {"server": self.plant.process.pid, "runtime": self.plant.runtime_pid()}
        return {name: _resident_mib(pid) for name, pid in found.items()}


def _resident_mib(pid: int) -> int:
    text = Path(f"/proc/{pid}/status").read_text()
    return int(text.partition("VmRSS:")[2].split()[0]) // 1024


@contextmanager
def team(folder: Path) -> Iterator[Team]:
    """The example of the bottling line on a server of its own."""
    with station(folder, "--example", "bottling") as plant:
        boss = plant.admin
        boss.wait_for_state("run", 120)
        boss.project_id = boss.get("/projects")[0]["id"]
        objects = boss.get(f"{boss.project}/objects")
        boss.ids = {one["name"]: one["id"] for one in objects}
        boss.application_id = next(one["id"] for one in objects if one["kind"] == "application")
        found = Team(plant, boss.project_id, boss.application_id, boss.get(boss.project)["revision"])
        for role in ROLES:
            found.login(role)
        yield found
