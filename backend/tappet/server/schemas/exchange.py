"""Imports of files of other systems."""

from __future__ import annotations

from tappet.project.exchange import ImportReport
from tappet.server.schemas.base import Reply
from tappet.server.schemas.projects import ProjectSummary


class ImportResult(Reply):
    """The project that was made or changed, and what the import has to say."""

    project: ProjectSummary
    report: ImportReport
