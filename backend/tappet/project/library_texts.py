"""A project as a library: one ST text an object, with its methods, actions and properties in it (LIB-02).

Everything of the POUs view and of the applications goes in except programs: a library has no tasks that would
call them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import asdict
from typing import Any

from tappet.iec.sections import end_keyword
from tappet.iec.source import Source
from tappet.project.errors import ProjectError
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.placement import in_scope_of
from tappet.project.sources import compiled, libraries, references_of, source_of


class NoLibraryError(ProjectError):
    """The project cannot be a library; the message says why."""

    code = "no_library"


def library_texts(project: Project) -> dict[str, str]:
    """ST texts by object name; raises NoLibraryError when there is none or two objects share a name."""
    texts: dict[str, str] = {}
    seen: dict[str, str] = {}
    for item in _objects(project):
        other = seen.setdefault(name_key(item.name), item.name)
        if item.name in texts or other != item.name:
            raise NoLibraryError(f"two objects are called '{other}'; names in a library are unique")
        texts[item.name] = text_with_parts(project, item)
    if not texts:
        raise NoLibraryError(
            "there is nothing to make a library of: no block, function, type or variable list"
        )
    return texts


def library_sources(project: Project) -> list[Source]:
    """What `library_texts` is made of, as a build takes it: each line knows its object."""
    found = []
    for item in _objects(project):
        for part in (item, *_parts(project, item)):
            text = source_of(project, part.id)
            if text is not None:
                found.append(text)
    return found


def library_requirements(project: Project) -> list[LibraryReference]:
    """The libraries that the project refers to, those of the POUs view also without an application."""
    found: list[LibraryReference] = []
    for application in project.applications():
        found += libraries(project, application.id)
    for item in project.children(None):
        found += references_of(project, item)
    return list(dict.fromkeys(found))


def requirements(references: Iterable[LibraryReference]) -> list[dict[str, Any]]:
    """How a library says that it needs others, each once."""
    found: list[dict[str, Any]] = []
    for reference in references:
        required = _requirement(reference)
        if required not in found:
            found.append(required)
    return found


def _requirement(reference: LibraryReference) -> dict[str, Any]:
    """A placeholder is resolved by who uses the library."""
    is_placeholder = reference.placeholder is not None
    facts: dict[str, Any] = {
        "name": reference.placeholder if is_placeholder else reference.name,
        "version": "*" if is_placeholder else reference.version,
        "namespace": reference.namespace or "",
    }
    if reference.qualified_only:
        facts["qualified_only"] = True
    if reference.parameters:
        facts["parameters"] = [asdict(parameter) for parameter in reference.parameters]
    return facts


def _objects(project: Project) -> Iterator[ProjectObject]:
    for owner in (*project.applications(), None):
        for item in in_scope_of(project, owner):
            if compiled(item).in_library and not item.excluded and item.subkind != "program":
                yield item


def _parts(project: Project, item: ProjectObject) -> list[ProjectObject]:
    """Methods and the like of a block or interface."""
    if compiled(item).members == "none":
        return []
    return [child for child in in_scope_of(project, item) if not child.excluded]


def text_with_parts(project: Project, item: ProjectObject) -> str:
    """The text of an object with its methods, actions and properties in it."""
    own = source_of(project, item.id)
    assert own is not None
    text = own.text.rstrip("\n") + "\n"
    if compiled(item).members == "none":
        return text
    parts = []
    for child in _parts(project, item):
        source = source_of(project, child.id)
        if source is not None:
            parts.append(source.text.rstrip("\n") + "\n")
    end = end_keyword(text)
    if compiled(item).members == "inside" and end is not None:
        head, keyword, _ = text.rpartition(end)
        return f"{head}{''.join(parts)}{keyword}\n"
    return text + "".join(f"\n{part}" for part in parts)
