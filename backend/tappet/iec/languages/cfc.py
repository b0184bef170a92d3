"""Continuous Function Chart: bodies drawn in other tools are kept."""

from tappet.iec.languages.language import Language

LANGUAGE = Language("CFC", "Continuous Function Chart", rank=50, text=False)
