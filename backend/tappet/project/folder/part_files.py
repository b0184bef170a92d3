"""Which lines of which file of a project folder are which part of an object: for tools that show files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tappet.iec.languages import file_ending
from tappet.project.folder.codec import placed
from tappet.project.folder.texts import Parts, declaration_line, implementation_line
from tappet.project.kind_registry import kinds
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import IecText, JsonFile


@dataclass(frozen=True, slots=True)
class PartOfFile:
    """Lines of a file that are a part of an object; lines from 0."""

    path: Path
    object_id: str
    part: str
    """`declaration` or `implementation`."""
    line: int
    """Line of the file at which the part begins."""
    count: int


def part_files(project: Project, root: Path) -> list[PartOfFile]:
    """The parts of all objects whose texts are files below `root`, from which the project was read."""
    found: list[PartOfFile] = []
    for item, place in placed(project):
        kind = kinds().get(item.kind)
        if kind is not None and isinstance(kind.folder, IecText):
            found += _parts(item, kind.folder, root / place)
        elif kind is not None and isinstance(kind.folder, JsonFile):
            found += _texts_apart(item, kind.folder, root / place)
    return found


def _texts_apart(item: ProjectObject, form: JsonFile, place: Path) -> Iterator[PartOfFile]:
    """Texts that have a file of their own beside that of the data."""
    for field, ending in form.texts.items():
        text = getattr(item.data, field, None)
        if isinstance(text, str) and text:
            yield PartOfFile(
                place.with_name(f"{place.name}.{ending}"), item.id, field, 0, text.count("\n") + 1
            )


def _parts(item: ProjectObject, form: IecText, place: Path) -> Iterator[PartOfFile]:
    declaration = getattr(item.data, "declaration", None)
    implementation = getattr(item.data, "implementation", None)
    path = place.with_name(f"{place.name}.st")
    text = _text(path)
    if text is None:
        return
    if isinstance(declaration, str):
        line = declaration_line(form, item.name, text)
        yield PartOfFile(path, item.id, "declaration", line, declaration.count("\n") + 1)
    if not isinstance(implementation, str) or not implementation:
        return
    count = implementation.count("\n") + 1
    begin = implementation_line(form, item.name, Parts(declaration, implementation), text)
    if begin is not None:
        yield PartOfFile(path, item.id, "implementation", begin, count)
        return
    ending = file_ending(getattr(item.data, "language", ""), implementation)
    if ending is not None:
        yield PartOfFile(place.with_name(f"{place.name}.{ending}"), item.id, "implementation", 0, count)


def _text(path: Path) -> str | None:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError):
        return None
