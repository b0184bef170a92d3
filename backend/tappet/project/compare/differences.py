"""What differs between two projects, an object at a time.

`old` is what is compared with, `new` what is looked at: an object that is only in `new` was added.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from tappet.project.compare.ignoring import EVERYTHING_COUNTS, Ignoring, is_iec_text
from tappet.project.compare.pairing import Pairing
from tappet.project.longest_rising import longest_rising
from tappet.project.model import Project, ProjectObject, is_pous_root

State = Literal["added", "removed", "changed"]


@dataclass(frozen=True, slots=True)
class Difference:
    """What is different in one object."""

    key: str
    """Names the difference in its comparison."""
    state: State
    old: ProjectObject | None
    new: ProjectObject | None
    fields: tuple[str, ...] = ()
    """Fields of the data that differ, of an object that is on both sides."""
    renamed: bool = False
    moved: bool = False
    """Below another object."""
    reordered: bool = False
    """Elsewhere among the same siblings."""

    @property
    def item(self) -> ProjectObject:
        """The object as it is now, or as it was when it is gone."""
        found = self.new or self.old
        assert found is not None, "an object is on one side at least"
        return found


class Comparison:
    """Two projects and what differs between them."""

    def __init__(self, old: Project, new: Project, ignoring: Ignoring = EVERYTHING_COUNTS) -> None:
        self.old = old
        self.new = new
        self.ignoring = ignoring
        self.pairs = Pairing(old, new)

    @cached_property
    def differences(self) -> dict[str, Difference]:
        """By key: those of the new project in tree order, then what is gone, in that of the old one."""
        reordered = self._reordered()
        found: list[Difference] = []
        for new in self.new.walk():
            old_id = self.pairs.to_old.get(new.id)
            if old_id is None:
                found.append(Difference(new.id, "added", None, new))
                continue
            old = self.old.get(old_id)
            one = Difference(
                new.id,
                "changed",
                old,
                new,
                self._fields(old, new),
                renamed=old.name != new.name,
                moved=self._moved(old, new),
                reordered=new.id in reordered,
            )
            if one.fields or one.renamed or one.moved or one.reordered:
                found.append(one)
        found += [
            Difference(f"-{old.id}", "removed", old, None)
            for old in self.old.walk()
            if old.id not in self.pairs.to_new
        ]
        return {one.key: one for one in found}

    def _fields(self, old: ProjectObject, new: ProjectObject) -> tuple[str, ...]:
        if old.data == new.data:
            return ()
        before, after = values_of(old), values_of(new)
        return tuple(
            field
            for field in dict.fromkeys([*after, *before])
            if not self.ignoring.same(
                before.get(field), after.get(field), iec=is_iec_text(old, field) and is_iec_text(new, field)
            )
        )

    def _moved(self, old: ProjectObject, new: ProjectObject) -> bool:
        if old.parent_id is None or new.parent_id is None:
            return (old.parent_id is None) != (new.parent_id is None)
        return self.pairs.to_new.get(old.parent_id) != new.parent_id

    def _reordered(self) -> set[str]:
        """The objects of the new project that have left their place among those that stayed below a parent:
        as few as possible."""
        groups: dict[tuple[str | None, bool], list[str]] = defaultdict(list)
        positions: dict[str, int] = {}
        for new in self.new.walk():
            old_id = self.pairs.to_old.get(new.id)
            if old_id is None or self._moved(self.old.get(old_id), new):
                continue
            groups[new.parent_id, is_pous_root(new.parent_id, new.kind)].append(new.id)
            positions[new.id] = self.old.get(old_id).index
        return {
            object_id
            for order in groups.values()
            for object_id in set(order) - longest_rising(order, positions)
        }


def values_of(item: ProjectObject) -> dict[str, Any]:
    """The data of an object as JSON values by field."""
    return item.data.model_dump(mode="json")
