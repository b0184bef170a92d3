"""What goes to the process of an import and comes back."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from tappet.libraries.missing import report_missing
from tappet.project.exchange.importing import Imported, import_files
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

    def read(self) -> Imported:
        """The project with the files in it. Raises ProjectError."""
        where = None if self.place is None else Place(None if self.place == "pous" else self.place)
        imported = import_files(self.files, self.project, where=where, name=self.name, chosen=self.chosen)
        report_missing(imported.project, imported.report)
        return imported


@dataclass(frozen=True, slots=True)
class Refused:
    """An error that a ProjectError says."""

    code: str
    message: str
