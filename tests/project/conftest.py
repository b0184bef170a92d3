"""Databases for the store's tests: a SQLite file, and a PostgreSQL server that the session starts."""

import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import psycopg
import pytest
from tests.project.project_paths import APP, stored_at

from tappet.project.model import ProjectObject
from tappet.project.store import Store


def postgres_binaries() -> Path | None:
    """Where initdb and pg_ctl are: Debian's place or the PATH."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    if found:
        return found[-1].parent
    on_path = shutil.which("initdb")
    return Path(on_path).parent if on_path else None


@pytest.fixture(scope="session")
def postgres_server() -> Iterator[str]:
    """Socket directory of a PostgreSQL server of this session; it runs as `postgres` when we are root."""
    binaries = postgres_binaries()
    if binaries is None:
        pytest.skip("no PostgreSQL server binaries are installed (Debian: apt-get install postgresql)")
    as_postgres: dict[str, object] = {}
    if os.geteuid() == 0:
        account = pwd.getpwnam("postgres")
        as_postgres = {"user": account.pw_uid, "group": account.pw_gid, "extra_groups": []}
    home = Path(tempfile.mkdtemp(prefix="tappet-pg-"))
    if as_postgres:
        os.chown(home, account.pw_uid, account.pw_gid)
    cluster = home / "data"

    def run(*command: str) -> None:
        done = subprocess.run(
            [str(binaries / command[0]), *command[1:]],
            cwd=home,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            **as_postgres,  # type: ignore[call-overload]
        )
        assert done.returncode == 0, done.stdout

    try:
        run("initdb", "-D", str(cluster), "-U", "postgres", "-A", "trust", "-E", "UTF8", "--no-sync")
        options = (
            f"-c listen_addresses='' -c unix_socket_directories={home} -c fsync=off -c max_connections=40"
        )
        run("pg_ctl", "-D", str(cluster), "-w", "-l", str(home / "log"), "-o", options, "start")
        try:
            yield str(home)
        finally:
            run("pg_ctl", "-D", str(cluster), "-w", "-m", "immediate", "stop")
    finally:
        shutil.rmtree(home, ignore_errors=True)


@pytest.fixture
def postgres_url(postgres_server: str) -> Iterator[str]:
    """URL of a fresh database on the session's PostgreSQL server."""
    name = f"t{os.urandom(6).hex()}"
    with psycopg.connect(host=postgres_server, user="postgres", dbname="postgres", autocommit=True) as server:
        server.execute(f"CREATE DATABASE {name}")
        try:
            yield f"postgresql://postgres@/{name}?host={postgres_server}"
        finally:
            server.execute(f"DROP DATABASE {name} WITH (FORCE)")


@pytest.fixture(params=["sqlite", pytest.param("postgres", marks=pytest.mark.postgres)])
def database_url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """An empty database: each test runs on both kinds."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/tappet.db"
    url: str = request.getfixturevalue("postgres_url")
    return url


@pytest.fixture
def store(database_url: str) -> Iterator[Store]:
    """An open store on an empty database."""
    opened = Store(database_url)
    yield opened
    opened.close()


@pytest.fixture
def pid(store: Store) -> str:
    """Id of a new project in the store."""
    return store.create_project("Press", "ann").id


@pytest.fixture
def prg(store: Store, pid: str) -> ProjectObject:
    """The program of that project."""
    return stored_at(store, pid, f"{APP}/PLC_PRG")
