"""Arguments of commands that talk to a runtime: its address and the access token."""

from __future__ import annotations

import os
from pathlib import Path

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError

TOKEN_VARIABLE = "TAPPET_RUNTIME_TOKEN"  # noqa: S105 - the name of the variable, not its value


def runtime_arguments(parser: ArgumentParser) -> None:
    """`--runtime` and `--token-file`."""
    parser.add_argument(
        "--runtime", metavar="URL", required=True, help="address of the runtime, such as ws://127.0.0.1:11740"
    )
    parser.path_option(
        "--token-file",
        metavar="FILE",
        help=f"file with the access token (else the variable {TOKEN_VARIABLE})",
    )


def runtime_token(token_file: Path | None) -> str:
    """The token. Raises UsageError."""
    if token_file is not None:
        try:
            return token_file.read_text(encoding="utf-8").strip()
        except OSError as error:
            raise UsageError(f"--token-file: {token_file}: {error.strerror or error}") from error
    token = os.environ.get(TOKEN_VARIABLE)
    if not token:
        raise UsageError(f"the runtime asks for a token: give --token-file, or set {TOKEN_VARIABLE}")
    return token
