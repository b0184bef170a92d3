"""The IEC libraries, those of the product and those installed besides, written in ST, and their loader.

One folder a library: `library.json` and one `.st` file a POU. May import lang. Start with `load`;
`repository` finds versions and placeholders, `parameters` gives values, `archive` installs libraries.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import lru_cache

from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import NOWHERE, Scope, Source, Use
from tappet.libraries import repository
from tappet.libraries.library import Library
from tappet.libraries.repository import NEWEST, ROOT, Installed, Requirement, UnknownLibraryError
from tappet.project.library_reference import LibraryReference, ParameterValue

APPLICATION = "the application"


def names() -> tuple[str, ...]:
    """Names of the libraries to choose from, sorted; those that only the compiler calls are left out."""
    return tuple(dict.fromkeys(item.name for item in repository.installed() if not item.internal))


def every_version() -> list[Library]:
    """All libraries to choose from in all versions, by name, newest first."""
    return [_whole(item, item.namespace) for item in repository.installed() if not item.internal]


def load(name: str, version: str = NEWEST, namespace: str | None = None) -> Library:
    """The library with its sources under `namespace`: its own, or a placeholder's name, unless given.

    `name` may be a full reference such as `Util, * (Tappet)`.
    Raises UnknownLibraryError, with what is installed, when there is no such library or version.
    """
    found = repository.find(name, version)
    return _whole(found, namespace or repository.namespace_of(found, name))


def as_called(name: str, texts: Iterable[str]) -> str:
    """The name to refer to a library by in texts that qualify by a placeholder, such as `Tc2_Standard.TON`.

    The library's own name qualifies in any case.
    """
    item = repository.find(name)
    for known in item.replaces:
        pattern = re.compile(rf"(?<![\w.]){re.escape(known.name)}\s*\.", re.IGNORECASE)
        if known.name.upper() != item.name.upper() and any(pattern.search(text) for text in texts):
            return known.name
    return item.name


def resolve(references: Iterable[LibraryReference]) -> tuple[list[Library], list[Diagnostic]]:
    """The libraries of an application and what they need, each once (LIB-05).

    A library that needs a placeholder gets the one whose reference resolves it. `*` in a requirement means
    the version that the application refers to, else the newest one. A version besides the one of the
    application is private: only what needs it sees it. Parameters have the values of the application's
    references; those it gives none, the values that other libraries ask for, the first one that does.
    The second part says what is missing, where the application gives two libraries one namespace, and which
    values are for no parameter.
    """
    return _Resolution(list(references)).outcome()


@dataclass(slots=True)
class _Used:
    """A library in use, under the namespace that it has here."""

    item: Installed
    space: str
    user: str
    private: bool = False
    qualified_only: bool = False
    place: str = ""
    """Path of the library manager whose reference brings it in."""
    uses: list[Use] = field(default_factory=list)
    given: list[tuple[ParameterValue, str]] = field(default_factory=list)
    """Values for its parameters, with where they are given: paths of library managers."""


class _Resolution:
    """Finds each library that is needed, once; the first that takes a namespace has it."""

    def __init__(self, references: Iterable[LibraryReference]) -> None:
        self.problems: list[Diagnostic] = []
        self._found: dict[str, _Used] = {}
        self._placeholders: dict[str, _Used] = {}
        for reference in references:
            self._refer(reference)

    def outcome(self) -> tuple[list[Library], list[Diagnostic]]:
        for used in list(self._found.values()):
            self._complete(used)
        done = 0
        while done < len(self._found):
            used = list(self._found.values())[done]
            done += 1
            for required in used.item.requires:
                self._require(used, required)
        return [self._loaded(used) for used in self._found.values()], self.problems

    def _loaded(self, used: _Used) -> Library:
        only = used.qualified_only or used.item.qualified_only
        library = _load(used.item, used.space, _label(used.item), only, tuple(used.uses), used.private)
        if not used.given:
            return library
        from tappet.libraries.parameters import Given, with_values

        given = [Given(parameter, place) for parameter, place in used.given]
        sources, unknown = with_values(library.sources, given, library.name)
        self.problems += unknown
        return replace(library, sources=sources)

    def _problem(self, place: str, message: str) -> None:
        self.problems.append(report("E0902", place, NOWHERE, message=message))

    def _refer(self, reference: LibraryReference) -> None:
        """A reference of the application."""
        place = reference.place
        try:
            item = repository.find(reference.name, reference.version)
        except UnknownLibraryError as error:
            self._problem(place, str(error))
            return
        placeholder = reference.placeholder
        space = reference.namespace or repository.namespace_of(item, placeholder or reference.name)
        known = self._found.setdefault(space.upper(), _Used(item, space, APPLICATION, place=place))
        if known.item != item:
            self._problem(
                place,
                f"{known.user} uses '{known.item.name}' {known.item.version} and {APPLICATION} '{item.name}' "
                f"{item.version} under the namespace '{space}'; give one of them another namespace",
            )
            return
        known.given += [(parameter, place) for parameter in reference.parameters]
        known.qualified_only |= reference.qualified_only
        if placeholder:
            self._placeholders.setdefault(placeholder.upper(), known)

    def _complete(self, used: _Used) -> None:
        """What another system has in one library and we have in several shares the namespace, unless the
        application refers to the further part itself."""
        for item in repository.completing(used.space):
            if all(other.item.name != item.name for other in self._found.values()):
                further = _Used(
                    item, used.space, APPLICATION, qualified_only=used.qualified_only, place=used.place
                )
                self._found[f"{used.space.upper()} {item.name.upper()}"] = further

    def _require(self, user: _Used, required: Requirement) -> None:
        """A library that another one needs: the one that is there, or beside it under a name of its own."""
        resolved = self._placeholders.get(required.name.upper())
        try:
            item = resolved.item if resolved else repository.find(required.name, required.version)
        except UnknownLibraryError as error:
            self._problem(user.place, f"'{user.item.name}' needs it: {error}")
            return
        same = [used for used in self._found.values() if used.item.name.upper() == item.name.upper()]
        wanted = required.namespace or repository.namespace_of(item, required.name)
        there = resolved or next(
            (used for used in same if required.version == NEWEST or used.item.version == item.version), None
        )
        if there is None:
            there = self._beside(item, wanted, user, private=bool(same))
        there.given += [(parameter, user.place) for parameter in required.parameters]
        use = Use(wanted, there.space, required.qualified_only or item.qualified_only)
        if there is not user and use not in user.uses:
            user.uses.append(use)

    def _beside(self, item: Installed, wanted: str, user: _Used, *, private: bool) -> _Used:
        private = private or wanted.upper() in self._found
        space = wanted
        if private:
            version = re.sub(r"\W", "_", item.version)
            space = f"{wanted}_{version}"
            while space.upper() in self._found:
                space += "_"
        used = _Used(item, space, f"'{user.item.name}'", private, place=user.place)
        return self._found.setdefault(space.upper(), used)


def _label(item: Installed) -> str:
    """First part of the names of its texts: the version is part of it where it is not the newest one."""
    newest = repository.find(item.name)
    return item.name if newest.version == item.version else f"{item.name} {item.version}"


def _whole(item: Installed, space: str) -> Library:
    """The library by itself, as it is shown."""
    return _load(item, space, _label(item), item.qualified_only)


@lru_cache(maxsize=128)
def _load(
    item: Installed,
    space: str,
    label: str,
    qualified_only: bool,
    uses: tuple[Use, ...] = (),
    private: bool = False,
) -> Library:
    sources = tuple(
        Source(
            uri=f"{label}/{path.stem}",
            text=path.read_text(encoding="utf-8"),
            scope=Scope.LIBRARY,
            name=path.stem,
            library=item.name,
            namespace=space,
            qualified_only=qualified_only,
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
        qualified_only,
        item.removable,
        tuple(known.name for known in item.replaces),
    )


__all__ = ["ROOT", "Library", "UnknownLibraryError", "as_called", "every_version", "load", "names", "resolve"]
