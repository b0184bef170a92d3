"""The compiler as a process of its own: reads build orders from its input, writes outcomes to its output.

Parsed texts and objects are kept from one build of an application to the next.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import time
import traceback
from collections import OrderedDict
from pathlib import Path
from types import FrameType
from typing import Any

from msgspec import convert, structs, to_builtins

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.change_report import change_report
from tappet.codegen.package import CodePackage
from tappet.codegen.variable_changes import ChangeReport
from tappet.iec.heap import HeapSettings
from tappet.iec.memory import ChangeReserve
from tappet.iec.task import Task
from tappet.lang.coding_settings import static_analysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source
from tappet.motion.queue_sources import with_queues
from tappet.project.library_reference import LibraryReference
from tappet.server.frames import CANCEL, pack_frame, read_frame

KEPT_SESSIONS = 8
"""Applications whose parsed texts are kept."""
PARTIAL_BUILDS = 20
"""Builds of single bodies leave little garbage: it is looked for after so many."""
BEHIND_TYPING = 5
"""Niceness of a build: the messages for who is typing come before it."""


class BuildCancelled(BaseException):
    """The running build is to end. No Exception: nothing on the way may take it for a failure."""


class Compiler:
    """Builds orders one after the other."""

    def __init__(self) -> None:
        self._sessions: OrderedDict[str, BuildSession] = OrderedDict()
        self._previous: tuple[bytes, CodePackage] | None = None
        self._built: tuple[bytes, CodePackage] | None = None
        """The last package made here: the next order's running one, mostly."""
        self._at_work = False
        self._partial = False
        self._since = 0

    def cancel(self, number: int, frame: FrameType | None) -> None:
        """Signal handler: ends the running build, if there is one."""
        if self._at_work:
            self._at_work = False
            raise BuildCancelled

    def outcome(self, order: dict[str, Any]) -> dict[str, Any]:
        """Outcome of an order, also of one that was cancelled or that the compiler fails at."""
        try:
            self._at_work = True
            found = self.build(order)
            self._at_work = False
        except BuildCancelled:
            return {"cancelled": True}
        except Exception as error:
            self._at_work = False
            traceback.print_exc()
            return {"crash": f"{type(error).__name__}: {error}"}
        return found

    def tidy(self) -> None:
        """What can wait until the answer is out: what the next build needs, and looking for garbage after
        builds of everything, and now and then."""
        for session in self._sessions.values():
            session.settle()
        self._since += 1
        if not self._partial or self._since >= PARTIAL_BUILDS:
            self._since = 0
            gc.collect()

    def build(self, order: dict[str, Any]) -> dict[str, Any]:
        """Outcome of an order: package or None, diagnostics as maps, sizes, seconds."""
        started = time.perf_counter()
        kept = self._sessions.pop(order["key"], None)
        session = BuildSession() if kept is None or order["fresh"] else kept
        self._sessions[order["key"]] = session
        while len(self._sessions) > KEPT_SESSIONS:
            self._sessions.popitem(last=False)
        previous = self._package(order["previous"])
        static = order["static"]
        options = BuildOptions(
            application=order["application"],
            project=order["project"],
            compiled=int(time.time()),
            libraries=tuple(LibraryReference.of(fields) for fields in order["libraries"]),
            cache=None if order["fresh"] else Path(order["cache"]),
            static=static_analysis(static["rules"], static["prefixes"], static["limits"]),
            heap=HeapSettings(**order["heap"]),
            reserve=ChangeReserve(**order["reserve"]),
            disabled_warnings=frozenset(order["disabled_warnings"]),
            check_only=order["check_only"],
        )
        sources = with_queues(convert(order["sources"], list[Source]), options.cache)
        tasks = convert(order["tasks"], list[Task])
        result = build_application(sources, tasks, options, previous, session)
        self._partial = result.partial
        package = result.package
        packed = package.to_bytes() if package else None
        variant = None
        if order["instrumented"] and session.generated is not None:
            from tappet.codegen.debug_build import instrument  # few builds need it

            variant = instrument(session.generated, session.cache(options.cache)).to_bytes()
        if package is not None and packed is not None:
            self._built = packed, package
        change = package.online_change if package else None
        if change is not None and change.refused:
            change = structs.replace(change, base_code_id="", reasons=(change.refused,))
        return {
            "package": packed,
            "variant": variant,
            "code_id": package.code_id if package else None,
            "data_id": package.data_id if package else None,
            "change_base": (change.base_code_id or None) if change else None,
            "change_reasons": list(change.reasons) if change else [],
            "change_report": _changes(previous, package),
            "code_size": result.code_size,
            "data_size": result.data_size,
            "diagnostics": [_fields(diagnostic) for diagnostic in result.diagnostics],
            "timings": result.timings,
            "seconds": time.perf_counter() - started,
        }

    def _package(self, data: bytes | None) -> CodePackage | None:
        """The running package; from one build to the next it is mostly the same."""
        if not data:
            return None
        for known in (self._previous, self._built):
            if known is not None and known[0] == data:
                self._previous = known
                return known[1]
        self._previous = data, CodePackage.from_bytes(data)
        return self._previous[1]


def _changes(previous: CodePackage | None, package: CodePackage | None) -> dict[str, Any]:
    """What an online change would do to the variables, as plain data."""
    report = ChangeReport() if previous is None or package is None else change_report(previous, package)
    fields: dict[str, Any] = to_builtins(report)
    return fields


def _fields(diagnostic: Diagnostic) -> dict[str, Any]:
    span = diagnostic.span
    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "advice": diagnostic.advice,
        "facts": dict(diagnostic.facts),
        "uri": diagnostic.uri,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def main() -> None:
    """Serves orders until the input ends."""
    os.nice(BEHIND_TYPING)
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints in here must not get between the frames
    compiler = Compiler()
    signal.signal(CANCEL, compiler.cancel)
    gc.disable()  # looking for garbage in large trees takes longer than a small build: done between builds
    while (order := read_frame(sys.stdin.buffer)) is not None:
        try:
            output.write(pack_frame(compiler.outcome(order)))
            output.flush()
        except BrokenPipeError:
            os._exit(0)  # the server was killed: there is nobody to answer
        del order
        compiler.tidy()


if __name__ == "__main__":
    main()
