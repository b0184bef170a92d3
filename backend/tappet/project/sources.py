"""What the compiler gets of a project: the texts of an application, its tasks and its libraries.

The texts have the fields of `lang.source.Source`; this room does not import that one. Besides, each knows
which object and part every line comes from, so that a diagnostic finds its editor.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from tappet.project.data import (
    NO_RULES,
    AccessorData,
    ActionData,
    ApplicationData,
    BodyData,
    DeclarationData,
    LibraryManagerData,
    LibraryReferenceData,
    StaticAnalysisData,
    TaskData,
)
from tappet.project.declaration_text import end_keyword
from tappet.project.durations import duration_ns
from tappet.project.errors import UnknownObjectError
from tappet.project.library_reference import LibraryReference, ParameterValue
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.placement import in_scope_of, owner_of

Part = Literal["declaration", "implementation"]
_CHART_TEXT = re.compile(r"\s*(?:INITIAL_)?STEP\s+\w+\s*:", re.IGNORECASE)
"""The beginning of a chart written as text."""


@dataclass(frozen=True, slots=True)
class Segment:
    """From `line` of a text on (0-based), the lines are those of a part of an object from `part_line` on."""

    line: int
    object_id: str
    part: Part
    part_line: int = 0


@dataclass(frozen=True, slots=True)
class Place:
    """A line of a part of an object, 0-based."""

    object_id: str
    part: Part
    line: int


@dataclass(frozen=True, slots=True)
class SourceText:
    """One text for the compiler; all fields before `object_id` are those of `lang.source.Source`."""

    uri: str
    text: str
    scope: Literal["application", "pous"]
    owner: str | None
    name: str | None
    library: str | None
    namespace: str | None
    body_line: int
    language: str | None
    """`IL` for a body in IL; None where the body tells by its first instruction."""
    object_id: str
    segments: tuple[Segment, ...]

    def locate(self, line: int) -> Place:
        """The object, part and line that a 0-based line of this text comes from."""
        found = self.segments[0]
        for segment in self.segments:
            if segment.line > line:
                break
            found = segment
        return Place(found.object_id, found.part, max(0, line - found.line) + found.part_line)


@dataclass(frozen=True, slots=True)
class WatchdogDefinition:
    """An enabled watchdog (TASK-31..33)."""

    time_ns: int
    sensitivity: int


@dataclass(frozen=True, slots=True)
class TaskDefinition:
    """A task as the build takes it."""

    name: str
    kind: Literal["cyclic", "freewheeling", "event", "status", "external"]
    interval_ns: int
    """0 unless cyclic."""
    priority: int
    event: str | None
    watchdog: WatchdogDefinition | None
    programs: tuple[str, ...]
    object_id: str | None
    """The task object; None for the task that stands in where none is configured."""


def application_sources(project: Project, application_id: str) -> list[SourceText]:
    """The texts of an application: its own, those of the applications above it, and those of the POUs view.
    What is excluded from the build is not among them.

    An object of the application hides an equally named one of an application above (CON-09); what it hides in
    the POUs view is left to the compiler, which warns.
    Raises UnknownObjectError when the id is no application.
    """
    texts: list[SourceText] = []
    hidden: set[str] = set()
    for application in _with_parents(project, application_id):
        own = [item for item in in_scope_of(project, application) if not item.excluded]
        visible = [item for item in own if name_key(item.name) not in hidden]
        texts += _texts(project, visible, "application")
        hidden.update(name_key(item.name) for item in own if item.kind != "folder")
    shared = (item for item in in_scope_of(project, None) if not item.excluded)
    texts += _texts(project, shared, "pous")
    return texts


def tasks(project: Project, application_id: str) -> list[TaskDefinition]:
    """The tasks of an application in tree order.

    An application without any task calls PLC_PRG every 20 ms if there is one (POU-07); else it has no task.
    """
    application = _application(project, application_id)
    found = [
        _task_definition(task, task.data)
        for configuration in project.children(application.id)
        if configuration.kind == "task_configuration"
        for task in project.children(configuration.id)
        if isinstance(task.data, TaskData)
    ]
    if found:
        return found
    main = any(
        item.kind == "pou" and name_key(item.name) == name_key("PLC_PRG") and not item.excluded
        for owner in (application, None)
        for item in in_scope_of(project, owner)
    )
    if not main:
        return []
    return [TaskDefinition("MainTask", "cyclic", duration_ns("T#20ms"), 1, None, None, ("PLC_PRG",), None)]


def libraries(project: Project, application_id: str) -> list[LibraryReference]:
    """The libraries of an application, then those of the applications above and of the POUs view (CON-09).

    One list may name a library in several versions; it hides the library in the lists further out.
    """
    found: list[LibraryReference] = []
    for owner in (*_with_parents(project, application_id), None):
        known = {name_key(reference.name) for reference in found}
        for manager in _library_managers(project, owner):
            found += [r for r in references_of(project, manager) if name_key(r.name) not in known]
    return found


def library_managers(project: Project, application_id: str) -> list[ProjectObject]:
    """The objects that `libraries` comes from."""
    owners = (*_with_parents(project, application_id), None)
    return [manager for owner in owners for manager in _library_managers(project, owner)]


def references_of(project: Project, manager: ProjectObject) -> list[LibraryReference]:
    """The references of a library manager as a build takes them."""
    assert isinstance(manager.data, LibraryManagerData)
    place = project.path_of(manager.id)
    return [_reference(reference, place) for reference in manager.data.references]


def static_analysis(project: Project, application_id: str) -> StaticAnalysisData:
    """The coding rules that run with each build of an application: none where it runs them on demand only."""
    data = _application(project, application_id).data
    assert isinstance(data, ApplicationData)
    chosen = data.static_analysis
    return chosen if chosen.with_build else NO_RULES


def source_of(project: Project, object_id: str) -> SourceText | None:
    """The text an object is compiled in, None for objects without code; an accessor is in its property's."""
    item = project.get(object_id)
    if isinstance(item.data, AccessorData) and item.parent_id is not None:
        item = project.get(item.parent_id)
    in_application = any(above.kind == "application" for above in project.ancestors(item.id))
    owner = owner_of(project, item.parent_id)
    owner_name = owner.name if owner is not None and owner.kind in ("pou", "interface") else None
    return _text(project, item, "application" if in_application else "pous", owner_name)


