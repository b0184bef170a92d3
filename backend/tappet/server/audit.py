"""The audit log: logins, writes, forces, downloads, changes of state and of users, with old and new value."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

from sqlalchemy import Connection, insert, select

from tappet.server.auth.identity import Identity
from tappet.server.tables import audit

MAX_TEXT = 2000
"""Longer values are cut in the log."""


@dataclass(frozen=True, slots=True)
class Act:
    """One thing done. `action` is a stable word such as `write`, `force`, `download`, `login-failed`."""

    action: str
    subject: str
    old_value: str | None = None
    new_value: str | None = None
    project_id: str | None = None
    runtime_id: str | None = None


def record(db: Connection, who: Identity, *acts: Act) -> None:
    """Writes acts of a known user."""
    write(db, who.username, who.address, *acts)


def write(db: Connection, username: str, address: str, *acts: Act) -> None:
    """Writes acts, also of somebody who only claims a name."""
    if not acts:
        return
    now = datetime.now(UTC)
    db.execute(
        insert(audit),
        [
            {
                "at": now,
                "username": username[:64],
                "address": address[:64],
                "action": act.action,
                "subject": _text(act.subject),
                "project_id": act.project_id,
                "runtime_id": act.runtime_id,
                "old_value": _text(act.old_value) if act.old_value is not None else None,
                "new_value": _text(act.new_value) if act.new_value is not None else None,
            }
            for act in acts
        ],
    )


def _text(value: str) -> str:
    """Cut to length, and without NUL, which PostgreSQL does not keep."""
    return value[:MAX_TEXT].replace("\x00", "\ufffd")


def read(db: Connection, limit: int, before: int | None, action: str | None) -> list[dict[str, object]]:
    """The newest entries, or those before an entry's id, newest first."""
    query = select(audit).order_by(audit.c.id.desc()).limit(limit)
    if before is not None:
        query = query.where(audit.c.id < before)
    if action is not None:
        query = query.where(audit.c.action == action)
    return [dict(row) for row in db.execute(query).mappings()]
