"""The table of all commands, with the modules that are imported when one of them is called.

A command `f` of a module is the function `f`, which takes the parsed arguments and returns the exit code, and
`f_arguments`, which declares the arguments to the parser.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from argparse import Namespace

    from tappet.cli.arguments import ArgumentParser

ABOUT = "Engineering IDE and soft PLC: edit, check, run and deploy IEC 61131-3 projects."


class Command(NamedTuple):
    """One command."""

    words: tuple[str, ...]
    """How it is called."""
    module: str
    """Module of `tappet.cli`."""
    function: str
    summary: str
    goes_on: bool = False
    """Runs until it is ended, or for the given time."""

    def load(self, parser: ArgumentParser) -> Callable[[Namespace], int]:
        """Declares the arguments to the parser; the function that executes the command."""
        module = import_module(f"tappet.cli.{self.module}")
        getattr(module, f"{self.function}_arguments")(parser)
        execute: Callable[[Namespace], int] = getattr(module, self.function)
        return execute


COMMANDS = (
    Command(
        ("serve",),
        "serve",
        "serve",
        "Serve the IDE, with a local soft PLC. SQLite in DIR, or the database of the variable DATABASE_URL.",
        goes_on=True,
    ),
    Command(("runtime",), "serve", "runtime", "Run a soft PLC alone.", goes_on=True),
    Command(
        ("check",),
        "check",
        "check",
        "Check programs without running them: one `file:line:column: severity code: message` a finding.",
    ),
    Command(
        ("build",),
        "build",
        "build",
        "Build an application; with --boot write the file that a runtime starts with.",
    ),
    Command(("run",), "run", "run", "Run an application for some cycles or a time and print values."),
    Command(
        ("test",),
        "unit_tests",
        "run_unit_tests",
        "Run the test suites (blocks that extend FB_TestSuite); exit code 1 when a test is not good.",
        goes_on=True,
    ),
    Command(
        ("replay",),
        "replay",
        "replay",
        "Run a recording of the flight recorder again; exit code 1 when it does not go as recorded.",
        goes_on=True,
    ),
    Command(
        ("import",),
        "projects",
        "import_project",
        "Import a project, or files of other systems, and report what came in, changed or stayed out.",
    ),
    Command(
        ("export",),
        "projects",
        "export_project",
        "Write a project as PLCopen XML for other systems, or as an archive for the workbench.",
    ),
    Command(
        ("compare",),
        "compare",
        "compare",
        "Compare two projects, or files of other systems; exit code 1 when they differ.",
    ),
    Command(
        ("document",),
        "document",
        "document",
        "Print a project as PDF or HTML: title page, contents, texts, tables.",
    ),
    Command(
        ("library", "list"),
        "library",
        "list_libraries",
        "The installed libraries in all their versions, newest first.",
    ),
    Command(
        ("library", "show"),
        "library",
        "show",
        "Every POU and type of a library, or a single one, with pins, types and defaults.",
    ),
    Command(
        ("library", "save"),
        "library",
        "save",
        "Make a library of a project: everything but its programs, when it compiles.",
    ),
    Command(
        ("library", "install"),
        "library",
        "install",
        "Install a library beside those that are there; the same version is replaced.",
    ),
    Command(("library", "remove"), "library", "remove", "Uninstall one version of a library."),
    Command(
        ("trace",),
        "trace",
        "trace",
        "Record a trace of a project, in a runtime or on virtual time, to a file.",
    ),
    Command(("deploy",), "deploy", "deploy", "Build an application, download it to a runtime and start it."),
    Command(
        ("source", "show"),
        "source",
        "show_source",
        "What source a runtime keeps: of which project, by whom, when.",
    ),
    Command(
        ("source", "download"), "source", "download_source", "Store the source of a project in a runtime."
    ),
    Command(
        ("source", "upload"),
        "source",
        "upload_source",
        "Read the source that a runtime keeps into a new project folder.",
    ),
    Command(
        ("lsp",),
        "lsp",
        "lsp",
        "Language Server Protocol on standard input and output, for VS Code and other editors.",
        goes_on=True,
    ),
    Command(
        ("dap",),
        "dap",
        "dap",
        "Debug adapter on standard input and output, for editors of the Debug Adapter Protocol.",
        goes_on=True,
    ),
    Command(
        ("bench",),
        "bench",
        "bench",
        "The product's own benchmarks, as ratios to a baseline in the same run.",
        goes_on=True,
    ),
)


def overview(group: Sequence[str] = ()) -> str:
    """The help of the whole, or of a group of commands such as `library`."""
    shown = [command for command in COMMANDS if command.words[: len(group)] == tuple(group)]
    width = max(len(" ".join(command.words)) for command in shown)
    call = " ".join(["tappet", *group])
    lines = [f"usage: {call} COMMAND ...", "", ABOUT, "", "commands:"]
    lines += [f"  {' '.join(command.words):{width}}  {command.summary}" for command in shown]
    lines += ["", f"{call} COMMAND --help shows the arguments of a command; tappet --version the version."]
    return "\n".join(lines)
