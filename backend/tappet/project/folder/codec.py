"""A project to files by path, and back: every object a file, its children in a folder of its name.

What no object claims is kept as an extra file. Reading takes files in that no index lists, so that a new
`FB_New.st` in a folder is a new object of the project.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from tappet.iec.languages import file_ending
from tappet.project.data import SPLIT_TEXTS, UnknownData
from tappet.project.errors import FolderFormatError, ProjectError
from tappet.project.folder.filenames import name_of, stem_of
from tappet.project.folder.layout import (
    DEVICES,
    POUS,
    Entry,
    derived_id,
    read_endings,
    read_index,
    read_json,
    read_project_file,
    read_utf8,
    write_index,
    write_json,
    write_project_file,
)
from tappet.project.folder.texts import Parts, kind_of_text, read_text, write_text
from tappet.project.kind_registry import kinds
from tappet.project.model import DEVICE, FOLDER, Project, ProjectObject
from tappet.project.naming import check_project_name, name_key, normal_name
from tappet.project.object_kind import IecText, JsonFile
from tappet.project.objects import make_object
from tappet.project.placement import check_project
from tappet.project.project_file import INDEX_FILE, PROJECT_FILE


@dataclass(frozen=True, slots=True)
class DecodedFolder:
    """A project that was read, and the paths of the files that are its objects."""

    project: Project
    own_files: frozenset[str]


def encode(project: Project) -> dict[str, bytes]:
    """The files of a project by path, `/` between the parts. The same project always gives the same bytes.

    Of an extra file and an object's file at the same path, the object's stays.
    """
    files: dict[str, bytes] = {}
    entries: dict[str, list[Entry]] = defaultdict(list)
    for item, place in placed(project):
        entries[place.rpartition("/")[0]].append(_encode_object(item, place, files))
    for folder, children in entries.items():
        files[f"{folder}/{INDEX_FILE}"] = write_index(children)
    files[PROJECT_FILE] = write_project_file(project.name, project.description)
    own = {name_key(path) for path in files}
    own_folders = {above for key in own for above in _with_ancestors(key.rpartition("/")[0])}
    extra = {
        path: content
        for path, content in project.extra_files.items()
        if name_key(path) not in own_folders and own.isdisjoint(_with_ancestors(name_key(path)))
    }
    return dict(sorted({**extra, **files}.items()))


def placed(project: Project) -> Iterator[tuple[ProjectObject, str]]:
    """Every object with the path of its file without ending, which is the folder of its children, too."""
    folders: dict[str, str] = {}
    for item in project.walk():
        if item.parent_id is not None:
            folder = folders[item.parent_id]
        else:
            folder = DEVICES if item.kind == DEVICE else POUS
        folders[item.id] = f"{folder}/{stem_of(item.name)}"
        yield item, folders[item.id]


def decode(files: Mapping[str, bytes]) -> DecodedFolder:
    """The project of files by path. Raises FolderFormatError, whose message begins with a path."""
    by_path = {normal_name(path): content for path, content in files.items()}
    if PROJECT_FILE not in by_path:
        raise FolderFormatError(PROJECT_FILE, "is missing, so this is no Tappet project folder")
    head = read_project_file(by_path[PROJECT_FILE])
    reader = _Reader(by_path)
    for view in (DEVICES, POUS):
        reader.read_view(view)
    extra = {path: content for path, content in by_path.items() if path not in reader.own}
    project = Project(head.name, head.description, reader.objects, extra)
    try:
        check_project_name(head.name)
        check_project(project)
    except ProjectError as error:
        raise FolderFormatError(PROJECT_FILE, str(error)) from error
    return DecodedFolder(project, frozenset(reader.own))


def _encode_object(item: ProjectObject, place: str, files: dict[str, bytes]) -> Entry:
    """Add the file of an object to `files`; its line of the index."""
    known = not isinstance(item.data, UnknownData)
    form = _form(item.kind) if known else JsonFile(optional=True)
    data = item.data.model_dump(mode="json", exclude_none=known)
    entry = Entry(kind=item.kind, name=item.name, id=None if item.id == derived_id(place) else item.id)
    if isinstance(form, IecText):
        body = data.get("implementation", "")
        ending = file_ending(data.get("language", ""), body) if _is_plain_text(body) else None
        if ending is not None:
            files[f"{place}.{ending}"] = body.encode()
            entry.texts = {"implementation": ending}
            data["implementation"] = ""
        parts = Parts(data.pop("declaration", None), data.pop("implementation", None))
        text, entry.split = write_text(form, item.name, parts)
        files[f"{place}.st"] = text.encode()
        fields = type(item.data).model_fields
        entry.options = {key: value for key, value in data.items() if value != fields[key].default} or None
        return entry
    entry.texts = _split_texts(data, form, place, files) or None
    if form.optional and known:
        defaults = kinds()[item.kind].data().model_dump(mode="json", exclude_none=True)
        apart = entry.texts or {}
        data = {} if data == {key: value for key, value in defaults.items() if key not in apart} else data
    if data or not form.optional:
        files[f"{place}.{item.kind}.json"] = write_json(data, flat=form.flat)
    return entry


def _split_texts(data: dict[str, Any], form: JsonFile, place: str, files: dict[str, bytes]) -> dict[str, str]:
    """Move texts of the data into files of their own; which they were.

    Without the plug-in, what says which they are goes into the index with them, or stays with all of them.
    """
    marked = read_endings(data.get(SPLIT_TEXTS))
    found = {
        field: ending
        for field, ending in (marked or form.texts).items()
        if field != SPLIT_TEXTS and _is_plain_text(data.get(field))
    }
    if marked and found != marked:
        return {}
    if marked:
        del data[SPLIT_TEXTS]
    for field, ending in found.items():
        files[f"{place}.{ending}"] = data.pop(field).encode()
    return found


def _is_plain_text(value: object) -> bool:
    """Whether a file gives the text back as it is."""
    return isinstance(value, str) and "\r" not in value and not value.startswith("\ufeff")


def _form(kind: str) -> IecText | JsonFile:
    """The folder format of a kind; of one whose plug-in is missing, JSON where there are data."""
    known = kinds().get(kind)
    return known.folder if known is not None else JsonFile(optional=True)


def _with_ancestors(path: str) -> Iterator[str]:
    """A path and the folders above it."""
    while path:
        yield path
        path = path.rpartition("/")[0]


def texts_of_index(path: str, content: bytes) -> list[str]:
    """The paths of the text files that an index says stand beside the JSON of objects."""
    if b'"texts"' not in content:
        return []
    folder = path.rpartition("/")[0]
    return [
        f"{folder}/{stem_of(normal_name(entry.name))}.{ending}"
        for entry in read_index(path, content)
        for ending in (entry.texts or {}).values()
    ]


class _Reader:
    """Reads the two views folder by folder."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self.files = files
        self.own: set[str] = {PROJECT_FILE}
        self.objects: dict[str, ProjectObject] = {}
        self._below: dict[str, set[str]] = defaultdict(set)
        self._spelling: dict[str, str] = {}
        for path in files:
            self._spelling.setdefault(name_key(path), path)
            folder, _, name = path.rpartition("/")
            while folder:
                self._below[folder].add(name)
                folder, _, name = folder.rpartition("/")
        self._folders = {name_key(folder): folder for folder in sorted(self._below, reverse=True)}
        self._with_code = {above for folder in self._code_folders() for above in _with_ancestors(folder)}

    def read_view(self, view: str) -> None:
        """Read everything below the folder of a view."""
        waiting: list[tuple[str, str | None]] = [(view, None)]
        while waiting:
            folder, parent_id = waiting.pop()
            entries = self._entries(folder)
            for index, entry in enumerate(entries):
                if parent_id is None and (entry.kind == DEVICE) != (view == DEVICES):
                    raise FolderFormatError(
                        f"{folder}/{INDEX_FILE}",
                        f"'{entry.name}' is a {entry.kind}; devices alone belong in {DEVICES}",
                    )
                place = f"{folder}/{stem_of(entry.name)}"
                item = self._object(entry, place, parent_id, index)
                if item.id in self.objects:
                    raise FolderFormatError(
                        f"{folder}/{INDEX_FILE}", f"'{item.name}' has the id of another object"
                    )
                self.objects[item.id] = item
                below = self._folders.get(name_key(place))
                if below is not None:
                    waiting.append((below, item.id))

    def _entries(self, folder: str) -> list[Entry]:
        """The children that the index lists, then those that are there besides, by name."""
        path = f"{folder}/{INDEX_FILE}"
        entries: list[Entry] = []
        if path in self.files:
            self.own.add(path)
            entries = read_index(path, self.files[path])
        listed = set()
        for entry in entries:
            entry.name = normal_name(entry.name)
            if name_key(stem_of(entry.name)) in listed:
                raise FolderFormatError(path, f"lists '{entry.name}' twice (names differ by more than case)")
            listed.add(name_key(stem_of(entry.name)))
        found = []
        for name in sorted(self._below.get(folder, ()), key=lambda name: ("." not in name, name)):
            key = name_key(name.partition(".")[0])
            unlisted = self._unlisted(f"{folder}/{name}", name) if key not in listed else None
            if unlisted is not None:
                listed.add(key)
                found.append(unlisted)
        return entries + sorted(found, key=lambda entry: name_key(entry.name))

    def _unlisted(self, path: str, name: str) -> Entry | None:
        """What a file or folder would be that no index lists; None for what is no object."""
        stem, dot, ending = name.partition(".")
        object_name = name_of(stem)
        kind: str | None = ending.removesuffix(".json") if ending.endswith(".json") else None
        if not dot:
            kind = FOLDER if path in self._with_code else None
        elif ending == "st" and path in self.files:
            kind = kind_of_text(read_utf8(path, self.files[path]))
            if kind is None:
                raise FolderFormatError(
                    path, "what it declares is not recognised; it should begin with PROGRAM, TYPE or the like"
                )
        elif kind is None or kind not in kinds() or isinstance(_form(kind), IecText):
            kind = None
        if kind is None:
            return None
        if stem_of(object_name) != stem:
            raise FolderFormatError(path, f"an object's file is named {stem_of(object_name)}, not {stem}")
        return Entry(kind=kind, name=object_name)

    def _code_folders(self) -> Iterable[str]:
        """Folders that hold an index or a text."""
        return (
            folder
            for folder, names in self._below.items()
            if any(name == INDEX_FILE or name.endswith(".st") for name in names)
        )

    def _object(self, entry: Entry, place: str, parent_id: str | None, index: int) -> ProjectObject:
        path, data = self._data(entry, place)
        try:
            return make_object(
                id=entry.id or derived_id(place),
                parent_id=parent_id,
                kind=entry.kind,
                name=entry.name,
                index=index,
                data=data,
            )
        except ProjectError as error:
            raise FolderFormatError(path, str(error)) from error

    def _data(self, entry: Entry, place: str) -> tuple[str, dict[str, Any]]:
        """The path of an object's file and the data in it."""
        form = _form(entry.kind)
        path = f"{place}.{entry.kind}.json" if isinstance(form, JsonFile) else f"{place}.st"
        actual = self._actual(path)
        if isinstance(form, JsonFile):
            if actual is None and not (form.optional or entry.texts):
                raise FolderFormatError(path, f"is missing, but the index lists '{entry.name}'")
            data = self._json(actual) if actual is not None else {}
            return actual or path, data | self._split_off(entry, place)
        if actual is None:
            raise FolderFormatError(path, f"is missing, but the index lists '{entry.name}'")
        self.own.add(actual)
        parts = read_text(form, entry.name, read_utf8(actual, self.files[actual]), entry.split)
        texts = {"declaration": parts.declaration, "implementation": parts.implementation}
        present = {key: value for key, value in texts.items() if value is not None}
        return actual, {**(entry.options or {}), **present, **self._split_off(entry, place)}

    def _actual(self, path: str) -> str | None:
        """The path as it is spelled."""
        return path if path in self.files else self._spelling.get(name_key(path))

    def _json(self, path: str) -> dict[str, Any]:
        self.own.add(path)
        data = read_json(path, self.files[path])
        if not isinstance(data, dict):
            raise FolderFormatError(path, "should hold a JSON object")
        return data

    def _split_off(self, entry: Entry, place: str) -> dict[str, Any]:
        """The data that are text files of their own; without the plug-in also which they are."""
        if not entry.texts:
            return {}
        found: dict[str, Any] = {}
        for field, ending in entry.texts.items():
            path = f"{place}.{ending}"
            actual = self._actual(path)
            if actual is None:
                raise FolderFormatError(path, f"is missing, but the index lists it for '{entry.name}'")
            self.own.add(actual)
            found[field] = read_utf8(actual, self.files[actual])
        return found if entry.kind in kinds() else found | {SPLIT_TEXTS: entry.texts}
