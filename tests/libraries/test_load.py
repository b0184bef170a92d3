"""Installed libraries and their sources."""

import json
from pathlib import Path

import pytest

from tappet.lang.source import Scope
from tappet.libraries import ROOT, UnknownLibraryError, load, names


def test_standard_is_installed_with_one_source_for_each_pou() -> None:
    library = load("standard")
    assert library.name == "Standard"
    assert "Standard" in names()
    assert {"TON", "CTU", "R_TRIG", "CONCAT"} <= {source.name for source in library.sources}
    assert all(source.scope is Scope.LIBRARY and source.namespace == "Standard" for source in library.sources)


def test_another_namespace_is_taken_over() -> None:
    assert load("Standard", namespace="STD").sources[0].namespace == "STD"


def test_unknown_names_and_versions_say_what_is_there() -> None:
    with pytest.raises(UnknownLibraryError, match=r"installed are .*Standard"):
        load("Standart")
    with pytest.raises(UnknownLibraryError, match=r"not 1\.0"):
        load("Standard", "1.0")


MANIFEST = {
    *("name", "version", "namespace", "company", "description", "internal"),
    *("replaces", "completes", "requires", "qualified_only"),
}
MANIFESTS = sorted(ROOT.glob("**/library.json"))


@pytest.mark.parametrize("path", MANIFESTS, ids=lambda path: path.parent.name)
def test_every_field_of_a_library_json_is_one_that_the_loader_reads(path: Path) -> None:
    assert set(json.loads(path.read_text(encoding="utf-8"))) <= MANIFEST
