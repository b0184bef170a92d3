"""Mutations: of words, so that texts stay close to programs; of bytes; of values in msgpack."""

from __future__ import annotations

import re
from collections.abc import Sequence
from random import Random
from typing import Any

import msgpack

_WORDS = re.compile(r"[A-Za-z_]\w*|\d[\w.#]*|:=|\.\.|<=|>=|<>|=>|\s+|.", re.DOTALL)
_SPICE = (
    "",
    "0",
    "1",
    "-1",
    "18446744073709551615",
    "1E308",
    "16#FF",
    "T#1d",
    "'",
    '"',
    "''",
    "$",
    "(",
    ")",
    "[",
    "]",
    ";",
    ":",
    ":=",
    "..",
    "^",
    ".",
    ",",
    "#",
    "%IX0.0",
    "%QW",
    "THIS",
    "SUPER^",
    "ARRAY [*] OF",
    "ARRAY [0..1] OF",
    "POINTER TO",
    "REFERENCE TO",
    "END_VAR",
    "VAR",
    "VAR_IN_OUT",
    "END_IF",
    "IF",
    "CASE",
    "OF",
    "FOR",
    "EXIT;",
    "STRING(3)",
    "EXTENDS",
    "IMPLEMENTS",
    "METHOD",
    "END_METHOD",
    "PROPERTY",
    "{IF defined(a)}",
    "{END_IF}",
    "(*",
    "*)",
    "//",
    "ADR(",
    "SIZEOF(",
    "__NEW(",
    "REF=",
    "S=",
    "CONSTANT",
    "AT",
    "INT",
    "LREAL",
    "TON",
    "MUX(",
    "BIT",
    "<Body>",
    "</",
    "&#0;",
    "]]>",
    "\0",
    "\ud7ff",
    "\ufeff",
    "é",
)


def words(text: str) -> list[str]:
    return _WORDS.findall(text)


def mutated(r: Random, seeds: list[bytes], spice: Sequence[str] = _SPICE) -> bytes:
    """A seed with some of its words changed, put together with a part of another one, or cut off.

    `spice`: words that may come in.
    """
    own = words(r.choice(seeds).decode("utf-8", "replace"))
    for _ in range(r.choice((1, 1, 2, 3, 8))):
        at, kind = r.randrange(len(own) + 1), r.randrange(8)
        end = min(len(own), at + r.choice((1, 1, 2, 5, 20)))
        if kind == 0:
            del own[at:end]
        elif kind == 7:
            del own[at:]
        elif kind == 1:
            own[at:at] = own[at:end] * r.choice((1, 2, 30))
        elif kind == 2:
            own.insert(at, f" {r.choice(spice)} ")
        elif kind == 3 and at < len(own):
            own[at] = r.choice(spice)
        elif kind == 4 and at < len(own):
            own[at] = r.choice(own)
        elif kind == 5:
            other = words(r.choice(seeds).decode("utf-8", "replace"))
            start = r.randrange(len(other) + 1)
            own[at:end] = other[start : start + r.choice((1, 5, 30))]
        elif at < len(own):
            other_at = r.randrange(len(own))
            own[at], own[other_at] = own[other_at], own[at]
    return "".join(own).encode("utf-8", "replace")


def mutated_bytes(r: Random, seeds: list[bytes]) -> bytes:
    """A seed with some of its bytes changed, removed or repeated, or cut off."""
    own = bytearray(r.choice(seeds))
    for _ in range(r.choice((1, 1, 2, 4, 16))):
        at, kind = r.randrange(len(own) + 1), r.randrange(6)
        end = min(len(own), at + r.choice((1, 1, 4, 30)))
        if kind == 0:
            del own[at:end]
        elif kind == 1:
            own[at:at] = own[at:end] * r.choice((1, 3))
        elif kind == 2 and at < len(own):
            own[at] ^= 1 << r.randrange(8)
        elif kind == 3 and at < len(own):
            own[at] = r.choice((0, 1, 0x7F, 0x80, 0xFF))
        elif kind == 4:
            other = r.choice(seeds)
            start = r.randrange(len(other) + 1)
            own[at:end] = other[start : start + r.choice((1, 4, 60))]
        elif r.randrange(4) == 0:
            del own[at:]
    return bytes(own)


_VALUES = (
    0,
    1,
    -1,
    7,
    2**31,
    2**53,
    2**63,
    2**64 - 1,
    -(2**63),
    0.5,
    "",
    "x",
    "v",
    b"",
    b"\0",
    None,
    True,
    [],
    {},
)


def mutated_values(r: Random, seeds: list[bytes]) -> bytes:
    """A msgpack value behind a head with some of its parts changed; sometimes its bytes."""
    if r.randrange(4) == 0:
        return mutated_bytes(r, seeds)
    seed = r.choice(seeds)
    head = next((n for n in range(min(16, len(seed))) if _holds_map(seed[n:])), None)
    if head is None:
        return mutated_bytes(r, seeds)
    value = msgpack.unpackb(seed[head:], raw=False, strict_map_key=False)
    for _ in range(r.choice((1, 1, 2, 5))):
        change(r, value)
    return seed[:head] + bytes(msgpack.packb(value, use_bin_type=True))


def _holds_map(data: bytes) -> bool:
    try:
        return isinstance(msgpack.unpackb(data, raw=False, strict_map_key=False), dict)
    except (ValueError, msgpack.UnpackException):
        return False


def change(r: Random, value: Any, spice: Sequence[Any] | None = None) -> None:
    """Changes one part of a map or list in place, sometimes to one of `spice`."""
    values = _VALUES if spice is None else spice
    keys = list(value) if isinstance(value, dict) else list(range(len(value)))
    if not keys:
        return
    key = r.choice(keys)
    inner = value[key]
    if isinstance(inner, dict | list) and inner and r.randrange(5):
        change(r, inner, spice)
    elif r.randrange(6) == 0:
        del value[key]
    elif r.randrange(6) == 0 and isinstance(value, dict):
        value[r.choice(("v", "id", "op", "x") if spice else ("v", "id", "op", "x", 5))] = r.choice(values)
    elif r.randrange(4) == 0:
        value[key] = value[r.choice(keys)]
    else:
        value[key] = r.choice(values)
