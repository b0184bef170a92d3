"""Warnings that the text switches off: `{warning disable W1122}` to `{warning restore W1122}`, and rules of
static analysis: `{analysis -33}` to `{analysis +33}`, by the number of CODESYS or by the code here."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence

from tappet.lang import ast
from tappet.lang.diagnostics import TABLE, Diagnostic
from tappet.lang.source import split_lines

_PRAGMA = re.compile(r"\{\s*warning\s+(disable|restore)\s+([\w ,]+?)\s*\}", re.IGNORECASE)
_ANALYSIS = re.compile(
    r"\{\s*(?:analysis|attribute\s+'analysis'\s*:=\s*')\s*([-+][^'}]*?)'?\s*\}", re.IGNORECASE
)
_RULE = re.compile(r"([-+])\s*(?:SA)?(\d{1,4}|[WS]\d{4}|NC\d+)\b", re.IGNORECASE)
_NAMES = ("S1001", "S1002", "S1003", "S1004")
"""What the naming conventions of CODESYS (NC0001 ...) are here."""
_Ranges = list[tuple[str, int, int]]


def kept(found: Sequence[Diagnostic], units: Iterable[ast.Unit]) -> list[Diagnostic]:
    """The messages without the warnings and notes that a pragma switches off at their place.

    A pragma names codes of this compiler, of CODESYS V3 (C0195) or its static analysis (33 for SA0033), and
    counts from its line to that of the restore, or to the end of the text. Errors cannot be switched off.
    """
    concerned = {d.uri for d in found if d.severity != "error"}
    ranges: dict[str, _Ranges] = {}
    for unit in units:
        source = unit.source
        if source.uri not in concerned:
            continue
        lower = source.text.lower()
        if "disable" in lower or "analysis" in lower:
            ranges.setdefault(source.uri, []).extend(_ranges(source.text))
    if not ranges:
        return list(found)
    return [d for d in found if d.severity == "error" or not _is_off(d, ranges.get(d.uri, ()))]


def without_warnings(found: Sequence[Diagnostic], codes: Collection[str]) -> list[Diagnostic]:
    """The messages without the warnings and notes of these codes; an error stays, whatever its code."""
    return [d for d in found if d.severity == "error" or d.code not in codes] if codes else list(found)


def _is_off(d: Diagnostic, ranges: Iterable[tuple[str, int, int]]) -> bool:
    names = (d.code, *TABLE[d.code].aliases)
    return any(code in names and first <= d.span.line <= last for code, first, last in ranges)


def _ranges(text: str) -> _Ranges:
    made: _Ranges = []
    begun: dict[str, int] = {}
    lines = split_lines(text)
    for number, line in enumerate(lines):
        for code, off in _switches(line):
            if off:
                begun.setdefault(code, number)
            elif code in begun:
                made.append((code, begun.pop(code), number))
    return made + [(code, first, len(lines)) for code, first in begun.items()]


def _switches(line: str) -> Iterator[tuple[str, bool]]:
    """The codes that a line switches, and whether off."""
    for match in _PRAGMA.finditer(line):
        for code in re.split(r"[\s,]+", match[2].upper()):
            yield code, match[1].lower() == "disable"
    for match in _ANALYSIS.finditer(line):
        for sign, rule in _RULE.findall(match[1]):
            codes = (f"SA{int(rule):04}",) if rule.isdigit() else (rule.upper(),)
            for code in _NAMES if rule[:2].upper() == "NC" else codes:
                yield code, sign == "-"
