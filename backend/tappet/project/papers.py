"""The sheets of paper that a documentation can be printed on."""

from __future__ import annotations

from typing import Literal

Paper = Literal["a3", "a4", "a5", "us-letter", "us-legal", "us-tabloid"]
Orientation = Literal["portrait", "landscape"]
PAPERS: dict[Paper, tuple[float, float]] = {
    "a3": (297, 420),
    "a4": (210, 297),
    "a5": (148, 210),
    "us-letter": (215.9, 279.4),
    "us-legal": (215.9, 355.6),
    "us-tabloid": (279.4, 431.8),
}
"""Width and height of the upright sheet in mm: ISO 216, ANSI/ASME Y14.1; legal is customary."""
