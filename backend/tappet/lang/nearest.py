"""The names that a misspelt one may mean: those that a slip or two of the fingers away.

The distance counts letters that are missing, too many, wrong or exchanged with their neighbour (Damerau and
Levenshtein, each place touched once). One slip is near, and one more for every four letters beyond four:
`Spead` is `Speed`, but `iqr` is not `idx`.
"""

from __future__ import annotations

from collections.abc import Iterable

_LETTERS_PER_SLIP = 4


def nearest(name: str, known: Iterable[str], count: int = 1) -> list[str]:
    """Up to `count` of the known names that are near, the nearest first, else in the order they have."""
    wanted = name.upper()
    limit = max(1, len(wanted) // _LETTERS_PER_SLIP)
    letters = frozenset(wanted)
    found = []
    for place, other in enumerate(known):
        if abs(len(other) - len(wanted)) <= limit:
            key = other.upper()
            if len(letters.difference(key)) > limit:  # one slip leaves at most one letter out
                continue
            slips = distance(wanted, key, limit)
            if slips <= limit and slips < len(wanted):
                found.append((slips, place, other))
    found.sort()
    return [other for _, _, other in found[:count]]


def distance(a: str, b: str, limit: int) -> int:
    """Slips between two texts; some number beyond `limit` when there are more."""
    if a == b:
        return 0
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        before, last, row = row, before, [i]
        for j, other in enumerate(b, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                cost = min(cost, last[j - 2] + 1)
            row.append(cost)
        if min(row) > limit:
            return limit + 1
    return row[-1]
