"""The messages of the compiler: one table of codes, and the values that carry a message to its reader.

`diagnostics.csv` is the only list of codes, severities and texts. E00xx lexer, E01xx parser, E02xx names,
E03xx types, E04xx declarations, E05xx calls, E06xx layout and addresses, E07xx tasks, E08xx statements;
W1xxx warnings and notes; S1xxx coding rules. `alias` names the numbers that CODESYS V3 and its static
analysis give the same message, separated by spaces.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from tappet.lang.source import Source, Span

Severity = Literal["error", "warning", "info"]
_SEVERITIES: dict[str, Severity] = {"error": "error", "warning": "warning", "info": "info"}


@dataclass(frozen=True, slots=True)
class Entry:
    """One row of the table. `message` and `advice` are templates with named fields; a field `hint` that the
    place of the fault gives, such as the closest name, takes the place of the advice."""

    code: str
    severity: Severity
    name: str
    aliases: tuple[str, ...]
    message: str
    advice: str


@dataclass(frozen=True, slots=True)
class Related:
    """Another place that explains a message, such as the first of two declarations."""

    message: str
    uri: str
    span: Span


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One message: what is wrong (`message`), where (`uri`, `span`) and what would be right (`advice`)."""

    code: str
    severity: Severity
    message: str
    advice: str
    uri: str
    span: Span
    related: tuple[Related, ...] = ()
    facts: Mapping[str, str] = field(default_factory=dict, compare=False)
    """What the message is about: the fields of the report, such as `name`, `source`, `target`."""
    element: str | None = None
    """Id of the drawn element that the message is at, where `with_elements` has found one."""

    @property
    def alias(self) -> str:
        """The number of the same message in CODESYS V3 (`C0032`), the first one, or ''."""
        return next(iter(TABLE[self.code].aliases), "")

    @property
    def name(self) -> str:
        """Short name of the code, as in the table."""
        return TABLE[self.code].name

    def __str__(self) -> str:
        """`uri:line:column: severity code: message advice` with 1-based line and column."""
        place = f"{self.uri}:{self.span.line + 1}:{self.span.column + 1}"
        at = "" if self.element is None else f"Element {self.element}: "
        text = f"{place}: {self.severity} {self.code}: {at}{self.message}"
        return f"{text}. {self.advice}" if self.advice else text

    def record(self) -> dict[str, object]:
        """For machines: `file`, place (lines and columns from 1), `severity`, `code`, `message`, `advice`."""
        return {
            "file": self.uri,
            "line": self.span.line + 1,
            "column": self.span.column + 1,
            "end_line": self.span.end_line + 1,
            "end_column": self.span.end_column + 1,
            "element": self.element,
            "severity": self.severity,
            "code": self.code,
            "message": self.message,
            "advice": self.advice,
        }


def _read_table() -> dict[str, Entry]:
    text = Path(__file__).with_name("diagnostics.csv").read_text(encoding="utf-8")
    table: dict[str, Entry] = {}
    for row in csv.DictReader(text.splitlines()):
        code = row["code"]
        if code in table:
            raise ValueError(f"diagnostics.csv lists {code} twice")
        table[code] = Entry(
            code,
            _SEVERITIES[row["severity"]],
            row["name"],
            tuple(row["alias"].split()),
            row["message"],
            row["advice"],
        )
    return table


def with_severity(found: Sequence[Diagnostic], errors: frozenset[str]) -> list[Diagnostic]:
    """The messages, those whose code is in `errors` as errors."""
    return [replace(d, severity="error") if d.code in errors else d for d in found]


def with_elements(found: Sequence[Diagnostic], sources: Iterable[Source]) -> list[Diagnostic]:
    """The messages, those about drawn bodies with the elements that they are at."""
    maps = {source.uri: source.map for source in sources if source.map is not None and source.bodies}
    if not maps:
        return list(found)
    return [replace(d, element=maps[d.uri].place(d.span).element) if d.uri in maps else d for d in found]


TABLE: dict[str, Entry] = _read_table()
"""All messages by code."""
CODING_RULES = frozenset(code for code in TABLE if code.startswith("S"))
"""Codes of the optional rules."""
WARNINGS = frozenset(code for code, entry in TABLE.items() if entry.severity != "error") - CODING_RULES
"""Codes of the warnings and notes of the compiler; a project can switch each one off."""


def report(
    code: str,
    uri: str,
    span: Span,
    related: Iterable[Related] = (),
    /,
    **fields: object,
) -> Diagnostic:
    """A message of the table with its fields filled in; all but `hint` are its facts, also fields that no
    template names.

    Raises KeyError when the code, or a field its templates name, is missing: a fault of the caller.
    """
    entry = TABLE[code]
    return Diagnostic(
        code,
        entry.severity,
        entry.message.format_map(fields),
        str(fields.get("hint") or "") or entry.advice.format_map(fields),
        uri,
        span,
        tuple(related),
        {name: str(value) for name, value in fields.items() if name != "hint"},
    )
