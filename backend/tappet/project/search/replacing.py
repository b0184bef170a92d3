"""Replacing what was found: chosen hits of several objects, as one change of the project."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from tappet.project import edit
from tappet.project.errors import ProjectError
from tappet.project.model import Project, ProjectObject
from tappet.project.objects import changed_object
from tappet.project.search.contents import NAME_PATH, Path
from tappet.project.search.finding import Hit, find_in_object
from tappet.project.search.pattern import Found, Pattern
from tappet.project.search.query import Query

Replace = Callable[[Found], str]


class NotReplaceableError(ProjectError):
    """A chosen hit does not exist, or is where nothing can be replaced."""

    code = "not_replaceable"


def replace_in_project(
    project: Project, query: Query, pattern: Pattern, replace: Replace, chosen: Mapping[str, Collection[int]]
) -> tuple[Project, int]:
    """The project with the chosen hits (their numbers, by object) replaced, and how many they were.

    Texts and tables change first; a name then changes as `edit.rename_object` does it, header included.
    Raises NotReplaceableError, InvalidDataError, InvalidNameError, NameTakenError, UnknownObjectError.
    """
    names: dict[str, str] = {}
    count = 0
    changed: dict[str, ProjectObject] = {}
    for object_id, numbers in chosen.items():
        item = project.get(object_id)
        hits = find_in_object(pattern, query, item)
        wanted = [_wanted(item, hits, number) for number in sorted(set(numbers))]
        count += len(wanted)
        changed[object_id], name = _replaced(item, wanted, replace)
        if name is not None:
            names[object_id] = name
    result = Project(
        project.name, project.description, {**project.objects, **changed}, extra_files=project.extra_files
    )
    for object_id, name in names.items():
        result = edit.rename_object(result, object_id, name)
    return result, count


def _wanted(item: ProjectObject, hits: Sequence[Hit], number: int) -> Hit:
    if number >= len(hits):
        raise NotReplaceableError(
            f"'{item.name}' has {len(hits)} hit(s), so there is none of number {number}; search again"
        )
    if not hits[number].content.writable:
        found = hits[number].match
        raise NotReplaceableError(f"'{found}' in '{item.name}' is a number or a fixed name; leave it out")
    return hits[number]


def _replaced(item: ProjectObject, hits: Sequence[Hit], replace: Replace) -> tuple[ProjectObject, str | None]:
    """The object with other texts, and the name it shall have if that changes."""
    data: Any = item.data.model_dump(mode="json")
    name = None
    by_text: dict[tuple[Path, Path | None], list[Hit]] = {}
    for hit in hits:
        by_text.setdefault((hit.content.path, hit.content.inner), []).append(hit)
    for (path, inner), found in by_text.items():
        text = _text_with(found[0].content.text, found, replace)
        if path == NAME_PATH:
            name = text
        elif inner is None:
            _put(data, path, text)
        else:
            body = json.loads(_at(data, path))
            _put(body, inner, text)
            _put(data, path, json.dumps(body, ensure_ascii=False, indent=_indent(_at(data, path))))
    return (changed_object(item, data=data) if set(by_text) - {(NAME_PATH, None)} else item), name


def _indent(body: str) -> int | None:
    """How many blanks a stored drawing is indented by, so that a diff shows what was replaced."""
    first, _, rest = body.partition("\n")
    return len(rest) - len(rest.lstrip(" ")) if first.strip() == "{" and rest.startswith(" ") else None


def _text_with(text: str, hits: Sequence[Hit], replace: Replace) -> str:
    pieces: list[str] = []
    position = 0
    for hit in hits:
        pieces += [text[position : hit.found.start], replace(hit.found)]
        position = hit.found.end
    return "".join([*pieces, text[position:]])


def _at(data: Any, path: Path) -> Any:
    for key in path:
        data = data[key]
    return data


def _put(data: Any, path: Path, text: str) -> None:
    _at(data, path[:-1])[path[-1]] = text
