"""`tappet deploy`: build, download, start."""

from __future__ import annotations

import argparse
import os
import sys
from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.output import show_json

if TYPE_CHECKING:
    from tappet.codegen.package import CodePackage

TOKEN_VARIABLE = "TAPPET_RUNTIME_TOKEN"  # noqa: S105 - the name of the variable, not its value


def deploy_arguments(parser: ArgumentParser) -> None:
    """What to build, and which runtime gets it."""
    parser.add_argument("path", type=Path, metavar="PATH", help="project folder or .st file")
    parser.add_argument(
        "--runtime", metavar="URL", required=True, help="address of the runtime, such as ws://127.0.0.1:11740"
    )
    parser.path_option(
        "--token-file",
        metavar="FILE",
        help=f"file with the access token (else the variable {TOKEN_VARIABLE})",
    )
    parser.application_option("which application of the project")
    parser.add_argument(
        "--start", action=argparse.BooleanOptionalAction, default=True, help="start it after the download"
    )
    parser.format_option()


def deploy(given: Namespace) -> int:
    """Builds, downloads and starts."""
    import asyncio

    from tappet.cli.inputs import one_application
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.runtime.client import RuntimeRefused
    from tappet.user_cache import cache_folder

    token = _token(given.token_file)
    chosen = one_application([given.path], given.application)
    result = build_application(
        chosen.sources, chosen.tasks, replace(chosen.options, cache=cache_folder("objects"))
    )
    if result.package is None:
        if given.format == "json":
            show_json(
                {"ok": False, "diagnostics": [diagnostic.record() for diagnostic in result.diagnostics]}
            )
        else:
            for diagnostic in result.diagnostics:
                print(format_diagnostic(diagnostic), file=sys.stderr)
        return 1
    try:
        state = asyncio.run(_deploy(given.runtime, token, result.package, given.start))
    except (OSError, RuntimeRefused) as error:
        raise UsageError(f"{given.runtime}: {error}") from error
    if given.format == "json":
        show_json({"ok": True, "application": chosen.name, "code_id": result.package.code_id, "state": state})
    else:
        print(f"{chosen.name} on {given.runtime}: {state}")
    return 0


def _token(token_file: Path | None) -> str:
    if token_file is not None:
        try:
            return token_file.read_text(encoding="utf-8").strip()
        except OSError as error:
            raise UsageError(f"--token-file: {token_file}: {error.strerror or error}") from error
    token = os.environ.get(TOKEN_VARIABLE)
    if not token:
        raise UsageError(f"the runtime asks for a token: give --token-file, or set {TOKEN_VARIABLE}")
    return token


async def _deploy(url: str, token: str, package: CodePackage, start: bool) -> str:
    from tappet.runtime.client import RuntimeClient
    from tappet.runtime.operations.life_cycle import GetInfo, Start

    async with await RuntimeClient.connect(url, token) as client:
        await client.download(package.to_bytes())
        if start:
            await client.call(Start())
        return (await client.call(GetInfo())).state
