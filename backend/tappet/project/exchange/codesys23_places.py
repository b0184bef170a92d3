"""Addresses of CoDeSys 2.3 that lead through the modules of a device: `%IX0.2.1.5`, `%ID0.2.0`.

The device is not here, so each path gets a place of its own behind the addresses in use; what overlapped by
path overlaps again.
"""

from __future__ import annotations

import re

_PATH = re.compile(r"%([IQM])([XBWDLR]?)(\d+(?:\.\d+)+)", re.IGNORECASE)
_FIRST_BYTE = 2048
_BYTES_A_PATH = 8
_UNITS = {"B": 1, "W": 2, "D": 4, "R": 4, "L": 8}
_WORD = 2


class Places:
    """The places of an import, by area and path."""

    def __init__(self) -> None:
        self._slots: dict[tuple[str, str], int] = {}

    def flat(self, text: str, at: int) -> tuple[str, str] | None:
        """The address through modules that begins at an offset, and the one it gets; None for others."""
        match = _PATH.match(text, at)
        if match is None:
            return None
        area, size = match[1].upper(), match[2].upper() or "X"
        path = match[3]
        bit = 0
        if size == "X":
            path, _, last = path.rpartition(".")
            bit = int(last)
        if "." not in path:
            return None
        slot = self._slots.setdefault((area, path), sum(key[0] == area for key in self._slots))
        byte = _FIRST_BYTE + slot * _BYTES_A_PATH
        if size == "X":
            made = f"%{area}X{byte // _WORD + bit // 16}.{bit % 16}"
        else:
            letter = "D" if size == "R" else size
            made = f"%{area}{letter}{byte // _UNITS[size]}"
        return match.group(), made
