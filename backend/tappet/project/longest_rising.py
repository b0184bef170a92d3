"""The longest rising run: which members of a changed order have kept their order."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence


def longest_rising(order: Sequence[str], current: Mapping[str, int]) -> set[str]:
    """The longest run of ids whose present positions rise already: those that need not move.

    Ids without a position are left out.
    """
    tails: list[int] = []
    tail_ids: list[str] = []
    before: dict[str, str | None] = {}
    for object_id in order:
        if object_id not in current:
            continue
        place = bisect_left(tails, current[object_id])
        before[object_id] = tail_ids[place - 1] if place else None
        tails[place : place + 1] = [current[object_id]]
        tail_ids[place : place + 1] = [object_id]
    kept: set[str] = set()
    last = tail_ids[-1] if tail_ids else None
    while last is not None:
        kept.add(last)
        last = before[last]
    return kept
