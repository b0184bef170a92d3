"""The IEC libraries, those of the product and those installed besides, written in ST, and their loader.

One folder a library: `library.json` and one `.st` file a POU. May import lang. Start with `load`;
`repository` finds versions and placeholders, `archive` installs libraries.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from tappet.lang.source import Scope, Source
from tappet.libraries import repository
from tappet.libraries.repository import NEWEST, ROOT, Installed, Requirement, UnknownLibraryError

APPLICATION = "the application"


@dataclass(frozen=True, slots=True)
class Library:
    """An installed library with its sources."""

    name: str
    version: str
    namespace: str
    company: str
    description: str
    sources: tuple[Source, ...]
    requires: tuple[Requirement, ...] = ()
    removable: bool = False
    """It was installed besides those of the product."""


def names() -> tuple[str, ...]:
    """Names of the libraries to choose from, sorted; those that only the compiler calls are left out."""
    return tuple(dict.fromkeys(item.name for item in repository.installed() if not item.internal))


def every_version() -> list[Library]:
    """All libraries to choose from in all versions, by name, newest first."""
    return [_load(item, item.namespace) for item in repository.installed() if not item.internal]


def load(name: str, version: str = NEWEST, namespace: str | None = None) -> Library:
    """The library with its sources under `namespace`: its own, or a placeholder's name, unless given.

    `name` may be a full reference such as `Util, * (Tappet)`.
    Raises UnknownLibraryError, with what is installed, when there is no such library or version.
    """
    found = repository.find(name, version)
    return _load(found, namespace or repository.namespace_of(found, name))


def as_called(name: str, texts: Iterable[str]) -> str:
    """The name to refer to a library by in texts that qualify by a placeholder, such as `Tc2_Standard.TON`.

    The library's own name qualifies in any case.
    """
    item = repository.find(name)
    for known in item.stands_for:
        pattern = re.compile(rf"(?<![\w.]){re.escape(known.name)}\s*\.", re.IGNORECASE)
        if known.name.upper() != item.name.upper() and any(pattern.search(text) for text in texts):
            return known.name
    return item.name


def resolve(references: Iterable[tuple[str, str, str | None]]) -> tuple[list[Library], list[str]]:
    """The libraries of an application (name, version, namespace) and what they need, each once (LIB-05).

    `*` in a requirement means the version that the application refers to, else the newest one. The second
    part says what is missing, and where two libraries would share a namespace.
    """
    found: dict[str, Library] = {}
    users: dict[str, str] = {}
    problems: list[str] = []

    def choose(name: str, version: str, namespace: str | None, user: str) -> None:
        try:
            library = load(name, version, namespace)
        except UnknownLibraryError as error:
            problems.append(f"{user} needs it: {error}" if user != APPLICATION else str(error))
            return
        key = library.namespace.upper()
        known = found.setdefault(key, library)
        first = users.setdefault(key, user)
        if (known.name, known.version) != (library.name, library.version):
            problems.append(
                f"{first} uses '{known.name}' {known.version} and {user} '{library.name}' {library.version} "
                f"under the namespace '{library.namespace}'; give one of them another namespace"
            )

    for name, version, namespace in references:
        choose(name, version, namespace, APPLICATION)
    done = 0
    while done < len(found):
        library = list(found.values())[done]
        done += 1
        for required in library.requires:
            present = any(known.name.upper() == required.name.upper() for known in found.values())
            if required.version != NEWEST or not present:
                choose(required.name, required.version, required.namespace or None, f"'{library.name}'")
    return list(found.values()), problems


@lru_cache(maxsize=64)
def _load(item: Installed, space: str) -> Library:
    newest = repository.find(item.name)
    label = item.name if newest.version == item.version else f"{item.name} {item.version}"
    sources = tuple(
        Source(
            uri=f"{label}/{path.stem}",
            text=path.read_text(encoding="utf-8"),
            scope=Scope.LIBRARY,
            name=path.stem,
            library=item.name,
            namespace=space,
        )
        for path in sorted(item.folder.glob("*.st"))
    )
    return Library(
        item.name,
        item.version,
        space,
        item.company,
        item.description,
        sources,
        item.requires,
        item.removable,
    )


__all__ = ["ROOT", "Library", "UnknownLibraryError", "as_called", "every_version", "load", "names", "resolve"]
