"""Which errors the source of a block names: its own, and those of INTERNAL parts that it is made of."""

from __future__ import annotations

import re
from functools import cache

from tappet.libraries.library import Library

_COMMENT = re.compile(r"\(\*.*?\*\)|//[^\n]*|\{[^}]*\}", re.DOTALL)
_ERROR = re.compile(r"\bSMC_ERROR\.(\w+)")
_NAME = re.compile(r"\b[A-Za-z]\w*\b")
_OF_THE_AXIS = re.compile(r"AXIS_REF|Axis[A-Z]|.*Handshake$|Refusal$", re.IGNORECASE)
"""Parts whose errors are those of every command: the axis, its states, the handshake with it."""
_NO_ERROR = "SMC_NO_ERROR"


@cache
def errors_of(library: Library, name: str) -> frozenset[str]:
    """Names of `SMC_ERROR` that a block may report besides those of every command."""
    texts = _texts(library)
    found: set[str] = set()
    seen = {name.upper()}
    waiting = [name.upper()]
    while waiting:
        text = texts[waiting.pop()]
        found.update(_ERROR.findall(text))
        for used in {word.upper() for word in _NAME.findall(text)} & texts.keys() - seen:
            if _is_internal(texts[used]) and not _OF_THE_AXIS.match(used):
                seen.add(used)
                waiting.append(used)
    return frozenset(found - {_NO_ERROR})


@cache
def _texts(library: Library) -> dict[str, str]:
    return {
        source.name.upper(): _COMMENT.sub(" ", source.text)
        for source in library.sources
        if source.name is not None
    }


def _is_internal(text: str) -> bool:
    return re.match(r"\s*(FUNCTION_BLOCK|FUNCTION)\s+INTERNAL\b", text) is not None
