"""What an importer reads before it has a place in a project: objects with names, texts and children."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from tappet.project.data import CodeData
from tappet.project.exchange.codesys23_places import Places
from tappet.project.kind_registry import kinds
from tappet.project.naming import normal_name

_NOT_FREE = re.compile(r"[\x00-\x1f\x7f./\\]+")


@dataclass(slots=True, eq=False)
class Draft:
    """An object to be: its kind, name and data, where it was read, and what is below it."""

    kind: str
    name: str
    data: dict[str, Any] = field(default_factory=dict)
    source: str = ""
    line: int | None = None
    children: list[Draft] = field(default_factory=list)
    id: str | None = None
    """32 hexadecimal digits, where the file has an id."""
    key: str = ""
    """What a preview calls it."""
    partial: bool = False
    """Something that the file has below it is not wanted."""

    def folder(self, name: str, source: str = "") -> Draft:
        """The child folder with this name, made if it is missing."""
        for child in self.children:
            if child.kind == "folder" and child.name.casefold() == name.casefold():
                return child
        made = Draft("folder", name, source=source or self.source)
        self.children.append(made)
        return made

    def below(self, folders: tuple[str, ...], source: str = "") -> Draft:
        """The folder at a path of names below this draft, made as far as it is missing."""
        place = self
        for name in folders:
            place = place.folder(name, source)
        return place


@dataclass(slots=True, eq=False)
class Batch:
    """Everything that a call imports."""

    name: str = ""
    """Name of the project in the file."""
    description: str = ""
    loose: Draft = field(default_factory=lambda: Draft("application", ""))
    """What belongs to no named application: goes to the one that is imported into."""
    devices: list[Draft] = field(default_factory=list)
    """Devices with their PLC logic, applications and what is in these."""
    pous: Draft = field(default_factory=lambda: Draft("pous_view", ""))
    """What belongs into the POUs view."""
    places: Places = field(default_factory=Places)
    """Where addresses of devices that are not here lie."""
    complete: bool = False
    """Whether the file is our own export, in which nothing is missing that a new project has."""

    @property
    def empty(self) -> bool:
        """Nothing was read."""
        return not (self.loose.children or self.devices or self.pous.children)


def body(language: str, text: str) -> dict[str, Any]:
    """The data of an implementation."""
    return {"implementation": text, "language": language}


def exclude(draft: Draft) -> None:
    """Leave an object out of the build; what is no code is not in it anyway."""
    known = kinds().get(draft.kind)
    if known is not None and issubclass(known.data, CodeData):
        draft.data["exclude_from_build"] = True


def has_members(kind: str) -> bool:
    """Whether what is below an object of a kind are its members: methods and the like."""
    known = kinds().get(kind)
    return known is not None and known.compiled.members != "none"


def is_implied(kind: str) -> bool:
    """Whether an importer makes objects of a kind to hold others: at their place there is one, with a fixed
    name."""
    known = kinds().get(kind)
    return known is not None and known.placement.once and known.naming.style == "fixed"


def fit_free(name: str) -> str:
    """A name made fit for what can be named freely."""
    visible = "".join(c if c.isprintable() else " " for c in normal_name(name))
    return " ".join(_NOT_FREE.sub("_", visible).split())[:200].strip() or "Folder"


def hex_id(text: str) -> str | None:
    """A GUID as an object id: `{0A1B...}` in any case, with or without braces and dashes."""
    digits = text.strip().strip("{}").replace("-", "").lower()
    return digits if len(digits) == 32 and all(digit in "0123456789abcdef" for digit in digits) else None


def task_configuration(application: Draft) -> Draft:
    """The task configuration of an application, made if it is missing."""
    return _only(application, "task_configuration", "Task Configuration")


def library_manager(application: Draft) -> Draft:
    """The library manager of an application, made if it is missing."""
    return _only(application, "library_manager", "Library Manager")


def plc_logic(device: Draft) -> Draft:
    """The PLC logic of a device, made if it is missing."""
    return _only(device, "plc_logic", "PLC Logic")


def _only(parent: Draft, kind: str, name: str) -> Draft:
    for child in parent.children:
        if child.kind == kind:
            return child
    made = Draft(kind, name, source=parent.source)
    parent.children.append(made)
    return made
