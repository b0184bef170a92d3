"""`tappet import` and `tappet export`: project archives, and the files of other systems."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.cli.output import counted, show_json
from tappet.libraries.missing import report_missing
from tappet.project import folder
from tappet.project.errors import ProjectError
from tappet.project.exchange.deciding import Decided
from tappet.project.exchange.existing import Decisions
from tappet.project.exchange.importing import ARCHIVES, import_files, importable, is_importable
from tappet.project.exchange.plcopen_write import write_plcopen
from tappet.project.exchange.report import ImportReport
from tappet.project.folder.archive import unpack
from tappet.project.model import Project
from tappet.project.project_file import is_project
from tappet.whole_file import write_output


def import_project_arguments(parser: ArgumentParser) -> None:
    """What to read, where to put it."""
    parser.add_argument(
        "files",
        type=Path,
        nargs="+",
        metavar="FILE",
        help="PLCopen XML, CODESYS .export, TwinCAT .sln, .tsproj, .plcproj or single .Tc* files, "
        "CoDeSys .EXP, .st, folders of these, or the archive of a project",
    )
    parser.path_option(
        "--to", metavar="DIR", help="new folder, or project folder to import into", required=True
    )
    parser.add_argument(
        "--existing",
        choices=("rename", "overwrite", "merge", "skip"),
        default="rename",
        help="what becomes of objects whose names exist in the project: they come in under counted names, "
        "take their place, are joined with them, or stay out (default: rename)",
    )
    parser.format_option()


def import_project(given: Namespace) -> int:
    """Imports and shows the report."""
    files, to = given.files, given.to
    for path in files:
        if not path.exists():
            raise UsageError(f"{path} does not exist")
    existing = is_project(to)
    if to.exists() and (not to.is_dir() or (any(to.iterdir()) and not existing)):
        raise UsageError(f"{to} is not empty; import into a new folder or into a project folder")
    try:
        into = load_project(to) if existing else None
        name = "" if existing else _name(files)
        decided = Decided(Decisions(all=given.existing))
        imported = import_files(files_to_import(files), into, name=name, decided=decided)
        project, report = imported.project, imported.report
        folder.save(project, to)
    except ProjectError as error:
        raise UsageError(str(error)) from error
    report_missing(project, report)
    _show(project, report, to, given.format)
    return 0


def _name(files: list[Path]) -> str:
    """The name of a project of several files: that of their folder; of one file says the file."""
    if len(files) == 1:
        return files[0].resolve().name if files[0].is_dir() else ""
    return files[0].resolve().parent.name


def files_to_import(paths: list[Path]) -> dict[str, bytes]:
    """The files to import by path; those beside a TwinCAT project belong to it, archives are unpacked.

    A file that is named by itself and lies in a folder or project of `paths` is read once.
    """
    found: dict[str, bytes] = {}
    folders: list[Path] = []
    single: list[Path] = []
    for path in paths:
        if path.suffix.lower() in ARCHIVES:
            found |= importable(unpack(path.read_bytes()))
        elif path.is_dir():
            found |= _below(path, path)
            folders.append(path.resolve())
        elif path.suffix.lower() in _PROJECTS:
            found |= _below(path.parent, path.parent, project=path)
            folders.append(path.resolve().parent)
        else:
            single.append(path)
    for path in single:
        if not any(path.resolve().is_relative_to(folder) for folder in folders):
            found[path.name if path.name not in found else str(path)] = path.read_bytes()
    return found


_TEXTS = (".xml", ".st", ".txt", ".exp")
_PROJECTS = {
    ".plcproj": (".plcproj", ".tsproj", ".tspproj", ".sln", *_TEXTS),
    ".tsproj": (".tsproj", ".tspproj", ".sln", *_TEXTS),
    ".tspproj": (".tsproj", ".tspproj", ".sln", *_TEXTS),
    ".sln": (".sln", *_TEXTS),
}
"""Files that say what else belongs to them, and endings of the files beside them that do not."""


def _below(top: Path, base: Path, project: Path | None = None) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    others = _PROJECTS[project.suffix.lower()] if project is not None else ()
    for path in sorted(top.rglob("*")):
        name = path.relative_to(base).as_posix()
        hidden = any(part.startswith(".") for part in Path(name).parts)
        other = path.suffix.lower() in others and path != project
        if path.is_file() and not path.is_symlink() and not hidden and not other and is_importable(path.name):
            found[name] = path.read_bytes()
    return found


def _show(project: Project, report: ImportReport, to: Path, output: str) -> None:
    if output == "json":
        show_json({"project": project.name, "objects": len(project.objects), **report.model_dump()})
        return
    for entry in report.noteworthy():
        print(str(entry))
    said = f" ({report.summary()})" if report.entries else ""
    print(f"{project.name}: {counted(len(project.objects), 'object')} in {to}{said}")


def export_project_arguments(parser: ArgumentParser) -> None:
    """What to write, where to."""
    parser.add_argument("source", type=Path, metavar="DIR", help="project folder")
    parser.path_option("--to", metavar="FILE", help="FILE.xml: PLCopen XML; FILE.zip: archive", required=True)


def export_project(given: Namespace) -> int:
    """Writes the file."""
    project, to = load_project(given.source), given.to
    if to.suffix.lower() not in (".xml", ".zip"):
        raise UsageError(f"{to}: the name should end in .xml (PLCopen XML) or .zip (archive of the folder)")
    write_output(to, write_plcopen(project) if to.suffix.lower() == ".xml" else folder.write_zip(project))
    print(f"{project.name}: {counted(len(project.objects), 'object')} in {to}")
    return 0
