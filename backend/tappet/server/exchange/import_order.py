"""What goes to the process of an import and comes back."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from tappet.libraries.missing import report_missing
from tappet.project.exchange.deciding import Decided
from tappet.project.exchange.existing import Decisions, Histories
from tappet.project.exchange.importing import Imported, import_files, read_as_project
from tappet.project.exchange.placing import Place
from tappet.project.model import Project


@dataclass(frozen=True, slots=True)
class ImportOrder:
    """What to read, and into what."""

    files: Mapping[str, bytes]
    project: Project | None
    place: str | None
    name: str
    chosen: Collection[str] | None
    decisions: Decisions = field(default_factory=Decisions)
    """What becomes of objects whose names exist in the project."""
    histories: Histories = field(default_factory=dict)
    """States of objects of the project in the past, newest first."""
    preview: bool = False
    """Look for objects whose names exist."""
    compare: str = ""
    """Key of an object to be compared with the one of its name."""
    as_project: bool = False
    """The files are a project of their own, to be compared with."""

    def read(self) -> Imported:
        """The project with the files in it. Raises ProjectError."""
        if self.as_project:
            return read_as_project(self.files, self.name)
        where = None if self.place is None else Place(None if self.place == "pous" else self.place)
        imported = import_files(
            self.files,
            self.project,
            where=where,
            name=self.name,
            chosen=self.chosen,
            decided=Decided(self.decisions, self.histories, compare=self.compare),
            preview=self.preview,
        )
        report_missing(imported.project, imported.report)
        return imported


@dataclass(frozen=True, slots=True)
class Refused:
    """An error that a ProjectError says."""

    code: str
    message: str
