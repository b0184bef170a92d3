"""`tappet deploy`: build, download, start."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path
from typing import Annotated

import typer

from tappet.cli.inputs import one_application
from tappet.cli.output import FormatOption, OutputFormat, UsageError, show_json
from tappet.codegen.build import build_application
from tappet.codegen.check import format_diagnostic
from tappet.codegen.package import CodePackage
from tappet.runtime.client import RuntimeClient, RuntimeRefused

TOKEN_VARIABLE = "TAPPET_RUNTIME_TOKEN"  # noqa: S105 - the name of the variable, not its value


def deploy(
    path: Annotated[Path, typer.Argument(metavar="PATH", help="project folder or .st file")],
    runtime: Annotated[
        str, typer.Option(metavar="URL", help="address of the runtime, such as ws://127.0.0.1:11740")
    ],
    token_file: Annotated[
        Path | None, typer.Option(help=f"file with the access token (else the variable {TOKEN_VARIABLE})")
    ] = None,
    application: Annotated[str | None, typer.Option(help="which application of the project")] = None,
    start: Annotated[bool, typer.Option(help="start it after the download")] = True,
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Build an application, download it to a runtime and start it."""
    token = _token(token_file)
    chosen = one_application([path], application)
    result = build_application(chosen.sources, chosen.tasks, chosen.options)
    if result.package is None:
        if output is OutputFormat.JSON:
            show_json(
                {"ok": False, "diagnostics": [diagnostic.record() for diagnostic in result.diagnostics]}
            )
        for diagnostic in result.diagnostics if output is OutputFormat.TEXT else []:
            typer.echo(format_diagnostic(diagnostic), err=True)
        raise typer.Exit(1)
    try:
        state = asyncio.run(_deploy(runtime, token, result.package, start))
    except (OSError, RuntimeRefused) as error:
        raise UsageError(f"{runtime}: {error}") from error
    if output is OutputFormat.JSON:
        show_json({"ok": True, "application": chosen.name, "code_id": result.package.code_id, "state": state})
    else:
        typer.echo(f"{chosen.name} on {runtime}: {state}")


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
    async with await RuntimeClient.connect(url, token) as client:
        await client.download(package.to_bytes())
        if start:
            await client.start()
        return (await client.info()).state
