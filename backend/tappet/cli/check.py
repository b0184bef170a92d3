"""`tappet check`: compile only."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from tappet.cli.inputs import applications
from tappet.cli.output import FormatOption, OutputFormat, UsageError, show_json
from tappet.codegen.check import check_application, format_diagnostic
from tappet.lang.coding_settings import StaticAnalysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.rules import chosen_codes


def check(
    paths: Annotated[
        list[Path], typer.Argument(metavar="PATH...", help="project folder, or .st files and folders of them")
    ],
    output: FormatOption = OutputFormat.TEXT,
    application: Annotated[str | None, typer.Option(help="only this application of the project")] = None,
    static: Annotated[
        str | None,
        typer.Option(
            metavar="RULES",
            help="coding rules to check, not those of the project: 'all', 'none', or codes such as S12,S1301",
        ),
    ] = None,
) -> None:
    """Check programs without running them: one `file:line:column: severity code: message` a finding."""
    try:
        rules = StaticAnalysis(chosen_codes(static or ""))
    except ValueError as error:
        raise UsageError(f"--static: {error}") from error
    found: list[Diagnostic] = []
    for item in applications(paths, application):
        found += check_application(
            item.sources, item.tasks, item.options if static is None else replace(item.options, static=rules)
        )
    errors = sum(diagnostic.severity == "error" for diagnostic in found)
    warnings = sum(diagnostic.severity == "warning" for diagnostic in found)
    if output is OutputFormat.JSON:
        show_json({"ok": errors == 0, "diagnostics": [diagnostic.record() for diagnostic in found]})
    else:
        for diagnostic in found:
            typer.echo(format_diagnostic(diagnostic))
        typer.echo(f"{errors} error(s), {warnings} warning(s)", err=bool(errors))
    raise typer.Exit(1 if errors else 0)
