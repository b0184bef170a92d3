"""Files of other systems into a project: what each file is, and which importer takes it."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from tappet.project.exchange import twincat, twincat_system
from tappet.project.exchange.choosing import ImportNode, keep_chosen, name_drafts, nodes_of
from tappet.project.exchange.codesys23 import read_export
from tappet.project.exchange.codesys_native import read_native
from tappet.project.exchange.deciding import Decided
from tappet.project.exchange.decoding import PAGE_NAMES, decode_text, decode_xml, shared_pages
from tappet.project.exchange.drafts import Batch, Draft, has_members, task_configuration
from tappet.project.exchange.existing import Comparison
from tappet.project.exchange.own_folder import project_in, project_tops, read_folder
from tappet.project.exchange.placing import Place, empty_project, find_existing, place
from tappet.project.exchange.plcopen_read import read_plcopen
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.simotion import REFUSED, is_unit
from tappet.project.exchange.split_text import split_text
from tappet.project.exchange.standard_tasks import read_configurations
from tappet.project.exchange.temporary_variables import rewrite_temporaries
from tappet.project.exchange.text_tree import folders_of, is_member, owner_paths, read_member, unmarked
from tappet.project.exchange.twincat_project import read_project
from tappet.project.exchange.twincat_types import FOLDER
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.model import Project

_TEXT_ENDINGS = (".st", ".exp", ".txt", ".iecst", ".lib")
ENDINGS = (".xml", ".export", *_TEXT_ENDINGS, ".plcproj", *twincat.ENDINGS, *twincat_system.ENDINGS)
"""Endings of the files that are read, in lower case."""
TAKEN = (*ENDINGS, *twincat.NOT_READ)
"""Endings of what an import takes of a folder: what is read, and what the report says a word about."""

ARCHIVES = (".zip", ".tpzip", ".tnzip", ".tszip")
"""Endings of archives of such files, in lower case; TwinCAT has its own for them."""

_HINTS = {
    ".project": "export the project in CODESYS (Project > Export, or Export PLCopenXML)",
    ".library": "open the library in CODESYS as a project and export it",
    ".compiled-library": "the library holds no texts; export its sources in CODESYS",
    ".pro": "export the project in CoDeSys 2.3 (Project > Export)",
    ".lib": "open the library in CoDeSys 2.3 and export it (Project > Export)",
}
"""What to do with files that only the system itself can read."""

_NATIVE = re.compile(r"<ExportFile[\s>]")
_MARKED = re.compile(r"\(\*\s*@(?:NESTEDCOMMENTS|PATH|OBJECTFLAGS|END_DECLARATION|GLOBAL_VARIABLE_LIST)\s*:=")


@dataclass(frozen=True, slots=True)
class Imported:
    """A project with what was imported in it, and what is to say about that."""

    project: Project
    report: ImportReport
    nodes: list[ImportNode]
    """All that the files hold, chosen or not."""
    comparison: Comparison | None = None
    """Of the object that was asked for."""
    unknown_pasts: frozenset[str] = frozenset()
    """Objects whose states in the past would have told what both sides were made from."""


def is_importable(path: str) -> bool:
    """Whether a file is of a kind that is read, by its name."""
    return path.lower().endswith(TAKEN)


def importable(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Those files of an archive that are read, and all files of the projects of our own in it."""
    tops = tuple(project_tops(files))
    return {path: content for path, content in files.items() if is_importable(path) or path.startswith(tops)}


def import_files(
    files: Mapping[str, bytes],
    into: Project | None = None,
    *,
    where: Place | None = None,
    chosen: Collection[str] | None = None,
    name: str = "",
    decided: Decided | None = None,
    preview: bool = False,
) -> Imported:
    """Import files, given by path (`/` between the parts), into a project or into a new one.

    A file that cannot be read does not hinder the others: the report says why. `where` is the place in the
    project; `chosen` are the keys of the objects that are wanted (None: all), as the tree of an earlier call
    has them; `decided` says what becomes of those whose names exist in the project, which `preview` looks
    for. Raises ExchangeError when nothing could be read, with the reason of the first file.
    """
    report = ImportReport()
    batch = Batch()
    failures = _read_all(files, batch, report)
    if batch.empty:
        _raise_reason(failures, report)
    rewrite_temporaries(batch, report)
    name_drafts(batch)
    decided = decided or Decided()
    existing, comparison = find_existing(batch, into, where, decided) if into and preview else ({}, None)
    nodes = nodes_of(batch, existing)
    if chosen is not None:
        keep_chosen(batch, chosen)
    tops = project_tops(files)
    whole = chosen is None and into is None and len(tops) == 1 and all(p.startswith(tops[0]) for p in files)
    if into is None:
        stem = posixpath.basename(next(iter(sorted(files)), "Import")).rsplit(".", 1)[0]
        into = empty_project(name or batch.name or stem, batch.description)
    placed = place(batch, into, report, where, decided)
    if whole:  # our own archive as a new project: with its further files, too
        placed = replace(placed, extra_files=project_in(tops[0], files).extra_files)
    return Imported(placed, report, nodes, comparison, frozenset(decided.missing))


def read_as_project(files: Mapping[str, bytes], name: str = "") -> Imported:
    """Files as a project to compare with: one of our own as it is, with the ids of its objects, others
    imported. Raises ExchangeError as `import_files`."""
    tops = project_tops(files)
    if len(tops) == 1 and all(path.startswith(tops[0]) for path in files):
        return Imported(project_in(tops[0], files), ImportReport(), [])
    return import_files(files, name=name)


def _raise_reason(failures: list[ExchangeError], report: ImportReport) -> None:
    """Say why nothing could be read, where there is a reason."""
    if failures:
        raise failures[0]
    for entry in report.entries:
        if entry.outcome == "refused":
            named = f"{entry.object}: {entry.text}" if entry.object else entry.text
            raise ExchangeError(entry.source, named, entry.line)


