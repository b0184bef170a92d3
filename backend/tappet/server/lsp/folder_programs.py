"""The `.st` files of a folder as programs, for editors that work on files.

A project folder of Tappet (docs/project-folder.md) is understood too: children of a block lie in a folder of
its name, accessors in a folder of their property, and each application is a program of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote, unquote, urlsplit

from tappet import libraries
from tappet.lang.coding_settings import NO_RULES, StaticAnalysis, static_analysis
from tappet.lang.services.documents import Program, Segment, SourceMap, Text, library_text, whole_file
from tappet.lang.source import Scope, Source, split_lines
from tappet.project.errors import FolderFormatError
from tappet.project.library_reference import LibraryReference
from tappet.project.project_file import INDEX_FILE

if TYPE_CHECKING:
    from tappet.project.kinds.application import ApplicationData

MAX_FILES = 20_000
"""A folder with more is not a project but, say, a home folder."""
_IGNORED = frozenset({".git", ".hg", ".svn", "node_modules", ".venv", "__pycache__"})
_PROPERTY_END = re.compile(r"^\s*END_PROPERTY\b", re.IGNORECASE)


def file_uri(path: Path) -> str:
    """The one spelling of a file's uri."""
    text = path.as_posix()
    return "file://" + quote(text if text.startswith("/") else f"/{text}", safe="/:~()+,;=@!$&'*")


def canonical_uri(uri: str) -> str:
    """`file:` uris in one spelling whatever the client escapes; others as they are."""
    if not uri.lower().startswith("file:"):
        return uri
    path = unquote(urlsplit(uri).path)
    if re.match(r"/[A-Za-z]:", path):
        path = "/" + path[1].lower() + path[2:]
    return "file://" + quote(path, safe="/:~()+,;=@!$&'*")


