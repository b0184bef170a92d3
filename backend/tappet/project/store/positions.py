"""Positions of siblings: numbers with gaps, so that moving one object does not touch the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tappet.project.longest_rising import longest_rising

GAP = 1 << 20
"""Distance of neighbours that are appended; twenty objects fit between two before a renumbering."""


def new_positions(order: Sequence[str], current: Mapping[str, int]) -> dict[str, int]:
    """The positions to change so that sorting by position gives `order`: as few as possible.

    `current` holds the positions of the ids that have one already; an id without one always gets one.
    """
    kept = longest_rising(order, current)
    changed: dict[str, int] = {}
    left: int | None = None
    waiting: list[str] = []
    for object_id in (*order, None):
        if object_id is not None and object_id not in kept:
            waiting.append(object_id)
            continue
        right = None if object_id is None else current[object_id]
        placed = _between(left, right, len(waiting))
        if placed is None:
            return _renumbered(order, current)
        changed.update(zip(waiting, placed, strict=True))
        waiting = []
        left = right
    return changed


def _between(left: int | None, right: int | None, count: int) -> list[int] | None:
    """`count` rising positions between two neighbours, None when the gap is too small."""
    if right is None:
        start = 0 if left is None else left
        return [start + GAP * (i + 1) for i in range(count)]
    if left is None:
        return [right - GAP * (count - i) for i in range(count)]
    if right - left <= count:
        return None
    return [left + (right - left) * (i + 1) // (count + 1) for i in range(count)]


def _renumbered(order: Sequence[str], current: Mapping[str, int]) -> dict[str, int]:
    places = {object_id: GAP * (i + 1) for i, object_id in enumerate(order)}
    return {object_id: place for object_id, place in places.items() if current.get(object_id) != place}
