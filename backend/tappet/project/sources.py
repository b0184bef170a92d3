"""What the compiler gets of a project: the texts of an application, its tasks and its libraries.

What an object gives, its kind says (`object_kind.Compiled`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from operator import is_
from typing import Any

from tappet.iec.heap import HeapSettings
from tappet.iec.memory import ChangeReserve
from tappet.iec.source import Scope, Source
from tappet.iec.task import Task
from tappet.project.data import UnknownData
from tappet.project.durations import duration_ns
from tappet.project.errors import UnknownObjectError
from tappet.project.kind_registry import kind_of, kinds
from tappet.project.kinds.application import NO_RULES, ApplicationData, StaticAnalysisData
from tappet.project.kinds.library_manager import LIBRARY_MANAGER
from tappet.project.kinds.pou import POU
from tappet.project.library_reference import LibraryReference
from tappet.project.model import APPLICATION, FOLDER, Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.object_kind import Compiled
from tappet.project.objects import changed_object
from tappet.project.placement import in_scope_of, owner_of
from tappet.project.source_text import SourceWriter

_NOTHING: Compiled[Any] = Compiled()
_Place = tuple[str, Scope, str | None]
"""Id of an object, its scope, and the object that it is a member of."""
_Written = tuple[ProjectObject, list[ProjectObject], Source | None]
"""An object, all objects below it, and its text."""


class WrittenSources:
    """The texts of objects as they were written last: an object that is the same with all below it keeps its
    text, so that an edit of one writes one."""

    def __init__(self) -> None:
        self._last: dict[_Place, _Written] = {}
        self._now: dict[_Place, _Written] = {}
        self._calls: dict[str, Source] = {}

    def begin(self) -> None:
        """Forget what was not asked for since the last time."""
        self._last, self._now = self._now, {}

    def unchanged(self, source: Source) -> Source:
        """The source that was written last where it is equal."""
        known = self._calls.get(source.uri)
        if known != source:
            known = self._calls[source.uri] = source
        return known

    def source(self, project: Project, item: ProjectObject, scope: Scope, owner: str | None) -> Source | None:
        """The text of an object; None for one without."""
        place = item.id, scope, owner
        known = self._last.get(place)
        below = list(project.walk(item.id))
        if known is not None and known[0] is item and _are_same(known[1], below):
            text = known[2]
        else:
            text = _text(project, item, scope, owner)
        self._now[place] = item, below, text
        return text


def _are_same(before: list[ProjectObject], now: list[ProjectObject]) -> bool:
    return len(before) == len(now) and all(map(is_, before, now))


def application_sources(
    project: Project, application_id: str, written: WrittenSources | None = None
) -> list[Source]:
    """The texts of an application: its own, those of the applications above it, and those of the POUs view.
    What is excluded from the build is not among them.

    An object of the application hides an equally named one of an application above (CON-09); what it hides in
    the POUs view is left to the compiler, which warns. `written`: of the same application before.
    Raises UnknownObjectError when the id is no application.
    """
    written = written or WrittenSources()
    written.begin()
    texts: list[Source] = []
    hidden: set[str] = set()
    seen: list[ProjectObject] = []
    for application in _with_parents(project, application_id):
        own = [item for item in in_scope_of(project, application) if not item.excluded]
        visible = [item for item in own if name_key(item.name) not in hidden]
        texts += _texts(project, visible, Scope.APPLICATION, written)
        seen += visible
        hidden.update(name_key(item.name) for item in own if item.kind != FOLDER)
    shared = [item for item in in_scope_of(project, None) if not item.excluded]
    texts += _texts(project, shared, Scope.POUS, written)
    seen += [item for item in shared if name_key(item.name) not in hidden]
    application = _application(project, application_id)
    joined = [*_together(project, application, seen), *_around_tasks(project, application)[0]]
    return texts + [written.unchanged(source) for source in joined]


def tasks(project: Project, application_id: str) -> list[Task]:
    """The tasks of an application in tree order, with the programs that objects have them call around
    those of the user.

    An application without any task calls PLC_PRG every 20 ms if there is one (POU-07); else it has no task.
    """
    return _around_tasks(project, _application(project, application_id))[1]


def _together(
    project: Project, application: ProjectObject, seen: Iterable[ProjectObject]
) -> Iterator[Source]:
    """The texts that objects of one kind have together."""
    of_kind: dict[str, list[ProjectObject]] = {}
    for item in seen:
        if compiled(item).together is not None:
            of_kind.setdefault(item.kind, []).append(item)
    for kind, items in of_kind.items():
        write = compiled(items[0]).together
        assert write is not None
        writer = SourceWriter()
        write(project, items, writer)
        yield Source(uri=f"{kind}.{application.name}", text=writer.text(), name=writer.name, map=writer.map())


def _around_tasks(project: Project, application: ProjectObject) -> tuple[list[Source], list[Task]]:
    """The texts of the programs that objects have tasks call, and the tasks with these calls."""
    tasks = _configured_tasks(project, application)
    texts = []
    for item in _own(project, application):
        around = compiled(item).around_tasks
        if around is not None:
            writer = SourceWriter()
            tasks = around(project, item, tasks, writer)
            text = writer.text()
            if text:
                uri = f"{item.name}.{application.name}"
                texts.append(Source(uri=uri, text=text, name=writer.name, map=writer.map()))
    return texts, tasks


def _configured_tasks(project: Project, application: ProjectObject) -> list[Task]:
    """The tasks of an application as they are configured."""
    found = []
    for item in _own(project, application):
        task = compiled(item).task
        if task is not None:
            found.append(task(item))
    if found:
        return found
    main = any(
        item.kind == POU.name and name_key(item.name) == name_key("PLC_PRG") and not item.excluded
        for owner in (application, None)
        for item in in_scope_of(project, owner)
    )
    if not main:
        return []
    return [Task("MainTask", interval_ns=duration_ns("T#20ms"), programs=("PLC_PRG",))]


def libraries(project: Project, application_id: str) -> list[LibraryReference]:
    """The libraries of an application, then those of the applications above and of the POUs view (CON-09).

    One list may name a library in several versions; it hides the library where other objects need it, and in
    the lists further out.
    """
    found: list[LibraryReference] = []
    for owner in (*_with_parents(project, application_id), None):
        for item in _with_libraries(project, owner):
            known = {name_key(reference.name) for reference in found}
            found += [r for r in references_of(project, item) if name_key(r.name) not in known]
    return found


def objects_with_libraries(project: Project, application_id: str) -> list[ProjectObject]:
    """The objects that `libraries` comes from."""
    owners = (*_with_parents(project, application_id), None)
    return [item for owner in owners for item in _with_libraries(project, owner)]


def references_of(project: Project, item: ProjectObject) -> list[LibraryReference]:
    """The libraries that an object lists or needs, as a build takes them."""
    needed = compiled(item).libraries
    return [] if needed is None else list(needed(item.data, project.path_of(item.id)))


def compiled(item: ProjectObject) -> Compiled[Any]:
    """What an object gives the compiler; nothing where its plug-in is missing.

    Raises InvalidDataError when its kind is installed and its data do not fit.
    """
    kind = kind_of(item)
    if kind is not None:
        return kind.compiled
    if item.kind in kinds() and isinstance(item.data, UnknownData):
        changed_object(item, data=item.data)  # says what is wrong with them
    return _NOTHING


def static_analysis(project: Project, application_id: str) -> StaticAnalysisData:
    """The coding rules that run with each build of an application: none where it runs them on demand only."""
    chosen = _application(project, application_id).data_as(ApplicationData).static_analysis
    return chosen if chosen.with_build else NO_RULES


def disabled_warnings(project: Project, application_id: str) -> frozenset[str]:
    """Codes of the warnings that an application does not want to be told of."""
    return frozenset(_application(project, application_id).data_as(ApplicationData).disabled_warnings)


def heap(project: Project, application_id: str) -> HeapSettings:
    """The settings of the memory that `__NEW` of an application takes from."""
    return _application(project, application_id).data_as(ApplicationData).heap.settings


def change_reserve(project: Project, application_id: str) -> ChangeReserve:
    """The memory that a download of an application sets aside for online changes."""
    return _application(project, application_id).data_as(ApplicationData).change_reserve.settings


def source_of(project: Project, object_id: str) -> Source | None:
    """The text an object is compiled in, None for objects without code; an accessor is in its property's."""
    item = project.get(object_id)
    if compiled(item).in_parent and item.parent_id is not None:
        item = project.get(item.parent_id)
    in_application = any(above.kind == APPLICATION for above in project.ancestors(item.id))
    owner = owner_of(project, item.parent_id)
    owner_name = owner.name if owner is not None and compiled(owner).members != "none" else None
    return _text(project, item, Scope.APPLICATION if in_application else Scope.POUS, owner_name)


