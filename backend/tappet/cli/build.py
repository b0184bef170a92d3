"""`tappet build`: machine code of an application, and the file that a runtime starts with."""

from __future__ import annotations

import sys
from argparse import Namespace
from dataclasses import replace
from pathlib import Path

from tappet.cli.arguments import ArgumentParser
from tappet.cli.output import show_json


def build_arguments(parser: ArgumentParser) -> None:
    """What to build, and where its boot application goes."""
    parser.add_argument("path", type=Path, metavar="PATH", help="project folder or .st file")
    parser.application_option("which application of the project")
    parser.add_argument("--rebuild", action="store_true", help="use no objects that earlier builds have left")
    parser.path_option(
        "--boot",
        metavar="FILE",
        help="write the boot application: boot.tappet in the data folder of a runtime",
    )
    parser.format_option()


def build(given: Namespace) -> int:
    """Builds and says how large code and data are."""
    from tappet.cli.inputs import one_application
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.user_cache import cache_folder
    from tappet.whole_file import write_output

    chosen = one_application([given.path], given.application)
    cache = None if given.rebuild else cache_folder("objects")
    result = build_application(chosen.sources, chosen.tasks, replace(chosen.options, cache=cache))
    package = result.package
    if package is not None and given.boot is not None:
        write_output(given.boot, package.to_bytes())
    if given.format == "json":
        show_json(
            {
                "ok": package is not None,
                "diagnostics": [diagnostic.record() for diagnostic in result.diagnostics],
                "code_id": package.code_id if package else None,
                "code_size": result.code_size if package else None,
                "data_size": result.data_size if package else None,
            }
        )
    else:
        for diagnostic in result.diagnostics:
            print(format_diagnostic(diagnostic), file=sys.stderr)
        if package is not None:
            print(f"{chosen.name}: {result.code_size} bytes of code, {result.data_size} bytes of data")
    return 0 if package is not None else 1
