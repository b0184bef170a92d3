"""The index of stored recordings in the database: lists are filtered and summed without opening a folder."""

from __future__ import annotations

from datetime import datetime
from typing import Any, NamedTuple

from sqlalchemy import ColumnElement, delete, func, insert, select, update

from tappet.server.database import Database
from tappet.server.tables import trace_recordings as table


class Wanted(NamedTuple):
    """Which recordings a list shows; None: whatever it is."""

    project_id: str | None = None
    runtime_id: str | None = None
    trace: str | None = None
    start: datetime | None = None
    """Those that hold something from this moment on."""
    end: datetime | None = None
    """Those that were begun before."""

    def conditions(self) -> list[ColumnElement[bool]]:
        """For the database."""
        c = table.c
        found: list[ColumnElement[bool]] = []
        if self.project_id is not None:
            found.append(c.project_id == self.project_id)
        if self.runtime_id is not None:
            found.append(c.runtime_id == self.runtime_id)
        if self.trace is not None:
            found.append(c.trace_key == self.trace.upper())
        if self.start is not None:
            found.append(c.last_ns >= int(self.start.timestamp() * 1e9))
        if self.end is not None:
            found.append(c.first_ns < int(self.end.timestamp() * 1e9))
        return found


ALL = Wanted()


class RecordingIndex:
    """A row a recording. Its methods block."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def put(self, row: dict[str, Any]) -> None:
        """Take the facts of a recording, in place of those before."""
        values = row | {"trace_key": row["trace"].upper()}

        def work(db: Any) -> None:
            changed = db.execute(update(table).where(table.c.id == row["id"]).values(values))
            if not changed.rowcount:
                db.execute(insert(table).values(values))

        self._database.write(work)

    def remove(self, *ids: str) -> None:
        """Forget recordings."""
        if ids:
            self._database.write(lambda db: db.execute(delete(table).where(table.c.id.in_(ids))))

    def states(self) -> dict[str, str]:
        """The state of each recording."""
        return self._database.read(
            lambda db: {row.id: row.state for row in db.execute(select(table.c.id, table.c.state))}
        )

    def found(self, wanted: Wanted = ALL) -> list[dict[str, Any]]:
        """The rows of recordings, newest first."""
        columns = [column for column in table.c if column.name != "trace_key"]
        query = select(*columns).where(*wanted.conditions()).order_by(table.c.started_at.desc(), table.c.id)
        return self._database.read(lambda db: [dict(row._mapping) for row in db.execute(query)])

    def ended_before(self, moment: datetime) -> list[str]:
        """Ids of the recordings that do not go on and ended, or were stored, before; oldest first."""
        c = table.c
        ended = func.coalesce(c.ended_at, c.started_at)
        query = select(c.id).where(c.state != "recording", ended < moment).order_by(ended, c.id)
        return self._database.read(lambda db: [row.id for row in db.execute(query)])

    def used(self) -> int:
        """Bytes of all of them."""
        query = select(func.coalesce(func.sum(table.c.bytes), 0))
        return int(self._database.read(lambda db: db.execute(query).scalar_one()))
