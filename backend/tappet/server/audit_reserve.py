"""Room for the audit rows of acts that are done even when the database takes no row.

A full disk must not keep anybody from stopping a machine, releasing forces or logging out, and these acts
belong into the audit log all the same. So a file of fixed size is written while there is room; rows that the
database does not take are written over its content, which needs none. They move into the database with the
next act that it takes, with the next look at the audit log, or at the next start.

Sessions that were ended meanwhile are in the file, too: they are refused while the database still has them.
"""

from __future__ import annotations

import logging
import os
import struct
import uuid
import zlib
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from threading import Lock
from typing import Any

import msgspec
from sqlalchemy import Connection, insert, select
from sqlalchemy.exc import DBAPIError

from tappet.disk_full import is_disk_full
from tappet.server import audit
from tappet.server.audit import Act, Result
from tappet.server.auth import sessions
from tappet.server.auth.identity import Identity
from tappet.server.database import Database
from tappet.server.tables import audit as audit_table

log = logging.getLogger(__name__)
FILE = "audit.reserve"
SIZE = 1 << 20
"""Bytes of the file: some thousand acts."""
MOST = 20_000
"""Entries; what does not fit into the file is in memory only."""
MAX_TEXT = 200
"""Longer values are cut in the file."""
_HEAD = struct.Struct("<II")  # length and checksum of the entry behind it; 0: there is none
_CHUNK = 1 << 16


class _Entry(msgspec.Struct, omit_defaults=True):
    """One line of the file: a row, what became of it, or the end of a session."""

    key: str = ""
    """Of the row that begins or is completed here."""
    columns: dict[str, Any] | None = None
    """Of a row that begins."""
    result: str = ""
    reason: str | None = None
    session_id: str = ""
    """Of a session that ends."""


