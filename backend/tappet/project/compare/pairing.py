"""Which object of one project is which of another.

Objects are the same when their ids are: revisions of one project, and copies of it. Others are by their path;
then by what they hold, so that what was renamed or moved elsewhere is not taken for deleted and added.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from difflib import SequenceMatcher
from typing import Any

from tappet.project.data import CodeData, NoData
from tappet.project.kind_registry import kind_of
from tappet.project.model import FOLDER, Project, ProjectObject, is_pous_root
from tappet.project.naming import name_key

ALIKE = 0.7
"""Share of equal lines from which on two objects with other names are taken for one that was renamed."""
FEWEST_LINES = 6
"""Shorter objects that are not equal say too little: most of them is what all objects of the kind have."""
MOST_CANDIDATES = 40
"""Of each side, below one parent, that are looked at for being alike: the effort grows with the square."""


class Pairing:
    """The pairs of objects of two projects; each object is in one pair at most."""

    def __init__(self, old: Project, new: Project) -> None:
        self.old = old
        self.new = new
        self.to_new: dict[str, str] = {}
        self.to_old: dict[str, str] = {}
        self._waiting: list[tuple[str | None, str | None]] = [(None, None)]
        for object_id, item in old.objects.items():
            twin = new.objects.get(object_id)
            if twin is not None and twin.kind == item.kind:
                self._pair(item, twin)
        self._below_pairs()
        while self._renamed() or self._moved():
            self._below_pairs()

    def _pair(self, old: ProjectObject, new: ProjectObject) -> None:
        self.to_new[old.id] = new.id
        self.to_old[new.id] = old.id
        self._waiting.append((old.id, new.id))

    def _rest(
        self, old_id: str | None, new_id: str | None
    ) -> tuple[list[ProjectObject], list[ProjectObject]]:
        """The children of two parents that are in no pair."""
        return (
            [item for item in self.old.children(old_id) if item.id not in self.to_new],
            [item for item in self.new.children(new_id) if item.id not in self.to_old],
        )

    def _below_pairs(self) -> None:
        """Pair what has the same kind and name below parents that are a pair."""
        while self._waiting:
            old_rest, new_rest = self._rest(*self._waiting.pop())
            named = {(item.kind, name_key(item.name)): item for item in new_rest}
            for item in old_rest:
                twin = named.get((item.kind, name_key(item.name)))
                if twin is not None:
                    self._pair(item, twin)

    def _renamed(self) -> bool:
        """Pair what has another name below the same parent; whether something was."""
        found = False
        for parents in [(None, None), *self.to_new.items()]:
            old_rest, new_rest = self._rest(*parents)
            if not old_rest or not new_rest:
                continue
            candidates = [
                (likeness, i, j)
                for i, old in enumerate(old_rest[:MOST_CANDIDATES])
                for j, new in enumerate(new_rest[:MOST_CANDIDATES])
                if old.kind == new.kind
                and is_pous_root(old.parent_id, old.kind) == is_pous_root(new.parent_id, new.kind)
                and (likeness := self._likeness(old, new)) >= ALIKE
            ]
            candidates += _alone(old_rest, new_rest)
            for _, i, j in sorted(candidates, key=lambda one: (-one[0], one[1], one[2])):
                old, new = old_rest[i], new_rest[j]
                if old.id not in self.to_new and new.id not in self.to_old:
                    self._pair(old, new)
                    found = True
        return found

    def _likeness(self, old: ProjectObject, new: ProjectObject) -> float:
        """How much of two objects of one kind is equal, 0 to 1; names do not count."""
        kind = kind_of(old)
        if kind is not None and kind.naming.style == "fixed":
            return 0.0
        if isinstance(old.data, NoData):
            names = [
                {(item.kind, name_key(item.name)) for item in side.children(one.id)}
                for side, one in ((self.old, old), (self.new, new))
            ]
            every = names[0] | names[1]
            return len(names[0] & names[1]) / len(every) if every else 0.0
        as_new = old.data if kind is None or kind.renamed is None else kind.renamed(old.data, new.name)
        if as_new == new.data:
            return 1.0
        before, after = _lines(as_new.model_dump(mode="json")), _lines(new.data.model_dump(mode="json"))
        if min(len(before), len(after)) < FEWEST_LINES:
            return 0.0
        matcher = SequenceMatcher(None, before, after, autojunk=False)
        return matcher.ratio() if matcher.real_quick_ratio() >= ALIKE <= matcher.quick_ratio() else 0.0

    def _moved(self) -> bool:
        """Pair what alone has its kind and name among the rest; whether something was."""
        rest: dict[tuple[str, str], tuple[list[ProjectObject], list[ProjectObject]]] = defaultdict(
            lambda: ([], [])
        )
        for item in self.old.objects.values():
            if item.id not in self.to_new:
                rest[item.kind, name_key(item.name)][0].append(item)
        for item in self.new.objects.values():
            if item.id not in self.to_old:
                rest[item.kind, name_key(item.name)][1].append(item)
        found = False
        for old_items, new_items in rest.values():
            if len(old_items) != 1 or len(new_items) != 1:
                continue
            old, new = old_items[0], new_items[0]
            kind = kind_of(old)
            by_name = kind is not None and kind.naming.unique == "scope"
            if by_name or (old.data == new.data and not isinstance(old.data, NoData)):
                self._pair(old, new)
                found = True
        return found


def _alone(old_rest: list[ProjectObject], new_rest: list[ProjectObject]) -> list[tuple[float, int, int]]:
    """Devices, applications, tasks and the like that alone are of their kind here, as the last candidates."""
    counts = [Counter(item.kind for item in rest) for rest in (old_rest, new_rest)]
    places = {item.kind: j for j, item in enumerate(new_rest)}
    return [
        (0.0, i, places[item.kind])
        for i, item in enumerate(old_rest)
        if item.kind != FOLDER
        and not isinstance(item.data, CodeData)
        and counts[0][item.kind] == counts[1][item.kind] == 1
    ]


def _lines(value: Any) -> list[str]:
    """What data hold, a line of text or another value each."""
    if isinstance(value, str):
        return [line for line in value.split("\n") if line.strip()]
    if isinstance(value, dict):
        return [f"{key}: {line}" for key in sorted(value) for line in _lines(value[key])]
    if isinstance(value, list):
        return [line for one in value for line in _lines(one)]
    return [str(value)]
