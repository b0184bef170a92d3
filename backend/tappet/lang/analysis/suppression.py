"""Warnings that the text switches off: `{warning disable W1122}` to `{warning restore W1122}`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import split_lines

_PRAGMA = re.compile(r"\{\s*warning\s+(disable|restore)\s+([\w ,]+?)\s*\}", re.IGNORECASE)
_Ranges = list[tuple[str, int, int]]


def kept(found: Sequence[Diagnostic], units: Iterable[ast.Unit]) -> list[Diagnostic]:
    """The messages without the warnings and notes that a pragma switches off at their place.

    A pragma names codes of this compiler or of CODESYS V3, and counts from its line to that of the restore,
    or to the end of the text. Errors cannot be switched off.
    """
    concerned = {d.uri for d in found if d.severity != "error"}
    ranges: dict[str, _Ranges] = {}
    for unit in units:
        source = unit.source
        if source.uri in concerned and "disable" in source.text.lower():
            ranges.setdefault(source.uri, []).extend(_ranges(source.text))
    if not ranges:
        return list(found)
    return [d for d in found if d.severity == "error" or not _is_off(d, ranges.get(d.uri, ()))]


def _is_off(d: Diagnostic, ranges: Iterable[tuple[str, int, int]]) -> bool:
    names = (d.code, d.alias or d.code)
    return any(code in names and first <= d.span.line <= last for code, first, last in ranges)


def _ranges(text: str) -> _Ranges:
    made: _Ranges = []
    begun: dict[str, int] = {}
    lines = split_lines(text)
    for number, line in enumerate(lines):
        for match in _PRAGMA.finditer(line):
            for code in re.split(r"[\s,]+", match[2].upper()):
                if match[1].lower() == "disable":
                    begun.setdefault(code, number)
                elif code in begun:
                    made.append((code, begun.pop(code), number))
    return made + [(code, first, len(lines)) for code, first in begun.items()]
