"""Which installed library has something of a name, so that the editor can offer to refer to it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from tappet import libraries


def libraries_with(name: str) -> Sequence[str]:
    """Names of the installed libraries that have a POU, type or list of a name, newest versions only."""
    return _index(libraries.names()).get(name.upper(), ())


@lru_cache(maxsize=2)
def _index(names: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for library in names:
        for source in libraries.load(library).sources:
            key = (source.name or source.uri.rpartition("/")[2]).upper()
            found[key] = (*found.get(key, ()), library)
    return found