def _read_all(files: Mapping[str, bytes], batch: Batch, report: ImportReport) -> list[ExchangeError]:
    """Read every file; the faults of those that cannot be read at all."""
    projects = sorted(path for path in files if path.lower().endswith(".plcproj"))
    used: set[str] = set()
    failures: list[ExchangeError] = []
    for top in project_tops(files):
        used |= {path for path in files if path.startswith(top)}
        try:
            read_folder(top, files, batch)
        except ExchangeError as error:
            _failed(error.source, error, report, failures)
    rest = {path: content for path, content in files.items() if path not in used}
    systems = twincat_system.read_systems(rest, report)
    used |= systems.used
    for failure in systems.failures:
        _failed(failure.source, failure, report, failures)
    if len(systems.names) == 1:
        batch.name = batch.name or systems.names[0]
    own_device = len(systems.tasks or projects) > 1
    for path in projects:
        if path in used:
            continue
        if systems.tasks and path not in systems.tasks:
            report.add("refused", path, "no system project (.tsproj) lists this PLC project")
            used.add(path)
            continue
        tasks = systems.tasks.get(path, {})
        try:
            used |= read_project(path, files, batch, report, own_device=own_device, tasks=tasks)
        except ExchangeError as error:
            _failed(path, error, report, failures)
            used.add(path)
    _add_types(systems.types, batch, own_device)
    rest = {path: content for path, content in files.items() if path not in used}
    pages = shared_pages(rest[path] for path in sorted(rest) if path.lower().endswith(_TEXT_ENDINGS))
    owners = owner_paths(rest)
    folders = folders_of([path for path in rest if path.lower().endswith(".st")])
    for path in sorted(rest, key=lambda path: (path in owners, path)):  # members behind their blocks
        if projects and path.lower().endswith(twincat.ENDINGS):
            report.add("refused", path, "no .plcproj lists this file, so it is not part of the project")
            continue
        try:
            _read(path, rest[path], pages, batch, report, folders.get(path, ()), owners.get(path))
        except ExchangeError as error:
            _failed(path, error, report, failures)
    return failures


def _add_types(types: list[Draft], batch: Batch, own_device: bool) -> None:
    """The data types of a system go where all its PLC projects see them; those that a project has stay."""
    waiting = [batch.loose, *batch.devices]
    known = set()
    while waiting:
        draft = waiting.pop()
        waiting += draft.children
        if draft.kind == "dut":
            known.add(draft.name.casefold())
    added = [draft for draft in types if draft.name.casefold() not in known]
    if added:
        place = batch.pous if own_device else batch.loose
        place.folder(FOLDER, added[0].source).children += added


def _owner(path: str | None, folder: tuple[str, ...], batch: Batch) -> Draft | None:
    """The block or interface of a file that has the name of the file."""
    if path is None:
        return None
    name = posixpath.splitext(posixpath.basename(path))[0].casefold()
    for draft in batch.loose.below(folder).children:
        if draft.source == path and draft.name.casefold() == name and has_members(draft.kind):
            return draft
    return None


def _failed(path: str, error: ExchangeError, report: ImportReport, failures: list[ExchangeError]) -> None:
    failures.append(error)
    report.add("refused", path, str(error).partition(": ")[2], line=error.line)


def _read(
    path: str,
    content: bytes,
    pages: tuple[str, ...],
    batch: Batch,
    report: ImportReport,
    folder: tuple[str, ...],
    owner_path: str | None,
) -> None:
    """Read one file by its ending; XML by its root. `pages` are the code pages that texts are likely in.

    Objects of texts go into `folder`. `owner_path`: the file of the block, for one named after a member.
    """
    ending = posixpath.splitext(path)[1].lower()
    if ending in twincat.ENDINGS:
        for draft in twincat.read_object(path, content, report):
            parent = task_configuration(batch.loose) if draft.kind == "task" else batch.loose
            parent.children.append(draft)
    elif ending == ".export" or _NATIVE.search(decode_xml(path, content[:400])):
        read_native(path, content, batch, report)
    elif ending == ".xml" or decode_xml(path, content[:400]).lstrip("\ufeff \t\r\n").startswith("<?xml"):
        read_plcopen(path, content, batch, report)
    elif ending in _TEXT_ENDINGS and not (ending in _HINTS and b"\0" in content):
        text, encoding = decode_text(path, content, pages)
        if encoding in PAGE_NAMES:
            report.add("changed", path, f"the file is not UTF-8; it was read as {PAGE_NAMES[encoding]}")
        if is_unit(text):
            raise ExchangeError(path, REFUSED)
        owner = _owner(owner_path, folder, batch)
        if ending == ".exp" or _MARKED.search(text):
            read_export(path, text, batch, report)
        elif owner is not None and is_member(text):
            read_member(path, text, owner, report)
        else:
            stem = posixpath.basename(path).rsplit(".", 1)[0]
            parted = unmarked(text)
            ends, marked = parted.declaration_ends, parted.marked
            split = split_text(
                path, parted.text, report, list_name=stem, declaration_ends=ends, open_ended=marked
            )
            drafts = split.drafts()
            for draft in drafts:
                mark_without_result(draft, report)
            if drafts:
                batch.loose.below(folder, path).children += drafts
            read_configurations(split, batch.loose, report)
    elif ending in twincat.NOT_READ:
        raise ExchangeError(path, f"{twincat.NOT_READ[ending]} are not read")
    else:
        hint = _HINTS.get(ending, f"possible are {', '.join(ENDINGS)}")
        raise ExchangeError(path, f"files of this kind are not read; {hint}")
