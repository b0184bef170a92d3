"""Drafts into a project: names made fit and free, objects made, nothing of the project overwritten."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from tappet.project.errors import InvalidDataError, InvalidNameError, UnknownObjectError
from tappet.project.exchange.drafts import Batch, Draft, library_manager, plc_logic, task_configuration
from tappet.project.exchange.report import ImportReport
from tappet.project.kind_registry import kind_of, kinds
from tappet.project.kinds.library_manager import DEFAULT_LIBRARIES
from tappet.project.model import APPLICATION, DEVICE, FOLDER, Project, ProjectObject, is_pous_root, new_id
from tappet.project.naming import check_project_name, name_key, normal_name, unique_name
from tappet.project.new_project import DEFAULT_DEVICE
from tappet.project.object_kind import Merging
from tappet.project.objects import changed_object, make_object
from tappet.project.placement import Site, check_project, check_spelling, in_code, owner_of, refusal

_NOT_FREE = re.compile(r"[\x00-\x1f\x7f./\\]+")
_NOT_IDENTIFIER = re.compile(r"[^A-Za-z0-9_]+", re.ASCII)


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a project the drafts go: an application, the POUs view (None), or a folder in one of them."""

    parent_id: str | None


def place(batch: Batch, project: Project, report: ImportReport, where: Place | None = None) -> Project:
    """The project with the drafts in it.

    A project without an application gets a device for what needs one. `where` takes the drafts of no named
    application and those of the first named one; without it, the first application of the project does.
    Raises UnknownObjectError for a place that cannot take objects, ProjectError when the outcome is no sound
    project, which is a fault of the importer.
    """
    fresh = not project.objects
    placer = _Placer(project, report)
    if where is not None:
        _place_in(where, batch, placer)
        return placer.outcome()
    target = next((item.id for item in project.applications()), None)
    devices = list(batch.devices)
    if batch.loose.children and devices and target is None:
        first = next(_applications(devices[0]), None)
        if first is not None:
            first.children += batch.loose.children
            batch.loose.children = []
    if batch.loose.children and target is None:
        device = Draft(DEVICE, DEFAULT_DEVICE)
        application = Draft(APPLICATION, "Application", children=batch.loose.children)
        plc_logic(device).children.append(application)
        devices.insert(0, device)
    elif batch.loose.children:
        placer.children(batch.loose, target)
    if target is not None and devices:
        first = next(_applications(devices[0]), None)
        if first is not None and not fresh:
            placer.children(first, target)
            rest = [item for item in _applications(devices[0]) if item is not first]
            placer.note_merged(devices[0], first, target)
            devices = devices[1:]
            for item in rest:
                placer.children(item, target)
    for device in devices:
        if not batch.complete:
            for application in _applications(device):
                _give_defaults(application)
        placer.add(device, None)
    placer.children(batch.pous, None)
    return placer.outcome()


def _place_in(where: Place, batch: Batch, placer: _Placer) -> None:
    """All drafts at one place; of the devices only their applications come in."""
    placer.check_place(where.parent_id)
    placer.spread(batch.loose, where.parent_id)
    for device in batch.devices:
        for application in _applications(device):
            placer.spread(application, where.parent_id)
            if where.parent_id is not None:
                placer.note_merged(device, application, where.parent_id)
    owner = placer.owner(where.parent_id)
    placer.children(batch.pous, where.parent_id if owner is None else None)


def _give_defaults(application: Draft) -> None:
    """What every new application has: the library Standard and a task configuration."""
    manager = library_manager(application)
    application.children.remove(manager)
    application.children.insert(0, manager)
    references = manager.data.setdefault("references", [])
    for default in DEFAULT_LIBRARIES:
        if all(name_key(item["name"]) != name_key(default.name) for item in references):
            references.insert(0, default.model_dump())
    task_configuration(application)


def _applications(device: Draft) -> Iterator[Draft]:
    for logic in device.children:
        if logic.kind == "plc_logic":
            yield from (item for item in logic.children if item.kind == APPLICATION)


