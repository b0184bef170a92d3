"""The audit log: who did what, or tried to, with old and new value and what became of it.

An act of a request is stored as `begun` before it is done and completed afterwards (`audited`); what changes
only this database may be stored with its result in the same transaction. A row that stays `begun` belongs to
an act during which the server ended, or whose result could not be stored.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from enum import StrEnum
from typing import Any

from sqlalchemy import Connection, func, insert, select, update
from sqlalchemy.exc import DBAPIError

from tappet.server.auth.identity import Identity
from tappet.server.database import Database
from tappet.server.tables import audit

log = logging.getLogger(__name__)
MAX_TEXT = 2000
"""Longer values are cut in the log."""
REPEATED_WITHIN = timedelta(minutes=10)
"""Equal refusals in this time are one row that counts them: nobody fills the disk by being refused."""
MOST_LOOKED_BACK = 5000
"""Rows among which an equal one is looked for: the log may be long."""


class Result(StrEnum):
    """What became of an act."""

    BEGUN = "begun"
    """Nobody knows yet, or any more."""
    OK = "ok"
    REFUSED = "refused"
    """Nothing was changed: no right, wrong state, wrong value."""
    FAILED = "failed"
    """It may have been done in part."""


@dataclass(frozen=True, slots=True)
class Act:
    """One thing to do. `action` is a stable word such as `write`, `force`, `download`, `login-failed`."""

    action: str
    subject: str
    old_value: str | None = None
    new_value: str | None = None
    project_id: str | None = None
    runtime_id: str | None = None


def record(db: Connection, who: Identity, *acts: Act) -> None:
    """Writes acts of a known user that this very transaction does."""
    write(db, who.username, who.address, *acts)


def begin(db: Connection, who: Identity, *acts: Act) -> list[int]:
    """Writes acts that are to be done next; returns the ids of their rows."""
    return write(db, who.username, who.address, *acts, result=Result.BEGUN)


def complete(
    db: Connection, ids: list[int], result: Result, reason: str | None = None, **known: str | None
) -> None:
    """What became of acts that had begun; `known` are columns whose values are known only now."""
    values: dict[str, Any] = {name: _text(value) for name, value in known.items()}
    values |= {"result": result.value, "reason": _text(reason)}
    db.execute(update(audit).where(audit.c.id.in_(ids)).values(values))


def write(db: Connection, username: str, address: str, *acts: Act, result: Result = Result.OK) -> list[int]:
    """Writes acts, also of somebody who only claims a name; returns the ids of their rows."""
    if not acts:
        return []
    rows = [{**columns(username, address, act), "result": result.value} for act in acts]
    query = insert(audit).returning(audit.c.id, sort_by_parameter_order=True)
    return list(db.scalars(query, rows))


def refuse(db: Connection, username: str, address: str, act: Act, reason: str) -> None:
    """Writes an act that was refused, or counts it on the row of an equal one shortly before."""
    row = {**columns(username, address, act), "result": Result.REFUSED.value}
    now = row.pop("at")
    equal = [audit.c[name].is_not_distinct_from(value) for name, value in row.items()]
    last = select(func.max(audit.alias().c.id)).scalar_subquery()
    recent = audit.c.id > last - MOST_LOOKED_BACK
    newest = select(audit.c.id).where(*equal, recent, audit.c.at > now - REPEATED_WITHIN)
    known = db.scalar(newest.order_by(audit.c.id.desc()).limit(1))
    if known is None:
        db.execute(insert(audit).values(**row, at=now, reason=_text(reason)))
        return
    db.execute(
        update(audit)
        .where(audit.c.id == known)
        .values(count=audit.c.count + 1, last_at=now, reason=_text(reason))
    )


def note_refusal(database: Database, who: Identity, act: Act, reason: str) -> None:
    """`refuse` in a transaction of its own. Blocks. Nothing was done, so nothing fails for want of a row."""
    try:
        database.write(lambda db: refuse(db, who.username, who.address, act, reason))
    except DBAPIError:
        log.exception("%s of %s was refused, which could not be stored: %s", act.action, who.username, reason)


def columns(username: str, address: str, act: Act) -> dict[str, Any]:
    """The columns of a row of now, but for its result."""
    return {
        "at": datetime.now(UTC),
        "username": username[:64],
        "address": address[:64],
        "action": act.action,
        "subject": _text(act.subject),
        "project_id": act.project_id and act.project_id[:32],
        "runtime_id": act.runtime_id and act.runtime_id[:32],
        "old_value": _text(act.old_value),
        "new_value": _text(act.new_value),
    }


def _text(value: str | None) -> str | None:
    """Cut to length, and without NUL, which PostgreSQL does not keep."""
    return None if value is None else value[:MAX_TEXT].replace("\x00", "\ufffd")


def read(db: Connection, limit: int, before: int | None, action: str | None) -> list[dict[str, object]]:
    """The newest entries, or those before an entry's id, newest first."""
    query = select(audit).order_by(audit.c.id.desc()).limit(limit)
    if before is not None:
        query = query.where(audit.c.id < before)
    if action is not None:
        query = query.where(audit.c.action == action)
    return [dict(row) for row in db.execute(query).mappings()]
