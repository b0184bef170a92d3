"""Texts as the compiler reads them, from the project, the folder or the library that hands them over."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from tappet.iec.places import BodyText, Segment, SourceMap


class Scope(StrEnum):
    """Where an object lives; an inner scope hides an outer one (spec CON-06..CON-09)."""

    APPLICATION = "application"
    POUS = "pous"
    LIBRARY = "library"


@dataclass(frozen=True, slots=True)
class GivenValue:
    """The value that a library reference gives to a parameter of the list that a text declares."""

    name: str
    """The parameter."""
    value: str
    """An expression as written."""
    place: str
    """Where it stands, for messages: the path of the library manager."""


class Use(NamedTuple):
    """A library that another one needs."""

    name: str
    """The name that the needing library gives to it."""
    label: str
    """The namespace under which it is here."""
    qualified_only: bool = False
    """Its names are used behind that name only."""


@dataclass(frozen=True, slots=True)
class Source:
    """One text the compiler reads: a whole POU, DUT, GVL, or a method, property or action of a POU.

    `uri` names the text in diagnostics: a file path, or an object path such as `FB_Motor.Start`.
    """

    uri: str
    text: str
    scope: Scope = Scope.APPLICATION
    owner: str | None = None
    """Name of the POU a METHOD / PROPERTY / ACTION text belongs to, None for whole objects."""
    name: str | None = None
    """Name of the object where the text carries none: a GVL, or an action given as bare body."""
    library: str | None = None
    """Name of the library the text comes from (scope LIBRARY)."""
    namespace: str | None = None
    """Namespace under which the library is referenced; its objects are visible with and without it."""
    body_line: int = 0
    """0-based line where the implementation begins, when declaration and body are edited apart; 0 = one
    text."""
    bodies: tuple[BodyText, ...] = ()
    """Where the first words of bodies do not show their language, or are drawn, in order of the lines."""
    uses: tuple[Use, ...] = ()
    """Libraries that the text's library needs."""
    private: bool = False
    """Only libraries that use this one see it: the application has another version of it."""
    qualified_only: bool = False
    """The application sees the library's objects behind the namespace only (LIB-08)."""
    given: tuple[GivenValue, ...] = ()
    """Values that the reference to the library gives to parameters of this list, in place of its own."""
    map: SourceMap | None = field(default=None, compare=False)
    """Which parts of which objects the lines show; None for a text that is a document of its own."""

    @property
    def segments(self) -> tuple[Segment, ...]:
        """The parts of objects that the lines show; none for a text that is a document of its own."""
        return () if self.map is None else self.map.segments


def source_maps(sources: Iterable[Source]) -> dict[str, SourceMap]:
    """What the lines of texts show, by upper-case uri.

    An object of the application hides one of the POUs view with the same name.
    """
    ordered = sorted(sources, key=lambda source: source.scope is Scope.APPLICATION)
    return {source.uri.upper(): source.map for source in ordered if source.map is not None}
