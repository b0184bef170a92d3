"""The command line (DESIGN section 3): one file a group of commands; others script against it.

May import every room. Exit code 0: good; 1: the project has errors; 2: wrong usage. Start with `main`.
"""

from __future__ import annotations

import sys

import typer

from tappet import __version__
from tappet.cli import bench, check, deploy, library, lsp, projects, run, serve, unit_tests
from tappet.cli.output import UsageError, complain

app = typer.Typer(
    name="tappet",
    help="Engineering IDE and soft PLC: edit, check, run and deploy IEC 61131-3 projects.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.command("serve")(serve.serve)
app.command("runtime", context_settings=serve.FORWARD)(serve.runtime)
app.command("check")(check.check)
app.command("run")(run.run)
app.command("test")(unit_tests.run_unit_tests)
app.command("import")(projects.import_project)
app.command("export")(projects.export_project)
app.add_typer(library.app, name="library")
app.command("deploy")(deploy.deploy)
app.command("lsp")(lsp.lsp)
app.command("bench")(bench.bench)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"tappet {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Show the version."
    ),
) -> None:
    """Engineering IDE and soft PLC: edit, check, run and deploy IEC 61131-3 projects."""


def main() -> None:
    """Entry point of the console script."""
    try:
        app()
    except UsageError as error:
        complain(str(error))
        sys.exit(2)
    except BrokenPipeError:
        sys.exit(0)
