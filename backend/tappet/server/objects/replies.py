"""From the store's objects to the shapes of the API."""

from __future__ import annotations

from tappet.project.model import ProjectObject as StoredObject
from tappet.project.store import records
from tappet.project.store.rows import summary_of
from tappet.server.objects.shapes import ObjectDetail, ObjectSummary


def object_summary(item: records.ObjectSummary) -> ObjectSummary:
    """An object in the tree."""
    return ObjectSummary.of(item)


def object_detail(item: StoredObject) -> ObjectDetail:
    """An object with its data."""
    return ObjectDetail(
        **object_summary(summary_of(item)).model_dump(), data=item.data.model_dump(mode="json")
    )
