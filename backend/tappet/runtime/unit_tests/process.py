"""Tests in a process of their own: a program under test that kills its process takes nobody with it.

The order is one msgpack map on the input of `python -m tappet.runtime.unit_tests.process FD`, where FD is a
PlacePage; reports come back as JSON, one a line, the last one is the result.
"""

from __future__ import annotations

import gc
import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import astuple
from typing import Any

import msgpack
import msgspec

from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.iec.heap import HeapSettings
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.posix import PAGE, map_memory
from tappet.runtime.unit_tests.attempts import FRESH, NO_MEMORY, Attempts
from tappet.runtime.unit_tests.known import NOTHING, Known
from tappet.runtime.unit_tests.memory import MemoryLimit, MemoryLimitReachedError
from tappet.runtime.unit_tests.order import TestLimits
from tappet.runtime.unit_tests.results import Report
from tappet.runtime.unit_tests.runner import TestProcess, run_tests
from tappet.user_cache import cache_folder


def run_in_process(command: bytes) -> Report:
    """Run an order and wait for its report; a test that kills its process is reported, others continue."""
    with Attempts(command) as attempts:
        report = None
        while report is None:
            try:
                done = subprocess.run(  # noqa: S603 - our own command
                    attempts.command,
                    input=attempts.order,
                    stdout=subprocess.PIPE,
                    pass_fds=attempts.pass_fds,
                    timeout=attempts.seconds_left,
                    check=False,
                )
                report = attempts.take(done.stdout, done.returncode)
            except subprocess.TimeoutExpired as late:
                report = attempts.take(late.stdout or b"", None)
        return report


def perform(content: dict[str, Any], write: Callable[[dict[str, Any]], None], place: int) -> None:
    """Carries an order out; `write` gets the lines of its output, `place` is the address of a PlacePage."""
    options = BuildOptions(
        application=content["application"],
        libraries=tuple(LibraryReference.of(reference) for reference in content["libraries"]),
        defines=tuple((name, value) for name, value in content["defines"]),
        cache=cache_folder("objects"),
        once=True,
        heap=HeapSettings(**content["heap"]),
    )
    sources = [msgspec.convert(source, Source) for source in content["sources"]]
    tasks = [Task(**{**task, "programs": tuple(task["programs"])}) for task in content["tasks"]]
    limits = TestLimits(**content["limits"])
    memory = MemoryLimit(limits.memory_mib)

    def send(report: Report, known: Known) -> None:
        write({"report": report.to_dict(), "known": known.to_dict()})

    report = run_tests(
        sources,
        tasks,
        options,
        test_filter=content["filter"],
        only=content["only"],
        limits=limits,
        process=TestProcess(
            Known.from_dict(content["known"]),
            place,
            memory,
            lambda marks: write({"marks": [astuple(mark) for mark in marks]}),
            send,
        ),
    )
    memory.lift()
    send(report, NOTHING)


def main() -> None:
    """Entry point of the process."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever prints in here must not get between the lines

    def write(line: dict[str, Any]) -> None:
        output.write(json.dumps(line) + "\n")
        output.flush()

    gc.disable()  # a build makes large trees and hardly any garbage, and the process ends soon
    content = msgpack.unpackb(sys.stdin.buffer.read(), raw=False, strict_map_key=False, use_list=False)
    page = map_memory(PAGE, int(sys.argv[1]))
    try:
        perform(content, write, page.address)
    except MemoryLimitReachedError:
        sys.exit(FRESH)
    except MemoryError:
        sys.exit(NO_MEMORY)
    except BrokenPipeError:
        pass  # who asked was killed: nobody wants to know
    os._exit(0)  # all is written; giving back the trees of the program one by one takes as long as the tests


if __name__ == "__main__":
    main()