def _application(project: Project, application_id: str) -> ProjectObject:
    application = project.get(application_id)
    if application.kind != "application":
        raise UnknownObjectError(f"'{application.name}' is a {application.kind}, not an application")
    return application


def _with_parents(project: Project, application_id: str) -> list[ProjectObject]:
    """An application, then the applications it is a child of, nearest first (CON-07)."""
    application = _application(project, application_id)
    above = [item for item in project.ancestors(application_id) if item.kind == "application"]
    return [application, *above]


def _library_managers(project: Project, owner: ProjectObject | None) -> list[ProjectObject]:
    below = project.children(owner.id if owner else None)
    return [item for item in below if isinstance(item.data, LibraryManagerData)]


def _reference(data: LibraryReferenceData, place: str) -> LibraryReference:
    return LibraryReference(
        name=data.name,
        version=data.version,
        namespace=data.namespace or None,
        placeholder=data.placeholder,
        parameters=tuple(ParameterValue(one.list, one.name, one.value) for one in data.parameters),
        place=place,
    )


def _texts(
    project: Project, items: Iterable[ProjectObject], scope: Literal["application", "pous"]
) -> Iterator[SourceText]:
    for item in items:
        text = _text(project, item, scope, None)
        if text is None:
            continue
        yield text
        if item.kind in ("pou", "interface"):
            for child in in_scope_of(project, item):
                child_text = None if child.excluded else _text(project, child, scope, item.name)
                if child_text is not None:
                    yield child_text


def _text(
    project: Project, item: ProjectObject, scope: Literal["application", "pous"], owner: str | None
) -> SourceText | None:
    writer = _Writer()
    name = None
    body_line = 0
    data = item.data
    if isinstance(data, BodyData):
        writer.part(item.id, "declaration", data.declaration)
        body_line = writer.line
        writer.part(item.id, "implementation", _compiled(item.name, data))
        writer.keyword(end_keyword(data.declaration))
    elif isinstance(data, ActionData):
        writer.keyword(f"ACTION {item.name}")
        body_line = writer.line
        writer.part(item.id, "implementation", _compiled(item.name, data))
        writer.keyword("END_ACTION")
        name = item.name
    elif isinstance(data, DeclarationData):
        writer.part(item.id, "declaration", data.declaration)
        if item.kind == "property":
            _accessors(project, item, writer)
        if item.kind in ("property", "interface"):
            writer.keyword(end_keyword(data.declaration))
        elif item.kind in ("gvl", "persistent"):
            name = item.name
    else:
        return None
    return SourceText(
        uri=f"{owner}.{item.name}" if owner else item.name,
        text=writer.text(),
        scope=scope,
        owner=owner,
        name=name,
        library=None,
        namespace=None,
        body_line=body_line,
        language="IL" if isinstance(data, BodyData | ActionData) and data.language == "IL" else None,
        object_id=item.id,
        segments=tuple(writer.segments),
    )


def _accessors(project: Project, item: ProjectObject, writer: _Writer) -> None:
    for accessor in project.children(item.id):
        if isinstance(accessor.data, AccessorData) and not accessor.excluded:
            keyword = accessor.name.upper()
            writer.keyword(keyword)
            if accessor.data.declaration:
                writer.part(accessor.id, "declaration", accessor.data.declaration)
            writer.part(accessor.id, "implementation", _compiled(item.name, accessor.data))
            writer.keyword(f"END_{keyword}")


def _compiled(name: str, data: BodyData | ActionData) -> str:
    """The implementation as the compiler takes it; an imported graphical body gives an error of its own."""
    textual = data.language in ("ST", "IL") or _CHART_TEXT.match(data.implementation) is not None
    if textual or not data.implementation:
        return data.implementation
    return (
        f"{{error 'The body of {name} is in {data.language}, which cannot be compiled yet; it was imported "
        "and is kept unchanged; write it in ST to run it'}"
    )


class _Writer:
    """Joins parts and keywords line by line and remembers which part each line came from."""

    def __init__(self) -> None:
        self.line = 0
        self.segments: list[Segment] = []
        self._pieces: list[str] = []

    def part(self, object_id: str, part: Part, text: str) -> None:
        """Append a part of an object."""
        self.segments.append(Segment(self.line, object_id, part))
        self.keyword(text)

    def keyword(self, text: str | None) -> None:
        """Append a line that is in no part; None appends nothing."""
        if text is not None:
            self._pieces.append(text)
            self.line += text.count("\n") + 1

    def text(self) -> str:
        """Everything appended so far."""
        return "\n".join(self._pieces)


def _task_definition(task: ProjectObject, data: TaskData) -> TaskDefinition:
    watchdog = None
    if data.watchdog.enabled:
        watchdog = WatchdogDefinition(duration_ns(data.watchdog.time), data.watchdog.sensitivity)
    return TaskDefinition(
        name=task.name,
        kind=data.type,
        interval_ns=duration_ns(data.interval) if data.type == "cyclic" else 0,
        priority=data.priority,
        event=data.event or None if data.type in ("event", "status", "external") else None,
        watchdog=watchdog,
        programs=tuple(call.name for call in data.pous),
        object_id=task.id,
    )
