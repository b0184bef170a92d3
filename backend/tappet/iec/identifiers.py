"""The identifiers that a text can refer to, found without parsing it."""

from __future__ import annotations

from tappet.iec.languages import languages
from tappet.iec.tokens import NAME


def identifiers(text: str) -> set[str]:
    """The upper-case identifiers of a text, those in comments and strings included, and the functions that
    it calls on a condition (`Language.call_modifier`)."""
    found = set(NAME.findall(text.upper()))
    for language in languages().values():
        if modifier := language.call_modifier:
            found.update([name.removesuffix(modifier) for name in found if name.endswith(modifier)])
    return found
