"""From the store's answers to the shapes of the API."""

from __future__ import annotations

from typing import Any

from tappet.project.store import records
from tappet.server.projects.shapes import ProjectSummary, Revision

_CHANGES = {"create": "created", "import": "created", "add": "created", "copy": "created", "move": "moved"}
"""What happened to an object, by the action of its change; `updated` for all others."""


def project_summary(info: records.ProjectInfo) -> ProjectSummary:
    """A project in the list."""
    return ProjectSummary(
        id=info.id,
        name=info.name,
        description=info.description,
        revision=info.revision,
        created=info.created_at,
        created_by=info.created_by,
        modified=info.changed_at,
        modified_by=info.changed_by,
    )


def object_revision(found: records.ObjectRevision) -> Revision:
    """A state of an object."""
    return _revision(
        found,
        found.deleted,
        project_revision=found.project_revision,
        object_id=found.object_id,
        object_name=found.name,
    )


def project_revision(found: records.ProjectRevision) -> Revision:
    """A change of a project."""
    object_id, name = found.objects[0] if len(found.objects) == 1 else (None, None)
    return _revision(
        found,
        found.action == "delete",
        project_revision=found.revision,
        object_id=object_id,
        object_name=name,
        object_count=len(found.objects),
    )


def _revision(
    found: records.ObjectRevision | records.ProjectRevision, deleted: bool, **about: Any
) -> Revision:
    """A revision of either, with what only one of them says."""
    return Revision(
        revision=found.revision,
        at=found.at,
        author=found.author,
        comment=found.comment,
        autosave=found.autosave,
        action=found.action,
        change="deleted" if deleted else _CHANGES.get(found.action, "updated"),
        **about,
    )
