"""Which kind of object may be where (CON-06..CON-09, TASK-02, PERS-02, LIB-01): one table.

A folder is transparent: it takes what the place it is in takes, except what must stand directly at its owner.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from tappet.project.data import Language
from tappet.project.errors import InvalidNameError, NameTakenError, NotPlaceableError, ProjectError
from tappet.project.model import Project, ProjectObject, is_pous_root
from tappet.project.naming import check_free_name, check_identifier, name_key, unique_name

DEVICES_VIEW = "devices_view"
"""Stands in the table for the root of the Devices view."""
POUS_VIEW = "pous_view"
"""Stands in the table for the root of the POUs view."""

Naming = Literal["identifier", "free", "fixed"]


class PlacementRule(BaseModel):
    """Where objects of one kind may be, and how they are named."""

    model_config = ConfigDict(frozen=True)

    kind: str
    parents: tuple[str, ...] = Field(description="Kinds of parent; devices_view and pous_view are the roots.")
    parent_subkinds: tuple[str, ...] = Field(
        default=(), description="Where the parent is a POU: which ones; empty means any."
    )
    in_folders: bool = Field(default=True, description="May stand in a folder of such a parent.")
    once: bool = Field(default=False, description="At most one below one parent, its folders included.")
    naming: Naming = Field(default="identifier", description="Identifier, free text, or one of `names`.")
    names: tuple[str, ...] = Field(default=(), description="The possible names where naming is fixed.")
    proposal: str = Field(default="", description="Name that the dialog proposes.")
    subkinds: tuple[str, ...] = Field(default=(), description="Templates to choose from for a new object.")
    languages: tuple[Language, ...] = Field(
        default=(), description="Languages to choose from for the body of a new object; the first is usual."
    )


_CODE_PLACES = ("application", POUS_VIEW)
_LANGUAGES: tuple[Language, ...] = ("ST", "IL")

RULES: Mapping[str, PlacementRule] = MappingProxyType(
    {
        rule.kind: rule
        for rule in (
            PlacementRule(
                kind="folder",
                parents=(*_CODE_PLACES, "folder", "pou", "interface"),
                parent_subkinds=("program", "function_block"),
                naming="free",
                proposal="Folder",
            ),
            PlacementRule(kind="device", parents=(DEVICES_VIEW,), naming="free", proposal="Device"),
            PlacementRule(
                kind="plc_logic", parents=("device",), once=True, naming="fixed", names=("PLC Logic",)
            ),
            PlacementRule(
                kind="application",
                parents=("plc_logic", "application"),
                in_folders=False,
                proposal="Application",
            ),
            PlacementRule(
                kind="pou",
                parents=_CODE_PLACES,
                proposal="POU",
                subkinds=("program", "function_block", "function"),
                languages=_LANGUAGES,
            ),
            PlacementRule(kind="interface", parents=_CODE_PLACES, proposal="ITF"),
            PlacementRule(
                kind="dut",
                parents=_CODE_PLACES,
                proposal="DUT",
                subkinds=("struct", "enum", "union", "alias", "subrange"),
            ),
            PlacementRule(
                kind="gvl",
                parents=_CODE_PLACES,
                proposal="GVL",
                subkinds=("variable_list", "parameter_list"),
            ),
            PlacementRule(kind="persistent", parents=("application",), once=True, proposal="PersistentVars"),
            PlacementRule(
                kind="method",
                parents=("pou", "interface"),
                parent_subkinds=("program", "function_block"),
                proposal="Meth",
                languages=_LANGUAGES,
            ),
            PlacementRule(
                kind="property",
                parents=("pou", "interface"),
                parent_subkinds=("program", "function_block"),
                proposal="Prop",
            ),
            PlacementRule(
                kind="action",
                parents=("pou",),
                parent_subkinds=("program", "function_block"),
                proposal="Act",
                languages=_LANGUAGES,
            ),
            PlacementRule(
                kind="accessor",
                parents=("property",),
                in_folders=False,
                naming="fixed",
                names=("Get", "Set"),
                languages=_LANGUAGES,
            ),
            PlacementRule(
                kind="task_configuration",
                parents=("application",),
                in_folders=False,
                once=True,
                naming="fixed",
                names=("Task Configuration",),
            ),
            PlacementRule(kind="task", parents=("task_configuration",), in_folders=False, proposal="Task"),
            PlacementRule(
                kind="library_manager",
                parents=_CODE_PLACES,
                in_folders=False,
                once=True,
                naming="fixed",
                names=("Library Manager",),
            ),
            PlacementRule(kind="scene", parents=("application",), proposal="Scene3D"),
        )
    }
)
"""The rule of each kind. A kind without a rule belongs to a plug-in that is not installed."""


def owner_of(project: Project, parent_id: str | None) -> ProjectObject | None:
    """The nearest object at or above `parent_id` that is no folder; None for a root of a view."""
    while parent_id is not None:
        parent = project.get(parent_id)
        if parent.kind != "folder":
            return parent
        parent_id = parent.parent_id
    return None


def in_scope_of(project: Project, owner: ProjectObject | None) -> Iterable[ProjectObject]:
    """The objects directly below an owner and in its folders; of None those of both views' roots."""
    waiting = list(reversed(project.children(owner.id if owner else None)))
    while waiting:
        item = waiting.pop()
        yield item
        if item.kind == "folder":
            waiting.extend(reversed(project.children(item.id)))