class FolderPrograms:
    """Composes the programs of a folder. Reads the files again each time; unchanged ones are cheap."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        self._read: dict[Path, tuple[tuple[int, int], str]] = {}

    def __call__(self, unsaved: Mapping[str, str]) -> list[Program]:
        """One program per application; files in no application count as one."""
        left_out = _LeftOut(self.root)
        files = {path: text for path, text in self._files(unsaved) if not left_out(path)}
        groups: dict[str, list[Path]] = {}
        shared: list[Path] = []
        for path in files:
            key = self._application(path)
            if key is None:
                shared.append(path)
            else:
                groups.setdefault(key, []).append(path)
        if not groups:
            groups = {self.root.name or "Folder": shared}
            shared = []
        found, _ = libraries.resolve(LibraryReference(name) for name in libraries.names())
        standard = [library_text(source) for library in found for source in library.sources]
        programs = []
        for name, paths in groups.items():
            texts = [*self._texts(files, paths, Scope.APPLICATION), *self._texts(files, shared, Scope.POUS)]
            chosen = self._settings(name)
            program = Program(
                name,
                [*texts, *standard],
                self._tasks(paths),
                static=_static(chosen),
                disabled_warnings=frozenset(chosen.disabled_warnings if chosen else ()),
            )
            programs.append(program)
        return programs

    def _files(self, unsaved: Mapping[str, str]) -> Iterator[tuple[Path, str]]:
        found: list[Path] = []
        waiting = [self.root]
        while waiting:
            folder = waiting.pop()
            try:
                entries = sorted(folder.iterdir())
            except OSError:
                continue
            for entry in entries:
                if entry.is_symlink():
                    continue
                if entry.is_dir():
                    if entry.name not in _IGNORED:
                        waiting.append(entry)
                elif entry.suffix.lower() == ".st":
                    found.append(entry)
            if len(found) > MAX_FILES:
                raise ValueError(
                    f"{self.root} holds more than {MAX_FILES} .st files; open the project's own folder"
                )
        for path in sorted(found):
            text = unsaved.get(file_uri(path))
            if text is None:
                text = self._text_of(path)
            if text is not None:
                yield path, text
        known = {file_uri(path) for path in found}
        for uri, text in unsaved.items():  # not saved yet, or outside of the folder
            if uri.startswith("file:") and uri not in known and uri.lower().endswith(".st"):
                yield Path(unquote(urlsplit(uri).path)), text

    def _text_of(self, path: Path) -> str | None:
        try:
            status = path.stat()
            key = (status.st_mtime_ns, status.st_size)
            known = self._read.get(path)
            if known is not None and known[0] == key:
                return known[1]
            raw = path.read_bytes()
        except OSError:
            return None
        try:
            text = raw.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = raw.decode("latin-1")
        self._read[path] = (key, text)
        return text

    def _application(self, path: Path) -> str | None:
        """The application a file of a project folder belongs to: the folder below `PLC Logic`."""
        try:
            parts = path.relative_to(self.root).parts
        except ValueError:
            return None
        if "PLC Logic" not in parts[:-2]:
            return None
        at = parts.index("PLC Logic")
        return "/".join(parts[: at + 2])

    def _settings(self, application: str) -> ApplicationData | None:
        """What the application of a project folder has chosen; None where there is no such file."""
        path = self.root / f"{application}.application.json"
        try:
            content = path.read_bytes()
            from tappet.project.kinds.application import ApplicationData  # project folders only

            return ApplicationData.model_validate_json(content)
        except (OSError, ValueError):
            return None

    def _tasks(self, paths: list[Path]) -> list[str]:
        folders = {path.parent / "Task Configuration" for path in paths}
        return sorted(
            file.name.removesuffix(".task.json") for folder in folders for file in folder.glob("*.task.json")
        )

    def _texts(self, files: Mapping[Path, str], paths: list[Path], scope: Scope) -> Iterator[Text]:
        accessors = {path for path in paths if _is_accessor(path, files)}
        for path in paths:
            if path in accessors:
                continue
            folder = path.with_suffix("")
            below = [child for child in (folder / "Get.st", folder / "Set.st") if child in accessors]
            owner = path.parent.name if path.parent.with_suffix(".st") in files else None
            name = f"{owner}.{path.stem}" if owner else path.stem
            if below:
                yield _property(path, files, below, scope, owner)
            else:
                source = Source(
                    str(path), files[path], scope=scope, owner=owner, name=name.rpartition(".")[2]
                )
                yield whole_file(file_uri(path), source)


class _LeftOut:
    """Whether a file of a project folder is excluded from the build, itself or with what it is below."""

    def __init__(self, root: Path) -> None:
        self._root = root
        self._listed: dict[Path, frozenset[str]] = {}

    def __call__(self, path: Path) -> bool:
        while path != self._root and path != path.parent:
            stem = path.stem if path.suffix.lower() == ".st" else path.name
            if stem in self._excluded_in(path.parent):
                return True
            path = path.parent
        return False

    def _excluded_in(self, folder: Path) -> frozenset[str]:
        """Stems of the files in a folder whose index excludes them."""
        found = self._listed.get(folder)
        if found is None:
            found = self._listed[folder] = frozenset(self._read(folder / INDEX_FILE))
        return found

    def _read(self, path: Path) -> Iterator[str]:
        try:
            content = path.read_bytes()
            from tappet.project.folder.filenames import stem_of  # project folders only
            from tappet.project.folder.layout import read_index

            entries = read_index(path.name, content)
        except (OSError, FolderFormatError):
            return
        for entry in entries:
            if (entry.options or {}).get("exclude_from_build") is True:
                yield stem_of(entry.name)


def _is_accessor(path: Path, files: Mapping[Path, str]) -> bool:
    return path.stem.upper() in ("GET", "SET") and path.parent.with_suffix(".st") in files


def _property(
    path: Path, files: Mapping[Path, str], accessors: list[Path], scope: Scope, owner: str | None
) -> Text:
    """A property with the files of its accessors in the place before END_PROPERTY."""
    lines = split_lines(files[path])
    end = next((number for number, line in enumerate(lines) if _PROPERTY_END.match(line)), len(lines))
    composed = lines[:end]
    segments = [Segment(0, file_uri(path), "", 0, end, len(lines[end - 1]))] if end else []
    for accessor in accessors:
        part = split_lines(files[accessor])
        segments.append(Segment(len(composed), file_uri(accessor), "", 0, len(part), len(part[-1])))
        composed += part
    if end < len(lines):
        segments.append(Segment(len(composed), file_uri(path), "", end, len(lines) - end, len(lines[-1])))
        composed += lines[end:]
    source = Source(str(path), "\n".join(composed), scope=scope, owner=owner, name=path.stem)
    return Text(source, SourceMap(tuple(segments)))


def _static(application: ApplicationData | None) -> StaticAnalysis:
    """The coding rules that run in the editors."""
    if application is None or not application.static_analysis.with_build:
        return NO_RULES
    chosen = application.static_analysis
    return static_analysis(chosen.rules, chosen.prefixes, chosen.limits)
