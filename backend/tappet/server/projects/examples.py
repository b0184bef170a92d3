"""Example projects: in the package, or in the checkout beside it."""

from __future__ import annotations

from pathlib import Path

import tappet
from tappet.project import folder
from tappet.project.edit import change_data
from tappet.project.errors import ProjectError
from tappet.project.kinds.device import DEVICE, DeviceData
from tappet.project.model import Project
from tappet.server.settings import LOCAL_RUNTIME


class UnknownExampleError(ProjectError):
    """No example of this name is installed."""

    code = "unknown_example"


def example_folders() -> dict[str, Path]:
    """The examples in the package or in the checkout, by name."""
    package = Path(tappet.__file__).resolve().parent
    roots = (package / "projects", package.parents[1] / "projects")
    return {
        path.parent.name: path.parent
        for root in reversed(roots)
        for path in sorted(root.glob("*/tappet-project.json"))
    }


def find_example(name: str) -> Path:
    """The folder of an example. Raises UnknownExampleError naming those there are."""
    found = example_folders()
    if name not in found:
        known = ", ".join(sorted(found)) or "none"
        raise UnknownExampleError(f"there is no example '{name}'; installed: {known}")
    return found[name]


def example_content(path: Path) -> Project:
    """The project in a folder of an example; devices that lead nowhere lead to the local runtime."""
    project = folder.load(path, with_extra_files=True)
    for item in project.find_kind(DEVICE.name):
        if isinstance(item.data, DeviceData) and item.data.runtime_id is None:
            data = item.data.model_copy(update={"runtime_id": LOCAL_RUNTIME})
            project = change_data(project, item.id, data)
    return project
