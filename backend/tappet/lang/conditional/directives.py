"""Whether a text has conditional pragmas at all."""

from __future__ import annotations

import re

_ANY = re.compile(r"\{\s*(IF|ELSIF|ELSE|END_IF|define|undefine|include)\b", re.IGNORECASE)


def has_directives(text: str) -> bool:
    """Whether a text may hold conditional pragmas at all; most do not."""
    return _ANY.search(text) is not None
