"""`tappet serve` on PostgreSQL: what is saved survives the server."""

from __future__ import annotations

from pathlib import Path

import psycopg
import pytest
from live_server import RUNTIME, Script, process, station
from tests.project import conftest as databases

postgres_server, postgres_url = databases.postgres_server, databases.postgres_url

pytestmark = pytest.mark.postgres
BODY = "n := n + 1; // Zähler 计数器 🙂"
DECLARATION = "PROGRAM PLC_PRG\nVAR\n    n : DINT;\nEND_VAR"


def test_projects_live_in_the_database(postgres_url: str, tmp_path: Path) -> None:
    with station(tmp_path, DATABASE_URL=postgres_url) as plant:
        script = plant.admin
        script.create_project("Auf PostgreSQL 项目")
        script.save("PLC_PRG", declaration=DECLARATION, implementation="n := n + 2;")
        saved = script.save("PLC_PRG", declaration=DECLARATION, implementation=BODY)
        late = {**saved["data"], "implementation": "n := n + 3;"}
        stale = {"base_revision": saved["revision"] - 1, "data": late}
        refused = script.call("PUT", f"{script.project}/objects/{saved['id']}", stale, 409)
        assert refused["current"]["revision"] == saved["revision"]
        script.download()
        script.wait_for_state("run")
        script.write("PLC_PRG.n", 1000)
        tree = script.get(f"{script.project}/objects")
        history = script.get(f"{script.project}/objects/{saved['id']}/revisions")
        assert [e["revision"] for e in history] == sorted((e["revision"] for e in history), reverse=True)
        secret = script.http.headers["Authorization"]
    assert not list((tmp_path / "data").glob("*.sqlite")), "nothing is stored beside the database"
    with psycopg.connect(postgres_url) as database:
        assert database.execute("SELECT count(*) FROM projects").fetchone() == (1,)

    with station(tmp_path, DATABASE_URL=postgres_url) as plant:
        again: Script = plant.script(secret.removeprefix("Bearer "))
        again.project_id, again.application_id, again.ids = (
            script.project_id,
            script.application_id,
            script.ids,
        )
        assert [p["name"] for p in again.get("/projects")] == ["Auf PostgreSQL 项目"]
        assert again.get(f"{again.project}/objects") == tree
        assert again.read_object("PLC_PRG") == saved
        assert again.get(f"{again.project}/objects/{saved['id']}/revisions") == history
        assert again.relation() == "same", "the server knows what it has downloaded"
        assert again.value("PLC_PRG.n") > 0
        back = again.post(
            f"{again.project}/objects/{saved['id']}/revert", {"revision": history[1]["revision"]}
        )
        assert back["data"]["implementation"] == "n := n + 2;"
        assert back["revision"] > saved["revision"]
        (write,) = again.get("/audit?action=write")
        assert (write["subject"], write["new_value"]) == ("PLC_PRG.n", "1000")
        assert again.get(RUNTIME)["connected"] is True


@pytest.mark.parametrize(
    ("url", "says"),
    [
        ("postgresql://nobody:sesame@/nothing?host=/nonexistent", "No such file or directory"),
        ("nonsense", "postgresql://user@host/name"),
    ],
)
def test_a_database_that_cannot_be_used_is_named(tmp_path: Path, url: str, says: str) -> None:
    log = tmp_path / "log"
    command = ["serve", "--port", "0", "--data", str(tmp_path / "data"), "--no-runtime"]
    with process(command, log, DATABASE_URL=url) as started:
        assert started.wait(60) == 1
    said = log.read_text()
    assert said.startswith("error: ")
    assert says in said
    assert "sesame" not in said
    assert "Traceback" not in said
