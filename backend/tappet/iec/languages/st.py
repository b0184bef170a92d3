"""Structured Text."""

from tappet.iec.languages.language import Language

LANGUAGE = Language("ST", "Structured Text", "tappet.lang.languages.st:READER", rank=10, offered=True)
