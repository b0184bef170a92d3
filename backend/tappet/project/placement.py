"""What may be where, and under which name (CON-06..CON-09, TASK-02, PERS-02, LIB-01): the rules of the kinds
applied.

A folder is transparent: it takes what the place it is in takes, except what must stand directly at its owner.
Whether an object may be somewhere is worked out here and nowhere else: `refusal` for any tree that is read
through `Site`, the one of a project or the one that an import is building.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from tappet.iec.languages import offered
from tappet.project.errors import InvalidNameError, NameTakenError, NotPlaceableError, ProjectError
from tappet.project.kind_registry import kinds
from tappet.project.model import DEVICE, FOLDER, Project, ProjectObject, is_pous_root
from tappet.project.naming import check_free_name, check_identifier, name_key, unique_name
from tappet.project.object_kind import DEVICES_VIEW, POUS_VIEW, NameStyle, ObjectKind


class PlacementRule(BaseModel):
    """Where objects of one kind may be, and how they are named; what the front end gets of a kind."""

    model_config = ConfigDict(frozen=True, json_schema_serialization_defaults_required=True)

    kind: str
    places: tuple[str, ...] = Field(
        description="Where objects may be: kind of the parent, a dot, what its declaration says (empty where "
        "it says nothing, * for anything), / for a folder in it; the roots are devices_view and pous_view."
    )
    once: bool = Field(default=False, description="At most one below one parent, its folders included.")
    naming: NameStyle = Field(default="identifier", description="Identifier, free text, or one of `names`.")
    names: tuple[str, ...] = Field(default=(), description="The possible names where naming is fixed.")
    proposal: str = Field(default="", description="Name that the dialog proposes.")
    first: str = Field(default="", description="The same for the first object of the kind in an application.")
    unique: Literal["scope", "place"] = Field(
        default="scope", description="Names differ at one owner with its folders, or among siblings only."
    )
    subkinds: tuple[str, ...] = Field(default=(), description="Templates to choose from for a new object.")
    languages: tuple[str, ...] = Field(
        default=(), description="Languages to choose from for the body of a new object; the first is usual."
    )


def placement_rules() -> list[PlacementRule]:
    """The rules of all kinds that are installed, in the order of the dialog that adds objects."""
    return [_rule_of(kind) for kind in kinds().values()]


def _rule_of(kind: ObjectKind[Any]) -> PlacementRule:
    return PlacementRule(
        kind=kind.name,
        places=tuple(sorted(kind.placement.places)),
        once=kind.placement.once,
        naming=kind.naming.style,
        names=kind.naming.names,
        proposal=kind.naming.proposal,
        first=kind.naming.first,
        unique=kind.naming.unique,
        subkinds=tuple(kind.templates),
        languages=offered() if kind.written else (),
    )


def owner_of(project: Project, parent_id: str | None) -> ProjectObject | None:
    """The nearest object at or above `parent_id` that is no folder; None for a root of a view."""
    while parent_id is not None:
        parent = project.get(parent_id)
        if parent.kind != FOLDER:
            return parent
        parent_id = parent.parent_id
    return None


def in_scope_of(project: Project, owner: ProjectObject | None) -> Iterable[ProjectObject]:
    """The objects directly below an owner and in its folders; of None those of both views' roots."""
    return _with_folders(project.children, owner)


def _with_folders(
    below: Callable[[str | None], Sequence[ProjectObject]], owner: ProjectObject | None
) -> Iterator[ProjectObject]:
    waiting = list(reversed(below(owner.id if owner else None)))
    while waiting:
        item = waiting.pop()
        yield item
        if item.kind == FOLDER:
            waiting.extend(reversed(below(item.id)))


@dataclass(frozen=True)
class Site:
    """A place of a tree where an object may be put; what is there already is looked for once."""

    parent: ProjectObject | None
    """None: a root of one of the two views."""
    owner: ProjectObject | None
    """The nearest object at or above the parent that is no folder."""
    below: Callable[[str | None], Sequence[ProjectObject]]
    """The children of an object; of None the roots."""
    path_of: Callable[[str], str]

    @classmethod
    def of(cls, project: Project, parent_id: str | None) -> Site:
        """The place below an object of a project. Raises UnknownObjectError."""
        parent = project.get(parent_id) if parent_id is not None else None
        return cls(parent, owner_of(project, parent_id), project.children, project.path_of)

    @cached_property
    def scope(self) -> list[ProjectObject]:
        """The objects directly below the owner and in its folders; of the roots those of both views."""
        return list(_with_folders(self.below, self.owner))

    def siblings(self, kind: str) -> Iterator[ProjectObject]:
        """The objects among which one of this kind would be."""
        parent_id = self.parent.id if self.parent else None
        view = is_pous_root(parent_id, kind)
        return (item for item in self.below(parent_id) if is_pous_root(parent_id, item.kind) == view)

    def view_or_kind(self, kind: str) -> str:
        """What stands in `Placement.parents` for this place and an object of this kind."""
        if self.owner is not None:
            return self.owner.kind
        return DEVICES_VIEW if self.parent is None and kind == DEVICE else POUS_VIEW


