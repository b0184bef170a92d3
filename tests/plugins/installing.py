"""Installs a plug-in package of this folder for a test, as an installer does: its modules and its metadata."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tappet.iec import languages
from tappet.project import kind_registry

PLUGINS = Path(__file__).parent


@contextmanager
def installed(package: str, site: Path) -> Iterator[list[str]]:
    """The package is there as long as the context lasts; gives the paths that a further process needs.

    `site` is an empty folder that gets the metadata which pip would write from the pyproject.toml.
    """
    project = tomllib.loads((PLUGINS / package / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    metadata = site / f"{package}-{project['version']}.dist-info"
    metadata.mkdir(parents=True)
    (metadata / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n", encoding="utf-8"
    )
    groups = [
        "\n".join([f"[{group}]", *(f"{name} = {target}" for name, target in entries.items())])
        for group, entries in project["entry-points"].items()
    ]
    (metadata / "entry_points.txt").write_text("\n\n".join(groups) + "\n", encoding="utf-8")
    paths = [str(PLUGINS / package), str(site)]
    sys.path[:0] = paths
    kind_registry.look_again()
    languages.look_again()
    try:
        yield paths
    finally:
        for path in paths:
            sys.path.remove(path)
        for name in [name for name in sys.modules if name.partition(".")[0] == package]:
            del sys.modules[name]
        kind_registry.look_again()
        languages.look_again()
