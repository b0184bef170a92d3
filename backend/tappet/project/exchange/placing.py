"""Drafts into a project: names made fit and free, objects made, nothing of the project overwritten."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from tappet.project.declaration_text import rename_header
from tappet.project.errors import InvalidDataError, InvalidNameError, UnknownObjectError
from tappet.project.exchange.drafts import Batch, Draft, library_manager, plc_logic, task_configuration
from tappet.project.exchange.libraries import with_more_parameters
from tappet.project.exchange.report import ImportReport
from tappet.project.model import Project, ProjectObject, changed_object, make_object, new_id
from tappet.project.naming import check_project_name, name_key, normal_name, unique_name
from tappet.project.placement import DEVICES_VIEW, POUS_VIEW, RULES, check_project, check_spelling, owner_of
from tappet.project.templates import DEFAULT_DEVICE, DEFAULT_LIBRARIES

_NOT_FREE = re.compile(r"[\x00-\x1f\x7f./\\]+")
_NOT_IDENTIFIER = re.compile(r"[^A-Za-z0-9_]+", re.ASCII)
_MERGED = frozenset(["plc_logic", "task_configuration", "library_manager", "folder", "persistent"])
"""Kinds whose like in the project takes the content instead of getting a twin."""

_REPORTED = frozenset(
    ["pou", "method", "action", "property", "interface", "dut", "gvl", "persistent", "task", "scene"]
)


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
        device = Draft("device", DEFAULT_DEVICE)
        application = Draft("application", "Application", children=batch.loose.children)
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
            yield from (item for item in logic.children if item.kind == "application")


class _Placer:
    """Adds drafts to the objects of a project; holds what names are taken where."""

    def __init__(self, project: Project, report: ImportReport) -> None:
        self.report = report
        self._noted = {
            (entry.source, entry.line) for entry in report.entries if entry.outcome in ("changed", "kept")
        }
        self.objects: dict[str, ProjectObject] = dict(project.objects)
        self._children: dict[str | None, list[str]] = {}
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
        self.report.tell_objects(self._placed)
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
        if item.kind not in ("application", "folder") or (
            owner is not None and self.objects[owner].kind != "application"
        ):
            raise UnknownObjectError(
                f"'{item.name}' takes no imported objects; choose an application, the POUs view or a folder"
            )

    def spread(self, draft: Draft, parent_id: str | None) -> None:
        """Place what is below a draft at a place; what cannot be in a folder goes beside it."""
        for child in draft.children:
            rule = RULES.get(child.kind)
            beside = rule is not None and not rule.in_folders
            self.add(child, self._owners[parent_id] if beside else parent_id)

    def _enter(self, item: ProjectObject, owner_id: str | None) -> None:
        self.objects[item.id] = item
        self._children.setdefault(item.parent_id, []).append(item.id)
        self._owners[item.id] = owner_id if item.kind == "folder" else item.id
        if item.kind not in ("folder", "device"):
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
        if draft.kind in _MERGED:
            there = self._like(draft, parent_id)
            if there is not None:
                self._merge_data(draft, there)
                self.children(draft, there.id)
                return
        misplaced = self._misplaced(draft.kind, draft.name, parent_id)
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
        if draft.kind in _REPORTED and (draft.source, draft.line) not in self._noted:
            owner = self.objects.get(self._owners[parent_id] or "")
            prefix = f"{owner.name}." if owner is not None and owner.kind in ("pou", "interface") else ""
            self.report.add(
                "imported", draft.source, name=f"{prefix}{item.name}", line=draft.line, object_id=item.id
            )
        self.children(draft, item.id)

    def _misplaced(self, kind: str, name: str, parent_id: str | None) -> str | None:
        """Why an object of this kind cannot be below this parent; the rules of `placement`."""
        rule = RULES.get(kind)
        owner_id = self._owners[parent_id]
        owner = self.objects[owner_id] if owner_id is not None else None
        if rule is None or (owner is not None and owner.kind not in RULES):
            return None
        place = owner.kind if owner is not None else DEVICES_VIEW if kind == "device" else POUS_VIEW
        if place not in rule.parents:
            return f"a {kind} cannot be below {'the root' if owner is None else f'a {owner.kind}'}"
        if owner is not None and owner.kind == "pou" and rule.parent_subkinds:
            subkind = owner.subkind
            if subkind is not None and subkind not in rule.parent_subkinds:
                return f"a {subkind} such as '{owner.name}' has no {kind}"
        if not rule.in_folders and parent_id != owner_id:
            return f"a {kind} cannot be in a folder"
        same = [self.objects[item] for item in self._children.get(parent_id, ())]
        same = [item for item in same if item.kind == kind]
        if (rule.once and same) or (rule.naming == "fixed" and any(item.name == name for item in same)):
            return f"there is a {kind} in this place already"
        return None

    def _like(self, draft: Draft, parent_id: str | None) -> ProjectObject | None:
        for child_id in self._children.get(parent_id, ()):
            item = self.objects[child_id]
            if item.kind == draft.kind and (
                draft.kind != "folder" or name_key(item.name) == name_key(_fit_free(draft.name))
            ):
                return item
        return None

    def _merge_data(self, draft: Draft, there: ProjectObject) -> None:
        if draft.kind == "persistent":
            old = there.data.model_dump()["declaration"]
            joined = "\n".join([old.rstrip("\n"), draft.data.get("declaration", "")])
            self.objects[there.id] = changed_object(there, data={"declaration": joined})
            text = f"its variables stand in the persistent list '{there.name}', which was there already"
            self.report.add(
                "changed", draft.source, text, name=draft.name, line=draft.line, object_id=there.id
            )
            return
        if draft.kind != "library_manager":
            return
        old = there.data.model_dump()
        known = {name_key(reference["name"]) for reference in old["references"]}
        read = draft.data.get("references", ())
        more = [item for item in read if name_key(item["name"]) not in known]
        kept = [
            with_more_parameters(
                reference, [item for item in read if name_key(item["name"]) == name_key(reference["name"])]
            )
            for reference in old["references"]
        ]
        data = {"references": [*kept, *more]}
        self.objects[there.id] = changed_object(there, data=data)

    def _made(self, draft: Draft, parent_id: str | None) -> ProjectObject:
        name, data = self._fit(draft), dict(draft.data)
        free = self._free_name(draft.kind, name, parent_id)
        if free != name:
            if "declaration" in data and draft.kind not in ("gvl", "persistent"):
                data["declaration"] = rename_header(data["declaration"], free)
            self.report.add(
                "changed",
                draft.source,
                f"'{name}' exists already in this place; it was imported as '{free}'",
                name=draft.name,
                line=draft.line,
            )
        object_id = draft.id if draft.id is not None and draft.id not in self.objects else new_id()
        siblings = (self.objects[child].kind for child in self._children.get(parent_id, ()))
        is_device = draft.kind == "device"
        index = sum(1 for kind in siblings if parent_id is not None or (kind == "device") == is_device)
        return make_object(
            id=object_id, parent_id=parent_id, kind=draft.kind, name=free, index=index, data=data
        )

    def _fit(self, draft: Draft) -> str:
        """The name of a draft, made fit for its kind where nothing refers to it by name."""
        name = normal_name(draft.name)
        rule = RULES.get(draft.kind)
        naming = rule.naming if rule is not None else "free"
        if naming == "fixed":
            check_spelling(draft.kind, name)
            return name
        try:
            check_spelling(draft.kind, name)
            return name
        except InvalidNameError:
            if naming == "identifier" and draft.kind not in ("gvl", "persistent", "task", "application"):
                raise
        fit = _fit_free(name) if naming == "free" else _fit_identifier(name)
        check_spelling(draft.kind, fit)
        text = f"the name '{name[:60]}' is not possible here; it became '{fit}'"
        self.report.add("changed", draft.source, text, name=draft.name, line=draft.line)
        return fit

    def _free_name(self, kind: str, name: str, parent_id: str | None) -> str:
        rule = RULES.get(kind)
        if rule is not None and rule.naming == "fixed":
            return name
        is_device = kind == "device"
        taken = [
            self.objects[child].name
            for child in self._children.get(parent_id, ())
            if parent_id is not None or (self.objects[child].kind == "device") == is_device
        ]
        if name_key(name) not in {name_key(other) for other in taken}:
            scope = self._scopes.get(self._owners[parent_id], {})
            if kind in ("folder", "device") or name_key(name) not in scope:
                return name
            taken += [self.objects[other].name for other in scope.values()]
        elif kind not in ("folder", "device"):
            taken += [
                self.objects[item].name for item in self._scopes.get(self._owners[parent_id], {}).values()
            ]
        return unique_name(name, taken)


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
