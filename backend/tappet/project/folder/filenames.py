"""Object names as file names that every file system takes, also those that ignore case."""

from __future__ import annotations

import hashlib
import re
from urllib.parse import unquote

from tappet.project.naming import normal_name

_UNSAFE = re.compile(r'[\x00-\x1f\x7f<>:"/\\|?*%~.]|^ | $')
_RESERVED = re.compile(r"(?:CON|PRN|AUX|NUL|CONIN\$|CONOUT\$|COM[0-9¹²³]|LPT[0-9¹²³])", re.IGNORECASE)
"""Names that Windows keeps for devices, with any extension."""

MAX_STEM_BYTES = 150
"""Longer file names are cut and end in a digest; file systems allow 255 bytes with the extension."""


def stem_of(name: str) -> str:
    """The file name, without extension, of an object. Different names never get the same one."""
    stem = _UNSAFE.sub(lambda match: _escaped(match.group()), name)
    if _RESERVED.fullmatch(stem):
        stem = _escaped(stem[0]) + stem[1:]
    encoded = stem.encode()
    if len(encoded) <= MAX_STEM_BYTES:
        return stem
    digest = hashlib.sha256(name.encode()).hexdigest()[:16]
    cut = encoded[: MAX_STEM_BYTES - 17].decode(errors="ignore").rstrip("% ")
    return f"{re.sub('%[0-9A-F]?$', '', cut)}~{digest}"


def name_of(stem: str) -> str:
    """The name of the object that a file name denotes; a cut one gives the cut name."""
    return normal_name(unquote(stem.partition("~")[0]))


def _escaped(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode())
