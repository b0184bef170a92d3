"""`tappet deploy`: build, download, start."""

from __future__ import annotations

import argparse
import getpass
import sys
from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.cli.output import show_json
from tappet.cli.runtime_access import runtime_arguments, runtime_token

if TYPE_CHECKING:
    from tappet.codegen.package import CodePackage
    from tappet.project.model import Project


def deploy_arguments(parser: ArgumentParser) -> None:
    """What to build, and which runtime gets it."""
    parser.add_argument("path", type=Path, metavar="PATH", help="project folder or .st file")
    runtime_arguments(parser)
    parser.application_option("which application of the project")
    parser.add_argument(
        "--start", action=argparse.BooleanOptionalAction, default=True, help="start it after the download"
    )
    parser.add_argument(
        "--source", action="store_true", help="store the source of the project in the runtime, too"
    )
    parser.format_option()


def deploy(given: Namespace) -> int:
    """Builds, downloads and starts."""
    import asyncio

    from tappet.cli.inputs import one_application
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.runtime.client import RuntimeRefused
    from tappet.runtime.source_transfer import SourceError
    from tappet.user_cache import cache_folder

    token = runtime_token(given.token_file)
    project = load_project(given.path) if given.source else None
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
        state = asyncio.run(_deploy(given.runtime, token, result.package, given.start, project))
    except (OSError, RuntimeRefused, SourceError) as error:
        raise UsageError(f"{given.runtime}: {error}") from error
    if given.format == "json":
        show_json({"ok": True, "application": chosen.name, "code_id": result.package.code_id, "state": state})
    else:
        print(f"{chosen.name} on {given.runtime}: {state}")
    return 0


async def _deploy(url: str, token: str, package: CodePackage, start: bool, project: Project | None) -> str:
    from tappet.project import folder
    from tappet.runtime.client import RuntimeClient
    from tappet.runtime.operations.life_cycle import GetInfo, Start

    async with await RuntimeClient.connect(url, token) as client:
        await client.download(package.to_bytes())
        if project is not None:
            await client.store_source(
                folder.write_zip(project),
                project=project.name,
                stored_by=getpass.getuser(),
                code_id=package.code_id,
            )
        if start:
            await client.call(Start())
        return (await client.call(GetInfo())).state
