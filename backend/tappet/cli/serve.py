"""`tappet serve` and `tappet runtime`: the two long-running programs."""

from __future__ import annotations

import typer

FORWARD = {"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []}
"""Context settings of a command that hands its arguments on unread."""


def runtime(context: typer.Context) -> None:
    """Run a soft PLC alone; --help lists its options."""
    from tappet.runtime.__main__ import main

    raise typer.Exit(main(context.args))
