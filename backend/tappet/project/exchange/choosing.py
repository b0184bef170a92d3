"""What an import would bring, as a tree to choose from, and leaving out what is not chosen.

A node is named by its place in what was read: reading the same files again gives the same names.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from pydantic import BaseModel, ConfigDict, Field

from tappet.project.data import Data
from tappet.project.exchange.drafts import Batch, Draft
from tappet.project.exchange.existing import Existing
from tappet.project.kind_registry import kinds


class ImportNode(BaseModel):
    """An object that an import would bring."""

    model_config = ConfigDict(frozen=True, json_schema_serialization_defaults_required=True)

    key: str = Field(description="To be sent back when the object is chosen.")
    parent: str | None
    kind: str
    subkind: str | None
    name: str
    source: str = Field(description="The file it is in.")
    line: int | None
    excluded: bool = Field(description="From the build.")
    existing: Existing | None = Field(default=None, description="What has its name in the project.")


def name_drafts(batch: Batch) -> None:
    """Give every draft the key that the preview calls it by."""
    for key, _, draft in _walk(batch):
        draft.key = key


def nodes_of(batch: Batch, existing: Mapping[str, Existing]) -> list[ImportNode]:
    """Everything that was read, parents before their children; `existing` by key."""
    return [
        ImportNode(
            key=key,
            parent=parent,
            kind=draft.kind,
            subkind=_subkind(draft),
            name=draft.name,
            source=draft.source,
            line=draft.line,
            excluded=bool(draft.data.get("exclude_from_build")),
            existing=existing.get(key),
        )
        for key, parent, draft in _walk(batch)
    ]


def keep_chosen(batch: Batch, chosen: Collection[str]) -> None:
    """Leave out what is not chosen; what holds something that is chosen stays."""
    wanted = set(chosen)
    kept: set[Draft] = set()
    above: dict[str, tuple[str | None, Draft]] = {}
    for key, parent, draft in _walk(batch):
        above[key] = parent, draft
        up: str | None = key if key in wanted else None
        while up is not None and above[up][1] not in kept:
            kept.add(above[up][1])
            up = above[up][0]
    for holder in (batch.loose, batch.pous, *(draft for _, draft in above.values())):
        wanted_children = [child for child in holder.children if child in kept]
        holder.partial = len(wanted_children) < len(holder.children)
        holder.children = wanted_children
    batch.devices = [device for device in batch.devices if device in kept]
    batch.complete = False  # what every application has comes with it, chosen or not


def _subkind(draft: Draft) -> str | None:
    """What the declaration says an object is, where it has one."""
    known = kinds().get(draft.kind)
    declaration = draft.data.get("declaration")
    if known is None or not isinstance(declaration, str):
        return None
    data: Data = known.data.model_construct(declaration=declaration)
    return data.subkind


def _walk(batch: Batch) -> Iterator[tuple[str, str | None, Draft]]:
    """Key, key of the parent, draft."""
    tops = (("application", batch.loose.children), ("device", batch.devices), ("pou", batch.pous.children))
    waiting: list[tuple[str, str | None, Draft]] = [
        (f"{name}.{index}", None, draft) for name, drafts in tops for index, draft in enumerate(drafts)
    ]
    waiting.reverse()
    while waiting:
        key, parent, draft = waiting.pop()
        yield key, parent, draft
        waiting += reversed([(f"{key}.{i}", key, child) for i, child in enumerate(draft.children)])
