"""Mutations of words: texts stay close enough to programs to get far into the compiler."""

from __future__ import annotations

import re
from random import Random

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


def mutated(r: Random, seeds: list[bytes]) -> bytes:
    """A seed with some of its words changed, or put together with a part of another one."""
    own = words(r.choice(seeds).decode("utf-8", "replace"))
    for _ in range(r.choice((1, 1, 2, 3, 8))):
        at, kind = r.randrange(len(own) + 1), r.randrange(7)
        end = min(len(own), at + r.choice((1, 1, 2, 5, 20)))
        if kind == 0:
            del own[at:end]
        elif kind == 1:
            own[at:at] = own[at:end] * r.choice((1, 2, 30))
        elif kind == 2:
            own.insert(at, f" {r.choice(_SPICE)} ")
        elif kind == 3 and at < len(own):
            own[at] = r.choice(_SPICE)
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
