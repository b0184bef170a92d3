"""The objects of a project while an import adds to them, with the names that are taken where."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tappet.project.exchange.drafts import Draft, fit_free
from tappet.project.kind_registry import kinds
from tappet.project.model import FOLDER, Project, ProjectObject, is_pous_root
from tappet.project.naming import name_key, unique_name
from tappet.project.object_kind import Merging
from tappet.project.placement import Site, in_code, owner_of


class GrowingTree:
    """Objects by id, their places and names; finding a free name costs one look."""

    def __init__(self, project: Project) -> None:
        self.before = project
        self.objects: dict[str, ProjectObject] = dict(project.objects)
        self._children: dict[str | None, list[str]] = {}
        self._siblings: dict[tuple[str | None, bool], dict[str, str]] = {}
        """Names by key below a parent, to their objects; of the roots those of one view."""
        self._scopes: dict[str | None, dict[str, str]] = {}
        """Owner (None: roots of the POUs view) to the keys of the names in its scope, to their objects."""
        self.owners: dict[str | None, str | None] = {None: None}
        """The object that what is below each one belongs to."""
        for item in project.walk():
            owner = owner_of(project, item.parent_id)
            self.enter(item, owner.id if owner else None)

    def enter(self, item: ProjectObject, owner_id: str | None) -> None:
        """Take an object in, which belongs to an owner."""
        self.objects[item.id] = item
        self._children.setdefault(item.parent_id, []).append(item.id)
        self._names_beside(item.kind, item.parent_id)[name_key(item.name)] = item.id
        self.owners[item.id] = owner_id if item.kind == FOLDER else item.id
        if in_code(item.kind):
            self._scopes.setdefault(owner_id, {}).setdefault(name_key(item.name), item.id)

    def remove(self, item: ProjectObject) -> None:
        """Take an object out, with all below it; its siblings are counted anew."""
        for child in self.children(item.id):
            self.remove(child)
        self._children[item.parent_id].remove(item.id)
        del self._names_beside(item.kind, item.parent_id)[name_key(item.name)]
        scope = self._scopes.get(self.owners[item.parent_id], {})
        if scope.get(name_key(item.name)) == item.id:
            del scope[name_key(item.name)]
        del self.objects[item.id]
        for index, sibling in enumerate(sorted(self.children(item.parent_id), key=lambda one: one.index)):
            if sibling.index != index:
                self.objects[sibling.id] = sibling.model_copy(update={"index": index})

    def children(self, parent_id: str | None) -> list[ProjectObject]:
        """What is directly below an object."""
        return [self.objects[child] for child in self._children.get(parent_id, ())]

    def count_beside(self, kind: str, parent_id: str | None) -> int:
        """The index of one more object of a kind."""
        return len(self._names_beside(kind, parent_id))

    def site(self, parent_id: str | None) -> Site:
        """The place below an object, for the rules of placement."""
        owner_id = self.owners[parent_id]
        return Site(
            self.objects[parent_id] if parent_id is not None else None,
            self.objects[owner_id] if owner_id is not None else None,
            self.children,
            lambda object_id: self.objects[object_id].name,
        )

    def like(self, draft: Draft, merging: Merging[Any], parent_id: str | None) -> ProjectObject | None:
        """The object that takes the content of a draft: of its kind at the place, folders included where the
        place can have only one."""
        site = self.site(parent_id)
        if not merging.by_name:
            return next((item for item in site.scope if item.kind == draft.kind), None)
        key = name_key(fit_free(draft.name))
        same = (item for item in site.siblings(draft.kind) if item.kind == draft.kind)
        return next((item for item in same if name_key(item.name) == key), None)

    def of_name(self, kind: str, name: str, parent_id: str | None) -> ProjectObject | None:
        """The object of the project as it was that keeps one of this kind from a name at a place."""
        key = name_key(name)
        found = self._names_beside(kind, parent_id).get(key)
        if found is None and in_code(kind):
            found = self._scopes.get(self.owners[parent_id], {}).get(key)
        return self.objects[found] if found is not None and found in self.before.objects else None

    def is_free(self, kind: str, name: str, parent_id: str | None) -> bool:
        """Whether an object of this kind can have a name at a place."""
        scope = self._scopes.get(self.owners[parent_id], {}) if in_code(kind) else {}
        return name_key(name) not in scope and name_key(name) not in self._names_beside(kind, parent_id)

    def free_name(self, kind: str, name: str, parent_id: str | None) -> str:
        """The name, counted on where it is taken; one that is fixed stays."""
        known = kinds().get(kind)
        if (known is not None and known.naming.style == "fixed") or self.is_free(kind, name, parent_id):
            return name
        taken = dict(self._names_beside(kind, parent_id))
        if in_code(kind):
            taken.update(self._scopes.get(self.owners[parent_id], {}))
        return unique_name(name, [self.objects[other].name for other in taken.values()])

    def outcome(self) -> Project:
        """The project with everything in it."""
        return replace(self.before, objects=self.objects)

    def _names_beside(self, kind: str, parent_id: str | None) -> dict[str, str]:
        """The names among which one of this kind has to be new."""
        return self._siblings.setdefault((parent_id, is_pous_root(parent_id, kind)), {})
