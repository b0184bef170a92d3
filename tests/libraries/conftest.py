"""Libraries that a test installs go into a folder of its own; an axis that can move."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.libraries.one_axis import OneAxis, one_axis

from tappet.libraries import repository


@pytest.fixture(autouse=True)
def library_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "libraries"
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(folder))
    return folder


@pytest.fixture
def axis() -> Iterator[OneAxis]:
    with one_axis() as one:
        yield one
