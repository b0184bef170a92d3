"""A library as it was loaded: plain data."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.lang.source import Source
from tappet.libraries.repository import Requirement


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
    qualified_only: bool = False
    """Its names are used behind the namespace only."""
    removable: bool = False
    """It was installed besides those of the product."""
    replaces: tuple[str, ...] = ()
    """Libraries of other systems that this one replaces."""
