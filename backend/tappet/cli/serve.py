"""`tappet serve` and `tappet runtime`: the two long-running programs."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

FORWARD = {"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []}
"""Context settings of a command that hands its arguments on unread."""


def serve(
    host: Annotated[str, typer.Option(help="address to listen on; beyond this machine only if told")] = (
        "127.0.0.1"
    ),
    port: Annotated[int, typer.Option(min=0, max=65535, help="port; 0 takes a free one")] = 8080,
    data: Annotated[Path, typer.Option(metavar="DIR", help="folder of everything that is stored")] = Path(
        "data"
    ),
    example: Annotated[
        str | None, typer.Option(metavar="NAME", help="load an example project and run it")
    ] = None,
    local_link: Annotated[
        bool, typer.Option("--local-link", help="print a one-time link that logs in on this machine")
    ] = False,
    https: Annotated[
        bool, typer.Option("--https", help="browsers come by https, through a proxy that ends it")
    ] = False,
    allowed_host: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="name the server is reached by; repeatable")
    ] = None,
    public_origin: Annotated[
        list[str] | None, typer.Option(metavar="URL", help="origin of pages besides its own; repeatable")
    ] = None,
    runtime: Annotated[bool, typer.Option(help="start a soft PLC on this machine")] = True,
) -> None:
    """Serve the IDE, with a local soft PLC. SQLite in DIR, or the database of the variable DATABASE_URL."""
    from tappet.server.serve import ServeOptions
    from tappet.server.serve import serve as run
    from tappet.server.settings import ServerSettings

    settings = ServerSettings(
        data_dir=data,
        database_url=os.environ.get("DATABASE_URL") or None,
        host=host,
        port=port,
        https=https,
        allowed_hosts=tuple(allowed_host or ()),
        public_origins=tuple(public_origin or ()),
        local_runtime=runtime,
    )
    raise typer.Exit(run(ServeOptions(settings, example, local_link)))


def runtime(context: typer.Context) -> None:
    """Run a soft PLC alone; --help lists its options."""
    from tappet.runtime.__main__ import main

    raise typer.Exit(main(context.args))
