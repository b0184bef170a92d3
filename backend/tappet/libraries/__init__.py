"""The IEC libraries, those of the product and those installed besides, written in ST, and their loader.

One folder a library: `library.json` and one `.st` file a POU. May import lang. Start with `load`;
`repository` finds versions and placeholders, `archive` installs libraries.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache

from tappet.lang.source import Scope, Source
from tappet.libraries import repository
from tappet.libraries.repository import NEWEST, ROOT, Installed, Requirement, UnknownLibraryError

APPLICATION = "the application"
Reference = tuple[str, str, str | None] | tuple[str, str, str | None, str | None]


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
    stands_for: tuple[str, ...] = ()
    """Libraries of other systems that it takes the place of."""


def names() -> tuple[str, ...]:
    """Names of the libraries to choose from, sorted; those that only the compiler calls are left out."""
    return tuple(dict.fromkeys(item.name for item in repository.installed() if not item.internal))


def every_version() -> list[Library]:
    """All libraries to choose from in all versions, by name, newest first."""
    return [_load(item, item.namespace, _label(item)) for item in repository.installed() if not item.internal]


def load(name: str, version: str = NEWEST, namespace: str | None = None) -> Library:
    """The library with its sources under `namespace`: its own, or a placeholder's name, unless given.

    `name` may be a full reference such as `Util, * (Tappet)`.
    Raises UnknownLibraryError, with what is installed, when there is no such library or version.
    """
    found = repository.find(name, version)
    return _load(found, namespace or repository.namespace_of(found, name), _label(found))


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


def resolve(references: Iterable[Reference]) -> tuple[list[Library], list[str]]:
    """The libraries of an application and what they need, each once (LIB-05).

    A reference is name, version, namespace or None for the usual one, and the name of the placeholder that it
    resolves, if it is one: a library that needs the placeholder gets this library. `*` in a requirement means
    the version that the application refers to, else the newest one. A version besides the one of the
    application is private: only what needs it sees it. The second part says what is missing, and where the
    application gives two libraries one namespace.
    """
    return _Resolution(list(references)).outcome()


@dataclass(slots=True)
class _Used:
    """A library in use, under the namespace that it has here."""

    item: Installed
    space: str
    user: str
    private: bool = False
    uses: list[tuple[str, str]] = field(default_factory=list)


class _Resolution:
    """Finds each library that is needed, once; the first that takes a namespace has it."""

    def __init__(self, references: Iterable[Reference]) -> None:
        self.problems: list[str] = []
        self._found: dict[str, _Used] = {}
        self._placeholders: dict[str, _Used] = {}
        for reference in references:
            self._refer(*reference)

    def outcome(self) -> tuple[list[Library], list[str]]:
        done = 0
        while done < len(self._found):
            used = list(self._found.values())[done]
            done += 1
            for required in used.item.requires:
                self._require(used, required)
        libraries = [
            _load(used.item, used.space, _label(used.item), tuple(used.uses), used.private)
            for used in self._found.values()
        ]
        return libraries, self.problems

    def _refer(self, name: str, version: str, namespace: str | None, placeholder: str | None = None) -> None:
        """A reference of the application."""
        try:
            item = repository.find(name, version)
        except UnknownLibraryError as error:
            self.problems.append(str(error))
            return
        space = namespace or repository.namespace_of(item, placeholder or name)
        known = self._found.setdefault(space.upper(), _Used(item, space, APPLICATION))
        if known.item != item:
            self.problems.append(
                f"{known.user} uses '{known.item.name}' {known.item.version} and {APPLICATION} '{item.name}' "
                f"{item.version} under the namespace '{space}'; give one of them another namespace"
            )
        elif placeholder:
            self._placeholders.setdefault(placeholder.upper(), known)

    def _require(self, user: _Used, required: Requirement) -> None:
        """A library that another one needs: the one that is there, or beside it under a name of its own."""
        resolved = self._placeholders.get(required.name.upper())
        try:
            item = resolved.item if resolved else repository.find(required.name, required.version)
        except UnknownLibraryError as error:
            self.problems.append(f"'{user.item.name}' needs it: {error}")
            return
        same = [used for used in self._found.values() if used.item.name.upper() == item.name.upper()]
        wanted = required.namespace or repository.namespace_of(item, required.name)
        there = resolved or next(
            (used for used in same if required.version == NEWEST or used.item.version == item.version), None
        )
        if there is None:
            there = self._beside(item, wanted, f"'{user.item.name}'", private=bool(same))
        if there is not user and (wanted, there.space) not in user.uses:
            user.uses.append((wanted, there.space))

    def _beside(self, item: Installed, wanted: str, user: str, *, private: bool) -> _Used:
        private = private or wanted.upper() in self._found
        space = wanted
        if private:
            version = re.sub(r"\W", "_", item.version)
            space = f"{wanted}_{version}"
            while space.upper() in self._found:
                space += "_"
        return self._found.setdefault(space.upper(), _Used(item, space, user, private))


def _label(item: Installed) -> str:
    """First part of the names of its texts: the version is told where it is not the newest one."""
    newest = repository.find(item.name)
    return item.name if newest.version == item.version else f"{item.name} {item.version}"


@lru_cache(maxsize=128)
def _load(
    item: Installed, space: str, label: str, uses: tuple[tuple[str, str], ...] = (), private: bool = False
) -> Library:
    sources = tuple(
        Source(
            uri=f"{label}/{path.stem}",
            text=path.read_text(encoding="utf-8"),
            scope=Scope.LIBRARY,
            name=path.stem,
            library=item.name,
            namespace=space,
            uses=uses,
            private=private,
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
        tuple(known.name for known in item.stands_for),
    )


__all__ = ["ROOT", "Library", "UnknownLibraryError", "as_called", "every_version", "load", "names", "resolve"]
