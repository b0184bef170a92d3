"""The literals of IEC 61131-3: what they look like in a text, and their values (spec LTYP-30..LTYP-40).

`decode` never raises: what is wrong with a literal comes back as the code and fields of a diagnostic.
Values are in the unit of their kind: TIME and TOD in ms, LTIME, LTOD, LDATE and LDT in ns, DATE and DT in s.
"""

from __future__ import annotations

import math
import re
import struct
from dataclasses import dataclass, field, replace
from datetime import date
from fractions import Fraction
from typing import Final

from tappet.iec.words import STRING_TYPES, elementary_type

_NUMBER: Final = r"\d\w*+(?:\#\w*+|(?:\.\d\w*+)?+(?:(?<=\d[eE])[+-]\d\w*+)?+)"
BASED_OR_REAL: Final = _NUMBER
"""Digits and what may follow them: `12`, `16#FF`, `1.5e-3`. `decode` refuses what is no number."""
QUOTED: Final = r"""'(?:[^'$\r\n]|\$[^\r\n])*+\$?+'?+|"(?:[^"$\r\n]|\$[^\r\n])*+\$?+"?+"""
"""A string that ends in its line, or the rest of the line."""
DATE_OR_TIME: Final = (
    r"(?i:L?(?:D|DT|DATE|TOD|TIME_OF_DAY|DATE_AND_TIME))\#\d\w*+(?:[-:]\d\w*+)*+(?:\.\d\w*+)?+"
)
TYPED: Final = rf"[^\W\d]\w*+\#(?:[+-]?+{_NUMBER}|{QUOTED}|\w*+)"
"""A prefix and a number, a string or a name: `INT#5`, `STRING#'a'`, `Colour#Red`."""
OVER_LINES: Final = {
    quote: re.compile(rf"({quote}(?:\$[^\r\n]|[^{quote}$]){{0,32767}}{quote})[ \t]*(?=[;,)\]+=<>:]|\r?\n|$)")
    for quote in "'\""
}


def quoted_is_closed(piece: str) -> bool:
    """Whether the last quote of a string closes it, rather than being escaped by an odd number of `$`."""
    if len(piece) < 2 or piece[-1] != piece[0]:
        return False
    body = piece[1:-1]
    return (len(body) - len(body.rstrip("$"))) % 2 == 0


def quoted_over_lines(text: str, start: int) -> str:
    """The string that begins at `start` and ends on a later line, '' where a quote is missing rather.

    A quote is taken as the end when what follows can follow a string, and the first line does not end like a
    statement: without its end, a string would go on to the begin of the next one.
    """
    match = OVER_LINES[text[start]].match(text, start)
    if match is None or match[0].partition("\n")[0].rstrip().endswith(";"):
        return ""
    return match[1]


Value = bool | int | float | str | bytes | None


@dataclass(frozen=True, slots=True)
class Decoded:
    """A literal: `kind` and `prefix` as in `ast.Literal`; value None when `problem` says what is wrong."""

    kind: str
    prefix: str | None = None
    value: Value = None
    problem: str | None = None
    """Code of the diagnostic, None for a good literal. A warning (W...) comes with a value."""
    fields: dict[str, object] = field(default_factory=dict)


