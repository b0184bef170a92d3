"""The IEC libraries that come with Tappet, written in ST, and the loader of their sources.

One folder a library: `library.json` and one `.st` file a POU. May import lang. Start with `load`.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from tappet.lang.source import Scope, Source

ROOT = Path(__file__).resolve().parent


class UnknownLibraryError(LookupError):
    """No library of this name, or not in this version, is installed."""


@dataclass(frozen=True, slots=True)
class Library:
    """An installed library with its sources."""

    name: str
    version: str
    namespace: str
    company: str
    description: str
    sources: tuple[Source, ...]


@cache
def names() -> tuple[str, ...]:
    """Names of the libraries to choose from, sorted; those that only the compiler calls are left out."""
    return tuple(name for name in _installed() if not _facts(name).get("internal", False))


def _installed() -> list[str]:
    return sorted(path.parent.name for path in ROOT.glob("*/library.json"))


def _facts(name: str) -> dict[str, Any]:
    facts: dict[str, Any] = json.loads((ROOT / name / "library.json").read_text(encoding="utf-8"))
    return facts


@cache
def load(name: str, version: str = "*", namespace: str | None = None) -> Library:
    """The library with its sources under `namespace` (its own unless given).

    Raises UnknownLibraryError, with the names that are installed, when there is no such library or version.
    """
    by_name = {known.upper(): known for known in _installed()}
    found = by_name.get(name.upper())
    if found is None:
        raise UnknownLibraryError(f"library '{name}' is not installed; installed are {', '.join(names())}")
    folder = ROOT / found
    facts = _facts(found)
    if version not in ("*", facts["version"]):
        raise UnknownLibraryError(
            f"library '{found}' is installed in version {facts['version']}, not {version}; "
            "choose that version or * for the newest"
        )
    space = namespace or str(facts["namespace"])
    sources = tuple(
        Source(
            uri=f"{found}/{path.stem}",
            text=path.read_text(encoding="utf-8"),
            scope=Scope.LIBRARY,
            name=path.stem,
            library=found,
            namespace=space,
        )
        for path in sorted(folder.glob("*.st"))
    )
    company, description = str(facts["company"]), str(facts["description"])
    return Library(found, str(facts["version"]), space, company, description, sources)
