"""`tappet serve` and `tappet runtime`: the two long-running programs."""

from __future__ import annotations

import argparse
import os
from argparse import Namespace
from datetime import timedelta
from pathlib import Path

from tappet.cli.arguments import ArgumentParser, integer


def serve_arguments(parser: ArgumentParser) -> None:
    """Where to listen, where to store, what to start."""
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        help="address to listen on; beyond this machine only on request (default: %(default)s)",
    )
    parser.add_argument(
        "--port",
        type=integer(0, 65535),
        default=8080,
        help="port; 0 takes a free one (default: %(default)s)",
    )
    parser.add_argument(
        "--data",
        type=Path,
        default=Path("data"),
        metavar="DIR",
        help="folder of everything that is stored (default: %(default)s)",
    )
    parser.add_argument("--example", metavar="NAME", help="load an example project and run it")
    parser.add_argument(
        "--local-link", action="store_true", help="print a one-time link that logs in on this machine"
    )
    parser.add_argument(
        "--https", action="store_true", help="browsers come by https, through a proxy that ends it"
    )
    parser.add_argument(
        "--allowed-host",
        action="append",
        default=[],
        metavar="NAME",
        help="name the server is reached by; repeatable",
    )
    parser.add_argument(
        "--public-origin",
        action="append",
        default=[],
        metavar="URL",
        help="origin of pages besides its own; repeatable",
    )
    parser.add_argument(
        "--recordings-gib",
        type=integer(1, 1 << 20),
        default=20,
        metavar="GIB",
        help="room of all stored recordings of traces; when it is used up, nothing more is recorded "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--recordings-days",
        type=integer(1, 36_525),
        metavar="DAYS",
        help="older recordings of traces are deleted, and older samples of those that go on (default: none)",
    )
    parser.add_argument(
        "--runtime",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="start a soft PLC on this machine",
    )


def serve(given: Namespace) -> int:
    """Serves until it is ended."""
    from tappet.server.serve import ServeOptions
    from tappet.server.serve import serve as run
    from tappet.server.settings import ServerSettings

    settings = ServerSettings(
        data_dir=given.data,
        database_url=os.environ.get("DATABASE_URL") or None,
        host=given.host,
        port=given.port,
        https=given.https,
        allowed_hosts=tuple(given.allowed_host),
        public_origins=tuple(given.public_origin),
        local_runtime=given.runtime,
        recordings_gib=given.recordings_gib,
        recordings_keep=None if given.recordings_days is None else timedelta(given.recordings_days),
    )
    return run(ServeOptions(settings, given.example, given.local_link))


def runtime_arguments(parser: ArgumentParser) -> None:
    """The process of a soft PLC reads its arguments itself."""
    parser.forwards = True


def runtime(given: Namespace) -> int:
    """Runs until it is ended."""
    from tappet.runtime.__main__ import main

    return main(given.words)
