"""SIMOTION: units of ST are recognised, so that they are refused by name instead of read as broken IEC texts.

A unit has an INTERFACE and an IMPLEMENTATION part around its objects, and USES and USEPACKAGE clauses.
"""

from __future__ import annotations

from tappet.iec.tokens import words

REFUSED = (
    "is a unit of SIMOTION SCOUT, whose ST is another language (UNIT, INTERFACE, IMPLEMENTATION, technology "
    "packages); put the programs and blocks of its IMPLEMENTATION part into IEC texts and import these"
)


def is_unit(text: str) -> bool:
    """Whether a text is a unit: it has an IMPLEMENTATION part, which no IEC 61131-3 text has."""
    found = {word.text for word in words(text) if word.text in ("IMPLEMENTATION", "END_IMPLEMENTATION")}
    return len(found) == 2
