"""`tappet dap`: the debug adapter for editors that start it themselves."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.runtime_access import runtime_token

if TYPE_CHECKING:
    from tappet.codegen.package import CodePackage
    from tappet.server.dap.debuggee import Debuggee
    from tappet.server.dap.messages import Attach, Launch
    from tappet.server.dap.program_files import ProgramFiles

    Built = tuple[CodePackage, ProgramFiles, Callable[[], bytes]]
    """The package, the files that it shows, and what compiles the instrumented variant."""

Say = Callable[[str], Awaitable[None]]


def dap_arguments(parser: ArgumentParser) -> None:
    """How to talk."""
    parser.add_argument("--stdio", action="store_true", help="talk on standard input and output (always)")


def dap(_given: Namespace) -> int:
    """Serves until the editor ends it."""
    from tappet.server.dap.stdio import main

    return main(_begin)


async def _begin(wanted: Launch | Attach, say: Say) -> Debuggee:
    """Build what the editor asks for, and load it, or find it loaded."""
    import asyncio

    from tappet.server.dap.connecting import attach, launch
    from tappet.server.dap.debuggee import Refused
    from tappet.server.dap.messages import Attach

    if isinstance(wanted, Attach) and not (wanted.program and wanted.runtime):
        raise Refused(
            "attach needs 'program', the folder, and 'runtime', its address such as ws://127.0.0.1:11740"
        )
    try:
        built = await asyncio.to_thread(_build, Path(wanted.program), wanted.application)
        if isinstance(built, list):
            for line in built:
                await say(line)
            raise Refused(f"{wanted.program} has errors: see the debug console")
        package, files, variant = built

        async def make_variant() -> bytes:
            return await asyncio.to_thread(variant)

        if isinstance(wanted, Attach):
            token = runtime_token(Path(wanted.token_file) if wanted.token_file else None)
            return await attach(wanted.runtime, token, package, make_variant, files, download=wanted.download)
        return await launch(package, make_variant, files)
    except UsageError as error:
        raise Refused(str(error)) from error


def _build(path: Path, application: str | None) -> Built | list[str]:
    """The messages where there are errors."""
    from tappet.cli.inputs import load_project, one_application
    from tappet.codegen.build import BuildSession, build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.codegen.debug_build import instrument
    from tappet.project.folder.part_files import part_files
    from tappet.project.project_file import is_project
    from tappet.server.dap.program_files import ProgramFiles
    from tappet.user_cache import cache_folder

    chosen = one_application([path], application)
    if not chosen.tasks:
        raise UsageError(f"{path} has nothing to run: no task and no PROGRAM")
    session, options = BuildSession(), replace(chosen.options, cache=cache_folder("objects"), once=False)
    result = build_application(chosen.sources, chosen.tasks, options, session=session)
    if result.package is None:
        return [format_diagnostic(diagnostic) for diagnostic in result.diagnostics]

    def variant() -> bytes:
        assert session.generated is not None
        return instrument(session.generated, session.cache(options.cache)).to_bytes()

    if is_project(path):
        return result.package, ProgramFiles(part_files(load_project(path), path.resolve())), variant
    return result.package, ProgramFiles(texts=[source.uri for source in chosen.sources]), variant
