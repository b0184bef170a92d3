"""Differences in words and lines, as people read them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from difflib import unified_diff
from typing import Any

from tappet.project.compare.differences import Comparison, Difference, values_of

CONTEXT_LINES = 2


def path_in(comparison: Comparison, one: Difference) -> str:
    """Where an object is; of one that is gone, where it was."""
    side = comparison.old if one.new is None else comparison.new
    return side.path_of(one.item.id)


def changed_lines(one: Difference) -> Iterator[str]:
    """The lines that differ in an object that is on both sides, with those around them."""
    if one.old is None or one.new is None:
        return
    old, new = values_of(one.old), values_of(one.new)
    for field in one.fields:
        sides = (text_of(old.get(field)).split("\n"), text_of(new.get(field)).split("\n"))
        yield f"{field}:"
        yield from list(unified_diff(*sides, lineterm="", n=CONTEXT_LINES))[2:]


def text_of(value: Any) -> str:
    """A value of a field as text: texts as they are, others as JSON."""
    if isinstance(value, str):
        return value
    return "" if value is None else json.dumps(value, indent=2, ensure_ascii=False, sort_keys=True)
