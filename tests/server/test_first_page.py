"""What the web server does not load to serve pages: compiler and soft PLC have processes of their own."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

SCRIPT = """
import asyncio, json, sys
from pathlib import Path
from tappet.server.app import create_app
from tappet.server.settings import ServerSettings

async def get(app, path):
    sent, requests = [], [{"type": "http.request"}]
    async def receive():
        return requests.pop() if requests else await asyncio.Event().wait()  # the client stays connected
    async def send(message):
        sent.append(message)
    await app({
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": "GET", "scheme": "http",
        "path": path, "raw_path": path.encode(), "query_string": b"", "root_path": "",
        "headers": [(b"host", b"localhost:8080")], "client": ("127.0.0.1", 1), "server": ("127.0.0.1", 8080),
    }, receive, send)
    return sent[0]["status"]

async def main():
    app = create_app(ServerSettings(data_dir=Path(sys.argv[1]), local_runtime=False))
    async with app.router.lifespan_context(app):
        found = [await get(app, path) for path in ("/api/v1/health", "/", "/api/v1/projects")]
        print(json.dumps([found, sorted(sys.modules)]))

asyncio.run(main())
"""
ROOMS = {
    "cnc",
    "iec",
    "project",
    "server",
    "runtime",
    "codegen",
    "lang",
    "libraries",
    "motion",
    "traces",
    "translation",
}
LANGUAGE = {"coding_settings", "diagnostic_translations", "diagnostics", "nearest", "reference", "source"}
"""The tables of messages and of help, and what reports of other processes consist of."""
CODE = {
    "converted_values", "display", "expressions", "faults", "literals", "package", "symbol_map",
    "symbol_types", "values", "variable_changes",
}  # fmt: skip
"""How a package and the values in a running one are read."""
MOTION = {"axis_measurement", "loops", "paths"}
"""What is asked of a controller to measure an axis, and words for the colours of a path; others compute."""
UNWANTED = {
    "llvmlite", "lsprotocol", "httpx", "viser", "numpy", "pyarrow", "rich", "sqlalchemy.dialects.postgresql",
    "tappet.libraries.catalog", "tappet.project.exchange.importing", "tappet.project.exchange.plcopen_write",
    "tappet.runtime.plc", "tappet.runtime.executive.loader",
    "tappet.runtime.unit_tests.runner", "tappet.server.lsp.session", "tappet.server.analysis.worker",
    "tappet.server.builds.worker",
}  # fmt: skip


def test_pages_are_served_without_the_compiler(tmp_path: Path) -> None:
    command = [sys.executable, "-c", SCRIPT, str(tmp_path)]
    for _ in range(2):  # the first one makes the database
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    statuses, loaded = json.loads(done.stdout.splitlines()[-1])
    assert statuses[0] == 200
    assert statuses[2] == 401
    names = [name.split(".") for name in loaded if name.startswith("tappet.")]
    rooms = {parts[1] for parts in names if find_spec(f"tappet.{parts[1]}").submodule_search_locations}
    assert rooms == ROOMS
    assert {parts[2] for parts in names if parts[1] == "lang" and parts[2:]} == LANGUAGE
    assert {parts[2] for parts in names if parts[1] == "codegen" and parts[2:]} == CODE
    assert {parts[2] for parts in names if parts[1] == "motion" and parts[2:]} == MOTION
    assert UNWANTED.isdisjoint(loaded), UNWANTED.intersection(loaded)


def test_what_is_not_wanted_exists() -> None:
    for name in UNWANTED:
        assert find_spec(name) is not None, name
