"""What can be done to a project: each function takes a project and returns the changed one.

Nothing here touches the project it is given, so that a caller can compare, refuse or store the outcome.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from tappet.project.data import (
    CodeData,
    Data,
    DeclarationData,
    MethodData,
    PouData,
    TaskData,
    UnknownData,
)
from tappet.project.declaration_text import rename_header
from tappet.project.errors import InvalidDataError, NotPlaceableError
from tappet.project.model import Project, ProjectObject, changed_object, make_object, new_id
from tappet.project.naming import name_key, normal_name, unique_name
from tappet.project.placement import (
    RULES,
    check_name,
    check_place,
    check_spelling,
    in_scope_of,
    owner_of,
    proposed_name,
)
from tappet.project.templates import children_of_new, new_data

AnyData = Data | UnknownData | Mapping[str, Any]


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
    check_place(project, kind, parent_id)
    name = proposed_name(project, kind, parent_id) if name is None else normal_name(name)
    check_name(project, kind, name, parent_id)
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
    for child_kind, child_name in children_of_new(kind):
        grown, _ = add_object(grown, added.id, child_kind, child_name)
    return grown, grown.get(added.id)


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
    """Rename an object: in the tree, in its declaration's header (DECL-30), and in the tasks that call it.

    Raises InvalidNameError, NameTakenError, UnknownObjectError.
    """
    item = project.get(object_id)
    name = normal_name(name)
    if name == item.name:
        return project
    check_name(project, item.kind, name, item.parent_id, own=object_id)
    changed = [_renamed(item, name)]
    if item.kind == "pou":
        changed += _tasks_calling(project, item, name)
    return _with(project, changed)


def move_object(project: Project, object_id: str, parent_id: str | None, index: int | None = None) -> Project:
    """Put an object below another parent or elsewhere among its siblings; `index` None appends.

    Raises NotPlaceableError, NameTakenError, UnknownObjectError.
    """
    item = project.get(object_id)
    if parent_id != item.parent_id:
        _check_no_cycle(project, item, parent_id)
        if item.kind in RULES:
            check_place(project, item.kind, parent_id, present=object_id)
        else:
            _check_unknown_place(project, item, parent_id)
        check_name(project, item.kind, item.name, parent_id, own=object_id)
        old_parent = item.parent_id
        end = len(project.siblings(parent_id, item.kind))
        moved = changed_object(item, parent_id=parent_id, index=end)
        project = _dense(_with(project, [moved]), old_parent, item.kind)
    last = len(project.siblings(parent_id, item.kind)) - 1
    return _ordered(project, object_id, last if index is None else index)


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
    if item.kind in RULES:
        check_place(project, item.kind, parent_id)
    else:
        _check_unknown_place(origin, item, parent_id, project)
    name = _free_name(project, item, parent_id)
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
    return grown, grown.get(top.id)


def delete_object(project: Project, object_id: str) -> Project:
    """Remove an object and all below it. Raises UnknownObjectError."""
    item = project.get(object_id)
    gone = {item.id} | {below.id for below in project.walk(item.id)}
    kept = {key: value for key, value in project.objects.items() if key not in gone}
    return _dense(replace(project, objects=kept), item.parent_id, item.kind)


def give_content(project: Project, then: ProjectObject) -> Project:
    """Give the object with the id of `then` its name and data; its place stays. Raises NameTakenError."""
    item = project.get(then.id)
    if then.name != item.name:
        check_name(project, item.kind, then.name, item.parent_id, own=item.id)
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
    if top.kind in RULES:
        check_place(project, top.kind, top.parent_id)
    name = _free_name(project, top, top.parent_id)
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
    return _ordered(_with(project, restored), top.id, index)


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


def _renamed(item: ProjectObject, name: str) -> ProjectObject:
    data = item.data
    if isinstance(data, (PouData, MethodData, DeclarationData)) and item.kind not in ("gvl", "persistent"):
        data = data.model_copy(update={"declaration": rename_header(data.declaration, name)})
    return changed_object(item, name=name, data=data)


def _tasks_calling(project: Project, program: ProjectObject, name: str) -> list[ProjectObject]:
    """The tasks of the program's scope that call it, with the new name."""
    application = next((item for item in project.ancestors(program.id) if item.kind == "application"), None)
    key = name_key(program.name)
    changed = []
    for task in project.walk(application.id if application else None):
        if isinstance(task.data, TaskData) and any(name_key(call.name) == key for call in task.data.pous):
            calls = tuple(
                call.model_copy(update={"name": name}) if name_key(call.name) == key else call
                for call in task.data.pous
            )
            changed.append(changed_object(task, data=task.data.model_copy(update={"pous": calls})))
    return changed


def _free_name(project: Project, item: ProjectObject, parent_id: str | None) -> str:
    rule = RULES.get(item.kind)
    if rule is not None and rule.naming == "fixed":
        check_name(project, item.kind, item.name, parent_id)
        return item.name
    taken = [other.name for other in in_scope_of(project, owner_of(project, parent_id))]
    taken += [other.name for other in project.children(parent_id)]
    return unique_name(item.name, taken)


def _check_no_cycle(project: Project, item: ProjectObject, parent_id: str | None) -> None:
    if parent_id is None:
        return
    above = {parent_id} | {ancestor.id for ancestor in project.ancestors(parent_id)}
    if item.id in above:
        raise NotPlaceableError(f"'{item.name}' cannot be moved into itself")


def _check_unknown_place(
    origin: Project, item: ProjectObject, parent_id: str | None, target: Project | None = None
) -> None:
    """An object whose plug-in is missing may only go where its like is: below the same kind of owner."""
    old_owner = owner_of(origin, item.parent_id)
    new_owner = owner_of(target or origin, parent_id)
    if (old_owner.kind if old_owner else None) != (new_owner.kind if new_owner else None):
        raise NotPlaceableError(
            f"'{item.name}' belongs to a plug-in that is not installed; where else it may be is not known"
        )
