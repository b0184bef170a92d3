"""`tappet library`: what the installed libraries offer."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

import typer

from tappet import libraries
from tappet.cli.output import FormatOption, OutputFormat, UsageError, show_json
from tappet.libraries.catalog import Item, Pin, items

app = typer.Typer(help="What the installed libraries offer.", no_args_is_help=True)


@app.command("list")
def list_libraries(output: FormatOption = OutputFormat.TEXT) -> None:
    """The installed libraries with their versions."""
    found = [libraries.load(name) for name in libraries.names()]
    if output is OutputFormat.JSON:
        keys = ("name", "version", "namespace", "company", "description")
        show_json([{key: getattr(library, key) for key in keys} for library in found])
        return
    for library in found:
        typer.echo(f"{library.name:16} {library.version:10} {library.description}")


@app.command("show")
def show(
    name: Annotated[str, typer.Argument(metavar="NAME", help="a library, or one POU or type of any library")],
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Every POU and type of a library, or a single one, with pins, types and defaults."""
    chosen = _find(name)
    if output is OutputFormat.JSON:
        show_json([asdict(item) for item in chosen])
        return
    for item in chosen:
        typer.echo(_text(item))


def _find(name: str) -> list[Item]:
    everything: list[Item] = []
    for library in (libraries.load(known) for known in libraries.names()):
        if library.name.casefold() == name.casefold():
            return items(library)
        everything += items(library)
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
        ("STRUCT", item.members),
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
