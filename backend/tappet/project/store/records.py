"""What the store answers with, besides the project model itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal

from tappet.project.errors import ProjectError
from tappet.project.model import ProjectObject


@dataclass(frozen=True, slots=True)
class ProjectInfo:
    """A project in the list. `revision` counts its changes."""

    id: str
    name: str
    description: str
    revision: int
    created_at: datetime
    created_by: str
    changed_at: datetime
    changed_by: str
    deleted_at: datetime | None


@dataclass(frozen=True, slots=True)
class ObjectSummary:
    """An object in the tree, without its data."""

    id: str
    parent_id: str | None
    kind: str
    subkind: str | None
    name: str
    index: int
    revision: int
    excluded: bool = False
    """From the build."""


@dataclass(frozen=True, slots=True)
class ObjectContent:
    """Other data for an object that was read at `base_revision`."""

    object_id: str
    base_revision: int
    data: Any


ObjectAction = Literal["created", "updated", "moved", "deleted"]


@dataclass(frozen=True, slots=True)
class ObjectChange:
    """What happened to one object; for a deleted one, as it was last."""

    action: ObjectAction
    summary: ObjectSummary


@dataclass(frozen=True, slots=True)
class ChangeEvent:
    """A change that has been stored; what listeners get."""

    project_id: str
    revision: int
    action: str
    author: str
    objects: tuple[ObjectChange, ...]


@dataclass(frozen=True, slots=True)
class ObjectRevision:
    """One state an object has had."""

    object_id: str
    revision: int
    name: str
    kind: str
    deleted: bool
    project_revision: int
    action: str
    author: str
    at: datetime
    comment: str
    autosave: bool


@dataclass(frozen=True, slots=True)
class ProjectRevision:
    """One change of a project, with the objects it touched (id and name, in no order)."""

    revision: int
    action: str
    author: str
    at: datetime
    comment: str
    autosave: bool
    objects: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class DeletedObject:
    """An object that was deleted, with how many below it."""

    id: str
    kind: str
    subkind: str | None
    name: str
    path: str
    """Where it was; of what it was in, the present names."""
    revision: int
    """To go back to, to have it again."""
    project_revision: int
    author: str
    at: datetime
    below: int


class UnknownProjectError(ProjectError):
    """No project with this id, or it has been deleted."""

    code = "unknown_project"


class UnknownRevisionError(ProjectError):
    """The object or project has no such revision."""

    code = "unknown_revision"


class StaleRevision(ProjectError):  # noqa: N818 - the name of the contract
    """Somebody else has changed the object since it was read; nothing has been written.

    Carries both versions, so that nothing is lost: `current` as it is stored now (None if it was deleted),
    and `yours`, what this save wanted to write on top of `base_revision`.
    """

    code = "stale_revision"

    def __init__(
        self,
        object_id: str,
        base_revision: int,
        current: ProjectObject | None,
        yours: Mapping[str, Any],
        author: str,
    ) -> None:
        if current is not None:
            what = (
                f"'{current.name}' was changed by {author} after you opened it (you have revision "
                f"{base_revision}, stored is {current.revision}). Compare the two versions and save again"
            )
        else:
            what = (
                f"The object was deleted by {author} after you opened it (you have revision "
                f"{base_revision}). Compare the two versions and save again"
            )
        super().__init__(what)
        self.object_id = object_id
        self.base_revision = base_revision
        self.current = current
        self.yours = dict(yours)
        self.author = author
