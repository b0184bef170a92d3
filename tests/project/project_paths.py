"""Objects of new projects by their paths."""

from __future__ import annotations

from tappet.project.model import Project, ProjectObject
from tappet.project.store import Store

APP = "Tappet Soft PLC/PLC Logic/Application"


def at(project: Project, path: str) -> ProjectObject:
    item = project.find(path)
    assert item is not None, path
    return item


def stored_at(store: Store, project_id: str, path: str) -> ProjectObject:
    return at(store.load(project_id), path)
