"""Stopping, releasing and logging out are done and recorded even when the audit log takes no row."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import browser
from sqlalchemy import Connection, Engine, event, func, select
from sqlalchemy.exc import OperationalError

from tappet.runtime.errors import PlcError
from tappet.runtime.operations import registry
from tappet.server import audit, audit_reserve
from tappet.server.audit import Act, Result
from tappet.server.audit_reserve import FILE, SIZE, AuditReserve
from tappet.server.auth.identity import Identity
from tappet.server.auth.roles import Role
from tappet.server.services import Services
from tappet.server.tables import audit as audit_table
from tappet.server.tables import sessions

WHO = Identity("1", "ann", Role.OPERATOR, "192.0.2.1")


@dataclass
class Disk:
    """The disk of the database; while it is full, no transaction that writes ends well."""

    full: bool = False


@pytest.fixture
def disk(services: Services) -> Iterator[Disk]:
    disk = Disk()

    def refuse(connection: Connection, _cursor: Any, statement: str, *_: Any) -> None:
        if disk.full and not connection.get_execution_options().get("tappet_reads_only", False):
            full = sqlite3.OperationalError("database or disk is full")
            full.sqlite_errorcode = sqlite3.SQLITE_FULL
            raise OperationalError(statement, None, full) from full

    engine: Engine = services.database.engine
    event.listen(engine, "before_cursor_execute", refuse)
    yield disk
    event.remove(engine, "before_cursor_execute", refuse)


def rows(services: Services, *actions: str) -> list[tuple[object, ...]]:
    """Of these actions, the oldest first: action, who, subject, old value, result."""
    found = services.database.read(lambda db: audit.read(db, 100, None, None))
    names = ("action", "username", "subject", "old_value", "result")
    return [tuple(r[n] for n in names) for r in reversed(found) if r["action"] in actions]


def test_exactly_these_are_always_done(app: FastAPI) -> None:
    always = [kind.op for kind in registry.known().values() if kind.rest is not None and kind.rest.always]
    assert always == ["stop_axis", "stop"], (
        "what starts or changes something is refused when it cannot be recorded"
    )


def test_a_machine_is_stopped_on_a_full_disk_and_that_is_recorded(
    admin: TestClient, services: Services, runtime_id: str, plc: FakePlc, disk: Disk
) -> None:
    url = f"/api/v1/runtimes/{runtime_id}"
    name = admin.get(url).json()["name"]
    assert admin.post(f"{url}/start").status_code == 200
    forced = {"values": [{"expression": "PLC_PRG.nCount", "value": 7}]}
    assert admin.post(f"{url}/values/force", json=forced).status_code == 200

    disk.full = True
    assert admin.post(f"{url}/values/unforce", json={"expressions": None}).json()["values"] == []
    assert admin.post(f"{url}/stop").json()["state"] == "stop"
    assert plc.state == "stop"
    assert admin.post(f"{url}/start").status_code == 507
    assert admin.post(f"{url}/values/force", json=forced).status_code == 507
    assert plc.state == "stop"
    assert rows(services, "stop", "unforce") == []
    assert admin.get("/api/v1/audit").status_code == 200

    disk.full = False
    assert [row["action"] for row in admin.get("/api/v1/audit").json()[:2]] == ["stop", "unforce"]
    assert rows(services, "stop", "unforce") == [
        ("unforce", "admin", "PLC_PRG.nCount", "7", "ok"),
        ("stop", "admin", name, None, "ok"),
    ]
    assert admin.post(f"{url}/start").status_code == 200
    assert [row["action"] for row in admin.get("/api/v1/audit").json()[:3]] == ["start", "stop", "unforce"]


def test_a_stop_that_fails_says_so(
    admin: TestClient, runtime_id: str, disk: Disk, monkeypatch: pytest.MonkeyPatch
) -> None:
    def hang(_: FakePlc) -> None:
        raise PlcError("it hangs")

    monkeypatch.setattr(FakePlc, "stop", hang)
    disk.full = True
    assert admin.post(f"/api/v1/runtimes/{runtime_id}/stop").status_code == 409
    disk.full = False
    (row,) = admin.get("/api/v1/audit?action=stop").json()
    assert (row["result"], row["reason"]) == ("refused", "'test stand' refused: it hangs")


def test_who_logs_out_on_a_full_disk_is_out(
    admin: TestClient, app: FastAPI, services: Services, disk: Disk
) -> None:
    (cookie,) = [c.value for c in admin.cookies.jar if c.name == "tappet_session"]
    disk.full = True
    assert admin.post("/api/v1/auth/logout").status_code == 204
    stolen = browser(app)
    stolen.cookies.set("tappet_session", str(cookie))
    assert stolen.get("/api/v1/auth/me").status_code == 401
    again = AuditReserve(services.settings.data_dir)
    (ended,) = services.database.read(lambda db: list(db.scalars(select(sessions.c.id))))
    assert again.has_ended(ended), "a server that starts anew knows it, too"
    disk.full = False
    services.audit_reserve.try_move(services.database)
    assert not services.audit_reserve.has_ended(ended)
    assert services.database.read(lambda db: list(db.scalars(select(sessions.c.id)))) == []
    assert stolen.get("/api/v1/auth/me").status_code == 401
    assert [row[0] for row in rows(services, "logout")] == ["logout"]


def test_what_was_kept_is_found_by_the_next_server(services: Services, tmp_path: Path) -> None:
    reserve = services.audit_reserve
    done, open_ = reserve.keep(WHO, Act("stop", "Press 1"), Act("stop", "Press 2"))
    reserve.complete([done], Result.OK, None)
    again = AuditReserve(tmp_path)
    again.move(services.database)
    wanted = [("stop", "ann", "Press 1", None, "ok"), ("stop", "ann", "Press 2", None, "begun")]
    assert rows(services, "stop") == wanted
    reserve.move(services.database)  # as after a kill right after the transaction: nothing is there twice
    assert rows(services, "stop") == wanted
    assert AuditReserve(tmp_path)._entries == []
    assert open_


def test_an_act_that_is_under_way_when_its_row_moves_gets_its_result(services: Services) -> None:
    reserve = services.audit_reserve
    keys = reserve.keep(WHO, Act("stop", "Press"))
    reserve.move(services.database)
    (number,) = reserve.complete(keys, Result.OK, None)
    services.database.write(lambda db: audit.complete(db, [number], Result.OK))
    assert rows(services, "stop") == [("stop", "ann", "Press", None, "ok")]


def torn(data: bytearray, end: int) -> None:
    data[end - 1] ^= 1


def cut(data: bytearray, end: int) -> None:
    del data[end - 3 :]


def empty(data: bytearray, end: int) -> None:
    data.clear()


def wild(data: bytearray, end: int) -> None:
    data[:8] = b"\xff" * 8


@pytest.mark.parametrize(("damage", "left"), [(torn, 1), (cut, 1), (empty, 0), (wild, 0)])
def test_a_damaged_file_gives_what_is_whole(
    tmp_path: Path, damage: Callable[[bytearray, int], None], left: int
) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    reserve = AuditReserve(folder)
    reserve.keep(WHO, Act("stop", "Press 1"))
    reserve.keep(WHO, Act("stop", "Press 2"))
    data = bytearray((folder / FILE).read_bytes())
    damage(data, reserve._end)
    (folder / FILE).write_bytes(data)
    again = AuditReserve(folder)
    assert len(again._entries) == left
    assert (folder / FILE).stat().st_size == SIZE
    again.keep(WHO, Act("stop", "Press 3"))
    assert len(AuditReserve(folder)._entries) == left + 1


def test_a_full_reserve_keeps_more_in_memory_and_then_counts(
    services: Services, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(audit_reserve, "MOST", 2500)
    reserve = services.audit_reserve
    acts = [Act("unforce", f"GVL.{'x' * 190}{n}", "1" * 500) for n in range(3000)]
    assert len(reserve.keep(WHO, *acts)) == 2500
    assert 1000 < len(AuditReserve(tmp_path)._entries) < 2500
    reserve.move(services.database)
    query = select(func.count()).select_from(audit_table).where(audit_table.c.action == "unforce")
    assert services.database.read(lambda db: db.scalar(query)) == 2500
    ((_, _, subject, _, _),) = rows(services, "audit-reserve-full")
    assert subject == "500 acts are in the log of the server only"


def test_every_byte_of_it_is_on_the_disk(tmp_path: Path, services: Services) -> None:
    status = (services.settings.data_dir / FILE).stat()
    assert (status.st_size, status.st_mode & 0o777) == (SIZE, 0o600)
    assert status.st_blocks * 512 >= SIZE


def test_without_room_for_it_a_stop_is_done_all_the_same(
    admin: TestClient, services: Services, runtime_id: str, plc: FakePlc, disk: Disk,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    (services.settings.data_dir / FILE).unlink()
    disk.full = True
    assert admin.post(f"/api/v1/runtimes/{runtime_id}/stop").status_code == 200
    assert "1 acts of admin are lost for the audit log when this process ends" in caplog.text
    disk.full = False
    assert [row["result"] for row in admin.get("/api/v1/audit?action=stop").json()] == ["ok"]
