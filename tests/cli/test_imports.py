"""What a command does not import: each module here once cost every call its time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAM = "PROGRAM Main\nVAR n : INT; t : TON; END_VAR\nt(IN := TRUE);\nn := n + 1;\nEND_PROGRAM\n"
SCRIPT = """
import contextlib, io, json, sys
from tappet.cli import main
with contextlib.redirect_stdout(io.StringIO()):
    code = main(sys.argv[1:])
print(json.dumps([code, sorted(sys.modules)]))
"""
WEB = ("fastapi", "starlette", "uvicorn", "httpx", "sqlalchemy", "alembic", "viser", "websockets", "asyncio")
NETWORK = ("ssl", "http", "urllib.request", "xmlrpc")
FOREIGN = (
    *WEB,
    *NETWORK,
    "pydantic",
    "numpy",
    "lsprotocol",
    "click",
    "rich",
    "zoneinfo",
    "importlib.metadata",
)
ROOMS = ("tappet.server", "tappet.bench", "tappet.project.model", "tappet.project.exchange")
MACHINE_CODE = ("llvmlite.binding", "ctypes", "subprocess", "elftools", "tappet.codegen.emit_module")
AFTER_AN_EDIT = ("tappet.lang.analysis.edits", "tappet.core.edits.relower")
OPTIONAL = ("tappet.lang.rules.coding.operands", "tappet.lang.conditional.select")


def modules_of(*arguments: str) -> set[str]:
    """The modules of a process after a command that goes well."""
    command = [sys.executable, "-c", SCRIPT, *arguments]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "backend")}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    code, modules = json.loads(done.stdout.splitlines()[-1])
    assert code == 0
    return set(modules)


def test_version_and_help_import_the_table_of_commands_only() -> None:
    for option in ("--version", "--help"):
        ours = {name for name in modules_of(option) if name.split(".")[0] == "tappet"}
        assert ours == {"tappet", "tappet.cli", "tappet.cli.commands", "tappet.cli.errors"}


@pytest.mark.parametrize(
    ("arguments", "unwanted"),
    [
        (("check",), (*FOREIGN, *ROOMS, *MACHINE_CODE, *AFTER_AN_EDIT, *OPTIONAL, "tappet.runtime.plc")),
        (("run", "--virtual"), (*FOREIGN, *ROOMS, *AFTER_AN_EDIT, *OPTIONAL, "elftools")),
        (
            ("library", "show", "TON"),
            (*FOREIGN, *ROOMS, *MACHINE_CODE, "tappet.codegen", "tappet.lang.analysis"),
        ),
    ],
    ids=lambda value: value[0] if isinstance(value[0], str) else None,
)
def test_a_command_imports_what_it_needs_only(
    arguments: tuple[str, ...], unwanted: tuple[str, ...], tmp_path: Path
) -> None:
    if arguments[0] != "library":
        file = tmp_path / "small.st"
        file.write_text(PROGRAM, encoding="utf-8")
        arguments = (arguments[0], str(file), *arguments[1:])
    modules_of(*arguments)  # what the first one of all stores is there for the second
    found = modules_of(*arguments)
    assert found.isdisjoint(unwanted), sorted(found.intersection(unwanted))


def test_the_modules_that_are_not_wanted_exist() -> None:
    """A name that is spelt wrong, or gone, would guard nothing."""
    from importlib.util import find_spec

    for name in (*FOREIGN, *ROOMS, *MACHINE_CODE, *AFTER_AN_EDIT, *OPTIONAL, "tappet.runtime.plc"):
        assert find_spec(name) is not None, name
