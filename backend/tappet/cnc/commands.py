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
    probes: bool = False
    """A line may have a word PROBE: its movement ends where a signal comes."""
    numbers: range | None = None
    """Values of L, where the command has it and no others make sense."""


_LINE = Command(_AXES | _SWITCHES, travels=True)
_ARC = Command(_AXES | _SWITCHES | frozenset("RIJKT"), frozenset("RIJK"), travels=True, probes=True)
_ELLIPSE = Command(_AXES | _SWITCHES | frozenset("RIJK"), frozenset("IJ"), travels=True, probes=True)
_MODE = Command()
_FLAG = Command(frozenset("L"), frozenset("L"), numbers=range(1, 33))
_SMOOTHED_AXIS = Command(frozenset("L"), frozenset("L"), numbers=range(4, 12))

COMMANDS: dict[int, Command] = {
    **dict.fromkeys((0, 5, 10), _LINE),
    1: Command(_AXES | _SWITCHES, travels=True, probes=True),
    **dict.fromkeys((2, 3), _ARC),
    4: Command(frozenset("T"), frozenset("T")),
    6: Command(_AXES | _SWITCHES | frozenset("IJ"), frozenset("IJ"), travels=True),
    **dict.fromkeys((8, 9), _ELLIPSE),
    16: Command(frozenset("IJK"), frozenset("IJK")),
    20: Command(frozenset("LK"), frozenset("L")),
    31: Command(_AXES, travels=True, probes=True),
    **dict.fromkeys((36, 37), Command(frozenset("O"), frozenset("D"))),
    **dict.fromkeys((38, 39), _FLAG),
    43: Command(frozenset("IJK")),
    **dict.fromkeys((54, 55, 56), Command(_AXES)),
    **dict.fromkeys((70, 71), _SMOOTHED_AXIS),
    92: Command(_AXES | _SWITCHES),
    **dict.fromkeys((15, 17, 18, 19, 40, 41, 42, 50, 51, 52, 53, 60, 61, 75, 90, 91, 98, 99), _MODE),
}
"""By the number behind G. Others are unknown."""
M_WORDS = frozenset("KLO")
LAST_M = 65532
MOST_SWITCHES = 3
