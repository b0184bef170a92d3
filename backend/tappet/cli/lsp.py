"""`tappet lsp`: the language server for editors that start it themselves."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError


def lsp_arguments(parser: ArgumentParser) -> None:
    """Which folder; how to talk."""
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path(), help="folder of .st files, or a project folder"
    )
    parser.add_argument("--stdio", action="store_true", help="talk on standard input and output (always)")


def lsp(given: Namespace) -> int:
    """Serves until the editor ends it."""
    from tappet.server.lsp.stdio import main

    if not given.folder.is_dir():
        raise UsageError(f"{given.folder} is no folder")
    return main(given.folder)