_INT = re.compile(r"[+-]?\d+(?:_\d+)*", re.ASCII)
_BASED = re.compile(r"(2|8|10|16)#([0-9A-F]+(?:_[0-9A-F]+)*)", re.ASCII | re.IGNORECASE)
_REAL = re.compile(r"[+-]?\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?(?:E[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_UNDERSCORES = re.compile(r"(?<=[0-9A-Za-z])__+(?=[0-9A-Za-z])", re.ASCII)
_TIME_PART = re.compile(r"(\d+(?:\.\d+)?)([a-z]*)", re.ASCII | re.IGNORECASE)
_DATE = re.compile(r"(\d{1,4})-(\d{1,2})-(\d{1,2})", re.ASCII)
_CLOCK = re.compile(r"(\d{1,2}):(\d{1,2})(?::(\d{1,2})(\.\d+)?)?", re.ASCII)
_ESCAPE = re.compile(r"\$(?:[0-9A-Fa-f]{2}|.)?", re.ASCII | re.DOTALL)
_WIDE_ESCAPE = re.compile(r"\$(?:[0-9A-Fa-f]{4}|.)?", re.ASCII | re.DOTALL)

_MAX_LENGTH: Final = 400  # characters of a numeric literal; more cannot be a value of any type
MAX_U32: Final = 2**32 - 1
MAX_U64: Final = 2**64 - 1
_NS_PER_S: Final = 1_000_000_000
_EPOCH: Final = date(1970, 1, 1).toordinal()

_TIME_KINDS: Final = {"T": "time", "TIME": "time", "LT": "ltime", "LTIME": "ltime"}
_DATE_KINDS: Final = {"D": "date", "DATE": "date", "LD": "ldate", "LDATE": "ldate"}
_TOD_KINDS: Final = {"TOD": "tod", "TIME_OF_DAY": "tod", "LTOD": "ltod", "LTIME_OF_DAY": "ltod"}
_DT_KINDS: Final = {"DT": "dt", "DATE_AND_TIME": "dt", "LDT": "ldt", "LDATE_AND_TIME": "ldt"}
_UNITS: Final = ("d", "h", "m", "s", "ms", "us", "ns")
_UNIT_NS: Final = {
    "d": 86_400 * _NS_PER_S,
    "h": 3_600 * _NS_PER_S,
    "m": 60 * _NS_PER_S,
    "s": _NS_PER_S,
    "ms": 1_000_000,
    "us": 1_000,
    "ns": 1,
}
_UNIT_LIMIT: Final = {"h": 23, "m": 59, "s": 59, "ms": 999, "us": 999, "ns": 999}
_ESCAPES: Final = {"L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t", "$": "$", "'": "'", '"': '"'}
_BOOLS: Final = {"TRUE": True, "1": True, "FALSE": False, "0": False}


def decode(text: str) -> Decoded:
    """A number, a string, or `PREFIX#...`; `X#name` where X is no elementary type is of kind 'enum'."""
    first = text[0]
    if first in "'\"":
        return _string(text, None)
    if "__" in text and text[-1] not in "'\"":
        found = _decode(_UNDERSCORES.sub("_", text))
        if found.problem is None and found.kind != "enum":
            return replace(found, problem="W1502", fields={"text": text})
    return _decode(text)


def _decode(text: str) -> Decoded:
    first = text[0]
    if "#" in text and not first.isdigit():
        prefix, _, body = text.partition("#")
        return _typed(text, prefix.upper(), body)
    return _number(text)


def _number(text: str) -> Decoded:
    if len(text) > _MAX_LENGTH:
        return _bad(text[:20] + "...", "int", "It has more digits than any type holds.")
    if _INT.fullmatch(text):
        return _integer(text, int(text.replace("_", "")))
    based = _BASED.fullmatch(text)
    if based:
        try:
            return _integer(text, int(based[2].replace("_", ""), int(based[1])))
        except ValueError:
            return _bad(text, "int", f"Base {based[1]} has no such digit.")
    if _REAL.fullmatch(text):
        value = float(text.replace("_", ""))
        if math.isinf(value):
            return _bad(text, "real", "The largest LREAL is 1.7976931348623157E308.")
        return Decoded("real", None, value)
    if "#" in text:
        return _bad(text, "int", "Write 2#1010, 8#17 or 16#FF.")
    parts = _TIME_PART.findall(text)
    if all(unit.lower() in _UNITS for _, unit in parts) and "".join(a + b for a, b in parts) == text:
        return Decoded("int", None, None, "E0016", {"text": text})
    if "__" in text or text.endswith("_"):
        return _bad(text, "int", "A single underscore may stand between two digits.")
    return _bad(text, "int", "A name cannot begin with a digit, and a number has digits only.")


def _integer(text: str, value: int) -> Decoded:
    if value > MAX_U64:
        return _bad(text, "int", "The largest number is 18446744073709551615 (ULINT).")
    return Decoded("int", None, value)


def _bad(text: str, kind: str, hint: str) -> Decoded:
    return Decoded(kind, None, None, "E0010", {"text": text, "hint": hint})


def _typed(text: str, prefix: str, body: str) -> Decoded:
    if prefix in _TIME_KINDS:
        return _duration(text, _TIME_KINDS[prefix], body)
    if prefix in _DATE_KINDS:
        return _date(text, _DATE_KINDS[prefix], body)
    if prefix in _TOD_KINDS:
        return _time_of_day(text, _TOD_KINDS[prefix], body)
    if prefix in _DT_KINDS:
        return _date_and_time(text, _DT_KINDS[prefix], body)
    if prefix in STRING_TYPES:
        quote = '"' if prefix == "WSTRING" else "'"
        if not (len(body) > 1 and body[0] == body[-1] == quote):
            return _wrong_kind(text, prefix, f"Write {prefix}#{quote}text{quote}.")
        return _string(body, prefix)
    elementary = elementary_type(prefix)
    if elementary is None:
        if body and (body[0] == "_" or body[0].isalpha()):
            return Decoded("enum")
        return Decoded("int", prefix, None, "E0017", {"prefix": prefix, "text": text})
    if elementary.family == "bool":
        value = _BOOLS.get(body.upper())
        if value is None:
            return _wrong_kind(text, prefix, "BOOL has the values TRUE, FALSE, 1 and 0.")
        return Decoded("bool", prefix, value)
    number = _number(body.lstrip("+-")) if body[:1] in ("+", "-") else _number(body) if body else None
    if number is None or isinstance(number.value, (str, bytes)) or number.value is None:
        hint = str(number.fields.get("hint", "")) if number else ""
        return _wrong_kind(text, prefix, hint or f"Write a number after {prefix}#.")
    magnitude = -number.value if body[0] == "-" else number.value
    if elementary.family == "real":
        return _real(text, prefix, float(magnitude), elementary.size)
    if isinstance(magnitude, float):
        return _wrong_kind(text, prefix, f"{prefix} holds whole numbers only.")
    bits = 8 * elementary.size
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if elementary.signed else (0, (1 << bits) - 1)
    if not low <= magnitude <= high:
        return Decoded("int", prefix, None, "E0014", {"text": text, "type": prefix, "low": low, "high": high})
    return Decoded("int", prefix, magnitude)


_LARGEST_OF_REAL = 3.4028235677973362e38
"""The last number that is rounded to the largest REAL; what follows is rounded to infinity."""


def _real(text: str, prefix: str, value: float, size: int) -> Decoded:
    limit = 3.4028234663852886e38 if size == 4 else 1.7976931348623157e308
    if abs(value) > (_LARGEST_OF_REAL if size == 4 else limit):
        fields = {"text": text, "type": prefix, "low": -limit, "high": limit}
        return Decoded("real", prefix, None, "E0014", fields)
    if size == 4:
        value = float(struct.unpack("<f", struct.pack("<f", value))[0])
    return Decoded("real", prefix, value)


def _wrong_kind(text: str, prefix: str, hint: str) -> Decoded:
    return Decoded("int", prefix, None, "E0015", {"text": text, "type": prefix, "hint": hint})


def _duration(text: str, kind: str, body: str) -> Decoded:
    def bad(reason: str, hint: str) -> Decoded:
        return Decoded(
            kind, None, None, "E0011", {"text": text, "type": kind.upper(), "reason": reason, "hint": hint}
        )

    order = "The units are d, h, m, s, ms in this order." if kind == "time" else (
        "The units are d, h, m, s, ms, us, ns in this order."
    )  # fmt: skip
    if len(body) > _MAX_LENGTH:
        return bad("it is too long", order)
    if body.startswith("-"):
        return bad("times cannot be negative", "Subtract the time instead.")
    parts = _TIME_PART.findall(body.replace("_", "").lstrip("+"))
    if not parts or "".join(number + unit for number, unit in parts) != body.replace("_", "").lstrip("+"):
        return bad("a number with its unit is expected", order)
    total = Fraction(0)
    previous = -1
    for index, (number, unit_text) in enumerate(parts):
        unit = unit_text.lower()
        last = index == len(parts) - 1
        if unit not in _UNIT_NS:
            return bad(f"unknown unit '{unit_text}'" if unit else f"the unit of {number} is missing", order)
        if kind == "time" and unit in ("us", "ns"):
            return bad(f"TIME has no unit '{unit_text}'", "Write LTIME#.")
        rank = _UNITS.index(unit)
        if rank <= previous:
            reason = (
                f"the unit '{unit_text}' stands twice" if rank == previous else "wrong order of the units"
            )
            return bad(reason, order)
        if "." in number and not last:
            return bad("only the last number may have a fraction", order)
        exempt = index == 0 or (kind == "ltime" and unit == "ns")  # LTYP-33, LTYP-34
        if not exempt and Fraction(number) >= _UNIT_LIMIT[unit] + 1:
            return bad(
                f"a lower unit exceeds its limit: {number}{unit}",
                f"Only the first unit may be larger than {_UNIT_LIMIT[unit]}.",
            )
        total += Fraction(number) * _UNIT_NS[unit]
        previous = rank
    total = total / 1_000_000 if kind == "time" else total
    limit = MAX_U32 if kind == "time" else MAX_U64
    if total > limit:
        largest = "T#49d17h2m47s295ms" if kind == "time" else "LTIME#213503d23h34m33s709ms551us615ns"
        return bad("it is too long", f"The longest time is {largest}.")
    if total.denominator != 1:
        return bad("the fraction is finer than the type", f"{kind.upper()} counts {_step(kind)}.")
    return Decoded(kind, None, total.numerator)


def _step(kind: str) -> str:
    return "milliseconds" if kind in ("time", "tod") else "nanoseconds"


def _bad_date(text: str, kind: str, reason: str, hint: str) -> Decoded:
    return Decoded(
        kind, None, None, "E0012", {"text": text, "type": kind.upper(), "reason": reason, "hint": hint}
    )


def _days(body: str) -> int | str:
    """Days since 1970-01-01 of `year-month-day`, or what is wrong with it."""
    match = _DATE.fullmatch(body)
    if not match:
        return "year-month-day is expected"
    year, month, day = (int(part) for part in match.groups())
    try:
        days = date(year, month, day).toordinal() - _EPOCH
    except ValueError:
        return f"there is no day {body}"
    return days if days >= 0 else "dates begin with 1970-01-01"


def _clock(body: str) -> Fraction | str:
    """Seconds since midnight of `hour:minute[:second[.fraction]]`, or what is wrong with it."""
    match = _CLOCK.fullmatch(body)
    if not match:
        return "hour:minute:second is expected"
    hour, minute, second = int(match[1]), int(match[2]), int(match[3] or 0)
    if hour > 23 or minute > 59 or second > 59:
        return "the largest time of day is 23:59:59"
    fraction = Fraction(f"0{match[4]}") if match[4] else Fraction(0)
    return hour * 3600 + minute * 60 + second + fraction


def _date(text: str, kind: str, body: str) -> Decoded:
    days = _days(body)
    if isinstance(days, str):
        return _bad_date(text, kind, days, "Write D#1996-05-06.")
    return _seconds(text, kind, Fraction(days * 86_400))


def _date_and_time(text: str, kind: str, body: str) -> Decoded:
    day, _, clock = body.rpartition("-")
    days, seconds = _days(day), _clock(clock)
    for part in (days, seconds):
        if isinstance(part, str):
            return _bad_date(text, kind, part, "Write DT#1996-05-06-15:36:30.")
    assert isinstance(days, int)
    assert isinstance(seconds, Fraction)
    return _seconds(text, kind, days * 86_400 + seconds)


def _seconds(text: str, kind: str, seconds: Fraction) -> Decoded:
    if kind[0] == "l":
        value, limit, latest = int(seconds * _NS_PER_S), MAX_U64, "2554-07-21"
    else:
        value, limit, latest = int(seconds), MAX_U32, "2106-02-07"
    if value > limit:
        return _bad_date(text, kind, "it is too late", f"The latest day is {latest}.")
    return Decoded(kind, None, value)


def _time_of_day(text: str, kind: str, body: str) -> Decoded:
    seconds = _clock(body)
    if isinstance(seconds, str):
        return _bad_date(text, kind, seconds, "Write TOD#15:36:30.123.")
    ticks = seconds * (1000 if kind == "tod" else _NS_PER_S)
    if ticks.denominator != 1:
        return _bad_date(
            text, kind, "the fraction is finer than the type", f"{kind.upper()} counts {_step(kind)}."
        )
    return Decoded(kind, None, ticks.numerator)


def _string(text: str, prefix: str | None) -> Decoded:
    wide = text[0] == '"'
    kind = "wstring" if wide else "string"
    problems: list[str] = []

    def replace(match: re.Match[str]) -> str:
        escape = match[0]
        if len(escape) > 2:
            return chr(int(escape[1:], 16))
        char = _ESCAPES.get(escape[1:].upper())
        if char is None:
            problems.append(escape)
            return ""
        return char

    body = text[1:-1]
    plain_outside_latin = next((char for char in body if char > "\xff"), None)
    # An escape gives one byte whatever the encoding, so encode the plain text around the escapes.
    pattern = _WIDE_ESCAPE if wide else _ESCAPE
    if wide:
        value: Value = pattern.sub(replace, body) if "$" in body else body
    else:
        encoding = "utf-8" if plain_outside_latin else "latin-1"
        pieces: list[bytes] = []
        position = 0
        for match in pattern.finditer(body):
            pieces.append(body[position : match.start()].encode(encoding, "replace"))
            pieces.append(replace(match).encode("latin-1"))
            position = match.end()
        pieces.append(body[position:].encode(encoding, "replace"))
        value = b"".join(pieces)
    if problems:
        hex_form = "$ and four hexadecimal digits" if wide else "$ and two hexadecimal digits"
        fields: dict[str, object] = {"escape": problems[0], "type": kind.upper(), "hex": hex_form}
        return Decoded(kind, prefix, None, "E0013", fields)
    if not wide and plain_outside_latin:
        return Decoded(kind, prefix, value, "W1501", {"char": plain_outside_latin})
    return Decoded(kind, prefix, value)
