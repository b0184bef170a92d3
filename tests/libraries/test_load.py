"""Installed libraries and their sources."""

import pytest

from tappet.lang.source import Scope
from tappet.libraries import UnknownLibraryError, load, names


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
