"""`tappet source`: the source of a project in a controller, stored, shown and read back."""

from __future__ import annotations

import getpass
from argparse import Namespace
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.cli.output import show_json
from tappet.cli.runtime_access import runtime_arguments, runtime_token

if TYPE_CHECKING:
    from tappet.runtime.client import RuntimeClient
    from tappet.runtime.source_archive import SourceInfo

T = TypeVar("T")


def show_source_arguments(parser: ArgumentParser) -> None:
    """Which runtime."""
    runtime_arguments(parser)
    parser.format_option()


def show_source(given: Namespace) -> int:
    """Prints what is there; exit code 1 for nothing."""
    from tappet.runtime.operations.source import GetSource

    info = _with_runtime(given, lambda client: client.call(GetSource()))
    if given.format == "json":
        show_json(_record(info) if info is not None else None)
    else:
        print(f"{given.runtime}: {_told(info) if info is not None else 'there is no source'}")
    return 0 if info is not None else 1


def download_source_arguments(parser: ArgumentParser) -> None:
    """The project, and which runtime gets it."""
    parser.add_argument("path", type=Path, metavar="DIR", help="project folder")
    runtime_arguments(parser)
    parser.format_option()


def download_source(given: Namespace) -> int:
    """Stores the archive of the project."""
    from tappet.project.folder import write_zip

    project = load_project(given.path)
    archive = write_zip(project)
    # which code was built from it is known to who builds: `tappet deploy --source` says so
    by = getpass.getuser()
    info = _with_runtime(
        given, lambda client: client.store_source(archive, project=project.name, stored_by=by, code_id="")
    )
    assert info is not None, "what has just been stored is there"
    if given.format == "json":
        show_json(_record(info))
    else:
        print(f"{given.runtime}: {_told(info)}")
    return 0


def upload_source_arguments(parser: ArgumentParser) -> None:
    """The runtime, and where the project goes."""
    runtime_arguments(parser)
    parser.path_option("--to", metavar="DIR", help="new folder for the project", required=True)
    parser.format_option()


def upload_source(given: Namespace) -> int:
    """Writes the project; a folder that holds something is left alone."""
    from tappet.project import folder
    from tappet.project.errors import ProjectError
    from tappet.runtime.source_transfer import read_source

    to: Path = given.to
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        raise UsageError(f"{to} is not empty; name a new folder")
    info, archive = _with_runtime(given, read_source)
    try:
        project = folder.read_zip(archive)
        folder.save(project, to)
    except ProjectError as error:
        raise UsageError(f"{given.runtime}: the source cannot be read: {error}") from error
    if given.format == "json":
        show_json({**_record(info), "objects": len(project.objects)})
    else:
        print(f"{project.name}: {len(project.objects)} objects in {to} ({_told(info)})")
    return 0


def _with_runtime(given: Namespace, act: Callable[[RuntimeClient], Awaitable[T]]) -> T:
    """What an act answers over a connection to the runtime. Raises UsageError."""
    import asyncio

    from tappet.runtime.client import RuntimeClient, RuntimeRefused
    from tappet.runtime.source_transfer import SourceError

    async def run() -> T:
        async with await RuntimeClient.connect(given.runtime, runtime_token(given.token_file)) as client:
            return await act(client)

    try:
        return asyncio.run(run())
    except (OSError, RuntimeRefused, SourceError) as error:
        raise UsageError(f"{given.runtime}: {error}") from error


def _record(info: SourceInfo) -> dict[str, object]:
    return {name: getattr(info, name) for name in info.__dataclass_fields__}


def _told(info: SourceInfo) -> str:
    from datetime import UTC, datetime

    at = datetime.fromtimestamp(info.stored_at_ms / 1000, UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
    state = "" if info.current else "; the application was built from another version"
    return f"source of '{info.project}', {info.size} bytes, stored by {info.stored_by} at {at}{state}"
