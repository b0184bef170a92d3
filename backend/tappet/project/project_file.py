"""The files that make a folder a project; known without reading one."""

from __future__ import annotations

from pathlib import Path

PROJECT_FILE = "tappet-project.json"
INDEX_FILE = "index.json"
"""The order of what lies in a folder, and what is excluded from the build."""


def is_project(path: Path) -> bool:
    """Whether the path is a project folder."""
    return (path / PROJECT_FILE).is_file()
