"""Project folders on disk."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from tappet.project.errors import FolderFormatError
from tappet.project.folder.codec import decode, encode, texts_of_index
from tappet.project.folder.layout import DEVICES, POUS
from tappet.project.model import Project
from tappet.project.naming import name_key, normal_name
from tappet.project.project_file import INDEX_FILE, PROJECT_FILE
from tappet.whole_file import replace_file

MAX_FILES = 100_000
MAX_BYTES = 1 << 30
"""A folder with more files or bytes is no project; this guards against opening a home directory."""


def load(path: str | Path, *, with_extra_files: bool = False) -> Project:
    """The project of a folder. Files that are no objects stay where they are unless asked for.

    Hidden files and symbolic links are not looked at. Raises FolderFormatError.
    """
    root = Path(path)
    if not (root / PROJECT_FILE).is_file():
        raise FolderFormatError(str(root), f"has no {PROJECT_FILE}, so it is no Tappet project folder")
    try:
        project = decode(_read(root, everything=with_extra_files)).project
    except FolderFormatError as error:
        raise FolderFormatError(str(root / error.path), str(error).removeprefix(f"{error.path}: ")) from error
    if with_extra_files:
        return project
    return Project(project.name, project.description, project.objects)


def save(project: Project, path: str | Path) -> None:
    """Write a project into a folder, which may hold an earlier state of it: only what differs is touched.

    Files of objects that are gone are removed, all others stay. Raises FolderFormatError when the folder
    holds a project that cannot be read, because what belongs to it is then not known.
    """
    root = Path(path)
    files = encode(project)
    old: dict[str, bytes] = {}
    if (root / PROJECT_FILE).is_file():
        old = _read(root, everything=False)
        own = decode(old).own_files
        old = {name: content for name, content in old.items() if normal_name(name) in own}
    new_by_key = {name_key(name): name for name in files}
    for name in old:
        target = new_by_key.get(name_key(name))
        if target is not None and target != name:
            _make_parents(root / target)
            (root / name).rename(root / target)
            _remove_empty_parents(root, root / name)
    for name, content in files.items():
        _write(root / name, content)
    for name in old:
        if name_key(name) not in new_by_key:
            (root / name).unlink(missing_ok=True)
            _remove_empty_parents(root, root / name)


def _read(root: Path, *, everything: bool) -> dict[str, bytes]:
    """The files of a folder by path; those that can be objects, or everything."""
    found = ((path.relative_to(root).as_posix(), path) for path in _walk(root))
    files: dict[str, bytes] = {}
    _add(((name, path) for name, path in found if everything or _may_be_object(name)), files)
    if not everything:
        indices = [name for name in files if name.endswith(f"/{INDEX_FILE}")]
        texts = [(text, root / text) for name in indices for text in texts_of_index(name, files[name])]
        _add(((name, path) for name, path in texts if path.is_file()), files)
    return files


def _add(paths: Iterable[tuple[str, Path]], files: dict[str, bytes]) -> None:
    total = sum(map(len, files.values()))
    for name, path in paths:
        files[name] = path.read_bytes()
        total += len(files[name])
        if len(files) > MAX_FILES or total > MAX_BYTES:
            raise FolderFormatError(name, "the folder has too many files or bytes for a project")


def _walk(root: Path) -> Iterator[Path]:
    """Regular files below a folder; no hidden ones, and nothing behind symbolic links."""
    waiting = [str(root)]
    while waiting:
        with os.scandir(waiting.pop()) as found:
            for entry in sorted(found, key=lambda entry: entry.name):
                if entry.name.startswith("."):
                    continue
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
                elif entry.is_file(follow_symlinks=False):
                    yield Path(entry.path)


def _may_be_object(name: str) -> bool:
    view, _, rest = name.partition("/")
    if not rest:
        return name == PROJECT_FILE
    return view in (DEVICES, POUS) and name.endswith((".st", ".json"))


def _write(path: Path, content: bytes) -> None:
    """Replace a file as a whole, and only if it differs, so that time stamps stay."""
    if path.is_file() and not path.is_symlink() and path.read_bytes() == content:
        return
    _make_parents(path)
    replace_file(path, content)


def _make_parents(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)


def _remove_empty_parents(root: Path, path: Path) -> None:
    for parent in path.parents:
        if parent == root or not parent.is_dir() or any(parent.iterdir()):
            return
        parent.rmdir()
