"""Compiled objects on disk."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tappet.codegen.build import BuildSession
from tappet.codegen.object_cache import ObjectCache


def filled(folder: Path) -> ObjectCache:
    """Three objects of 100 bytes and their check, written one second after the other."""
    cache = ObjectCache(folder, limit=250)
    for second, name in enumerate(("a1", "b2", "c3"), 1):
        cache.write(name, name.encode() * 50)
        os.utime(folder / name / name, (second, second))
    return cache


def names(folder: Path) -> set[str]:
    return {file.name for file in folder.glob("*/*")}


def test_the_oldest_objects_go_when_the_folder_is_full(tmp_path: Path):
    filled(tmp_path).trim()
    assert names(tmp_path) == {"b2", "c3"}
    assert ObjectCache(tmp_path).read("c3") == b"c3" * 50


def test_a_session_looks_once_whether_its_folder_is_full_before_it_stores(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    looked = []
    monkeypatch.setattr(ObjectCache, "trim", lambda cache: looked.append(cache.folder))
    session = BuildSession()
    assert session.cache(tmp_path) is session.cache(tmp_path)
    session.cache(tmp_path).read("aa")
    assert looked == []
    session.cache(tmp_path).write("aa", b"1")
    session.cache(tmp_path).write("bb", b"2")
    assert looked == [tmp_path]


def test_nothing_to_remove_is_no_error(tmp_path: Path):
    ObjectCache(None).trim()
    ObjectCache(tmp_path / "gone").trim()
    assert names(tmp_path) == set()
