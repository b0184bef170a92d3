"""Where libraries are installed, which versions there are, and what a reference such as `Util, *` means.

Each location holds `<Name>/<version>/library.json` with the `.st` files beside it; the libraries that come
with the product stand in `<Name>/` (LIB-02, LIB-08).
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from tappet.project.library_reference import ParameterValue

ROOT = Path(__file__).resolve().parent
"""The libraries that come with the product."""
LOCATION_VARIABLE = "TAPPET_LIBRARIES"
"""Environment variable: the folder of libraries that are installed besides; a server's processes share it."""
NEWEST = "*"
_DESIGNATION = re.compile(
    r"^\s*(?P<name>[^,()]+?)\s*(?:,\s*(?P<version>[^()]+?)\s*)?(?:\((?P<company>.*)\)\s*)?$"
)


class UnknownLibraryError(LookupError):
    """No library of this name, or not in this version, is installed."""


@dataclass(frozen=True, slots=True)
class Designation:
    """A reference as it is written: `Util, 3.5.0.0 (Tappet)`, `Util, *`, or only `Util`."""

    name: str
    version: str = NEWEST
    company: str | None = None


@dataclass(frozen=True, slots=True)
class Requirement:
    """A library that a library needs."""

    name: str
    version: str = NEWEST
    namespace: str = ""
    parameters: tuple[ParameterValue, ...] = ()
    """Values of its parameters that the library asks for."""
    qualified_only: bool = False
    """The library that needs it uses its names behind the namespace only."""


@dataclass(frozen=True, slots=True)
class Installed:
    """A library in one version, as its `library.json` describes it."""

    folder: Path
    name: str
    version: str
    namespace: str
    company: str
    description: str
    qualified_only: bool
    """Its names are used behind the namespace only."""
    internal: bool
    """Only the compiler calls it."""
    replaces: tuple[Designation, ...]
    """Libraries of other systems that this one replaces (placeholders)."""
    completes: tuple[str, ...]
    """Upper-case namespaces of libraries of other systems whose second part it is."""
    requires: tuple[Requirement, ...]
    removable: bool
    stamp: int
    """Changes when the library is installed again."""


def user_location() -> Path:
    """The folder that libraries are installed in; it need not exist yet."""
    given = os.environ.get(LOCATION_VARIABLE)
    return Path(given) if given else Path.home() / ".tappet" / "libraries"


def designation(text: str, version: str = NEWEST) -> Designation:
    """Name, version and company of a reference; `version` holds where the text has none."""
    match = _DESIGNATION.match(text)
    if match is None:
        return Designation(text.strip(), version)
    written = match["version"] or version
    return Designation(match["name"], written if version == NEWEST else version, match["company"])


@lru_cache(maxsize=512)
def version_key(version: str) -> tuple[tuple[int, str], ...]:
    """Sorts versions by their numbers: 3.10 is newer than 3.9."""
    return tuple((int(part), "") if part.isdigit() else (-1, part) for part in version.split("."))


def installed() -> list[Installed]:
    """All libraries in all versions, by name, newest first."""
    found = [*_of_the_product(), *_in(user_location(), removable=True)]
    found.sort(key=lambda item: version_key(item.version), reverse=True)
    found.sort(key=lambda item: item.name.upper())
    return found


@cache
def _of_the_product() -> tuple[Installed, ...]:
    """They stay as they are while the process runs."""
    return tuple(_in(ROOT, removable=False))


def find(text: str, version: str = NEWEST) -> Installed:
    """The library a reference means: in its version, the newest one with `*`, or a placeholder's stand-in.

    Raises UnknownLibraryError, saying what is installed.
    """
    wanted = designation(text, version)
    everything = installed()
    named = [item for item in everything if item.name.upper() == wanted.name.upper()]
    if wanted.company is not None:
        named = [item for item in named if item.company.upper() == wanted.company.upper()] or (
            [item for item in named if _replaces(item, wanted)]
        )
    if not named:
        for item in everything:
            if _replaces(item, wanted):
                return item
        names = dict.fromkeys(item.name for item in everything if not item.internal)
        raise UnknownLibraryError(f"library '{text}' is not installed; installed are {', '.join(names)}")
    if wanted.version == NEWEST:
        return named[0]
    for item in named:
        if item.version == wanted.version:
            return item
    if wanted.company is not None and _replaces(named[0], wanted):
        return named[0]  # other systems number their libraries in their own way
    versions = " and ".join(item.version for item in named)
    raise UnknownLibraryError(
        f"library '{named[0].name}' is installed in version {versions}, not {wanted.version}; "
        "choose that version or * for the newest"
    )


def completing(namespace: str) -> list[Installed]:
    """The libraries, in their newest versions, that are further parts of another system's library."""
    found: dict[str, Installed] = {}
    for item in installed():
        if namespace.upper() in item.completes:
            found.setdefault(item.name, item)
    return list(found.values())


def namespace_of(item: Installed, text: str) -> str:
    """The prefix of a library's names under a reference: a placeholder keeps its own name if it is a word."""
    name = designation(text).name
    if name.upper() == item.name.upper() or not name.isidentifier():
        return item.namespace
    return name


def _replaces(item: Installed, wanted: Designation) -> bool:
    return any(
        known.name.upper() == wanted.name.upper()
        and (
            wanted.company is None or known.company is None or known.company.upper() == wanted.company.upper()
        )
        for known in item.replaces
    )


def _in(location: Path, *, removable: bool) -> Iterator[Installed]:
    for pattern in ("*/library.json", "*/*/library.json"):
        for path in location.glob(pattern):
            try:
                stamp = path.stat().st_mtime_ns
                yield _read(path, stamp, removable)
            except (OSError, ValueError, KeyError, TypeError):
                continue  # half removed, or not ours: what is listed can be loaded


def _requirement(facts: Mapping[str, Any]) -> Requirement:
    return Requirement(
        str(facts["name"]),
        str(facts.get("version", NEWEST)),
        str(facts.get("namespace", "")),
        tuple(
            ParameterValue(str(one.get("list", "")), str(one["name"]), str(one["value"]))
            for one in facts.get("parameters", ())
        ),
        bool(facts.get("qualified_only", False)),
    )


@lru_cache(maxsize=512)
def _read(path: Path, stamp: int, removable: bool) -> Installed:
    facts: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return Installed(
        folder=path.parent,
        name=str(facts["name"]),
        version=str(facts["version"]),
        namespace=str(facts.get("namespace") or facts["name"]),
        company=str(facts.get("company", "")),
        description=str(facts.get("description", "")),
        qualified_only=bool(facts.get("qualified_only", False)),
        internal=bool(facts.get("internal", False)),
        replaces=tuple(designation(text) for text in facts.get("replaces", ())),
        completes=tuple(str(name).upper() for name in facts.get("completes", ())),
        requires=tuple(_requirement(required) for required in facts.get("requires", ())),
        removable=removable,
        stamp=stamp,
    )