def _application(project: Project, application_id: str) -> ProjectObject:
    application = project.get(application_id)
    if application.kind != APPLICATION:
        raise UnknownObjectError(f"'{application.name}' is a {application.kind}, not an application")
    return application


def _with_parents(project: Project, application_id: str) -> list[ProjectObject]:
    """An application, then the applications it is a child of, nearest first (CON-07)."""
    application = _application(project, application_id)
    above = [item for item in project.ancestors(application_id) if item.kind == APPLICATION]
    return [application, *above]


def _with_libraries(project: Project, owner: ProjectObject | None) -> list[ProjectObject]:
    """The list of an owner, then its objects that need libraries themselves."""
    found = in_scope_of(project, owner)
    giving = [item for item in found if not item.excluded and compiled(item).libraries is not None]
    return sorted(giving, key=lambda item: item.kind != LIBRARY_MANAGER.name)


def _own(project: Project, application: ProjectObject) -> Iterator[ProjectObject]:
    """The objects below an application, without those of the applications below it and without what is
    excluded from the build."""
    waiting = list(reversed(project.children(application.id)))
    while waiting:
        item = waiting.pop()
        if item.kind != APPLICATION and not item.excluded:
            yield item
            waiting += reversed(project.children(item.id))


def _texts(
    project: Project, items: Iterable[ProjectObject], scope: Scope, written: WrittenSources
) -> Iterator[Source]:
    for item in items:
        text = written.source(project, item, scope, None)
        if text is None:
            continue
        yield text
        if compiled(item).members != "none":
            for child in in_scope_of(project, item):
                child_text = None if child.excluded else written.source(project, child, scope, item.name)
                if child_text is not None:
                    yield child_text


def _text(project: Project, item: ProjectObject, scope: Scope, owner: str | None) -> Source | None:
    write = compiled(item).source
    if write is None:
        return None
    writer = SourceWriter()
    write(project, item, writer)
    return Source(
        uri=f"{owner}.{item.name}" if owner else item.name,
        text=writer.text(),
        scope=scope,
        owner=owner,
        name=writer.name,
        body_line=writer.body_line,
        bodies=writer.bodies(),
        map=writer.map(),
    )
