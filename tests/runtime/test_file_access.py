"""Files of an application for clients, against what lies in the folder; nothing beyond it is reached."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.runtime.file_access import (
    LARGEST,
    FileRefusedError,
    NoSuchFileError,
    delete_file,
    list_files,
    read_file,
    write_file,
)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    (tmp_path / "secret.txt").write_text("not of the application")
    return tmp_path / "files"


def test_files_are_written_listed_read_and_deleted(root: Path) -> None:
    assert list_files(root, "recipes/bread/", "") == []
    write_file(root, "recipes/bread/", "Rye.Bread.txtrecipe", b"a:=1\r\n")
    write_file(root, "recipes/bread", "Rye.Bread.txtrecipe", b"a:=2\r\n")
    write_file(root, "recipes/bread", "notes.txt", b"")
    there = root / "recipes" / "bread" / "Rye.Bread.txtrecipe"
    assert there.read_bytes() == b"a:=2\r\n"
    (found,) = list_files(root, "recipes/bread", ".txtrecipe")
    assert (found.name, found.size, found.modified_ns) == (there.name, 6, there.stat().st_mtime_ns)
    assert read_file(root, "recipes/bread", found.name) == b"a:=2\r\n"
    assert sorted(os.listdir(there.parent)) == ["Rye.Bread.txtrecipe", "notes.txt"]
    delete_file(root, "recipes/bread", found.name)
    assert not there.exists()
    for act in (read_file, delete_file):
        with pytest.raises(NoSuchFileError, match=r"there is no file 'Rye\.Bread\.txtrecipe'"):
            act(root, "recipes/bread", found.name)


@pytest.mark.parametrize("folder", ["..", "a/../..", "./..", "\0", "link", "link/x"])
def test_no_folder_leads_out(root: Path, folder: str) -> None:
    root.mkdir()
    (root / "link").symlink_to(root.parent)
    for act in (
        lambda: read_file(root, folder, "secret.txt"),
        lambda: write_file(root, folder, "made.txt", b"x"),
        lambda: delete_file(root, folder, "secret.txt"),
    ):
        with pytest.raises((FileRefusedError, OSError)):
            act()
    assert (root.parent / "secret.txt").exists()
    assert not (root.parent / "made.txt").exists()


@pytest.mark.parametrize("name", ["", ".", "..", "../secret.txt", "a/b", "a\0b", "n" * 256, "ü" * 200])
def test_what_is_no_name_is_refused(root: Path, name: str) -> None:
    for act in (lambda: read_file(root, "", name), lambda: write_file(root, "", name, b"")):
        with pytest.raises(FileRefusedError, match="is no name of a file"):
            act()


def test_links_and_folders_are_no_files(root: Path) -> None:
    root.mkdir()
    (root / "link").symlink_to(root.parent / "secret.txt")
    (root / "folder").mkdir()
    os.mkfifo(root / "pipe")
    assert list_files(root, "", "") == []
    for name in ("link", "folder", "pipe"):
        with pytest.raises(FileRefusedError):
            read_file(root, "", name)
    write_file(root, "", "link", b"own")
    assert (root.parent / "secret.txt").read_text() == "not of the application"
    assert (root / "link").read_bytes() == b"own"
    with pytest.raises(FileRefusedError):
        delete_file(root, "", "folder")


def test_large_files_are_refused(root: Path) -> None:
    root.mkdir()
    (root / "large").write_bytes(b"")
    os.truncate(root / "large", LARGEST + 1)
    with pytest.raises(FileRefusedError, match="at most"):
        read_file(root, "", "large")
    with pytest.raises(FileRefusedError, match="at most"):
        write_file(root, "", "other", bytes(LARGEST + 1))
    assert [file.name for file in list_files(root, "", "")] == ["large"]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(folder=st.text(alphabet="ab./\\ü", max_size=12), name=st.text(alphabet="ab./\\ü", max_size=8))
def test_whatever_the_path_only_the_folder_changes(tmp_path: Path, folder: str, name: str) -> None:
    root = tmp_path / "files"
    before = sorted(path for path in tmp_path.rglob("*") if root not in (path, *path.parents))
    try:
        write_file(root, folder, name, b"data")
    except FileRefusedError:
        pass
    else:
        assert read_file(root, folder, name) == b"data"
    assert sorted(path for path in tmp_path.rglob("*") if root not in (path, *path.parents)) == before
