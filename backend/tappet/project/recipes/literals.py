"""Values of recipes as they are written in tables and files: literals, or names of constants."""

from __future__ import annotations

import re
from typing import Literal

_PLAIN = re.compile(
    r"""(?ix) [+-]? (?:[a-z_]\w*\#)? [+-]? (?: \d+\#[0-9a-f_]+ | \d[\w.]* (?: (?<=e)[+-]\d+ )? )
        | true | false
        | (?:time|t|ltime|lt)\# [+-]? [\w.]+
        | l?(?:d|dt|date|tod|time_of_day|date_and_time)\# \d[\d:.-]* """
)
_QUOTED = re.compile(r"""'(?:[^'$]|\$.)*'|"(?:[^"$]|\$.)*\"""")
_NAME = re.compile(r"[^\W\d]\w*(?:[.#][^\W\d]\w*)*")
Form = Literal["literal", "name", "wrong"]


def form_of(text: str) -> Form:
    """A literal, the name of a constant or of a value of an enumeration, or neither."""
    text = text.strip()
    if _PLAIN.fullmatch(text) or _QUOTED.fullmatch(text):
        return "literal"
    return "name" if _NAME.fullmatch(text) else "wrong"


def narrow(text: str) -> str:
    """A literal with codes for characters that 8-bit text has not."""
    digits = 4 if text.startswith('"') else 2
    if not text.startswith(("'", '"')):
        return text
    pieces = []
    for letter in text:
        code = ord(letter)
        if 32 <= code < 127:
            pieces.append(letter)
        elif code < 16**digits:
            pieces.append(f"${code:0{digits}X}")
        else:
            pieces.append("?")
    return "".join(pieces)


def st_string(text: str) -> str:
    """A STRING literal of a text; what is no ASCII stands in it as UTF-8."""
    return "'" + "".join(_in_string(byte) for byte in text.encode()) + "'"


def _in_string(byte: int) -> str:
    letter = chr(byte)
    if letter in "'$":
        return f"${letter}"
    return letter if 32 <= byte < 127 else f"${byte:02X}"
