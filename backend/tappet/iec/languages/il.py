"""Instruction List."""

from tappet.iec.languages.language import Language

LANGUAGE = Language(
    "IL",
    "Instruction List",
    "tappet.lang.languages.il.reader:READER",
    rank=20,
    named=True,
    offered=True,
    call_modifier="CN",
)
