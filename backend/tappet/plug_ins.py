"""Entry points by which other packages add kinds of objects, languages and wire operations.

May be imported by every room.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

_METADATA = (".dist-info", ".egg-info")
_FILE = "entry_points.txt"


def entry_points(group: str) -> list[EntryPoint]:
    """Those of the installed packages in a group, by name."""
    if not _may_exist(group):
        return []
    from importlib import metadata  # takes as long to import as a small program to be checked

    return sorted(metadata.entry_points(group=group), key=lambda point: point.name)


def _may_exist(group: str) -> bool:
    """Whether a package names the group; True where only `importlib.metadata` can tell."""
    heading = f"[{group}]"
    for folder in sys.path:
        try:
            with os.scandir(folder or ".") as entries:
                if any(heading in _entry_points_in(entry) for entry in entries):
                    return True
        except NotADirectoryError:  # an archive with packages
            return True
        except OSError:
            continue
    return False


def _entry_points_in(entry: os.DirEntry[str]) -> str:
    if not entry.name.endswith(_METADATA):
        return ""
    try:
        with open(os.path.join(entry.path, _FILE), encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return ""


__all__ = ["entry_points"]
