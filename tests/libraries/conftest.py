"""Libraries that a test installs go into a folder of its own."""

from pathlib import Path

import pytest

from tappet.libraries import repository


@pytest.fixture(autouse=True)
def library_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "libraries"
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(folder))
    return folder
