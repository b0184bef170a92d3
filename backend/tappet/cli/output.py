"""How commands speak: text for people, JSON for machines, errors on the error stream."""

from __future__ import annotations

import json
from enum import StrEnum
from typing import Annotated, Any

import typer


class OutputFormat(StrEnum):
    """What `--format` takes."""

    TEXT = "text"
    JSON = "json"


FormatOption = Annotated[OutputFormat, typer.Option("--format", help="text for people, json for machines")]


class UsageError(Exception):
    """The call is wrong; the message says what would be right. Exit code 2."""


def complain(message: str) -> None:
    """Writes an error for people."""
    typer.echo(f"tappet: {message}", err=True)


def show_json(value: Any) -> None:
    """Writes one JSON document."""
    typer.echo(json.dumps(value, indent=2, ensure_ascii=False))
