"""After an import: which libraries the project names that are not installed here."""

from __future__ import annotations

from tappet.libraries import repository
from tappet.project.exchange.report import ImportReport
from tappet.project.model import Project
from tappet.project.sources import references_of


def report_missing(project: Project, report: ImportReport) -> None:
    """One entry for each library that is referenced and not installed."""
    for item in project.walk():
        for reference in references_of(project, item):
            try:
                repository.find(reference.name, reference.version)
            except repository.UnknownLibraryError:
                text = "the library is not installed: what it declares is unknown until it is"
                place = project.path_of(item.id)
                report.add("kept", place, text, name=reference.name, object_id=item.id)