def check_place(project: Project, kind: str, parent_id: str | None, *, present: str | None = None) -> None:
    """Raise NotPlaceableError unless an object of `kind` may be below `parent_id` (None: root of a view).

    `present` is the id of an object that is there already or is being moved, which does not count as another.
    """
    rule = RULES.get(kind)
    if rule is None:
        raise NotPlaceableError(f"Objects of kind '{kind}' belong to a plug-in that is not installed")
    owner = owner_of(project, parent_id)
    place = _place_of(project, kind, parent_id, owner)
    if place not in rule.parents:
        raise NotPlaceableError(
            f"A {_words(kind)} cannot be below {_place_name(owner, place)}; it belongs below "
            + " or ".join(_words(parent) for parent in rule.parents)
        )
    if (
        owner is not None
        and owner.kind == "pou"
        and rule.parent_subkinds
        and owner.subkind is not None
        and owner.subkind not in rule.parent_subkinds
    ):
        allowed = " and ".join(_words(subkind) for subkind in rule.parent_subkinds)
        raise NotPlaceableError(
            f"A {_words(owner.subkind)} such as '{owner.name}' has no {_words(kind)}; {allowed} objects may"
        )
    if not rule.in_folders and parent_id is not None and project.get(parent_id).kind == "folder":
        raise NotPlaceableError(
            f"A {_words(kind)} cannot be in a folder; put it at {_place_name(owner, place)}"
        )
    if rule.once:
        for item in in_scope_of(project, owner):
            if item.kind == kind and item.id != present:
                raise NotPlaceableError(
                    f"{_place_name(owner, place)} has a {_words(kind)} already ('{item.name}'); "
                    "only one is possible"
                )


def check_name(
    project: Project, kind: str, name: str, parent_id: str | None, *, own: str | None = None
) -> None:
    """Raise InvalidNameError or NameTakenError unless `name` fits the kind and is free at this place.

    `own` is the id of the object that has or gets the name. Within an application, and within the POUs view,
    names are unique across folders too, because code refers to them by name alone.
    """
    check_spelling(kind, name)
    _check_siblings(project, kind, name, parent_id, own)
    if kind == "folder":
        return
    key = name_key(name)
    owner = owner_of(project, parent_id)
    if owner is None and kind == "device":
        return
    for item in in_scope_of(project, owner):
        if item.id != own and item.kind not in ("folder", "device") and name_key(item.name) == key:
            raise NameTakenError(f"'{name}' exists already at {project.path_of(item.id)}")


def check_spelling(kind: str, name: str) -> None:
    """Raise InvalidNameError unless `name` can name an object of this kind."""
    rule = RULES.get(kind)
    if rule is not None and rule.naming == "identifier":
        check_identifier(name)
        return
    check_free_name(name)
    if rule is not None and rule.naming == "fixed" and name not in rule.names:
        raise InvalidNameError(f"A {_words(kind)} is named {' or '.join(rule.names)}, not '{name}'")


def proposed_name(project: Project, kind: str, parent_id: str | None) -> str:
    """A free name for a new object of this kind; PLC_PRG for the first POU of an application (POU-07)."""
    rule = RULES.get(kind)
    owner = owner_of(project, parent_id)
    scope = list(in_scope_of(project, owner))
    if rule is not None and rule.naming == "fixed":
        taken = {item.name for item in scope}
        return next((name for name in rule.names if name not in taken), rule.names[0])
    wanted = rule.proposal if rule is not None else kind
    if kind == "pou" and owner is not None and not any(item.kind == "pou" for item in scope):
        wanted = "PLC_PRG"
    return unique_name(wanted, (item.name for item in scope))


def check_project(project: Project) -> None:
    """Raise the first ProjectError that a tree from outside has: parents, places, names, order.

    Objects of kinds that are not installed may be anywhere and may hold anything (CON-03).
    """
    for object_id, item in project.objects.items():
        if object_id != item.id:
            raise ProjectError(f"The object '{item.name}' has the id {item.id} but is listed as {object_id}")
        if item.parent_id is not None and item.parent_id not in project.objects:
            raise ProjectError(f"The parent of '{item.name}' is missing")
    reached = 0
    taken: set[tuple[str | None, bool, str]] = set()
    for item in project.walk():
        reached += 1
        check_spelling(item.kind, item.name)
        place = item.parent_id, is_pous_root(item.parent_id, item.kind), name_key(item.name)
        if place in taken:
            raise NameTakenError(
                f"'{project.path_of(item.id)}' is there twice; names differ by more than case"
            )
        taken.add(place)
        owner = owner_of(project, item.parent_id)
        if item.kind in RULES and (owner is None or owner.kind in RULES):
            check_place(project, item.kind, item.parent_id, present=item.id)
    if reached != len(project.objects):
        raise ProjectError("Some objects of the project are their own ancestors")


def _check_siblings(project: Project, kind: str, name: str, parent_id: str | None, own: str | None) -> None:
    key = name_key(name)
    for sibling in project.siblings(parent_id, kind):
        if sibling.id == own or name_key(sibling.name) != key:
            continue
        raise NameTakenError(f"'{sibling.name}' exists already in this place; names differ by more than case")


def _place_of(project: Project, kind: str, parent_id: str | None, owner: ProjectObject | None) -> str:
    if owner is not None:
        return owner.kind
    if parent_id is None and kind == "device":
        return DEVICES_VIEW
    return POUS_VIEW


def _place_name(owner: ProjectObject | None, place: str) -> str:
    return _words(place) if owner is None else f"the {_words(place)} '{owner.name}'"


_WORDS = {
    DEVICES_VIEW: "the Devices view",
    POUS_VIEW: "the POUs view",
    "pou": "POU",
    "dut": "DUT",
    "gvl": "GVL",
}


def _words(kind: str) -> str:
    return _WORDS.get(kind, kind.replace("_", " "))
