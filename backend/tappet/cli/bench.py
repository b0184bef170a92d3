"""`tappet bench`: the product's own benchmarks, each with its baseline in the same run."""

from __future__ import annotations

from typing import Annotated

import typer

from tappet.cli.output import FormatOption, OutputFormat, UsageError


def bench(
    name: Annotated[
        str | None, typer.Argument(help="scan, jitter, build or editor; all of them if left out")
    ] = None,
    output: FormatOption = OutputFormat.TEXT,
) -> None:
    """Measure scan speed, task jitter, build speed and the check in the editor as ratios to a baseline."""
    from tappet.bench import build, editor, jitter, scan

    known = {"scan": scan.run, "jitter": jitter.run, "build": build.run, "editor": editor.run}
    if name is not None and name not in known:
        raise UsageError(f"there is no benchmark '{name}'; there are {', '.join(known)}")
    for benchmark in [name] if name else list(known):
        report = known[benchmark]()
        typer.echo(report.json() if output is OutputFormat.JSON else report.text())
