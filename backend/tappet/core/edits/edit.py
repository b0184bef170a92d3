"""What an edit has changed since an application was lowered."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang.symbols import PouSymbol


@dataclass(slots=True)
class Edit:
    """What is new since an application was lowered."""

    bodies: dict[int, PouSymbol] = field(default_factory=dict)
    """POUs, methods and accessors that were analysed again, by id()."""
    texts: set[str] = field(default_factory=set)
    """Uris of the texts that were declared again."""
    entities: set[int] = field(default_factory=set)
    """id() of the symbols and types of their declarations."""
