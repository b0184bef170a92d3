"""What can be done to a project: each function takes a project and returns the changed one.

Nothing here touches the project it is given, so that a caller can compare, refuse or store the outcome.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import chain
from typing import Any

from tappet.project.data import CodeData, Data
from tappet.project.errors import InvalidDataError, NeededObjectError, NotPlaceableError
from tappet.project.kind_registry import kind_of, kinds
from tappet.project.model import APPLICATION, Project, ProjectObject, new_id
from tappet.project.naming import normal_name, unique_name
from tappet.project.object_kind import Renaming
from tappet.project.objects import changed_object, make_object
from tappet.project.placement import (
    Site,
    check_name,
    check_place,
    check_spelling,
    in_scope_of,
    owner_of,
    proposed_name,
)
from tappet.project.renamed_variable import users_renamed
from tappet.project.templates import new_data

AnyData = Data | Mapping[str, Any]


def add_object(
    project: Project,
    parent_id: str | None,
    kind: str,
    name: str | None = None,
    *,
    subkind: str | None = None,
    language: str | None = None,
    data: AnyData | None = None,
    index: int | None = None,
) -> tuple[Project, ProjectObject]:
    """Add an object and what comes with its kind; without `data` it begins with the kind's template, in the
    language that is asked for.

    `name` None takes a proposed one; `index` None appends. Raises NotPlaceableError, InvalidNameError,
    NameTakenError, InvalidDataError, UnknownObjectError (parent).
    """
    site = Site.of(project, parent_id)
    check_place(site, kind)
    name = proposed_name(site, kind) if name is None else normal_name(name)
    check_name(site, kind, name)
    added = make_object(
        id=new_id(),
        parent_id=parent_id,
        kind=kind,
        name=name,
        index=len(project.siblings(parent_id, kind)),
        data=new_data(kind, name, subkind, language) if data is None else data,
    )
    grown = _with(project, [added])
    if index is not None:
        grown = _ordered(grown, added.id, index)
    for child in kinds()[kind].children:
        grown, _ = add_object(grown, added.id, child.kind, child.name)
    return _with_companions(grown, added.id), grown.get(added.id)


def change_data(project: Project, object_id: str, data: AnyData) -> Project:
    """Give an object other data of its kind. Raises InvalidDataError, UnknownObjectError."""
    return _with(project, [changed_object(project.get(object_id), data=data)])


def exclude_object(project: Project, object_id: str, excluded: bool) -> Project:
    """Exclude an object from the build, or take it in again.

    Raises InvalidDataError for objects that the compiler does not get anyway, UnknownObjectError.
    """
    item = project.get(object_id)
    if not isinstance(item.data, CodeData):
        raise InvalidDataError(f"'{item.name}' is not compiled, so it cannot be excluded from the build")
    data = item.data.model_copy(update={"exclude_from_build": excluded})
    return _with(project, [changed_object(item, data=data)])


def rename_object(project: Project, object_id: str, name: str) -> Project:
    """Rename an object: in the tree, in its declaration's header (DECL-30), and where others follow, such as
    the tasks that call it.

    Raises InvalidNameError, NameTakenError, UnknownObjectError.
    """
    item = project.get(object_id)
    name = normal_name(name)
    if name == item.name:
        return project
    check_name(Site.of(project, item.parent_id), item.kind, name, own=object_id)
    return _with(project, [_renamed(item, name), *_following(project, item, name)])


def move_object(project: Project, object_id: str, parent_id: str | None, index: int | None = None) -> Project:
    """Put an object below another parent or elsewhere among its siblings; `index` None appends.

    Raises NotPlaceableError, NameTakenError, UnknownObjectError.
    """
    item = project.get(object_id)
    if parent_id != item.parent_id:
        _check_no_cycle(project, item, parent_id)
        site = Site.of(project, parent_id)
        if item.kind in kinds():
            check_place(site, item.kind, present=object_id)
        else:
            _check_unknown_place(project, item, site)
        check_name(site, item.kind, item.name, own=object_id)
        old_parent = item.parent_id
        end = len(project.siblings(parent_id, item.kind))
        moved = changed_object(item, parent_id=parent_id, index=end)
        project = _dense(_with(project, [moved]), old_parent, item.kind)
    last = len(project.siblings(parent_id, item.kind)) - 1
    there = _ordered(project, object_id, last if index is None else index)
    left = [] if item.parent_id is None else in_scope_of(there, owner_of(there, item.parent_id))
    return _with_companions(there, object_id, *(other.id for other in left))


def copy_object(
    project: Project,
    object_id: str,
    parent_id: str | None,
    *,
    index: int | None = None,
    source: Project | None = None,
) -> tuple[Project, ProjectObject]:
    """Copy an object with all below it, under new ids and a free name (CON-02); names inside stay.

    `source` is the project to copy from, by default the same. Raises NotPlaceableError, UnknownObjectError.
    """
    origin = source or project
    item = origin.get(object_id)
    site = Site.of(project, parent_id)
    if item.kind in kinds():
        check_place(site, item.kind)
    else:
        _check_unknown_place(origin, item, site)
    name = _free_name(site, item)
    check_spelling(item.kind, name)
    ids = {item.id: new_id()} | {below.id: new_id() for below in origin.walk(item.id)}
    top = changed_object(
        item if name == item.name else _renamed(item, name),
        id=ids[item.id],
        parent_id=parent_id,
        index=len(project.siblings(parent_id, item.kind)),
        revision=0,
    )
    copies = [top]
    for below in origin.walk(item.id):
        assert below.parent_id is not None, "an object below another has a parent"
        copies.append(changed_object(below, id=ids[below.id], parent_id=ids[below.parent_id], revision=0))
    grown = _with(project, copies)
    if index is not None:
        grown = _ordered(grown, top.id, index)
    return _with_companions(grown, top.id), grown.get(top.id)


def delete_object(project: Project, object_id: str) -> Project:
    """Remove an object and all below it. Raises UnknownObjectError, NeededObjectError."""
    return delete_objects(project, [object_id])


def delete_objects(project: Project, object_ids: Iterable[str]) -> Project:
    """Remove objects and all below them.

    Raises UnknownObjectError, and NeededObjectError if what stays needs one of them.
    """
    chosen = list(dict.fromkeys(object_ids))
    tops = [one for one in chosen if not {above.id for above in project.ancestors(one)} & set(chosen)]
    removed = []
    for object_id in tops:
        item = project.get(object_id)
        removed.append(item)
        gone = {item.id} | {below.id for below in project.walk(item.id)}
        kept = {key: value for key, value in project.objects.items() if key not in gone}
        project = _dense(replace(project, objects=kept), item.parent_id, item.kind)
    _check_companions(project, removed)
    return project


def give_content(project: Project, then: ProjectObject) -> Project:
    """Give the object with the id of `then` its name and data; its place stays. Raises NameTakenError."""
    item = project.get(then.id)
    if then.name != item.name:
        check_name(Site.of(project, item.parent_id), item.kind, then.name, own=item.id)
    return _with(project, [changed_object(item, name=then.name, data=then.data)])


def restore_objects(
    project: Project, top: ProjectObject, below: Iterable[ProjectObject], index: int
) -> Project:
    """Bring a deleted object back at `index`, with those of `below` that were under it.

    A name that is taken by now counts on. Raises NotPlaceableError when its parent is gone too, or the like
    of it has taken its place.
    """
    if top.parent_id is not None and top.parent_id not in project.objects:
        raise NotPlaceableError(f"What '{top.name}' was in has been deleted too; restore that first")
    site = Site.of(project, top.parent_id)
    if top.kind in kinds():
        check_place(site, top.kind)
    name = _free_name(site, top)
    restored = [top if name == top.name else _renamed(top, name)]
    found = {top.id}
    waiting = list(below)
    while True:
        now = [item for item in waiting if item.parent_id in found]
        if not now:
            break
        restored += now
        found.update(item.id for item in now)
        waiting = [item for item in waiting if item.id not in found]
    end = len(project.siblings(top.parent_id, top.kind))
    restored[0] = changed_object(restored[0], index=end)
    return _with_companions(_ordered(_with(project, restored), top.id, index), top.id)


def _with(project: Project, items: Iterable[ProjectObject]) -> Project:
    return replace(project, objects={**project.objects, **{item.id: item for item in items}})


def _in_order(project: Project, siblings: list[ProjectObject]) -> Project:
    """The project with these siblings numbered from 0 in this order."""
    moved = [item.model_copy(update={"index": i}) for i, item in enumerate(siblings) if item.index != i]
    return _with(project, moved) if moved else project


def _dense(project: Project, parent_id: str | None, kind: str) -> Project:
    return _in_order(project, project.siblings(parent_id, kind))


def _ordered(project: Project, object_id: str, index: int) -> Project:
    """The project with an object at `index` among its siblings; a number out of range means the end."""
    item = project.get(object_id)
    siblings = [other for other in project.siblings(item.parent_id, item.kind) if other.id != object_id]
    siblings.insert(max(0, index), item)
    return _in_order(project, siblings)


def _with_companions(project: Project, *object_ids: str) -> Project:
    """The project with what the kinds of objects, and of those below them, want to stand beside them."""
    for item in chain.from_iterable((project.get(one), *project.walk(one)) for one in object_ids):
        companion = _companion_of(item)
        owner = owner_of(project, item.parent_id)
        if companion and owner and all(one.kind != companion for one in in_scope_of(project, owner)):
            project, _ = add_object(project, owner.id, companion)
    return project


def _companion_of(item: ProjectObject) -> str:
    kind = kind_of(item)
    return "" if kind is None else kind.companion


def _check_companions(project: Project, removed: Iterable[ProjectObject]) -> None:
    """Raise NeededObjectError when objects that are gone were companions of some that stay."""
    for item in removed:
        owner = item.parent_id
        if owner is None or owner not in project.objects:
            continue
        beside = list(in_scope_of(project, owner_of(project, owner)))
        if any(other.kind == item.kind for other in beside):
            continue
        needs = next((other for other in beside if _companion_of(other) == item.kind), None)
        if needs is not None:
            raise NeededObjectError(f"'{item.name}' is needed by '{needs.name}'; delete that first")


def _renamed(item: ProjectObject, name: str) -> ProjectObject:
    kind = kind_of(item)
    data = item.data if kind is None or kind.renamed is None else kind.renamed(item.data, name)
    return changed_object(item, name=name, data=data)


def _following(project: Project, renamed: ProjectObject, name: str) -> list[ProjectObject]:
    """The objects of the same application, or of all for one of the POUs view, that follow a new name."""
    above = project.ancestors(renamed.id)
    application = next((item for item in above if item.kind == APPLICATION), None)
    renaming = Renaming(renamed.kind, renamed.subkind, renamed.name, name)
    changed = []
    for item in project.walk(application.id if application else None):
        kind = kind_of(item)
        if kind is None or kind.follow is None or item.id == renamed.id:
            continue
        data = kind.follow(item.data, renaming)
        if data is not item.data:
            changed.append(changed_object(item, data=data))
    kind = kind_of(renamed)
    if kind is not None and kind.compiled.variable_in:
        changed += users_renamed(
            project,
            project.walk(application.id if application else None),
            (
                *(name.format(name=renamed.name) for name in kind.compiled.variable_in),
                *((application.name,) if application else ()),
            ),
            {renamed.name + ending: name + ending for ending in kind.compiled.variable_endings},
        )
    return changed


def _free_name(site: Site, item: ProjectObject) -> str:
    known = kinds().get(item.kind)
    if known is not None and known.naming.style == "fixed":
        check_name(site, item.kind, item.name)
        return item.name
    below = site.below(site.parent.id if site.parent else None)
    return unique_name(item.name, [other.name for other in (*site.scope, *below)])


def _check_no_cycle(project: Project, item: ProjectObject, parent_id: str | None) -> None:
    if parent_id is None:
        return
    above = {parent_id} | {ancestor.id for ancestor in project.ancestors(parent_id)}
    if item.id in above:
        raise NotPlaceableError(f"'{item.name}' cannot be moved into itself")


def _check_unknown_place(origin: Project, item: ProjectObject, site: Site) -> None:
    """An object whose plug-in is missing may only go where its like is: below the same kind of owner."""
    old_owner = owner_of(origin, item.parent_id)
    if (old_owner.kind if old_owner else None) != (site.owner.kind if site.owner else None):
        raise NotPlaceableError(
            f"'{item.name}' belongs to a plug-in that is not installed; where else it may be is not known"
        )
