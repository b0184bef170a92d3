"""The applications of a stored project as programs, with the texts that are open in an editor in them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from msgspec import structs

from tappet import libraries
from tappet.iec.source import Source
from tappet.lang.coding_settings import static_analysis
from tappet.lang.services.documents import Program, SourceMap, Text, library_text
from tappet.project import sources as project_sources
from tappet.project.model import Project, ProjectObject
from tappet.project.sources import WrittenSources

PARTS = ("declaration", "implementation")


def object_uri(project_id: str, object_id: str) -> str:
    """An object; its documents have the name of their part behind it."""
    return f"tappet:/{project_id}/{object_id}"


def part_uri(project_id: str, object_id: str, part: str) -> str:
    """The document of one part of an object."""
    return f"{object_uri(project_id, object_id)}/{part}"


def parse_part_uri(uri: str, project_id: str) -> tuple[str, str] | None:
    """Object and part of a document of the project; None for any other uri."""
    prefix = f"tappet:/{project_id}/"
    if not uri.startswith(prefix):
        return None
    object_id, slash, part = uri[len(prefix) :].partition("/")
    return (object_id, part) if slash and part in PARTS else None


class ProjectPrograms:
    """Composes the programs of one project; `load` reads it again after `changed` was called."""

    def __init__(self, project_id: str, load: Callable[[], Project]) -> None:
        self.project_id = project_id
        self._load = load
        self._project: Project | None = None
        self._changes = 0
        self._loaded = 0
        """Changes that the project read last holds for certain."""
        self._composed: dict[str, _Composed] = {}
        """By id of the application; of '' where there is none."""

    def changed(self) -> None:
        """The stored project is another one now. Any thread may say so, also while the project is read."""
        self._changes += 1

    def __call__(self, unsaved: Mapping[str, str]) -> list[Program]:
        """All applications with the libraries they use."""
        project = self._with_unsaved(self._stored(), unsaved)
        applications = project.applications()
        before, self._composed = self._composed, {}
        for application_id in [application.id for application in applications] or [""]:
            self._composed[application_id] = before.get(application_id) or _Composed(self.project_id)
        programs = [self._application(project, application) for application in applications]
        return programs or [self._without_application(project)]

    def stored(self, document: str) -> str | None:
        """The stored text of a document; None for a document of something else, or one that is gone."""
        found = parse_part_uri(document, self.project_id)
        item = self._stored().objects.get(found[0]) if found is not None else None
        text = getattr(item.data, found[1], None) if found is not None and item is not None else None
        return text if isinstance(text, str) else None

    def _stored(self) -> Project:
        """The project as it is stored."""
        if self._project is None or self._loaded != self._changes:
            changes = self._changes
            self._project = self._load()
            self._loaded = changes  # one that came meanwhile counts: it may have been too late to be read
        return self._project

    def _with_unsaved(self, project: Project, unsaved: Mapping[str, str]) -> Project:
        objects = dict(project.objects)
        for uri, text in unsaved.items():
            found = parse_part_uri(uri, self.project_id)
            item = objects.get(found[0]) if found is not None else None
            if found is None or item is None or not hasattr(item.data, found[1]):
                continue  # deleted by somebody else, or no text of this project
            if getattr(item.data, found[1]) != text:
                data = item.data.model_copy(update={found[1]: text})
                objects[item.id] = item.model_copy(update={"data": data})
        return replace(project, objects=objects)

    def _application(self, project: Project, application: ProjectObject) -> Program:
        composed = self._composed[application.id]
        sources = project_sources.application_sources(project, application.id, composed.written)
        found, _ = libraries.resolve(
            project_sources.libraries(project, application.id)
        )  # what is missing, the build and the library manager say
        texts = composed.texts(sources)
        texts += [library_text(source) for library in found for source in library.sources]
        tasks = [task.name for task in project_sources.tasks(project, application.id)]
        chosen = project_sources.static_analysis(project, application.id)
        static = static_analysis(chosen.rules, chosen.prefixes, chosen.limits)
        off = project_sources.disabled_warnings(project, application.id)
        name = f"{application.name} {application.id}"
        return Program(name, texts, tasks, static=static, disabled_warnings=off)

    def _without_application(self, project: Project) -> Program:
        return Program(project.name, self._composed[""].texts(_objects_with_text(project)))


class _Composed:
    """The texts of one program as they were composed last: what has not changed stays the same object, which
    nobody has to compare then."""

    def __init__(self, project_id: str) -> None:
        self.written = WrittenSources()
        self._project_id = project_id
        self._texts: dict[str, tuple[Source, Text]] = {}
        """With what they are made of, by uri."""

    def texts(self, own: Iterable[Source]) -> list[Text]:
        """The texts of these sources."""
        before, self._texts = self._texts, {}
        texts: list[Text] = []
        seen: set[str] = set()
        for source in own:
            uri = source.uri
            while uri.upper() in seen:  # hidden by one of the application: diagnostics need a name of its own
                uri += " (POUs)"
            seen.add(uri.upper())
            known = before.get(uri)
            text = known[1] if known is not None and known[0] is source else self._text(source, uri)
            self._texts[uri] = source, text
            texts.append(text)
        return texts

    def _text(self, text: Source, uri: str) -> Text:
        source = replace(text, uri=uri, map=None)
        segments = (
            structs.replace(segment, object_id=object_uri(self._project_id, segment.object_id))
            for segment in text.segments
        )
        return Text(source, SourceMap(tuple(segments)))


def _objects_with_text(project: Project) -> Iterator[Source]:
    """Every object of a project that has no application."""
    for item in project.walk():
        if not project_sources.compiled(item).in_parent:
            text = project_sources.source_of(project, item.id)
            if text is not None:
                yield text
