"""A drawn language: a chain of elements, each of which puts a result into a variable."""

from tappet.iec.languages import Language

LANGUAGE = Language(
    "CHAIN",
    "Chain of elements",
    "toy_language.reader:READER",
    rank=200,
    text=False,
    extension="chain",
    offered=True,
)
