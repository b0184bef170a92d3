"""TIME literals and bare numbers of microseconds, as the task editor takes them (TASK-17, tasks EX-04)."""

from __future__ import annotations

import re
from decimal import Decimal

from tappet.project.errors import InvalidTimeError

UNIT_NS = {
    "d": 86_400_000_000_000,
    "h": 3_600_000_000_000,
    "m": 60_000_000_000,
    "s": 1_000_000_000,
    "ms": 1_000_000,
    "us": 1_000,
    "ns": 1,
}
"""Nanoseconds of each unit of a TIME or LTIME literal."""

LONGEST_NS = 2**63 - 1
"""The largest duration the runtime's clock can hold."""

_LITERAL = re.compile(r"(?:T|TIME|LT|LTIME)#(?P<parts>[0-9_.a-z]+)", re.IGNORECASE | re.ASCII)
_PART = re.compile(r"(?P<number>\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?)(?P<unit>ms|us|ns|d|h|m|s)", re.IGNORECASE)
_MICROSECONDS = re.compile(r"\d+", re.ASCII)


def duration_ns(text: str) -> int:
    """Nanoseconds of a TIME literal (`t#200ms`, `T#1s500ms`) or of a bare number of microseconds (`300`).

    Raises InvalidTimeError when the text is neither. Source: TASK-17.
    """
    literal = text.strip()
    if _MICROSECONDS.fullmatch(literal):
        # a number with more than 19 digits is too long anyway; int() of a huge text would take its time
        nanoseconds = int(literal) * UNIT_NS["us"] if len(literal) <= 19 else LONGEST_NS + 1
    else:
        nanoseconds = _literal_ns(literal)
    if nanoseconds > LONGEST_NS:
        raise InvalidTimeError(f"'{_shown(text)}' is longer than a task can wait (292 years)")
    return nanoseconds


def _literal_ns(literal: str) -> int:
    """Nanoseconds of `T#...`: units in falling order, each at most once, a fraction only in the last one."""
    match = _LITERAL.fullmatch(literal)
    if match is None or len(literal) > 200:
        raise _invalid(literal)
    parts = match["parts"].strip("_")
    total = Decimal(0)
    position = 0
    last_unit = UNIT_NS["d"] + 1
    while position < len(parts):
        part = _PART.match(parts, position)
        if part is None:
            raise _invalid(literal)
        unit = UNIT_NS[part["unit"].lower()]
        position = part.end()
        if unit >= last_unit or ("." in part["number"] and position < len(parts)):
            raise _invalid(literal)
        last_unit = unit
        total += Decimal(part["number"].replace("_", "")) * unit
        if position < len(parts) and parts[position] == "_":
            position += 1
    if position == 0:
        raise _invalid(literal)
    return int(total)


def _invalid(literal: str) -> InvalidTimeError:
    return InvalidTimeError(
        f"'{_shown(literal)}' is no time. Write a TIME literal such as T#20ms or T#500us, "
        "or a number of microseconds"
    )


def _shown(text: str) -> str:
    return text if len(text) <= 40 else text[:37] + "..."
