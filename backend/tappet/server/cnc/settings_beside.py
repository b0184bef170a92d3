"""The CNC settings that a CNC program has: those of its application."""

from __future__ import annotations

from tappet.project.cnc.settings import CncSettingsData
from tappet.project.store import Store


def settings_beside(store: Store, project_id: str, object_id: str) -> CncSettingsData:
    """Of the application that a program is in; those of a new project where there are none."""
    tree = store.tree(project_id)
    parents = {item.id: item.parent_id for item in tree}
    settings = {item.parent_id: item.id for item in tree if item.kind == "cnc_settings"}
    place: str | None = object_id
    while place is not None:
        if place in settings:
            data = store.get(project_id, settings[place]).data
            return data if isinstance(data, CncSettingsData) else CncSettingsData()
        place = parents.get(place)
    return CncSettingsData()
