"""G commands and the words that they know. Spec cnc 8.

The decoder of SM3_CNC has the same table (AllowedWords).
"""

from __future__ import annotations

from dataclasses import dataclass

from tappet.cnc.letters import AXES

MODAL = frozenset({"D", "F", "S", "E", "FF", "EF", *(f"{kind}{axis}" for kind in "FE" for axis in "ZPQUVW")})
"""Words that a line may have whatever its command is: they stay for the next lines. Spec GC-12."""
LIMITLESS = frozenset(f"{kind}{axis}" for kind in "FE" for axis in "XYABC")
"""Limits of axes that a path object has no place for."""
_AXES = frozenset(AXES)
_SWITCHES = frozenset("HLO")


@dataclass(frozen=True, slots=True)
class Command:
    """What a line with a G command may have and needs."""

    words: frozenset[str] = frozenset()
    """Beside the modal ones."""
    needs: frozenset[str] = frozenset()
    """One of them at least, where there are some."""
    travels: bool = False
    """The command stays for lines without one. Spec GC-06."""
    refused: str = ""
    """What the command would do, if the decoder does not know it."""


_LINE = Command(_AXES | _SWITCHES, travels=True)
_ARC = Command(_AXES | _SWITCHES | frozenset("RIJKT"), frozenset("RIJK"), travels=True)
_ELLIPSE = Command(_AXES | _SWITCHES | frozenset("RIJK"), frozenset("IJ"), travels=True)
_MODE = Command()

COMMANDS: dict[int, Command] = {
    **dict.fromkeys((0, 1, 5, 10), _LINE),
    **dict.fromkeys((2, 3), _ARC),
    4: Command(frozenset("T"), frozenset("T")),
    6: Command(_AXES | _SWITCHES | frozenset("IJ"), frozenset("IJ"), travels=True),
    **dict.fromkeys((8, 9), _ELLIPSE),
    16: Command(frozenset("IJK"), frozenset("IJK")),
    20: Command(frozenset("LK"), frozenset("L")),
    31: Command(refused="a line with probe"),
    **dict.fromkeys((36, 37), Command(frozenset("O"), frozenset("D"))),
    **dict.fromkeys((38, 39), Command(refused="parameters of preprocessing")),
    43: Command(refused="tool length correction"),
    **dict.fromkeys((54, 55, 56), Command(_AXES)),
    **dict.fromkeys((70, 71), Command(refused="smoothing of additional axes")),
    92: Command(_AXES | _SWITCHES),
    **dict.fromkeys((15, 17, 18, 19, 40, 41, 42, 50, 51, 52, 53, 60, 61, 75, 90, 91, 98, 99), _MODE),
}
"""By the number behind G. Others are unknown."""
M_WORDS = frozenset("KLO")
LAST_M = 65532
MOST_SWITCHES = 3
