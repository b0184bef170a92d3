"""`tappet library`: what the installed libraries offer; save, install and remove libraries."""

from __future__ import annotations

import sys
from argparse import Namespace
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path

from tappet import libraries
from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.output import counted, show_json
from tappet.libraries import archive
from tappet.libraries.archive import LibraryFileError
from tappet.libraries.catalog import Item, Pin, items
from tappet.libraries.library import Library
from tappet.whole_file import write_output


def list_libraries_arguments(parser: ArgumentParser) -> None:
    """For whom."""
    parser.format_option()


def list_libraries(given: Namespace) -> int:
    """Shows the libraries."""
    found = libraries.every_version()
    if given.format == "json":
        keys = ("name", "version", "namespace", "qualified_only", "company", "description")
        show_json(
            [
                {key: getattr(library, key) for key in keys}
                | {"requires": [asdict(required) for required in library.requires]}
                for library in found
            ]
        )
        return 0
    for library in found:
        print(f"{library.name:16} {library.version:10} {library.description}")
    return 0


def show_arguments(parser: ArgumentParser) -> None:
    """Which library or item."""
    parser.add_argument(
        "name", metavar="NAME", help="a library such as Util or 'Util, 3.5.0.0', or one POU or type of any"
    )
    parser.format_option()


def show(given: Namespace) -> int:
    """Shows the items."""
    chosen = _find(given.name)
    if given.format == "json":
        show_json([asdict(item) for item in chosen])
        return 0
    with suppress(libraries.UnknownLibraryError):
        print(_head(libraries.load(given.name)))
    for item in chosen:
        print(_text(item))
    return 0


def save_arguments(parser: ArgumentParser) -> None:
    """Which project, and how the library is called."""
    parser.add_argument("path", type=Path, metavar="PATH", help="project folder")
    parser.path_option("--to", metavar=f"FILE{archive.SUFFIX}", help="library file to write", required=True)
    parser.add_argument("--version", required=True, help="such as 1.2.0.0")
    parser.add_argument("--name", help="name of the library; that of the project")
    parser.add_argument("--namespace", default="", help="prefix of its names; the name")
    parser.add_argument("--qualified-only", action="store_true", help="its names need the prefix in any case")
    parser.add_argument("--company", default="", help="who makes it")
    parser.add_argument("--description", help="what it is for; that of the project")


def save(given: Namespace) -> int:
    """Checks the project and writes the library."""
    from tappet.cli.inputs import load_project
    from tappet.codegen.build import BuildOptions
    from tappet.codegen.check import check_application, format_diagnostic
    from tappet.lang.source import Source
    from tappet.project.errors import ProjectError
    from tappet.project.library_texts import library_requirements, library_texts, requirements

    project = load_project(given.path)
    try:
        texts = library_texts(project)
        needed = library_requirements(project)
        facts = archive.manifest(
            given.name or project.name,
            given.version,
            namespace=given.namespace,
            company=given.company,
            description=project.description if given.description is None else given.description,
            requires=requirements(needed),
            qualified_only=given.qualified_only,
        )
    except (ProjectError, LibraryFileError) as error:
        raise UsageError(str(error)) from error
    sources = [Source(f"{stem}.st", text, name=stem) for stem, text in texts.items()]
    errors = [
        diagnostic
        for diagnostic in check_application(sources, (), BuildOptions(facts["name"], libraries=tuple(needed)))
        if diagnostic.severity == "error"
    ]
    for diagnostic in errors:
        print(format_diagnostic(diagnostic), file=sys.stderr)
    if errors:
        return 1
    write_output(given.to, archive.pack(facts, texts))
    print(f"{facts['name']} {given.version}: {counted(len(texts), 'object')} in {given.to}")
    return 0


def install_arguments(parser: ArgumentParser) -> None:
    """Which library."""
    help_ = f"{archive.SUFFIX} file, or a folder with {archive.MANIFEST}"
    parser.add_argument("path", type=Path, metavar="PATH", help=help_)


def install(given: Namespace) -> int:
    """Installs it."""
    try:
        found = archive.install(*archive.read(given.path))
    except LibraryFileError as error:
        raise UsageError(str(error)) from error
    print(f"{found.name} {found.version} is installed in {found.folder}")
    return 0


def remove_arguments(parser: ArgumentParser) -> None:
    """Which library in which version."""
    parser.add_argument("name", metavar="NAME")
    parser.add_argument("version", metavar="VERSION")


def remove(given: Namespace) -> int:
    """Removes it."""
    try:
        archive.remove(given.name, given.version)
    except (libraries.UnknownLibraryError, LibraryFileError) as error:
        raise UsageError(str(error)) from error
    print(f"{given.name} {given.version} is removed")
    return 0


def _find(name: str) -> list[Item]:
    with suppress(libraries.UnknownLibraryError):
        return items(libraries.load(name))
    everything = [item for known in libraries.names() for item in items(libraries.load(known))]
    found = [item for item in everything if item.name.casefold() == name.casefold()]
    if not found:
        raise UsageError(f"no library, POU or type '{name}'; libraries are {', '.join(libraries.names())}")
    return found


def _head(library: Library) -> str:
    access = ", qualified access only" if library.qualified_only else ""
    return f"LIBRARY {library.name} {library.version}, namespace {library.namespace}{access}\n"


def _text(item: Item) -> str:
    returns = f" : {item.returns}" if item.returns else ""
    lines = [f"{item.kind.upper()} {item.name}{returns}"]
    lines += [f"    {line.strip()}" for line in item.summary.splitlines()]
    for section, pins in (
        ("VAR_INPUT", item.inputs),
        ("VAR_OUTPUT", item.outputs),
        ("VAR_IN_OUT", item.in_out),
        ("VAR_GLOBAL CONSTANT" if item.kind == "parameter_list" else "STRUCT", item.members),
    ):
        lines += _section(section, pins)
    for value in item.values:
        number = f" := {value.value}" if value.value else ""
        lines.append(f"    {value.name}{number}  {value.comment}".rstrip())
    return "\n".join([*lines, ""])


def _section(title: str, pins: tuple[Pin, ...]) -> list[str]:
    if not pins:
        return []
    width = max(len(pin.name) for pin in pins)
    lines = [f"  {title}"]
    for pin in pins:
        default = f" := {pin.default}" if pin.default else ""
        lines.append(f"    {pin.name:{width}} : {pin.type}{default}  {pin.comment}".rstrip())
    return lines
