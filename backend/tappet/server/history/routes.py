"""Undo and redo of changes of the tree; what was deleted."""

from __future__ import annotations

from tappet.project.store import Store
from tappet.server.dependencies import Engineer, StoreDep, Viewer
from tappet.server.history.shapes import DeletedObject, UndoOutcome, UndoStep, UndoSteps
from tappet.server.routing import Router

router = Router(prefix="/projects/{project_id}", tags=["objects"])


@router.get("/undo")
def read_undo_steps(project_id: str, who: Viewer, store: StoreDep) -> UndoSteps:
    """What undo and redo of the tree would do next, for who asks; also after a restart."""
    return UndoSteps.of(store.steps(project_id, who.username))


@router.post("/undo")
def undo_step(project_id: str, who: Engineer, store: StoreDep) -> UndoOutcome:
    """Take back the last change of the tree by who asks: adding, copying, deleting, renaming, moving,
    excluding from the build, importing, merging. What others did since stays: where both concern the same,
    the answer is the problem `changed-since`.
    """
    return _undo(store, project_id, who.username, redo=False)


@router.post("/redo")
def redo_step(project_id: str, who: Engineer, store: StoreDep) -> UndoOutcome:
    """Do again what was undone last, as long as nothing else was changed by who asks."""
    return _undo(store, project_id, who.username, redo=True)


def _undo(store: Store, project_id: str, author: str, *, redo: bool) -> UndoOutcome:
    step, event = store.undo(project_id, author, redo=redo)
    return UndoOutcome(
        done=UndoStep.of(step),
        touched=[change.summary.id for change in event.objects] if event is not None else [],
        steps=UndoSteps.of(store.steps(project_id, author)),
    )


@router.get("/deleted-objects")
def list_deleted_objects(project_id: str, who: Viewer, store: StoreDep) -> list[DeletedObject]:
    """What was deleted and is not back, latest first; what was deleted with it is counted."""
    return [DeletedObject.of(one) for one in store.deleted_objects(project_id)]
