"""Sequential Function Chart: textual charts are compiled, charts drawn in other tools are kept."""

from tappet.iec.languages.language import Language

LANGUAGE = Language(
    "SFC",
    "Sequential Function Chart",
    "tappet.lang.languages.sfc.reader:READER",
    rank=60,
    begins=r"\s*(?:INITIAL_)?STEP\s+\w+\s*:",
    implicit_names="SFC",
)