class _Placer:
    """Adds drafts to the objects of a project; holds what names are taken where."""

    def __init__(self, project: Project, report: ImportReport) -> None:
        self.report = report
        self._noted = {
            (entry.source, entry.line) for entry in report.entries if entry.outcome in ("changed", "kept")
        }
        self.objects: dict[str, ProjectObject] = dict(project.objects)
        self._children: dict[str | None, list[str]] = {}
        self._siblings: dict[tuple[str | None, bool], dict[str, str]] = {}
        """Names by key below a parent; of the roots those of one view."""
        self._scopes: dict[str | None, dict[str, str]] = {}
        """Owner (None: roots of the POUs view) to the keys of the names in its scope, to their objects."""
        self._owners: dict[str | None, str | None] = {None: None}
        for item in project.walk():
            owner = owner_of(project, item.parent_id)
            self._enter(item, owner.id if owner else None)
        self._project = project
        self._placed: dict[tuple[str, int | None], str] = {}
        """Object of each file and line."""

    def outcome(self) -> Project:
        """The project with all that was placed; the report then knows the objects."""
        self.report.add_objects(self._placed)
        result = replace(self._project, objects=self.objects)
        check_project(result)
        return result

    def owner(self, parent_id: str | None) -> str | None:
        """The object that what is below `parent_id` belongs to."""
        return self._owners[parent_id]

    def check_place(self, parent_id: str | None) -> None:
        """Raise UnknownObjectError unless objects of an import can be there."""
        if parent_id is None:
            return
        item = self._project.get(parent_id)
        owner = self._owners[parent_id]
        if item.kind not in (APPLICATION, FOLDER) or (
            owner is not None and self.objects[owner].kind != APPLICATION
        ):
            raise UnknownObjectError(
                f"'{item.name}' takes no imported objects; choose an application, the POUs view or a folder"
            )

    def spread(self, draft: Draft, parent_id: str | None) -> None:
        """Place what is below a draft at a place; what cannot be in a folder goes beside it."""
        for child in draft.children:
            known = kinds().get(child.kind)
            beside = known is not None and not known.placement.in_folders
            self.add(child, self._owners[parent_id] if beside else parent_id)

    def _enter(self, item: ProjectObject, owner_id: str | None) -> None:
        self.objects[item.id] = item
        self._children.setdefault(item.parent_id, []).append(item.id)
        self._names_beside(item.kind, item.parent_id)[name_key(item.name)] = item.name
        self._owners[item.id] = owner_id if item.kind == FOLDER else item.id
        if in_code(item.kind):
            self._scopes.setdefault(owner_id, {}).setdefault(name_key(item.name), item.id)

    def note_merged(self, device: Draft, application: Draft, target: str) -> None:
        """Say that an application of the file went into one of the project."""
        into = self.objects[target].name
        if application.name:
            self.report.add(
                "changed",
                application.source or device.source,
                f"its objects were put into the application '{into}' of the project",
                name=application.name,
                line=application.line,
            )

    def children(self, draft: Draft, parent_id: str | None) -> None:
        """Place what is below a draft below an object of the project."""
        for child in draft.children:
            self.add(child, parent_id)

    def add(self, draft: Draft, parent_id: str | None) -> None:
        """Place a draft and all below it; what cannot be placed is reported."""
        known = kinds().get(draft.kind)
        if known is not None and known.merging is not None:
            there = self._like(draft, known.merging, parent_id)
            if there is not None:
                self._merge_data(draft, known.merging, there)
                self.children(draft, there.id)
                return
        misplaced = self._misplaced(draft, parent_id)
        if misplaced:
            self.report.add("refused", draft.source, misplaced, name=draft.name, line=draft.line)
            return
        try:
            item = self._made(draft, parent_id)
        except (InvalidNameError, InvalidDataError) as error:
            self.report.add("refused", draft.source, str(error), name=draft.name, line=draft.line)
            return
        self._enter(item, self._owners[parent_id])
        self._placed.setdefault((draft.source, draft.line), item.id)
        if known is not None and known.reported and (draft.source, draft.line) not in self._noted:
            owner = self.objects.get(self._owners[parent_id] or "")
            kind = kind_of(owner) if owner is not None else None
            has_members = kind is not None and kind.compiled.members != "none"
            prefix = f"{owner.name}." if owner is not None and has_members else ""
            self.report.add(
                "imported", draft.source, name=f"{prefix}{item.name}", line=draft.line, object_id=item.id
            )
        self.children(draft, item.id)

    def _misplaced(self, draft: Draft, parent_id: str | None) -> str | None:
        """Why an object of this kind cannot be below this parent."""
        known = kinds().get(draft.kind)
        site = self._site(parent_id)
        if known is None or (site.owner is not None and site.owner.kind not in kinds()):
            return None
        refused = refusal(known, site)
        if refused is None and known.naming.style == "fixed":
            taken = any(item.name == draft.name for item in site.siblings(draft.kind))
            refused = f"There is a {known.words} '{draft.name}' in this place already" if taken else None
        return refused

    def _site(self, parent_id: str | None) -> Site:
        owner_id = self._owners[parent_id]
        return Site(
            self.objects[parent_id] if parent_id is not None else None,
            self.objects[owner_id] if owner_id is not None else None,
            lambda above: [self.objects[child] for child in self._children.get(above, ())],
            lambda object_id: self.objects[object_id].name,
        )

    def _like(self, draft: Draft, merging: Merging[Any], parent_id: str | None) -> ProjectObject | None:
        """The object that takes the content of a draft: of its kind at the place, folders included where the
        place can have only one."""
        site = self._site(parent_id)
        if not merging.by_name:
            return next((item for item in site.scope if item.kind == draft.kind), None)
        key = name_key(_fit_free(draft.name))
        same = (item for item in site.siblings(draft.kind) if item.kind == draft.kind)
        return next((item for item in same if name_key(item.name) == key), None)

    def _merge_data(self, draft: Draft, merging: Merging[Any], there: ProjectObject) -> None:
        if merging.join is None:
            return
        self.objects[there.id] = changed_object(there, data=merging.join(there.data, draft.data))
        if merging.note:
            text = merging.note.format(name=there.name)
            self.report.add(
                "changed", draft.source, text, name=draft.name, line=draft.line, object_id=there.id
            )

    def _made(self, draft: Draft, parent_id: str | None) -> ProjectObject:
        name = self._fit(draft)
        free = self._free_name(draft.kind, name, parent_id)
        known = kinds().get(draft.kind)
        object_id = draft.id if draft.id is not None and draft.id not in self.objects else new_id()
        made = make_object(
            id=object_id,
            parent_id=parent_id,
            kind=draft.kind,
            name=free,
            index=len(self._names_beside(draft.kind, parent_id)),
            data=draft.data,
        )
        if free == name:
            return made
        self.report.add(
            "changed",
            draft.source,
            f"'{name}' exists already in this place; it was imported as '{free}'",
            name=draft.name,
            line=draft.line,
        )
        if known is None or known.renamed is None:
            return made
        return changed_object(made, data=known.renamed(made.data, free))

    def _fit(self, draft: Draft) -> str:
        """The name of a draft, made fit for its kind where nothing refers to it by name."""
        name = normal_name(draft.name)
        known = kinds().get(draft.kind)
        style = known.naming.style if known is not None else "free"
        try:
            check_spelling(draft.kind, name)
            return name
        except InvalidNameError:
            adapted = known is None or known.naming.from_imports == "adapted" or style == "free"
            if style == "fixed" or not adapted:
                raise
        fit = _fit_free(name) if style == "free" else _fit_identifier(name)
        check_spelling(draft.kind, fit)
        text = f"the name '{name[:60]}' is not possible here; it became '{fit}'"
        self.report.add("changed", draft.source, text, name=draft.name, line=draft.line)
        return fit

    def _free_name(self, kind: str, name: str, parent_id: str | None) -> str:
        known = kinds().get(kind)
        if known is not None and known.naming.style == "fixed":
            return name
        taken = self._names_beside(kind, parent_id)
        scope = self._scopes.get(self._owners[parent_id], {}) if in_code(kind) else {}
        if name_key(name) not in scope and name_key(name) not in taken:
            return name
        return unique_name(name, [*taken.values(), *(self.objects[other].name for other in scope.values())])

    def _names_beside(self, kind: str, parent_id: str | None) -> dict[str, str]:
        """The names among which one of this kind has to be new."""
        return self._siblings.setdefault((parent_id, is_pous_root(parent_id, kind)), {})


def _fit_free(name: str) -> str:
    visible = "".join(c if c.isprintable() else " " for c in normal_name(name))
    return " ".join(_NOT_FREE.sub("_", visible).split())[:200].strip() or "Folder"


def _fit_identifier(name: str) -> str:
    plain = re.sub("_+", "_", _NOT_IDENTIFIER.sub("_", name))[:200].strip("_") or "Unnamed"
    return f"_{plain}" if plain[0].isdigit() else plain


def empty_project(name: str, description: str) -> Project:
    """A project without objects, with a name that is possible."""
    name = normal_name(name)
    try:
        check_project_name(name)
    except InvalidNameError:
        name = _fit_free(name)
    return Project(name, description)
