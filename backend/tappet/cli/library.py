"""`tappet library`: what the installed libraries offer; save, install and remove libraries."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from tappet import libraries
from tappet.cli.inputs import load_project
from tappet.cli.output import FormatOption, OutputFormat, UsageError, show_json
from tappet.codegen.build import BuildOptions
from tappet.codegen.check import check_application, format_diagnostic
from tappet.lang.source import Source
from tappet.libraries import archive
from tappet.libraries.archive import LibraryFileError
from tappet.libraries.catalog import Item, Pin, items
from tappet.project.errors import ProjectError
from tappet.project.library_texts import library_requirements, library_texts, requirements

app = typer.Typer(help="What the installed libraries offer.", no_args_is_help=True)


@app.command("list")
def list_libraries(output: FormatOption = OutputFormat.TEXT) -> None:
    """The installed libraries in all their versions, newest first."""
    found = libraries.every_version()
    if output is OutputFormat.JSON:
        keys = ("name", "version", "namespace", "company", "description")
        show_json(
            [
                {key: getattr(library, key) for key in keys}
                | {"requires": [asdict(required) for required in library.requires]}
                for library in found
            ]
        )
        return
    for library in found:
        typer.echo(f"{library.name:16} {library.version:10} {library.description}")


@app.command("show")
def show(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME", help="a library such as Util or 'Util, 3.5.0.0', or one POU or type of any"
        ),
    ],
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Every POU and type of a library, or a single one, with pins, types and defaults."""
    chosen = _find(name)
    if output is OutputFormat.JSON:
        show_json([asdict(item) for item in chosen])
        return
    for item in chosen:
        typer.echo(_text(item))


@app.command("save")
def save(
    path: Annotated[Path, typer.Argument(metavar="PATH", help="project folder")],
    to: Annotated[Path, typer.Option("--to", metavar=f"FILE{archive.SUFFIX}", help="library file to write")],
    version: Annotated[str, typer.Option(help="such as 1.2.0.0")],
    name: Annotated[str | None, typer.Option(help="name of the library; that of the project")] = None,
    namespace: Annotated[str, typer.Option(help="prefix of its names; the name")] = "",
    company: Annotated[str, typer.Option(help="who makes it")] = "",
    description: Annotated[str | None, typer.Option(help="what it is for; that of the project")] = None,
) -> None:
    """Make a library of a project: everything but its programs, when it compiles."""
    project = load_project(path)
    try:
        texts = library_texts(project)
        needed = library_requirements(project)
        facts = archive.manifest(
            name or project.name,
            version,
            namespace=namespace,
            company=company,
            description=project.description if description is None else description,
            requires=requirements(needed),
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
        typer.echo(format_diagnostic(diagnostic), err=True)
    if errors:
        raise typer.Exit(1)
    to.write_bytes(archive.pack(facts, texts))
    typer.echo(f"{facts['name']} {version}: {len(texts)} objects in {to}")


@app.command("install")
def install(
    path: Annotated[
        Path,
        typer.Argument(metavar="PATH", help=f"{archive.SUFFIX} file, or a folder with {archive.MANIFEST}"),
    ],
) -> None:
    """Install a library beside those that are there; the same version is replaced."""
    try:
        found = archive.install(*archive.read(path))
    except LibraryFileError as error:
        raise UsageError(str(error)) from error
    typer.echo(f"{found.name} {found.version} is installed in {found.folder}")


@app.command("remove")
def remove(
    name: Annotated[str, typer.Argument(metavar="NAME")],
    version: Annotated[str, typer.Argument(metavar="VERSION")],
) -> None:
    """Uninstall one version of a library."""
    try:
        archive.remove(name, version)
    except (libraries.UnknownLibraryError, LibraryFileError) as error:
        raise UsageError(str(error)) from error
    typer.echo(f"{name} {version} is removed")


def _find(name: str) -> list[Item]:
    with suppress(libraries.UnknownLibraryError):
        return items(libraries.load(name))
    everything = [item for known in libraries.names() for item in items(libraries.load(known))]
    found = [item for item in everything if item.name.casefold() == name.casefold()]
    if not found:
        raise UsageError(f"no library, POU or type '{name}'; libraries are {', '.join(libraries.names())}")
    return found


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
