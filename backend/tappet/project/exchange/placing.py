"""Drafts into a project: names made fit and free, objects made, nothing of the project overwritten."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from tappet.project.errors import (
    InvalidDataError,
    InvalidNameError,
    NameTakenError,
    UnknownObjectError,
)
from tappet.project.exchange.deciding import ConflictError, Decided, Given, compared
from tappet.project.exchange.drafts import (
    Batch,
    Draft,
    fit_free,
    library_manager,
    plc_logic,
    task_configuration,
)
from tappet.project.exchange.existing import Comparison, Decision, Decisions, Existing, ExistingAct
from tappet.project.exchange.growing_tree import GrowingTree
from tappet.project.exchange.report import ImportReport, Outcome
from tappet.project.kind_registry import kind_of, kinds
from tappet.project.kinds.library_manager import DEFAULT_LIBRARIES
from tappet.project.model import APPLICATION, DEVICE, FOLDER, Project, ProjectObject, new_id
from tappet.project.naming import check_project_name, name_key, normal_name
from tappet.project.new_project import DEFAULT_DEVICE
from tappet.project.object_kind import Merging
from tappet.project.objects import changed_object, make_object
from tappet.project.placement import check_project, check_spelling, refusal

_NOT_IDENTIFIER = re.compile(r"[^A-Za-z0-9_]+", re.ASCII)


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a project the drafts go: an application, the POUs view (None), or a folder in one of them."""

    parent_id: str | None


def place(
    batch: Batch,
    project: Project,
    report: ImportReport,
    where: Place | None = None,
    decided: Decided | None = None,
) -> Project:
    """The project with the drafts in it; `decided` says what becomes of those whose names exist already.

    A project without an application gets a device for what needs one. `where` takes the drafts of no named
    application and those of the first named one; without it, the first application of the project does.
    Raises UnknownObjectError for a place that cannot take objects, ProjectError when the outcome is no sound
    project, which is a fault of the importer.
    """
    placer = _Placer(project, report, decided or Decided())
    _place(batch, placer, project, where)
    return placer.outcome()


def find_existing(
    batch: Batch, project: Project, where: Place | None, decided: Decided
) -> tuple[dict[str, Existing], Comparison | None]:
    """The objects of a project that have the names of drafts, by their keys; nothing is changed.

    The draft that `decided` asks for is compared.
    """
    decided = replace(decided, decisions=Decisions(all="merge"))
    placer = _Placer(project, ImportReport(), decided, probing=True)
    _place(batch, placer, project, where)
    return placer.existing, placer.comparison


