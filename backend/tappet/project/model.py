"""What a project is: a tree of objects, each of a kind with its own data (CON-05, PRJ-01).

Everything here is a frozen value. `objects` makes objects whose data fit their kind, `edit` changed projects;
`placement` says what may be where, `kinds` what each kind is.
"""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, Field, SerializeAsAny, StrictInt

from tappet.project.data import CodeData, Data
from tappet.project.errors import InvalidDataError, UnknownObjectError
from tappet.project.naming import name_key

APPLICATION = "application"
"""The kind of what is compiled and downloaded as one."""
DEVICE = "device"
"""The kind of the roots of the Devices view; all other roots are those of the POUs view."""
FOLDER = "folder"
"""The kind of what groups objects and is transparent to everything else."""

D = TypeVar("D", bound=Data)


class ProjectObject(BaseModel):
    """An object of the tree. Its data are those of its kind, `UnknownData` while no plug-in knows them."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: str = Field(pattern=r"^[0-9a-f]{32}$", description="uuid4 as 32 hexadecimal digits.")
    parent_id: str | None = Field(
        default=None, description="None for the roots of the Devices and the POUs view."
    )
    kind: str = Field(min_length=1, max_length=64, pattern=r"^[a-z][a-z0-9_]*$")
    name: str = Field(min_length=1)
    index: StrictInt = Field(
        0, ge=0, description="Order among the children of one parent (roots: of one view), from 0."
    )
    revision: StrictInt = Field(
        0, ge=0, description="Number of the last save in the store; 0 = never stored."
    )
    data: SerializeAsAny[Data]

    @property
    def subkind(self) -> str | None:
        """What the declaration text says this is (`program`, `struct` ...), None where kind says it all."""
        return self.data.subkind

    @property
    def excluded(self) -> bool:
        """The compiler does not get this object, nor what is below it."""
        return isinstance(self.data, CodeData) and self.data.exclude_from_build

    def data_as(self, model: type[D]) -> D:
        """The data, which are of this model. Raises InvalidDataError when they are not."""
        if not isinstance(self.data, model):
            raise InvalidDataError(f"The data of the {self.kind} '{self.name}' do not fit its kind")
        return self.data


def new_id() -> str:
    """A fresh object id."""
    return uuid.uuid4().hex


def is_pous_root(parent_id: str | None, kind: str) -> bool:
    """Whether an object is a root of the POUs view; the roots of the two views are counted apart."""
    return parent_id is None and kind != DEVICE


@dataclass(frozen=True)
class Project:
    """A project: its name and its objects by id. A value: `edit` returns changed copies."""

    name: str
    description: str = ""
    objects: Mapping[str, ProjectObject] = field(default_factory=dict)
    extra_files: Mapping[str, bytes] = field(default_factory=dict)
    """Files of the project folder that are no objects (README.md, drawings), by path; kept as they are."""

    @cached_property
    def _children(self) -> dict[str | None, list[ProjectObject]]:
        children: dict[str | None, list[ProjectObject]] = {}
        for item in self.objects.values():
            children.setdefault(item.parent_id, []).append(item)
        for siblings in children.values():
            siblings.sort(
                key=lambda item: (
                    is_pous_root(item.parent_id, item.kind),
                    item.index,
                    name_key(item.name),
                    item.id,
                )
            )
        return children

    def get(self, object_id: str) -> ProjectObject:
        """The object with this id. Raises UnknownObjectError."""
        try:
            return self.objects[object_id]
        except KeyError:
            raise UnknownObjectError(
                f"The project '{self.name}' has no object with the id {object_id}"
            ) from None

    def children(self, object_id: str | None) -> list[ProjectObject]:
        """The children of an object in their order; of None the roots of both views, devices first."""
        return list(self._children.get(object_id, ()))

    def siblings(self, parent_id: str | None, kind: str) -> list[ProjectObject]:
        """The objects among which one of this kind below `parent_id` is counted by its index."""
        view = is_pous_root(parent_id, kind)
        return [
            item for item in self._children.get(parent_id, ()) if is_pous_root(parent_id, item.kind) == view
        ]

    def child(self, object_id: str | None, name: str) -> ProjectObject | None:
        """The child with this name in any case, None when there is none."""
        key = name_key(name)
        return next((item for item in self._children.get(object_id, ()) if name_key(item.name) == key), None)

    def walk(self, object_id: str | None = None) -> Iterator[ProjectObject]:
        """The objects below an object (of None: all), depth first, in tree order."""
        waiting = list(reversed(self._children.get(object_id, ())))
        while waiting:
            item = waiting.pop()
            yield item
            waiting.extend(reversed(self._children.get(item.id, ())))

    def ancestors(self, object_id: str) -> Iterator[ProjectObject]:
        """The parent of an object, its parent, and so on up to a root."""
        parent_id = self.get(object_id).parent_id
        while parent_id is not None:
            parent = self.get(parent_id)
            yield parent
            parent_id = parent.parent_id

    def path_of(self, object_id: str) -> str:
        """Names from the root to the object, joined by `/`: `PLC/PLC Logic/Application/PLC_PRG`."""
        names = [self.get(object_id).name, *(item.name for item in self.ancestors(object_id))]
        return "/".join(reversed(names))

    def find(self, path: str) -> ProjectObject | None:
        """The object at a path as `path_of` gives it, in any case; None when there is none."""
        found: list[ProjectObject | None] = [None]
        for name in path.split("/"):
            key = name_key(name)
            found = [
                child
                for parent in found
                for child in self._children.get(parent.id if parent else None, ())
                if name_key(child.name) == key
            ]
        return found[0] if found and path else None

    def find_kind(self, kind: str) -> list[ProjectObject]:
        """All objects of a kind, in tree order."""
        return [item for item in self.walk() if item.kind == kind]

    def applications(self) -> list[ProjectObject]:
        """All applications, in tree order."""
        return self.find_kind(APPLICATION)
