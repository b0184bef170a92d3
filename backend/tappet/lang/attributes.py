"""Look-up of `{attribute 'name' := 'value'}` pragmas of a declaration."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang.ast import Pragma


def attribute(pragmas: Iterable[Pragma], *names: str) -> str | None:
    """Value of the first attribute that has one of the names ('' without a value), None when there is
    none."""
    for pragma in pragmas:
        if pragma.attribute is not None and pragma.attribute.lower() in names:
            return pragma.value or ""
    return None
