"""`tappet check`: compile only."""

from __future__ import annotations

import sys
from argparse import Namespace
from dataclasses import replace

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.output import show_json


def check_arguments(parser: ArgumentParser) -> None:
    """What to check, by which rules."""
    parser.programs()
    parser.format_option()
    parser.application_option("only this application of the project")
    parser.add_argument(
        "--static",
        metavar="RULES",
        help="coding rules to check, not those of the project: 'all', 'none', or codes such as S12,S1301",
    )


def check(given: Namespace) -> int:
    """Shows the messages."""
    from tappet.cli.inputs import applications
    from tappet.codegen.check import check_application, format_diagnostic
    from tappet.lang.coding_settings import StaticAnalysis
    from tappet.lang.diagnostics import Diagnostic
    from tappet.lang.rules import chosen_codes

    try:
        rules = None if given.static is None else StaticAnalysis(chosen_codes(given.static))
    except ValueError as error:
        raise UsageError(f"--static: {error}") from error
    found: list[Diagnostic] = []
    for item in applications(given.paths, given.application):
        options = item.options if rules is None else replace(item.options, static=rules)
        found += check_application(item.sources, item.tasks, options)
    errors = sum(diagnostic.severity == "error" for diagnostic in found)
    warnings = sum(diagnostic.severity == "warning" for diagnostic in found)
    if given.format == "json":
        show_json({"ok": errors == 0, "diagnostics": [diagnostic.record() for diagnostic in found]})
    else:
        for diagnostic in found:
            print(format_diagnostic(diagnostic))
        print(f"{errors} error(s), {warnings} warning(s)", file=sys.stderr if errors else sys.stdout)
    return 1 if errors else 0
