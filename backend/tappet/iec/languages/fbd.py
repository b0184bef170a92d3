"""Function Block Diagram: bodies drawn in other tools are kept."""

from tappet.iec.languages.language import Language

LANGUAGE = Language("FBD", "Function Block Diagram", rank=40, text=False)
