"""The arguments of a command: what argparse lacks for ours."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

from tappet.cli.errors import UsageError


class ArgumentParser(argparse.ArgumentParser):
    """Options may stand anywhere between the others and are written in full; errors are UsageErrors."""

    def __init__(self, prog: str, description: str) -> None:
        super().__init__(
            prog,
            description=description,
            allow_abbrev=False,
            formatter_class=lambda prog: argparse.HelpFormatter(prog, max_help_position=32, width=110),
        )
        self.forwards = False
        """Whether the words are handed on unread, in `words`."""

    def parse(self, words: Sequence[str]) -> argparse.Namespace:
        """The arguments of a call. Raises UsageError."""
        return argparse.Namespace(words=list(words)) if self.forwards else self.parse_intermixed_args(words)

    def error(self, message: str) -> NoReturn:
        """What argparse finds wrong."""
        raise UsageError(f"{message}\n{self.format_usage().rstrip()}")

    def format_option(self) -> None:
        """`--format`."""
        self.add_argument(
            "--format",
            choices=("text", "json"),
            default="text",
            help="text for people, json for machines (default: text)",
        )

    def path_option(self, name: str, *, metavar: str, help: str, required: bool = False) -> None:
        """An option that takes a file or a folder."""
        self.add_argument(name, type=Path, metavar=metavar, help=help, required=required)

    def application_option(self, help: str) -> None:
        """`--application`."""
        self.add_argument("--application", metavar="NAME", help=help)

    def cycle_limit_option(self, seconds: float, counts_as: str) -> None:
        """`--cycle-limit`; `counts_as` says what a longer cycle is taken for."""
        self.add_argument(
            "--cycle-limit",
            type=decimal(0.01),
            default=seconds,
            metavar="S",
            help=f"seconds after which a cycle counts as {counts_as} (default: %(default)s)",
        )

    def programs(self) -> None:
        """PATH...: a project folder or plain texts."""
        self.add_argument(
            "paths",
            type=Path,
            nargs="+",
            metavar="PATH",
            help="project folder, or .st files and folders of them",
        )


def integer(low: int, high: int | None = None) -> Callable[[str], int]:
    """A whole number within bounds."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"'{text}' is no whole number") from None
        if value < low or (high is not None and value > high):
            raise argparse.ArgumentTypeError(f"{text} is not {_range(low, high)}")
        return value

    return read


def decimal(low: float) -> Callable[[str], float]:
    """A number from `low`."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"'{text}' is no number") from None
        if not value >= low:
            raise argparse.ArgumentTypeError(f"{text} is not {_range(low, None)}")
        return value

    return read


def _range(low: float, high: float | None) -> str:
    return f"at least {low}" if high is None else f"between {low} and {high}"
