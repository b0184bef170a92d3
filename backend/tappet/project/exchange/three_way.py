"""Two changed versions of a text or of data joined, line by line and field by field (diff3).

Where the common ancestor is known, a change that only one side has made is taken. Without one, the lines that
both sides have stand for it: what only one side has stays, what differs at one place is a conflict.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Any

from tappet.iec.languages import is_plain_text
from tappet.iec.tokens import NAME, words

MOST_LINES = 20_000
"""Of a text that is compared line by line; a longer one is taken as a whole."""


@dataclass(frozen=True, slots=True)
class JoinedText:
    """A text with the changes of both sides; where they conflict, with those of the second one."""

    text: str
    conflicts: tuple[int, ...]
    """Lines of `text`, from 1, at which both sides differ."""


@dataclass(frozen=True, slots=True)
class JoinedData:
    """Data with the changes of both sides; where they conflict, with those of the second one."""

    data: dict[str, Any]
    conflicts: dict[str, tuple[int, ...]]
    """Fields that both sides have changed in different ways: for a text the lines, else nothing."""


def join_data(
    base: Mapping[str, Any] | None, ours: Mapping[str, Any], theirs: Mapping[str, Any]
) -> JoinedData:
    """The data of an object as two sides have them, both of the same kind and with every field."""
    joined: dict[str, Any] = {}
    conflicts: dict[str, tuple[int, ...]] = {}
    for field in {**ours, **theirs}:
        here, there = ours.get(field), theirs.get(field)
        before = base.get(field) if base is not None else None
        if here == there or (base is not None and there == before):
            joined[field] = here
        elif base is not None and here == before:
            joined[field] = there
        elif isinstance(here, str) and isinstance(there, str) and is_line_text(field, ours, theirs):
            start = before if isinstance(before, str) else None
            text = join_texts(start, here, there, declarations=field == "declaration")
            joined[field] = text.text
            if text.conflicts:
                conflicts[field] = text.conflicts
        else:
            joined[field] = there
            conflicts[field] = ()
    return JoinedData({field: value for field, value in joined.items() if value is not None}, conflicts)


def is_line_text(field: str, *sides: Mapping[str, Any]) -> bool:
    """Whether a field holds text of lines that stand for themselves; drawn bodies do not."""
    if field != "implementation":
        return field == "declaration"
    languages = {str(side.get("language", "")) for side in sides}
    return len(languages) == 1 and is_plain_text(languages.pop())


def join_texts(base: str | None, ours: str, theirs: str, *, declarations: bool = False) -> JoinedText:
    """Join the lines of two texts; of `declarations`, both sides may add different variables at a place."""
    here, there = ours.split("\n"), theirs.split("\n")
    if max(len(here), len(there)) > MOST_LINES:
        return JoinedText(theirs, (1,) if ours != theirs else ())
    start = _common(here, there) if base is None else base.split("\n")
    lines: list[str] = []
    conflicts: list[int] = []
    for before, left, right in _regions(start, here, there):
        if left == right or right == before:
            lines += left
        elif left == before:
            lines += right
        elif declarations and not before and _other_names(left, right):
            lines += left + right
        else:
            conflicts.append(len(lines) + 1)
            lines += right
    return JoinedText("\n".join(lines), tuple(conflicts))


def nearest(history: Sequence[Mapping[str, Any]], theirs: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """The state, newest first, that the other side was most likely made from: the one most like it."""
    wanted = _lines(theirs)

    def distance(state: Mapping[str, Any]) -> int:
        found = _lines(state)
        return (wanted - found).total() + (found - wanted).total()

    return min(history, key=distance, default=None)


def _lines(data: Mapping[str, Any]) -> Counter[str]:
    return Counter(f"{field}:{line}" for field, value in data.items() for line in str(value).split("\n"))


def _common(left: list[str], right: list[str]) -> list[str]:
    blocks = SequenceMatcher(None, left, right, autojunk=False).get_matching_blocks()
    return [line for block in blocks for line in left[block.a : block.a + block.size]]


def _regions(
    base: list[str], left: list[str], right: list[str]
) -> Iterator[tuple[list[str], list[str], list[str]]]:
    """The texts cut where all three agree: the same lines, or what stands between such ones."""
    at = here = there = 0
    for base_at, left_at, right_at, size in _agreed(base, left, right):
        if at < base_at or here < left_at or there < right_at:
            yield base[at:base_at], left[here:left_at], right[there:right_at]
        if size:
            same = base[base_at : base_at + size]
            yield same, same, same
        at, here, there = base_at + size, left_at + size, right_at + size


def _agreed(base: list[str], left: list[str], right: list[str]) -> Iterator[tuple[int, int, int, int]]:
    """Places in the three texts, and the number of lines that are the same in all from there on."""
    lefts = SequenceMatcher(None, base, left, autojunk=False).get_matching_blocks()
    rights = SequenceMatcher(None, base, right, autojunk=False).get_matching_blocks()
    i = j = 0
    while i < len(lefts) and j < len(rights):
        one, other = lefts[i], rights[j]
        begin = max(one.a, other.a)
        end = min(one.a + one.size, other.a + other.size)
        if begin < end:
            yield begin, one.b + begin - one.a, other.b + begin - other.a, end - begin
        if one.a + one.size < other.a + other.size:
            i += 1
        else:
            j += 1
    yield len(base), len(left), len(right), 0


def _other_names(left: list[str], right: list[str]) -> bool:
    """Whether both sides declare variables, and none of the same name."""
    here, there = _declared("\n".join(left)), _declared("\n".join(right))
    return bool(here) and bool(there) and here.isdisjoint(there)


def _declared(text: str) -> set[str]:
    """The names that whole declarations in a text declare; none where it is anything else."""
    names: set[str] = set()
    waiting: list[str] = []
    in_names = True
    for word in words(text):
        if word.text == ";":
            if in_names:
                return set()
            waiting, in_names = [], True
        elif in_names and word.text in (":", "AT"):
            names |= set(waiting)
            in_names = False
        elif in_names and NAME.fullmatch(word.text):
            waiting.append(word.text)
        elif in_names and word.text != ",":
            return set()
    return names if in_names and not waiting else set()
