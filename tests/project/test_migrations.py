"""One schema history for the whole database, run at every start."""

import importlib
from pathlib import Path
from threading import Thread

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import text

from tappet.project.store import Store, engine
from tappet.project.store.engine import StoreError, migrate, newest_revision, open_engine
from tappet.project.store.tables import metadata


def test_the_migrated_schema_is_that_of_the_tables(store: Store) -> None:
    importlib.import_module("tappet.server.tables")  # the server's tables are on the same metadata
    with store.engine.connect() as connection:

        def ours(_object: object, name: str | None, kind: str, *_: object) -> bool:
            return kind != "table" or name in metadata.tables

        context = MigrationContext.configure(connection, opts={"include_object": ours, "compare_type": True})
        assert compare_metadata(context, metadata) == []
        assert context.get_current_revision() == newest_revision()
    assert ScriptDirectory(str(Path(engine.__file__).parent / "migrations")).get_heads() == [
        newest_revision()
    ]


def test_several_processes_may_start_at_once(database_url: str) -> None:
    failed: list[BaseException] = []

    def start() -> None:
        try:
            engine = open_engine(database_url)
            migrate(engine)
            engine.dispose()
        except BaseException as error:
            failed.append(error)

    threads = [Thread(target=start) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []
    engine = open_engine(database_url)
    with engine.connect() as connection:
        assert connection.execute(text("SELECT count(*) FROM alembic_version")).scalar() == 1
    engine.dispose()


def test_a_database_of_a_newer_version_is_left_alone(database_url: str) -> None:
    Store(database_url).close()
    engine = open_engine(database_url)
    with engine.begin() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '9999_later'"))
    with pytest.raises(StoreError, match="newer version of Tappet"):
        migrate(engine)
    with engine.begin() as connection:
        assert connection.execute(text("SELECT version_num FROM alembic_version")).scalar() == "9999_later"
    engine.dispose()


def test_other_databases_are_refused() -> None:
    with pytest.raises(StoreError, match="'mysql' is no database of the store"):
        open_engine("mysql://localhost/x")


def test_a_database_that_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match=r"missing/x\.db cannot be used: unable to open database file"):
        Store(f"sqlite:///{tmp_path}/missing/x.db")
    (tmp_path / "text.db").write_text("this is no database" * 100)
    with pytest.raises(StoreError, match="cannot be used: file is not a database"):
        Store(f"sqlite:///{tmp_path}/text.db")


@pytest.mark.postgres
def test_a_server_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match=r"postgresql\+psycopg://ann:\*\*\*@.* cannot be used"):
        Store(f"postgresql://ann:secret@/x?host={tmp_path}")
