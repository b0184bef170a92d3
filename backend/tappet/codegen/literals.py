"""IEC literals of times, dates and strings, read and written (LTYP-33..LTYP-39).

Times are integers in the unit of their type: TIME and TOD ms, LTIME LDATE LTOD LDT ns, DATE and DT s.
"""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_NS = {"d": 86_400_000_000_000, "h": 3_600_000_000_000, "m": 60_000_000_000, "s": 1_000_000_000}
_NS |= {"ms": 1_000_000, "us": 1_000, "ns": 1}
_UNIT_ORDER = ["d", "h", "m", "s", "ms", "us", "ns"]
_PART = re.compile(r"(\d[\d_]*(?:\.\d+)?)(ms|us|ns|d|h|m|s)", re.IGNORECASE)
_PREFIXES = {
    "time": ("T", "TIME"),
    "ltime": ("LTIME", "LT"),
    "date": ("D", "DATE"),
    "ldate": ("LDATE", "LD"),
    "tod": ("TOD", "TIME_OF_DAY"),
    "ltod": ("LTOD", "LTIME_OF_DAY"),
    "dt": ("DT", "DATE_AND_TIME"),
    "ldt": ("LDT", "LDATE_AND_TIME"),
}
_UNIT_NS = {"time": 1_000_000, "tod": 1_000_000, "date": 1_000_000_000, "dt": 1_000_000_000}
_SAMPLES = {
    "time": "T#1s500ms", "ltime": "LTIME#1s500us", "date": "D#2026-01-31", "ldate": "LDATE#2026-01-31",
    "tod": "TOD#12:30:00", "ltod": "LTOD#12:30:00.5", "dt": "DT#2026-01-31-12:30:00",
    "ldt": "LDT#2026-01-31-12:30:00",
}  # fmt: skip
_LIMITS = {"time": 1 << 32, "tod": 86_400_000, "date": 1 << 32, "dt": 1 << 32}
_ESCAPES = {"$": "$", "'": "'", '"': '"', "L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}
_NAMES = {"\n": "$N", "\f": "$P", "\r": "$R", "\t": "$T", "$": "$$"}


def parse_time(kind: str, text: str) -> int:
    """Number in the unit of `kind` (time ltime date ldate tod ltod dt ldt); ValueError with a sample."""
    prefix, mark, rest = text.strip().partition("#")
    if not mark or prefix.upper() not in _PREFIXES[kind]:
        raise ValueError(f"'{text}' is no {kind.upper()} literal; write for example {_SAMPLES[kind]}")
    try:
        ns = _duration(rest) if kind in ("time", "ltime") else _calendar(kind.removeprefix("l"), rest)
    except ValueError as error:
        raise ValueError(f"'{text}': {error}; write for example {_SAMPLES[kind]}") from None
    number = ns // _UNIT_NS.get(kind, 1)
    if not 0 <= number < _LIMITS.get(kind, 1 << 63):
        raise ValueError(f"'{text}' is outside the range of {kind.upper()}")
    return number


def _duration(text: str) -> int:
    total, at, last = 0, 0, -1
    for match in _PART.finditer(text):
        if text[at : match.start()].strip("_"):
            raise ValueError(f"unexpected '{text[at : match.start()]}'")
        unit = match[2].lower()
        rank = _UNIT_ORDER.index(unit)
        if rank <= last:
            raise ValueError("units must come in the order d h m s ms us ns, each once")
        last, at = rank, match.end()
        whole, _, fraction = match[1].replace("_", "").partition(".")
        total += int(whole) * _NS[unit]
        if fraction:
            total += int(fraction) * _NS[unit] // 10 ** len(fraction)
    if last < 0 or text[at:].strip("_ "):
        raise ValueError("no duration")
    return total


def _calendar(kind: str, text: str) -> int:
    date, clock = "1970-01-01", "00:00:00"
    if kind == "date":
        date = text
    elif kind == "tod":
        clock = text
    else:
        parts = text.split("-")
        if len(parts) != 4:
            raise ValueError("expected year-month-day-hour:minute:second")
        date, clock = "-".join(parts[:3]), parts[3]
    year, month, day = (int(p) for p in date.split("-"))
    fields = clock.split(":")
    if len(fields) == 2:
        fields.append("0")
    if len(fields) != 3:
        raise ValueError("expected hour:minute:second")
    seconds, _, fraction = fields[2].partition(".")
    hour, minute, second = int(fields[0]), int(fields[1]), int(seconds)
    if max(year, month, day) > datetime.max.year:
        raise ValueError("year, month or day out of range")
    if not (0 <= hour < 24 and 0 <= minute < 60 and 0 <= second < 60):
        raise ValueError("hour, minute or second out of range")
    days = (datetime(year, month, day, tzinfo=UTC) - _EPOCH).days
    nanoseconds = int((fraction + "000000000")[:9]) if fraction else 0
    return ((days * 24 + hour) * 60 + minute) * 60 * 1_000_000_000 + second * 1_000_000_000 + nanoseconds


def format_time(kind: str, number: int) -> str:
    """Literal of `number`, for example `T#1s500ms`, `D#1996-05-06`, `TOD#15:36:30.123`."""
    ns = number * _UNIT_NS.get(kind, 1)
    prefix = _PREFIXES[kind][0]
    if kind in ("time", "ltime"):
        return f"{prefix}#{_format_duration(ns, 'ms' if kind == 'time' else 'ns')}"
    seconds, fraction = divmod(ns, 1_000_000_000)
    moment = _EPOCH + timedelta(seconds=seconds) if seconds < 253_402_300_800 else None
    if moment is None:
        return f"{prefix}#?{number}"
    text = f"{moment:%H:%M:%S}"
    if fraction:
        text += f".{fraction:09d}".rstrip("0")
    if kind in ("tod", "ltod"):
        return f"{prefix}#{text}"
    day = f"{moment.year:04d}-{moment:%m-%d}"
    return f"{prefix}#{day}" if kind in ("date", "ldate") else f"{prefix}#{day}-{text}"


def _format_duration(ns: int, smallest: str) -> str:
    if ns == 0:
        return f"0{smallest}"
    sign, ns = ("-", -ns) if ns < 0 else ("", ns)
    parts = []
    for unit in _UNIT_ORDER:
        count, ns = divmod(ns, _NS[unit])
        if count:
            parts.append(f"{count}{unit}")
    return sign + "".join(parts)


def parse_string(text: str, wide: bool) -> str:
    """Content of `'...'` or `"..."` with its `$` escapes resolved; ValueError on bad escapes."""
    quote = '"' if wide else "'"
    text = text.strip()
    if len(text) < 2 or text[0] != quote or text[-1] != quote:
        raise ValueError(f"write a {'W' if wide else ''}STRING between {quote} quotes")
    body, digits, result, at = text[1:-1], 4 if wide else 2, [], 0
    while at < len(body):
        char = body[at]
        at += 1
        if char == quote:
            raise ValueError(f"write ${quote} for a quote inside the string")
        if char != "$":
            result.append(char)
            continue
        code = body[at : at + 1].upper()
        if code in _ESCAPES:
            result.append(_ESCAPES[code])
            at += 1
            continue
        number = body[at : at + digits]
        if not re.fullmatch(rf"[0-9A-Fa-f]{{{digits}}}", number):
            raise ValueError(f"'${number}' is no escape; write $$, $N, $T, ${quote} or {digits} hex digits")
        result.append(chr(int(number, 16)))
        at += digits
    return "".join(result)


def format_string(text: str, wide: bool) -> str:
    """`text` as literal in quotes."""
    quote = '"' if wide else "'"
    digits = 4 if wide else 2
    parts = []
    for char in text:
        if char == quote:
            parts.append("$" + quote)
        elif char in _NAMES:
            parts.append(_NAMES[char])
        elif ord(char) < 32 or ord(char) == 127 or 0xD800 <= ord(char) < 0xE000:
            parts.append(f"${ord(char):0{digits}X}")
        else:
            parts.append(char)
    return quote + "".join(parts) + quote
