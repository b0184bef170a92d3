"""What bodies lowered from graphs ask of a program: texts with types, names that no text holds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from tappet.iec.languages import language_of
from tappet.lang import ast
from tappet.lang.languages import reader_of
from tappet.lang.parser import parse


def with_libraries(units: Sequence[ast.Unit], earlier: Sequence[ast.Unit]) -> Sequence[ast.Unit]:
    """The units, and those of the libraries that graphs need, from an earlier analysis if it had one."""
    languages: set[str] = set()
    for unit in units:
        if unit.graphs:
            languages |= unit.graphs
    added = [unit for name in sorted(languages) for unit in _library(name, units, earlier)]
    return [*units, *added] if added else units


def _library(language: str, units: Iterable[ast.Unit], earlier: Iterable[ast.Unit]) -> list[ast.Unit]:
    source = reader_of(language).library()
    if source is None or any(unit.source.library == source.library for unit in units):
        return []
    kept = [unit for unit in earlier if unit.source.library == source.library]
    return kept[:1] or [parse(source).unit]


def looks_names_up(unit: ast.Unit) -> bool:
    """Whether bodies of a text depend on names that do not stand in it."""
    return any(language_of(language).implicit_names for language in unit.graphs)


def implicit_names(units: Iterable[ast.Unit]) -> tuple[str, ...]:
    """How upper-case names begin that graphs of a program look for although no text holds them."""
    languages = {language for unit in units if unit.graphs for language in unit.graphs}
    return tuple(prefix for name in languages if (prefix := language_of(name).implicit_names))
