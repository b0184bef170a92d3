"""Tests in a process of their own: a program under test that kills its process takes nobody with it.

The order is one msgpack map on the input of `python -m tappet.runtime.unit_tests.process`; reports come back
as JSON, one a line, the last one is the result.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, astuple, replace
from typing import Any

import msgpack

from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.codegen.package import TaskSpec
from tappet.lang.source import Scope, Source
from tappet.runtime.unit_tests.results import Report
from tappet.runtime.unit_tests.runner import TestLimits, run_tests

COMMAND = (sys.executable, "-m", "tappet.runtime.unit_tests.process")
WALL_LIMIT_S = 600.0
"""A run that takes longer is ended; restarts after endless loops take their time."""


def order(
    sources: Sequence[Source],
    tasks: Sequence[TaskSpec],
    options: BuildOptions,
    *,
    test_filter: str = "",
    only: Sequence[str] = (),
    limits: TestLimits | None = None,
) -> bytes:
    """What the process reads."""
    content = {
        "application": options.application,
        "libraries": [astuple(reference) for reference in options.libraries],
        "defines": options.defines,
        "sources": [asdict(source) for source in sources],
        "tasks": [{"name": t.name, "interval_ns": t.interval_ns, "programs": t.programs} for t in tasks],
        "filter": test_filter,
        "only": list(only),
        "limits": asdict(limits or TestLimits()),
    }
    packed: bytes = msgpack.packb(content, use_bin_type=True)
    return packed


def run_in_process(command: bytes) -> Report:
    """Run an order and wait for its report; a process that dies leaves what was known before."""
    try:
        done = subprocess.run(  # noqa: S603 - our own command
            COMMAND, input=command, stdout=subprocess.PIPE, timeout=WALL_LIMIT_S, check=False
        )
        return report_of(done.stdout, done.returncode)
    except subprocess.TimeoutExpired as late:
        return report_of(late.stdout or b"", None)


def report_of(output: bytes, code: int | None) -> Report:
    """The result in what a process has written; `code` None: it was ended after WALL_LIMIT_S."""
    lines = output.splitlines()
    if code == 0 and lines:
        return Report.from_dict(json.loads(lines[-1]))
    before = Report("")
    for line in lines:
        try:
            before = Report.from_dict(json.loads(line))
        except ValueError:
            break
    return replace(before, problem=_why(code))


def _why(code: int | None) -> str:
    if code is None:
        return f"the tests took longer than {WALL_LIMIT_S:g} s and were ended"
    if code < 0:
        name = signal.Signals(-code).name
        return f"a test killed its process ({name}); the tests that had not finished before have no result"
    return f"the test process ended with code {code}"


def perform(content: dict[str, Any], write: Any) -> None:
    """Carries an order out; `write` gets every report as plain data."""
    options = BuildOptions(
        application=content["application"],
        libraries=tuple(LibraryReference(*reference) for reference in content["libraries"]),
        defines=tuple((name, value) for name, value in content["defines"]),
    )
    sources = [Source(**{**source, "scope": Scope(source["scope"])}) for source in content["sources"]]
    tasks = [TaskSpec(**{**task, "programs": tuple(task["programs"])}) for task in content["tasks"]]
    report = run_tests(
        sources,
        tasks,
        options,
        test_filter=content["filter"],
        only=content["only"],
        limits=TestLimits(**content["limits"]),
        progress=lambda so_far: write(so_far.to_dict()),
    )
    write(report.to_dict())


def main() -> None:
    """Entry point of the process."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever prints in here must not get between the lines

    def write(report: dict[str, Any]) -> None:
        output.write(json.dumps(report) + "\n")
        output.flush()

    perform(msgpack.unpackb(sys.stdin.buffer.read(), raw=False, strict_map_key=False, use_list=False), write)


if __name__ == "__main__":
    main()
