"""`tappet import` and `tappet export`: projects as folders and as archives of folders."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from tappet.cli.inputs import load_project
from tappet.cli.output import UsageError
from tappet.project import folder
from tappet.project.errors import ProjectError


def import_project(
    archive: Annotated[Path, typer.Argument(metavar="FILE.zip", help="archive of a project folder")],
    to: Annotated[Path, typer.Option("--to", metavar="DIR", help="new folder for the project")],
) -> None:
    """Unpack a project archive into a new folder, checking every name and size in it."""
    if not archive.is_file():
        raise UsageError(f"{archive} does not exist")
    if to.exists() and any(to.iterdir()):
        raise UsageError(f"{to} is not empty; import into a new folder")
    try:
        project = folder.read_zip(archive.read_bytes())
        folder.save(project, to)
    except ProjectError as error:
        raise UsageError(f"{archive}: {error}") from error
    typer.echo(f"{project.name}: {len(project.objects)} objects in {to}")


def export_project(
    source: Annotated[Path, typer.Argument(metavar="DIR", help="project folder")],
    to: Annotated[Path, typer.Option("--to", metavar="FILE.zip", help="archive to write")],
) -> None:
    """Pack a project folder into one archive, as the workbench exports and imports it."""
    project = load_project(source)
    to.write_bytes(folder.write_zip(project))
    typer.echo(f"{project.name}: {len(project.objects)} objects in {to}")
