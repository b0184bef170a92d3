"""Opening the database and bringing its schema up to date."""

from __future__ import annotations

import json
import os
import re
import sqlite3
import time
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

from sqlalchemy import Connection, Engine, create_engine, event, inspect, make_url, text
from sqlalchemy.engine.interfaces import DBAPIConnection
from sqlalchemy.exc import ArgumentError, OperationalError
from sqlalchemy.pool import ConnectionPoolEntry

from tappet.project.errors import ProjectError
from tappet.project.store.tables import complete_for

if TYPE_CHECKING:
    from alembic.config import Config

BUSY_TIMEOUT_MS = 15_000
"""How long a connection waits for SQLite's lock before it gives up."""

_MIGRATION_LOCK = 7_461_707_065
"""Key of the advisory lock that lets one process at a time migrate a PostgreSQL database."""

_ONE_AT_A_TIME = Lock()  # Alembic keeps the running migration in a global

_MIGRATIONS = Path(__file__).parent / "migrations"
_REVISION = re.compile(r"^(revision|down_revision) = \"(.*)\"$", re.MULTILINE)


class StoreError(ProjectError):
    """The database cannot be used."""

    code = "store"


def open_engine(url: str) -> Engine:
    """An engine for `sqlite:///path` or `postgresql://user@host/name`, as DATABASE_URL has it.

    SQLite runs in WAL mode with foreign keys. Raises StoreError for other databases.
    """
    try:
        address = make_url(url)
    except (
        ArgumentError,
        ValueError,
    ):  # the message of neither names the place; the text may hold a password
        raise StoreError(
            "The address of the database is no URL; use sqlite:///file or postgresql://user@host/name"
        ) from None
    if address.drivername in ("postgres", "postgresql"):
        address = address.set(drivername="postgresql+psycopg")
    name = address.get_backend_name()
    if name not in ("sqlite", "postgresql"):
        raise StoreError(f"'{name}' is no database of the store; use sqlite:///file or postgresql://...")
    complete_for(name)
    if name == "sqlite" and address.database not in (None, "", ":memory:"):
        _keep_private(Path(address.database))
    engine = create_engine(address, json_serializer=_json, pool_pre_ping=name == "postgresql")
    if name == "sqlite":
        event.listen(engine, "connect", _prepare_sqlite)
        event.listen(engine, "begin", _begin_sqlite)
    return engine


def _keep_private(file: Path) -> None:
    """Lets nobody else read the database. SQLite gives its log files the mode that the database has."""
    with suppress(OSError):  # what cannot be opened is reported by who opens it
        os.close(os.open(file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600))
        for one in (file, Path(f"{file}-wal"), Path(f"{file}-shm")):
            if one.exists():
                one.chmod(0o600)


def reading(engine: Engine) -> Engine:
    """The same engine for transactions that only read, each seeing one state of the database.

    Other transactions take SQLite's write lock when they begin: taking it later, after a read, would fail
    whenever somebody else has written in between.
    """
    if engine.dialect.name == "sqlite":
        return engine.execution_options(tappet_reads_only=True)
    return engine.execution_options(isolation_level="REPEATABLE READ", postgresql_readonly=True)


def migrate(engine: Engine) -> None:
    """Bring the schema to the newest revision; safe when several processes start at once.

    Raises StoreError when the database cannot be reached, or was made by a newer Tappet.
    """
    try:
        if engine.dialect.name == "sqlite":
            _use_write_ahead_log(engine)
        _upgrade(engine)
    except OperationalError as error:
        where = engine.url.render_as_string(hide_password=True)
        raise StoreError(f"The database {where} cannot be used: {error.orig}") from error


def _upgrade(engine: Engine) -> None:
    if _is_newest(engine):
        return
    from alembic import command
    from alembic.util import CommandError

    config = _config()
    with (
        _ONE_AT_A_TIME,
        engine.begin() as connection,
    ):
        if engine.dialect.name == "postgresql":
            connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": _MIGRATION_LOCK})
        config.attributes["connection"] = connection
        try:
            command.upgrade(config, "head")
        except CommandError as error:
            if "Can't locate revision" not in str(error):
                raise
            raise StoreError(
                "The database was written by a newer version of Tappet; start that version, "
                f"or restore a backup made with this one ({error})"
            ) from error


def _is_newest(engine: Engine) -> bool:
    """Whether there is nothing to migrate, which every start but one finds: Alembic takes long to import."""
    with reading(engine).connect() as connection:
        if not inspect(connection).has_table("alembic_version"):
            return False
        return connection.execute(text("SELECT version_num FROM alembic_version")).all() == [
            (newest_revision(),)
        ]


def newest_revision() -> str:
    """The schema revision that `migrate` leads to: the one that no other builds on."""
    revisions: set[str] = set()
    bases: set[str | None] = set()
    for file in (_MIGRATIONS / "versions").glob("[0-9]*.py"):
        facts = dict(_REVISION.findall(file.read_text(encoding="utf-8")))
        revisions.add(facts["revision"])
        bases.add(facts.get("down_revision"))
    (newest,) = revisions - bases
    return newest


def _config() -> Config:
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(_MIGRATIONS).replace("%", "%%"))
    return config


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def _use_write_ahead_log(engine: Engine) -> None:
    """Switch a SQLite file to WAL, which it then stays in; unlike others, this lock is not waited for."""
    deadline = time.monotonic() + BUSY_TIMEOUT_MS / 1000
    while True:
        try:
            with engine.connect() as connection:
                connection.connection.cursor().execute("PRAGMA journal_mode = WAL").close()
            return
        except sqlite3.DatabaseError as error:
            if "locked" not in str(error) or time.monotonic() > deadline:
                raise StoreError(f"The database {engine.url.database} cannot be used: {error}") from error
            time.sleep(0.02)


def _prepare_sqlite(connection: DBAPIConnection, _entry: ConnectionPoolEntry) -> None:
    connection.isolation_level = None  # the driver begins no transactions of its own; _begin_sqlite does
    cursor = connection.cursor()
    cursor.execute(f"PRAGMA busy_timeout = {BUSY_TIMEOUT_MS}")
    cursor.execute("PRAGMA foreign_keys = ON")
    cursor.close()


def _begin_sqlite(connection: Connection) -> None:
    reads_only = connection.get_execution_options().get("tappet_reads_only", False)
    connection.exec_driver_sql("BEGIN" if reads_only else "BEGIN IMMEDIATE")
