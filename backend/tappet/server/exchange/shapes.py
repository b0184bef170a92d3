"""Imports of files of other systems."""

from __future__ import annotations

from pydantic import Field

from tappet.project.exchange.choosing import ImportNode
from tappet.project.exchange.report import ImportReport
from tappet.server.projects.shapes import ProjectSummary
from tappet.server.shapes import Reply


class ImportFormats(Reply):
    """Which files of a folder an import takes."""

    endings: list[str] = Field(description="Of the names of files and archives, in lower case.")
    project_file: str = Field(
        description="A folder with a file of this name is a project of our own: all of it."
    )


class ImportPreview(Reply):
    """What an import would bring."""

    name: str = Field(description="Of the project it would go into.")
    nodes: list[ImportNode] = Field(description="Everything in the files, parents before their children.")
    report: ImportReport


class ImportResult(Reply):
    """The project that was made or changed, and what the import has to say."""

    project: ProjectSummary
    report: ImportReport
