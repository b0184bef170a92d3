"""`tappet lsp`: the language server for editors that start it themselves."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from tappet.cli.output import UsageError


def lsp(
    folder: Annotated[Path, typer.Argument(help="Folder of .st files, or a project folder.")] = Path(),
    stdio: Annotated[
        bool, typer.Option("--stdio", help="Talk on standard input and output (always).")
    ] = True,
) -> None:
    """Language Server Protocol on standard input and output, for VS Code and other editors."""
    from tappet.server.lsp.stdio import main

    if not folder.is_dir():
        raise UsageError(f"{folder} is no folder")
    raise typer.Exit(main(folder))