def _place(batch: Batch, placer: _Placer, project: Project, where: Place | None) -> None:
    if where is not None:
        _place_in(where, batch, placer)
        return
    fresh = not project.objects
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
    """Adds drafts to the objects of a project."""

    def __init__(
        self, project: Project, report: ImportReport, decided: Decided, *, probing: bool = False
    ) -> None:
        self.report = report
        self.existing: dict[str, Existing] = {}
        """The objects whose names exist, by the key of the draft; only where `probing`."""
        self.comparison: Comparison | None = None
        self._noted = {
            (entry.source, entry.line) for entry in report.entries if entry.outcome in ("changed", "kept")
        }
        self._tree = GrowingTree(project)
        self._decided = decided
        self._probing = probing
        self._placed: dict[tuple[str, int | None], str] = {}
        """Object of each file and line."""

    def outcome(self) -> Project:
        """The project with all that was placed; the report then knows the objects."""
        self.report.add_objects(self._placed)
        result = self._tree.outcome()
        check_project(result)
        return result

    def owner(self, parent_id: str | None) -> str | None:
        """The object that what is below `parent_id` belongs to."""
        return self._tree.owners[parent_id]

    def check_place(self, parent_id: str | None) -> None:
        """Raise UnknownObjectError unless objects of an import can be there."""
        if parent_id is None:
            return
        item = self._tree.before.get(parent_id)
        owner = self._tree.owners[parent_id]
        if item.kind not in (APPLICATION, FOLDER) or (
            owner is not None and self._tree.objects[owner].kind != APPLICATION
        ):
            raise UnknownObjectError(
                f"'{item.name}' takes no imported objects; choose an application, the POUs view or a folder"
            )

    def spread(self, draft: Draft, parent_id: str | None) -> None:
        """Place what is below a draft at a place; what cannot be in a folder goes beside it."""
        for child in draft.children:
            known = kinds().get(child.kind)
            beside = known is not None and not known.placement.in_folders
            self.add(child, self._tree.owners[parent_id] if beside else parent_id)

    def note_merged(self, device: Draft, application: Draft, target: str) -> None:
        """Say that an application of the file went into one of the project."""
        into = self._tree.objects[target].name
        if application.name:
            self.report.add(
                "changed",
                application.source or device.source,
                f"its objects were put into the application '{into}' of the project",
                name=application.name,
                line=application.line,
            )

    def children(self, draft: Draft, parent_id: str | None, given: ExistingAct | None = None) -> None:
        """Place what is below a draft below an object of the project, for which `given` was decided."""
        for child in draft.children:
            self.add(child, parent_id, given)

    def add(self, draft: Draft, parent_id: str | None, given: ExistingAct | None = None) -> None:
        """Place a draft and all below it; what cannot be placed is reported."""
        known = kinds().get(draft.kind)
        if known is not None and known.merging is not None:
            there = self._tree.like(draft, known.merging, parent_id)
            if there is not None:
                self._merge_data(draft, known.merging, there)
                self.children(draft, there.id, given)
                return
        there = self._tree.of_name(draft.kind, normal_name(draft.name), parent_id)
        decision = self._decided.decision(draft, there, given)
        if there is not None and self._probing:
            proposal = self._tree.free_name(draft.kind, there.name, parent_id)
            self.existing[draft.key] = compared(draft, there, self._tree, proposal)
            if draft.key == self._decided.compare and there.kind == draft.kind:
                self.comparison = self._decided.compare_texts(draft, there)
        if decision.act == "skip" and (there is not None or given == "skip"):
            self._skip(draft, there, told=given != "skip")
        elif there is not None and decision.act in ("overwrite", "merge"):
            self._give(draft, there, decision)
        else:
            self._add_new(draft, parent_id, decision.name if there is not None else None)

    def _skip(self, draft: Draft, there: ProjectObject | None, *, told: bool) -> None:
        """Leave a draft out, except for what is decided otherwise below it."""
        if told and there is not None:
            text = "exists already and stays as it is"
            self._tell("skipped", draft, text, self._title(there), there)
        if there is not None:
            self.children(draft, there.id, "skip")

    def _give(self, draft: Draft, there: ProjectObject, decision: Decision) -> None:
        """Overwrite an object, or join it with a draft; it keeps its id, its place and its history."""
        title = self._title(there)
        try:
            given = self._decided.content(draft, there, decision) if not self._probing else Given(there.data)
            name = normal_name(draft.name) if decision.act == "overwrite" else there.name
            changed = changed_object(there, data=given.data, name=name)
        except ConflictError as error:
            self._tell("refused", draft, str(error), title, there)
        except InvalidDataError as error:
            self._tell("refused", draft, str(error), title, there)
            return
        else:
            self._tree.objects[there.id] = changed
            if decision.act == "overwrite":
                self._remove_others(draft, there)
            done: Outcome = "overwritten" if decision.act == "overwrite" else "merged"
            self._tell(done, draft, given.text, title, there)
        self._placed.setdefault((draft.source, draft.line), there.id)
        self.children(draft, there.id, decision.act)

    def _remove_others(self, draft: Draft, there: ProjectObject) -> None:
        """Members that only the project has go with what is overwritten."""
        kind = kind_of(there)
        if draft.partial or kind is None or kind.compiled.members == "none":
            return
        kept = {name_key(child.name) for child in draft.children}
        for member in self._tree.children(there.id):
            if name_key(member.name) not in kept:
                title = self._title(member)
                self._tree.remove(member)
                self.report.add(
                    "overwritten",
                    draft.source,
                    "deleted: the file does not have it",
                    name=title,
                    line=draft.line,
                )

    def _tell(self, outcome: Outcome, draft: Draft, text: str, title: str, there: ProjectObject) -> None:
        self.report.add(outcome, draft.source, text, name=title, line=draft.line, object_id=there.id)

    def _title(self, item: ProjectObject) -> str:
        """`Owner.Member` for a member, else the name."""
        owner = self._tree.objects.get(self._tree.owners[item.parent_id] or "")
        kind = kind_of(owner) if owner is not None else None
        has_members = kind is not None and kind.compiled.members != "none"
        return f"{owner.name}.{item.name}" if owner is not None and has_members else item.name

    def _add_new(self, draft: Draft, parent_id: str | None, name: str | None) -> None:
        known = kinds().get(draft.kind)
        misplaced = self._misplaced(draft, parent_id)
        if misplaced:
            self.report.add("refused", draft.source, misplaced, name=draft.name, line=draft.line)
            return
        if name is not None:
            self._check_wanted(draft, name, parent_id)
        try:
            item = self._made(draft, parent_id, name)
        except (InvalidNameError, InvalidDataError) as error:
            self.report.add("refused", draft.source, str(error), name=draft.name, line=draft.line)
            return
        self._tree.enter(item, self._tree.owners[parent_id])
        self._placed.setdefault((draft.source, draft.line), item.id)
        if known is not None and known.reported and (draft.source, draft.line) not in self._noted:
            self._tell("imported", draft, "", self._title(item), item)
        self.children(draft, item.id)

    def _check_wanted(self, draft: Draft, name: str, parent_id: str | None) -> None:
        """Raise InvalidNameError or NameTakenError for a name that the user has given."""
        check_spelling(draft.kind, name)
        if not self._tree.is_free(draft.kind, name, parent_id):
            raise NameTakenError(f"'{draft.name}' cannot be imported as '{name}': that name exists already")

    def _misplaced(self, draft: Draft, parent_id: str | None) -> str | None:
        """Why an object of this kind cannot be below this parent."""
        known = kinds().get(draft.kind)
        site = self._tree.site(parent_id)
        if known is None or (site.owner is not None and site.owner.kind not in kinds()):
            return None
        refused = refusal(known, site)
        if refused is None and known.naming.style == "fixed":
            taken = any(item.name == draft.name for item in site.siblings(draft.kind))
            refused = f"There is a {known.words} '{draft.name}' in this place already" if taken else None
        return refused

    def _merge_data(self, draft: Draft, merging: Merging[Any], there: ProjectObject) -> None:
        if merging.join is None:
            return
        self._tree.objects[there.id] = changed_object(there, data=merging.join(there.data, draft.data))
        if merging.note:
            text = merging.note.format(name=there.name)
            self._tell("changed", draft, text, draft.name, there)

    def _made(self, draft: Draft, parent_id: str | None, wanted: str | None) -> ProjectObject:
        name = self._fit(draft)
        free = (
            normal_name(wanted) if wanted is not None else self._tree.free_name(draft.kind, name, parent_id)
        )
        known = kinds().get(draft.kind)
        object_id = draft.id if draft.id is not None and draft.id not in self._tree.objects else new_id()
        made = make_object(
            id=object_id,
            parent_id=parent_id,
            kind=draft.kind,
            name=free,
            index=self._tree.count_beside(draft.kind, parent_id),
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
        fit = fit_free(name) if style == "free" else _fit_identifier(name)
        check_spelling(draft.kind, fit)
        text = f"the name '{name[:60]}' is not possible here; it became '{fit}'"
        self.report.add("changed", draft.source, text, name=draft.name, line=draft.line)
        return fit


def _fit_identifier(name: str) -> str:
    plain = re.sub("_+", "_", _NOT_IDENTIFIER.sub("_", name))[:200].strip("_") or "Unnamed"
    return f"_{plain}" if plain[0].isdigit() else plain


def empty_project(name: str, description: str) -> Project:
    """A project without objects, with a name that is possible."""
    name = normal_name(name)
    try:
        check_project_name(name)
    except InvalidNameError:
        name = fit_free(name)
    return Project(name, description)
