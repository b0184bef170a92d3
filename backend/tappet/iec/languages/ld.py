"""Ladder Diagram: bodies drawn in other tools are kept."""

from tappet.iec.languages.language import Language

LANGUAGE = Language("LD", "Ladder Diagram", rank=30, text=False)
