"""What the web server orders of a compiler process."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from tappet.project.library_reference import LibraryReference


@dataclass(frozen=True, slots=True)
class BuildOrder:
    """Everything a build depends on, as plain data."""

    key: str
    """Names the application; builds of one key share their caches."""
    application: str
    sources: tuple[dict[str, Any], ...]
    """Fields of `iec.source.Source`."""
    tasks: tuple[dict[str, Any], ...]
    """Fields of `iec.task.Task`."""
    libraries: tuple[LibraryReference, ...]
    previous: bytes | None
    """Package that runs now; unchanged data keep their places."""
    cache: str
    """Folder of compiled objects."""
    static: dict[str, Any]
    """Fields of `project.kinds.application.StaticAnalysisData`."""
    heap: dict[str, Any]
    """Fields of `iec.heap.HeapSettings`."""
    reserve: dict[str, Any] = field(default_factory=dict)
    """Fields of `iec.memory.ChangeReserve`."""
    disabled_warnings: tuple[str, ...] = ()
    """Codes of warnings that are not reported."""
    check_only: bool = False
    """Make no package."""
    project: str = ""
    """Name of the project, for programs that ask."""
    instrumented: bool = False
    """Make the instrumented variant, too."""
    fresh: bool = False
    """Use nothing that earlier builds left: no trees, no objects."""
