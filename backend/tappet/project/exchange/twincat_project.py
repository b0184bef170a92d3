"""TwinCAT 3: `.plcproj`, the list of the files, folders and libraries of a PLC project."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from urllib.parse import unquote

from tappet.project.exchange.drafts import (
    Batch,
    Draft,
    exclude,
    library_manager,
    plc_logic,
    task_configuration,
)
from tappet.project.exchange.libraries import reference, take_access, take_parameters
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.twincat import ENDINGS, NOT_READ, read_object
from tappet.project.exchange.twincat_system import SystemTask, adjust_task
from tappet.project.exchange.xml_tree import Element, read_xml

_RESOLUTION = re.compile(r"\s*(?P<name>[^,]+?)\s*(?:,\s*(?P<version>[^,(]+?)\s*)?(?:[,(].*)?$", re.DOTALL)


def read_project(
    source: str,
    files: Mapping[str, bytes],
    batch: Batch,
    report: ImportReport,
    *,
    own_device: bool,
    tasks: Mapping[str, SystemTask],
) -> set[str]:
    """Take a project in, with those of its files that are in `files`; the paths of these.

    `own_device`: it becomes a device of its own, not part of the application that is imported into.
    `tasks`: those of the system project it is in, by folded name.
    """
    root = read_xml(source, files[source])
    if root.tag != "Project":
        raise ExchangeError(source, "is no PLC project: its root is not <Project>", root.line)
    name = _property(root, "Title") or _property(root, "Name") or posixpath.basename(source).rsplit(".", 1)[0]
    batch.name = batch.name or name
    batch.description = batch.description or _property(root, "Description")
    application = batch.loose
    if own_device:
        device = Draft("device", name, source=source)
        application = Draft("application", name, source=source)
        plc_logic(device).children.append(application)
        batch.devices.append(device)
    by_key = {path.casefold(): path for path in files}
    used = {source}
    left_out = {_key(_include(item)) for item in root.walk() if item.tag == "Folder" and _is_excluded(item)}
    for item in root.walk():
        include = _include(item)
        if item.tag == "Folder" and include:
            application.below(_folders(include), source)
        elif item.tag in ("Compile", "None", "Content", "EmbeddedResource") and include:
            link = item.child("Link")
            path = by_key.get(
                posixpath.normpath(posixpath.join(posixpath.dirname(source), include)).casefold()
            )
            if not include.casefold().endswith(ENDINGS):
                if item.tag == "Compile":
                    what = NOT_READ.get(posixpath.splitext(include)[1].casefold(), "files of this kind")
                    report.add("refused", source, f"{what} are not read", name=include, line=item.line)
                    used |= {path} if path is not None else set()
                continue
            if path is None:
                text = "the project lists this file, but it was not given with it"
                report.add("refused", source, text, name=include, line=item.line)
                continue
            used.add(path)
            place = link.text().replace("\\", "/") if link is not None else include
            folders = _folders(posixpath.dirname(place))
            drafts = _read(path, files[path], report)
            if _is_excluded(item) or any(
                _key("/".join(folders[:n])) in left_out for n in range(1, len(folders) + 1)
            ):
                for draft in drafts:
                    exclude(draft)
            _add(application, folders, path, drafts, tasks, report)
        elif item.tag in ("PlaceholderReference", "LibraryReference") and include:
            _library(source, item, include, application, report)
    return used


def _read(path: str, content: bytes, report: ImportReport) -> list[Draft]:
    try:
        return read_object(path, content, report)
    except ExchangeError as error:
        report.add("refused", error.source, str(error).partition(": ")[2], line=error.line)
        return []


def _add(
    application: Draft,
    folders: tuple[str, ...],
    path: str,
    drafts: list[Draft],
    tasks: Mapping[str, SystemTask],
    report: ImportReport,
) -> None:
    for draft in drafts:
        parent = task_configuration(application) if draft.kind == "task" else application.below(folders, path)
        task = tasks.get(draft.name.casefold()) if draft.kind == "task" else None
        if task is None or adjust_task(draft, task, report):
            parent.children.append(draft)


def _library(source: str, item: Element, include: str, application: Draft, report: ImportReport) -> None:
    resolution = item.child("DefaultResolution")
    text = resolution.text() if resolution is not None else include
    match = _RESOLUTION.match(text)
    namespace = item.child("Namespace")
    made = reference(
        source,
        match["name"] if match else include,
        (match["version"] or "*") if match else "*",
        namespace.text().strip() if namespace is not None else "",
        report,
        item.line,
    )
    made = take_parameters(source, made, item, report)
    access = item.child("QualifiedOnly")
    made = take_access(made, access.text() if access is not None else "")
    library_manager(application).data.setdefault("references", []).append(made)


def _include(item: Element) -> str:
    return unquote(item.get("Include")).replace("\\", "/")


def _is_excluded(item: Element) -> bool:
    """Whether a file or a folder with all that is in it is left out of the build."""
    mark = item.child("ExcludeFromBuild")
    return mark is not None and mark.text().strip().casefold() == "true"


def _key(path: str) -> str:
    return "/".join(_folders(path)).casefold()


def _folders(path: str) -> tuple[str, ...]:
    return tuple(part for part in path.split("/") if part not in ("", ".", ".."))


def _property(root: Element, tag: str) -> str:
    for group in root.children("PropertyGroup"):
        child = group.child(tag)
        if child is not None and child.text().strip():
            return child.text().strip()
    return ""
