"""The command line (docs/architecture.md, section 3): one file a group of commands; others script against it.

May import every room. Exit code 0: good; 1: the project has errors; 2: wrong usage. Start with `main`. What a
command needs is imported when it runs, so that the version and the help of a command come at once.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence

from tappet import __version__
from tappet.cli.commands import COMMANDS, Command, overview
from tappet.cli.errors import UsageError, complain

INTERRUPTED = 130
"""Exit code after Ctrl+C: 128 and the number of SIGINT, as shells have it."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command line, that of the process unless it is given; returns the exit code."""
    if arguments is not None:
        return _guarded(list(arguments))
    gc.disable()  # modules and trees are no garbage; long-running commands enable it
    try:
        return _guarded(sys.argv[1:])
    finally:
        gc.freeze()  # the process ends: nothing is worth being looked at once more


def _guarded(words: list[str]) -> int:
    try:
        return _run(words)
    except UsageError as error:
        complain(str(error))
        return 2
    except BrokenPipeError:  # who reads has seen enough; the interpreter would complain when it ends
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 0
    except OSError as error:
        from tappet.disk_full import is_disk_full

        if not is_disk_full(error):
            raise
        complain(f"the disk is full: {error.filename or 'the output'} was not written")
        return 2
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(words: list[str]) -> int:
    known = [command for command in COMMANDS if words[: len(command.words)] == list(command.words)]
    if known:
        return _execute(known[0], words[len(known[0].words) :])
    if "--version" in words[:1]:
        print(f"tappet {__version__}")
        return 0
    group = [words[0]] if words and any(command.words[0] == words[0] for command in COMMANDS) else []
    rest = words[len(group) :]
    if not rest or rest[0] in ("--help", "-h"):
        print(overview(group))
        return 0 if rest else 2
    name = " ".join([*group, rest[0]])
    there = ", ".join(
        dict.fromkeys(c.words[len(group)] for c in COMMANDS if c.words[: len(group)] == (*group,))
    )
    raise UsageError(
        f"there is no {'option' if rest[0].startswith('-') else 'command'} '{name}'; there is {there}"
    )


def _execute(command: Command, words: list[str]) -> int:
    from tappet.cli.arguments import ArgumentParser

    parser = ArgumentParser(f"tappet {' '.join(command.words)}", command.summary)
    execute = command.load(parser)
    if command.goes_on:
        gc.enable()
    return execute(parser.parse(words))
