"""Differences taken over: objects, or parts of them, become in the new project what they were in the old one.

What is not chosen stays as it is. What a chosen object cannot be without comes with it: an object that was
removed brings what was below it, and what it was in if that is gone too; with one that was added goes what is
below it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from tappet.project.compare.differences import Comparison, Difference, values_of
from tappet.project.errors import InvalidDataError, ProjectError
from tappet.project.kind_registry import kind_of
from tappet.project.model import Project, ProjectObject, is_pous_root, new_id
from tappet.project.objects import changed_object
from tappet.project.placement import check_project

Group = tuple[str | None, bool]
"""Siblings in one order: their parent, and whether they are roots of the POUs view."""


class UnknownDifferenceError(ProjectError):
    """The comparison has no such difference, or not in this part of the object."""

    code = "unknown_difference"


@dataclass(frozen=True, slots=True)
class Take:
    """What to take of one difference."""

    key: str
    whole: bool = True
    """The object as it was; otherwise only what follows, of an object that is on both sides."""
    name: bool = False
    place: bool = False
    """What it was below, and where among its siblings."""
    fields: tuple[str, ...] = ()
    """Of the data."""
    texts: Mapping[str, str] = field(default_factory=dict)
    """Texts to give to fields: with blocks of the old text taken over, others kept."""


def take(comparison: Comparison, takes: Iterable[Take]) -> Project:
    """The new project with these differences taken over from the old one.

    Raises UnknownDifferenceError, InvalidDataError for parts that do not go together, and what
    `check_project` finds in the outcome: a name that is taken, a place that does not fit.
    """
    taking = _Taking(comparison)
    for one in takes:
        difference = comparison.differences.get(one.key)
        if difference is None:
            raise UnknownDifferenceError(
                f"There is no difference {one.key} in this comparison (any more); compare again"
            )
        taking.take(difference, one)
    return taking.result()


def take_all(comparison: Comparison) -> Project:
    """The new project with everything taken over: what the old one is, with the ids of the new one."""
    return take(comparison, [Take(key) for key in comparison.differences])


class _Taking:
    """The project as it becomes."""

    def __init__(self, comparison: Comparison) -> None:
        self.old = comparison.old
        self.new = comparison.new
        self.pairs = comparison.pairs
        self.objects = dict(comparison.new.objects)
        self.ids = dict(comparison.pairs.to_new)
        """Of objects of the old project, their ids in the outcome."""
        self.placed: set[str] = set()
        """Old ids of what stands in its old place."""

    def take(self, difference: Difference, one: Take) -> None:
        old, new = difference.old, difference.new
        if old is None or new is None:
            if not one.whole:
                raise UnknownDifferenceError(
                    f"'{difference.item.name}' is on one side only; it can only be taken as a whole"
                )
            if new is not None:
                self._remove(new)
            elif old is not None and old.id not in self.ids:
                self._restore_with_owners(old)
            return
        if one.whole:
            self._change(new.id, name=old.name, data=old.data)
        else:
            self._take_parts(old, new, one)
        if one.place or (one.whole and (difference.moved or difference.reordered)):
            self._place(old)

    def _change(self, object_id: str, **values: Any) -> None:
        """Other values, as they were stored: data that do not fit their kind any more are kept, too."""
        self.objects[object_id] = self.objects[object_id].model_copy(update=values)

    def _take_parts(self, old: ProjectObject, new: ProjectObject, one: Take) -> None:
        before, data = values_of(old), values_of(new)
        unknown = [name for name in (*one.fields, *one.texts) if name not in before and name not in data]
        if unknown:
            raise UnknownDifferenceError(f"'{new.name}' has no field '{unknown[0]}' in its data")
        wrong = [name for name in one.texts if not isinstance(data.get(name, before.get(name)), str)]
        if wrong:
            raise InvalidDataError(f"'{wrong[0]}' of '{new.name}' is no text; take it as a field")
        for name in one.fields:
            if name in before:
                data[name] = before[name]
            else:
                del data[name]
        data |= one.texts
        if one.fields or one.texts:
            self.objects[new.id] = changed_object(self.objects[new.id], data=data)
        if one.name and old.name != new.name:
            item = self.objects[new.id]
            kind = kind_of(item)
            renamed = item.data if kind is None or kind.renamed is None else kind.renamed(item.data, old.name)
            self._change(new.id, name=old.name, data=renamed)

    def _remove(self, new: ProjectObject) -> None:
        """Remove an object that the old project has not; what it has taken in goes back to its place."""
        self.objects.pop(new.id, None)
        for child in self.new.children(new.id):
            old_id = self.pairs.to_old.get(child.id)
            if old_id is None:
                self._remove(child)
            else:
                self._place(self.old.get(old_id))

    def _restore_with_owners(self, old: ProjectObject) -> None:
        self._restore_owners(old)
        self._restore(old)

    def _restore_owners(self, old: ProjectObject) -> None:
        """Bring back what an object was in, without what else was in there."""
        missing = [owner for owner in self.old.ancestors(old.id) if owner.id not in self.ids]
        for owner in reversed(missing):
            self._add(owner)

    def _restore(self, old: ProjectObject) -> None:
        """Bring back an object, and what was below it and is gone, too."""
        self._add(old)
        for child in self.old.children(old.id):
            if child.id not in self.pairs.to_new:
                self._restore(child)

    def _add(self, old: ProjectObject) -> None:
        if old.id in self.ids:
            return
        object_id = old.id if old.id not in self.new.objects else new_id()
        self.ids[old.id] = object_id
        self.objects[object_id] = old.model_copy(update={"id": object_id, "revision": 0})
        self.placed.add(old.id)

    def _place(self, old: ProjectObject) -> None:
        self._restore_owners(old)
        self.placed.add(old.id)

    def result(self) -> Project:
        """The outcome in its order. Raises what `check_project` finds."""
        for old_id in self.placed:
            if self.ids[old_id] in self.objects:
                parent_id = self.old.get(old_id).parent_id
                parent = None if parent_id is None else self.ids[parent_id]
                self._change(self.ids[old_id], parent_id=parent)
        for order in self._orders().values():
            for index, object_id in enumerate(order):
                if self.objects[object_id].index != index:
                    self._change(object_id, index=index)
        project = replace(self.new, objects=self.objects)
        check_project(project)
        return project

    def _orders(self) -> dict[Group, list[str]]:
        """The order of all siblings: what is placed stands behind what it stood behind before."""
        placed = {self.ids[old_id] for old_id in self.placed}
        orders: dict[Group, list[str]] = defaultdict(list)
        for item in self.new.walk():
            now = self.objects.get(item.id)
            if now is not None and item.id not in placed:
                orders[now.parent_id, is_pous_root(now.parent_id, now.kind)].append(item.id)
        for old in self.old.walk():
            if old.id not in self.placed or self.ids[old.id] not in self.objects:
                continue
            now = self.objects[self.ids[old.id]]
            order = orders[now.parent_id, is_pous_root(now.parent_id, now.kind)]
            before = [
                self.ids[other.id]
                for other in self.old.siblings(old.parent_id, old.kind)[: old.index]
                if other.id in self.ids
            ]
            positions = {object_id: index for index, object_id in enumerate(order)}
            behind = next((positions[one] for one in reversed(before) if one in positions), -1)
            order.insert(behind + 1, self.ids[old.id])
        return orders
