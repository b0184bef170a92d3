"""Entry points are found wherever `importlib.metadata` finds them, which is the reference."""

from __future__ import annotations

import sys
import zipfile
from importlib import metadata
from pathlib import Path

import pytest

from tappet.plug_ins import entry_points

GROUP = "tappet.test_group"
POINTS = f"[other]\nx = a:b\n\n[{GROUP}]\nsecond = toy.b:B\nfirst = toy.a:A\n"
ABOUT = "Metadata-Version: 2.1\nName: toy\nVersion: 1\n"


def found(group: str) -> list[tuple[str, str]]:
    """What is found, after a comparison with what there is."""
    points = entry_points(group)
    assert {point.name for point in points} == {point.name for point in metadata.entry_points(group=group)}
    return [(point.name, point.value) for point in points]


@pytest.mark.parametrize(("folder", "about"), [("toy-1.dist-info", "METADATA"), ("toy.egg-info", "PKG-INFO")])
def test_an_installed_package(
    folder: str, about: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    assert found(GROUP) == []
    (tmp_path / folder).mkdir()
    (tmp_path / folder / about).write_text(ABOUT)
    assert found(GROUP) == []
    (tmp_path / folder / "entry_points.txt").write_text(POINTS)
    assert found(GROUP) == [("first", "toy.a:A"), ("second", "toy.b:B")]
    assert found("tappet.test") == []


def test_a_package_in_an_archive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with zipfile.ZipFile(tmp_path / "toy.zip", "w") as archive:
        archive.writestr("toy-1.dist-info/METADATA", ABOUT)
        archive.writestr("toy-1.dist-info/entry_points.txt", POINTS)
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path / "toy.zip"), str(tmp_path / "missing")])
    assert found(GROUP) == [("first", "toy.a:A"), ("second", "toy.b:B")]


def test_metadata_that_is_no_text_hides_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, content in (("bad", b"\xff\xfe"), ("toy", POINTS.encode())):
        folder = tmp_path / f"{name}-1.dist-info"
        folder.mkdir()
        (folder / "entry_points.txt").write_bytes(content)
        (folder / "METADATA").write_text(ABOUT.replace("toy", name))
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    there = metadata.EntryPoint("first", "toy.a:A", GROUP)
    monkeypatch.setattr(metadata, "entry_points", lambda group: [there])  # it would not read the bad one
    assert entry_points(GROUP) == [there]
    assert entry_points("tappet.test") == []
