"""Steps that can be undone, and what was deleted."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from tappet.server.shapes import Reply


class UndoStep(Reply):
    """A change of the tree that can be undone, or done again."""

    revision: int
    action: str = Field(description="What was done at first: `add`, `delete`, `rename`, `move`, `merge` ...")
    at: datetime
    objects: list[str] = Field(description="Names of the objects that it touched.")


class UndoSteps(Reply):
    """What the next undo and the next redo of who asks would do."""

    undo: UndoStep | None
    redo: UndoStep | None


class UndoOutcome(Reply):
    """What was undone or done again, and what can be now."""

    done: UndoStep
    touched: list[str] = Field(description="Ids of the objects that are other than before, or gone.")
    steps: UndoSteps


class DeletedObject(Reply):
    """An object that was deleted; `revert` to its revision brings it back with what was below it."""

    id: str
    kind: str
    subkind: str | None
    name: str
    path: str = Field(description="Where it was.")
    revision: int
    project_revision: int = Field(description="The change that deleted it.")
    author: str
    at: datetime
    below: int = Field(description="How many objects were deleted with it.")
