"""The objects of a project: tree, data, history."""

from __future__ import annotations

from tappet.project.store.records import ObjectContent
from tappet.server.dependencies import Engineer, StoreDep, Viewer
from tappet.server.objects.replies import object_detail, object_summary
from tappet.server.objects.shapes import (
    CopyTarget,
    NewObject,
    ObjectDetail,
    ObjectMove,
    ObjectSave,
    ObjectsSave,
    ObjectsToDelete,
    ObjectSummary,
)
from tappet.server.problems import Problem
from tappet.server.projects.replies import object_revision
from tappet.server.projects.shapes import RevertTarget, Revision
from tappet.server.routing import Router
from tappet.server.shapes import Number

router = Router(prefix="/projects/{project_id}/objects", tags=["objects"])


@router.get("")
def list_objects(project_id: str, who: Viewer, store: StoreDep) -> list[ObjectSummary]:
    """The tree: all objects without their data, siblings in their order."""
    return [object_summary(item) for item in store.tree(project_id)]


@router.post("", status_code=201)
def create_object(project_id: str, body: NewObject, who: Engineer, store: StoreDep) -> ObjectDetail:
    """Add an object; without `data` it begins with the template of its kind.

    Some kinds bring children: a device its PLC logic and application, a property its accessors.
    """
    item = store.add(
        project_id,
        who.username,
        body.parent_id,
        body.kind,
        body.name,
        subkind=body.subkind,
        language=body.language,
        data=body.data,
        index=body.index,
    )
    return object_detail(item)


@router.put("")
def save_objects(project_id: str, body: ObjectsSave, who: Engineer, store: StoreDep) -> list[ObjectDetail]:
    """Save the data of several objects as one change of the project: all of them, or none.

    If somebody else saved one of them since it was read, the answer is the problem `stale-revision` (409) as
    for a single object, and nothing was written.
    """
    contents = [ObjectContent(item.object_id, item.base_revision, item.data) for item in body.objects]
    return [
        object_detail(saved)
        for saved in store.save_all(project_id, contents, who.username, comment=body.comment)
    ]


@router.post("/delete", status_code=204)
def delete_objects(project_id: str, body: ObjectsToDelete, who: Engineer, store: StoreDep) -> None:
    """Delete objects and all below them as one change of the project, which can be undone."""
    store.delete(project_id, who.username, *body.object_ids)


@router.get("/{object_id}")
def read_object(project_id: str, object_id: str, who: Viewer, store: StoreDep) -> ObjectDetail:
    """One object with its data."""
    return object_detail(store.get(project_id, object_id))


@router.put("/{object_id}")
def save_object(
    project_id: str, object_id: str, body: ObjectSave, who: Engineer, store: StoreDep
) -> ObjectDetail:
    """Save the data of an object that was read at `base_revision`.

    If somebody else saved it since, the answer is the problem `stale-revision` (409) with `current`, the
    object as it is stored (null if it was deleted), and `yours`, what this request wanted to write; nothing
    was written. A mere move of the object is no conflict.
    """
    saved = store.save(
        project_id,
        object_id,
        body.base_revision,
        body.data,
        who.username,
        comment=body.comment,
        autosave=body.autosave,
    )
    return object_detail(saved)


@router.patch("/{object_id}")
def move_object(
    project_id: str, object_id: str, body: ObjectMove, who: Engineer, store: StoreDep
) -> ObjectDetail:
    """Rename or move an object, or exclude it from the build.

    A new name goes into the header of its declaration and into calling tasks.
    """
    sent = body.model_fields_set
    if not sent & {"name", "parent_id", "index", "excluded"}:
        raise Problem(422, "nothing-to-change", "Send a name, a parent_id, an index or excluded.")
    place = None
    if "parent_id" in sent:
        place = (body.parent_id, body.index)
    elif body.index is not None:
        place = (store.get(project_id, object_id).parent_id, body.index)
    moved = store.arrange(
        project_id,
        who.username,
        object_id,
        name=body.name,
        place=place,
        excluded=body.excluded,
        base_revision=body.base_revision,
    )
    return object_detail(moved)


@router.post("/{object_id}/copy", status_code=201)
def copy_object(
    project_id: str, object_id: str, body: CopyTarget, who: Engineer, store: StoreDep
) -> ObjectDetail:
    """Copy an object with all below it to a place in this project, under a free name."""
    copied = store.copy(
        project_id,
        who.username,
        object_id,
        body.parent_id,
        index=body.index,
        source_project_id=body.source_project_id,
    )
    return object_detail(copied)


@router.delete("/{object_id}", status_code=204)
def delete_object(project_id: str, object_id: str, who: Engineer, store: StoreDep) -> None:
    """Delete an object and all below it; reverting the object brings them back."""
    store.delete(project_id, who.username, object_id)


@router.get("/{object_id}/revisions")
def list_object_revisions(project_id: str, object_id: str, who: Viewer, store: StoreDep) -> list[Revision]:
    """The states an object has had, newest first; also of one that is deleted."""
    return [object_revision(found) for found in store.object_revisions(project_id, object_id)]


@router.get("/{object_id}/revisions/{revision}")
def read_object_revision(
    project_id: str, object_id: str, revision: Number, who: Viewer, store: StoreDep
) -> ObjectDetail:
    """An object as it was; its index is not kept and 0."""
    return object_detail(store.object_at(project_id, object_id, revision))


@router.post("/{object_id}/revert")
def revert_object(
    project_id: str, object_id: str, body: RevertTarget, who: Engineer, store: StoreDep
) -> ObjectDetail:
    """Give an object the name and data of a revision again, as a new revision.

    A deleted object comes back where it was, with what was deleted below it at the same time.
    """
    reverted = store.revert_object(project_id, object_id, body.revision, who.username, comment=body.comment)
    return object_detail(reverted)
