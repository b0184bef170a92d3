"""`tappet bench`: the product's own benchmarks, each with its baseline in the same run."""

from __future__ import annotations

from argparse import Namespace
from importlib import import_module

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError

BENCHMARKS = ("scan", "axes", "cnc", "path-planner", "jitter", "load", "build", "editor", "start", "trace")


def bench_arguments(parser: ArgumentParser) -> None:
    """Which one."""
    known = f"{', '.join(BENCHMARKS[:-1])} or {BENCHMARKS[-1]}"
    parser.add_argument("name", nargs="?", metavar="NAME", help=f"{known}; all of them if left out")
    parser.format_option()


def bench(given: Namespace) -> int:
    """Runs one benchmark, or all."""
    if given.name is not None and given.name not in BENCHMARKS:
        raise UsageError(f"there is no benchmark '{given.name}'; there are {', '.join(BENCHMARKS)}")
    for name in [given.name] if given.name else BENCHMARKS:
        report = import_module(f"tappet.bench.{name.replace('-', '_')}").run()
        print(report.json() if given.format == "json" else report.text())
    return 0
