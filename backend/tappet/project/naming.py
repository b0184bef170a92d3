"""Names of objects: IEC identifiers where code refers to them, free names for the rest of the tree."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from functools import lru_cache

from tappet.iec.words import RESERVED
from tappet.project.errors import InvalidNameError

MAX_NAME = 200
"""Characters in the name of an object. Identifiers in code have no limit (LDEC-08); file systems do."""

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)
_COUNTED = re.compile(r"(?P<stem>.*?)_(?P<count>[1-9]\d{0,8})", re.DOTALL)
_SEPARATORS = frozenset("./\\")


def normal_name(name: str) -> str:
    """The name in Unicode normal form C, so that equal looking names are equal on every file system."""
    return unicodedata.normalize("NFC", name)


@lru_cache(maxsize=65536)
def name_key(name: str) -> str:
    """What names are compared by: two siblings whose keys are equal cannot both exist (LDEC-06).

    Upper case before folding, so that names that a case-insensitive file system holds for one are one here.
    """
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).upper().casefold())


def check_identifier(name: str) -> None:
    """Raise InvalidNameError unless `name` is an IEC identifier and no keyword (LDEC-05, -07, -10)."""
    if len(name) > MAX_NAME:
        raise InvalidNameError(f"The name '{name[:40]}...' is longer than {MAX_NAME} characters")
    if not _IDENTIFIER.fullmatch(name):
        raise InvalidNameError(
            f"'{_shown(name)}' is no valid identifier. "
            "Use letters, digits and underscores, not beginning with a digit"
        )
    if "__" in name:
        raise InvalidNameError(
            f"'{name}' has two consecutive underscores; identifiers may have only single ones"
        )
    if name.upper() in RESERVED:
        raise InvalidNameError(f"'{name}' is a keyword of the language and cannot name an object")


def check_free_name(name: str) -> None:
    """Raise InvalidNameError unless `name` can name a device, folder or another thing not named in code."""
    _check_visible(name)
    for character in name:
        if character in _SEPARATORS:
            raise InvalidNameError(
                f"'{_shown(name)}' contains '{character}', which separates the parts of a path"
            )


def check_project_name(name: str) -> None:
    """Raise InvalidNameError unless `name` can name a project: what can be read, on one line."""
    _check_visible(name)


def _check_visible(name: str) -> None:
    if not name:
        raise InvalidNameError("A name is needed")
    if len(name) > MAX_NAME:
        raise InvalidNameError(f"The name '{name[:40]}...' is longer than {MAX_NAME} characters")
    if name != name.strip():
        raise InvalidNameError(f"'{_shown(name)}' begins or ends with a blank")
    for character in name:
        if unicodedata.category(character) in ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"):
            raise InvalidNameError(
                f"'{_shown(name)}' contains the character U+{ord(character):04X}, which cannot be seen"
            )
    if normal_name(name) != name:
        raise InvalidNameError(f"'{_shown(name)}' is not in Unicode normal form C")


def unique_name(wanted: str, taken: Iterable[str]) -> str:
    """`wanted`, or the first of `wanted_1`, `wanted_2` ... that no name in `taken` equals (CON-02)."""
    keys = {name_key(name) for name in taken}
    if name_key(wanted) not in keys:
        return wanted
    counted = _COUNTED.fullmatch(wanted)
    stem, count = (counted["stem"], int(counted["count"])) if counted else (wanted, 0)
    while True:
        count += 1
        ending = f"_{count}"
        candidate = stem[: MAX_NAME - len(ending)].rstrip("_ ") + ending
        if name_key(candidate) not in keys:
            return candidate


def _shown(name: str) -> str:
    shown = name if len(name) <= 40 else name[:37] + "..."
    return "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in shown)
