"""The languages of our texts, and how a client names the one it wants."""

from __future__ import annotations

from typing import Literal

Language = Literal["en", "zh"]


def language_of(tag: str | None) -> Language:
    """The language of our texts for a tag such as `zh-CN`; English for those that we do not speak."""
    return "zh" if (tag or "").lower().startswith("zh") else "en"


def accepted(header: str | None) -> Language:
    """The language of ours that an `Accept-Language` header prefers (RFC 9110 12.5.4); English for none."""
    best: tuple[float, Language] = (0.0, "en")
    for part in (header or "")[:500].split(","):
        tag, _, rest = part.strip().partition(";")
        name = tag.strip().lower().partition("-")[0]
        weight = _weight(rest)
        if name in ("zh", "en", "*") and weight > best[0]:
            best = (weight, language_of(name))
    return best[1]


def _weight(parameter: str) -> float:
    """The quality of `q=0.8`; 1 where none is said, 0 for what cannot be read."""
    name, _, value = parameter.strip().partition("=")
    if not name:
        return 1.0
    try:
        weight = float(value)
    except ValueError:
        return 0.0
    return weight if name.strip().lower() == "q" and 0 <= weight <= 1 else 0.0
