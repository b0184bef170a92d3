"""`tappet compare`: what differs between two projects."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import Any

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.cli.output import show_json
from tappet.cli.projects import files_to_import
from tappet.project.compare.differences import Comparison, Difference, values_of
from tappet.project.compare.ignoring import Ignoring
from tappet.project.compare.shown import changed_lines, path_in
from tappet.project.errors import ProjectError
from tappet.project.exchange.importing import read_as_project
from tappet.project.model import Project
from tappet.project.project_file import is_project


def compare_arguments(parser: ArgumentParser) -> None:
    """What to compare, and what does not count."""
    what = "project folder, archive of a project, or a file that can be imported"
    parser.add_argument("old", type=Path, metavar="A", help=f"{what}: compared with")
    parser.add_argument("new", type=Path, metavar="B", help=f"{what}: what is only in it was added")
    parser.add_argument("--ignore-white-space", action="store_true", help="blanks and line ends in texts")
    parser.add_argument("--ignore-comments", action="store_true", help="comments in texts")
    parser.add_argument("--ignore-pragmas", action="store_true", help="pragmas in texts")
    parser.add_argument("--lines", action="store_true", help="show the lines that differ, too")
    parser.format_option()


def compare(given: Namespace) -> int:
    """Shows the differences; 1 when there are some."""
    ignoring = Ignoring(given.ignore_white_space, given.ignore_comments, given.ignore_pragmas)
    comparison = Comparison(_project(given.old), _project(given.new), ignoring)
    differences = list(comparison.differences.values())
    if given.format == "json":
        show_json({"differences": [_as_json(comparison, one) for one in differences]})
        return 1 if differences else 0
    for one in differences:
        print(f"{one.state:8}{path_in(comparison, one)}{_detail(comparison, one)}")
        if given.lines and one.state == "changed":
            for line in changed_lines(one):
                print(f"    {line}")
    states = [one.state for one in differences]
    counted = [f"{states.count(state)} {state}" for state in ("added", "removed", "changed")]
    print(", ".join(counted) if differences else "no differences")
    return 1 if differences else 0


def _project(path: Path) -> Project:
    if not path.exists():
        raise UsageError(f"{path} does not exist")
    if is_project(path):
        return load_project(path)
    try:
        return read_as_project(files_to_import([path]), path.stem).project
    except ProjectError as error:
        raise UsageError(str(error)) from error


def _detail(comparison: Comparison, one: Difference) -> str:
    """What is different in an object that is on both sides."""
    if one.old is None or one.new is None:
        return ""
    said = [f"renamed from {one.old.name}"] if one.renamed else []
    if one.moved:
        said.append(f"moved from {comparison.old.path_of(one.old.id)}")
    if one.reordered:
        said.append("in another order")
    return f": {', '.join([*said, *one.fields])}"


def _as_json(comparison: Comparison, one: Difference) -> dict[str, Any]:
    found: dict[str, Any] = {"state": one.state, "kind": one.item.kind, "path": path_in(comparison, one)}
    if one.old is None or one.new is None:
        return found
    old, new = values_of(one.old), values_of(one.new)
    return found | {
        "old_path": comparison.old.path_of(one.old.id),
        "renamed": one.renamed,
        "moved": one.moved,
        "reordered": one.reordered,
        "fields": [{"field": name, "old": old.get(name), "new": new.get(name)} for name in one.fields],
    }