class AuditReserve:
    """The file. Its methods block; they may be called from any thread."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        self._lock = Lock()
        self._entries: list[_Entry] = []
        self._end = 0
        self._moved: dict[str, int] = {}
        """Rows that came into the database before their acts were done, by their keys."""
        self._lost = 0
        """Acts for which there was no room in memory either; they are in the log of the server only."""
        self.prepare()

    def prepare(self) -> None:
        """Makes the file, unless it is there. Without room for it, stopping acts are done and only logged."""
        with self._lock:
            try:
                if not self._path.exists() or self._path.stat().st_blocks * 512 < SIZE:
                    content = self._path.read_bytes()[:SIZE] if self._path.exists() else b""
                    self._fill(content)
                self._read()
            except OSError as error:
                log.error("acts that stop something cannot be recorded on a full disk: %s", error)

    def _fill(self, content: bytes) -> None:
        """Every byte is written: what was never written may need room later."""
        fd = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            for at in range(len(content), SIZE, _CHUNK):
                os.pwrite(fd, bytes(min(_CHUNK, SIZE - at)), at)
            if content:
                os.pwrite(fd, content, 0)
            os.fsync(fd)
        except OSError:
            if not content:
                self._path.unlink(missing_ok=True)
            raise
        finally:
            os.close(fd)

    def _read(self) -> None:
        data = self._path.read_bytes()
        self._entries, self._end = [], 0
        for entry, end in _entries(data):
            self._entries.append(entry)
            self._end = end
        if any(data[self._end :]):  # torn: what is whole behind it would be read again
            self._zero(self._end, len(data))

    # -- acts --------------------------------------------------------------------------------------------

    def keep(self, who: Identity, *acts: Act) -> list[str]:
        """Keeps rows of acts that are to be done next; returns their keys. It never raises."""
        keys: list[str] = []
        volatile: list[Act] = []
        for act in acts:
            columns = {k: _short(v) for k, v in audit.columns(who.username, who.address, act).items()}
            key = uuid.uuid4().hex
            if len(self._entries) < MOST:
                keys.append(key)
            else:
                self._lost += 1
            if not self._append(_Entry(key=key, columns=columns)):
                volatile.append(act)
        if volatile:
            first = f"{volatile[0].action} of {_short(volatile[0].subject)}"
            text = "%d acts of %s are lost for the audit log when this process ends, first: %s"
            log.error(text, len(volatile), who.username, first)
        return keys

    def complete(self, keys: list[str], result: Result, reason: str | None) -> list[int]:
        """What became of kept acts; returns the ids of those that are in the database by now."""
        rows = []
        for key in keys:
            with self._lock:
                row = self._moved.pop(key, None)
            if row is not None:
                rows.append(row)
            else:
                self._append(_Entry(key=key, result=result.value, reason=_short(reason)))
        return rows

    def end_session(self, session_id: str) -> None:
        """A session that the database cannot forget now."""
        self._append(_Entry(session_id=session_id))

    def has_ended(self, session_id: str | None) -> bool:
        """Whether a session that the database still has was ended."""
        return any(entry.session_id == session_id for entry in self._entries if entry.session_id)

    def _append(self, entry: _Entry) -> bool:
        """Whether the entry is in the file."""
        data = msgspec.msgpack.encode(entry)
        with self._lock:
            if len(self._entries) >= MOST:
                return False
            self._entries.append(entry)
            try:
                if self._end + _HEAD.size + len(data) > SIZE or not self._path.exists():
                    return False
                fd = os.open(self._path, os.O_WRONLY | os.O_CLOEXEC)
                try:
                    os.pwrite(fd, _HEAD.pack(len(data), zlib.crc32(data)) + data, self._end)
                    os.fdatasync(fd)
                finally:
                    os.close(fd)
            except OSError as error:
                log.error("the reserve of the audit log cannot be written: %s", error)
                return False
            self._end += _HEAD.size + len(data)
            return True

    # -- back into the database --------------------------------------------------------------------------

    def move(self, database: Database) -> None:
        """Brings all that is kept into the database; raises DBAPIError while that takes nothing."""
        if not self._entries:
            return
        with self._lock:
            moved = database.write(self._store)
            self._moved |= moved
            self._clear()

    def try_move(self, database: Database) -> None:
        """`move`, when it can be done now."""
        try:
            self.move(database)
        except (DBAPIError, OSError) as error:
            if not is_disk_full(error):
                log.exception("the reserve of the audit log cannot be brought into the database")

    def _store(self, db: Connection) -> dict[str, int]:
        """Stores all; returns the rows whose acts are not done yet."""
        begun: dict[str, int] = {}
        results = {e.key: (e.result, e.reason) for e in self._entries if e.result}
        for entry in self._entries:
            if entry.columns is not None:
                row = {**entry.columns, "at": datetime.fromisoformat(entry.columns["at"])}
                same = [audit_table.c[name] == row[name] for name in ("at", "username", "action", "subject")]
                if db.scalar(select(audit_table.c.id).where(*same)) is None:  # else: killed before `_clear`
                    result, reason = results.get(entry.key, (Result.BEGUN.value, None))
                    query = insert(audit_table).values(**row, result=result, reason=reason)
                    number = db.scalar(query.returning(audit_table.c.id))
                    if entry.key not in results and number is not None:
                        begun[entry.key] = number
            if entry.session_id:
                sessions.end_by_id(db, entry.session_id)
        if self._lost:
            act = Act("audit-reserve-full", f"{self._lost} acts are in the log of the server only")
            audit.write(db, "server", "console", act)
        return begun

    def _clear(self) -> None:
        self._zero(0, self._end)
        self._entries, self._end, self._lost = [], 0, 0

    def _zero(self, start: int, end: int) -> None:
        fd = os.open(self._path, os.O_WRONLY | os.O_CLOEXEC)
        try:
            os.pwrite(fd, bytes(end - start), start)
            os.fdatasync(fd)
        finally:
            os.close(fd)


def _entries(data: bytes) -> Iterator[tuple[_Entry, int]]:
    """The whole entries of a file, each with where it ends."""
    at = 0
    while at + _HEAD.size <= len(data):
        length, check = _HEAD.unpack_from(data, at)
        content = data[at + _HEAD.size : at + _HEAD.size + length]
        if not length or len(content) < length or zlib.crc32(content) != check:
            return
        try:
            entry = msgspec.msgpack.decode(content, type=_Entry)
        except msgspec.MsgspecError:
            return
        at += _HEAD.size + length
        yield entry, at


def _short(value: Any) -> Any:
    """As it is kept in the file."""
    if isinstance(value, datetime):
        return value.isoformat()
    return value[:MAX_TEXT] if isinstance(value, str) else value