def refusal(kind: ObjectKind[Any], site: Site, *, present: str | None = None) -> str | None:
    """Why an object of a kind may not be at a place, as a sentence; None where it may.

    `present` is the id of an object that is there already or is being moved, which does not count as another.
    """
    owner = site.owner
    place = site.view_or_kind(kind.name)
    in_folder = site.parent is not None and site.parent.kind == FOLDER
    if not kind.placement.accepts(place, owner.subkind if owner is not None else None, in_folder):
        return _why_not(kind, owner, place)
    if kind.placement.once:
        for item in site.scope:
            if item.kind == kind.name and item.id != present:
                return (
                    f"{_place_name(owner, place)} has a {kind.words} already ('{item.name}'); "
                    "only one is possible"
                )
    return None


def _why_not(kind: ObjectKind[Any], owner: ProjectObject | None, place: str) -> str:
    """Why a place that the table does not hold is none for a kind."""
    rule = kind.placement
    if place not in rule.parents:
        parents = " or ".join(words_of(parent) for parent in rule.parents)
        return f"A {kind.words} cannot be below {_place_name(owner, place)}; it belongs below {parents}"
    if owner is not None and owner.subkind is not None and not rule.accepts(place, owner.subkind, False):
        allowed = " and ".join(words_of(subkind) for subkind in rule.parent_subkinds)
        return (
            f"A {words_of(owner.subkind)} such as '{owner.name}' has no {kind.words}; {allowed} objects may"
        )
    return f"A {kind.words} cannot be in a folder; put it at {_place_name(owner, place)}"


def check_place(site: Site, kind: str, *, present: str | None = None) -> None:
    """Raise NotPlaceableError unless an object of `kind` may be at a place; `present` as in `refusal`."""
    known = kinds().get(kind)
    if known is None:
        raise NotPlaceableError(f"Objects of kind '{kind}' belong to a plug-in that is not installed")
    refused = refusal(known, site, present=present)
    if refused is not None:
        raise NotPlaceableError(refused)


def check_name(site: Site, kind: str, name: str, *, own: str | None = None) -> None:
    """Raise InvalidNameError or NameTakenError unless `name` fits the kind and is free at a place.

    `own` is the id of the object that has or gets the name. Within an application, and within the POUs view,
    names are unique across folders too, because code refers to them by name alone.
    """
    check_spelling(kind, name)
    key = name_key(name)
    for sibling in site.siblings(kind):
        if sibling.id != own and name_key(sibling.name) == key:
            raise NameTakenError(
                f"'{sibling.name}' exists already in this place; names differ by more than case"
            )
    if not in_code(kind):
        return
    for item in site.scope:
        if item.id != own and in_code(item.kind) and name_key(item.name) == key:
            raise NameTakenError(f"'{name}' exists already at {site.path_of(item.id)}")


def in_code(kind: str) -> bool:
    """Whether code may refer to objects of a kind by name alone; of a kind that is not installed, it may."""
    known = kinds().get(kind)
    return known is None or known.naming.unique == "scope"


def check_spelling(kind: str, name: str) -> None:
    """Raise InvalidNameError unless `name` can name an object of this kind."""
    known = kinds().get(kind)
    if known is not None and known.naming.style == "identifier":
        check_identifier(name)
        return
    check_free_name(name)
    if known is not None and known.naming.style == "fixed" and name not in known.naming.names:
        raise InvalidNameError(f"A {known.words} is named {' or '.join(known.naming.names)}, not '{name}'")


def proposed_name(site: Site, kind: str) -> str:
    """A free name for a new object of this kind; PLC_PRG for the first POU of an application (POU-07)."""
    known = kinds().get(kind)
    if known is None:
        return unique_name(kind, (item.name for item in site.scope))
    naming = known.naming
    if naming.style == "fixed":
        taken = {item.name for item in site.scope}
        return next((name for name in naming.names if name not in taken), naming.names[0])
    first = naming.first and site.owner is not None and all(item.kind != kind for item in site.scope)
    wanted = naming.first if first else naming.proposal or kind
    return unique_name(wanted, (item.name for item in site.scope))


def check_project(project: Project) -> None:
    """Raise the first ProjectError that a tree from outside has: parents, places, names, order.

    Objects of kinds that are not installed may be anywhere and may hold anything (CON-03).
    """
    for object_id, item in project.objects.items():
        if object_id != item.id:
            raise ProjectError(f"The object '{item.name}' has the id {item.id} but is listed as {object_id}")
        if item.parent_id is not None and item.parent_id not in project.objects:
            raise ProjectError(f"The parent of '{item.name}' is missing")
    installed = kinds()
    sites: dict[str | None, Site] = {}
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
        site = sites.get(item.parent_id)
        if site is None:
            site = sites[item.parent_id] = Site.of(project, item.parent_id)
        if item.kind in installed and (site.owner is None or site.owner.kind in installed):
            check_place(site, item.kind, present=item.id)
    if reached != len(project.objects):
        raise ProjectError("Some objects of the project are their own ancestors")


def _place_name(owner: ProjectObject | None, place: str) -> str:
    return words_of(place) if owner is None else f"the {words_of(place)} '{owner.name}'"


_VIEWS = {DEVICES_VIEW: "the Devices view", POUS_VIEW: "the POUs view"}


def words_of(kind: str) -> str:
    """What messages call a kind, a subkind or a view."""
    known = kinds().get(kind)
    return known.words if known is not None else _VIEWS.get(kind) or kind.replace("_", " ")
