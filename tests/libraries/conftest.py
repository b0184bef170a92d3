"""Libraries that a test installs go into a folder of its own; an axis that can move; transformations."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from tests.libraries.one_axis import OneAxis, one_axis
from tests.libraries.transformations import Transformations, transformations

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


@pytest.fixture(scope="module")
def transform() -> Iterator[Transformations]:
    with transformations() as running:
        yield running


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(20)
