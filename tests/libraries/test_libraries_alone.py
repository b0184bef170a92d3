"""Each library builds without a message where no other one is referenced: what it uses it requires itself."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import tappet.libraries
from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.catalog import items

ROOT = Path(tappet.libraries.__file__).parent
NAMES = sorted(json.loads(path.read_text())["name"] for path in ROOT.glob("*/library.json"))


@pytest.mark.parametrize("name", NAMES)
def test_a_library_builds_alone(name: str) -> None:
    library = load(name)
    blocks = [item.name for item in items(library) if item.kind == "function_block"]
    variables = "\n".join(
        f"    v{number} : {library.namespace}.{block};" for number, block in enumerate(blocks)
    )
    source = Source("program", f"PROGRAM Main\nVAR\n{variables}\nEND_VAR\nEND_PROGRAM\n")
    options = BuildOptions(libraries=(LibraryReference(name),))
    result = build_application([source], options=options, session=BuildSession())
    messages = [str(d) for d in result.diagnostics if d.severity in ("error", "warning")]
    assert [message for message in messages if not message.startswith("program:")] == []
