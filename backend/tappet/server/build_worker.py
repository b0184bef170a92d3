"""The compiler as a process of its own: reads build orders from its input, writes outcomes to its output.

A frame is the length of what follows (8 bytes, little endian) and a msgpack map. Parsed texts and objects are
kept from one build of an application to the next.
"""

from __future__ import annotations

import os
import struct
import sys
import time
import traceback
from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import msgpack

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Scope, Source
from tappet.project.sources import TaskDefinition, WatchdogDefinition

LENGTH = struct.Struct("<Q")
KEPT_SESSIONS = 8
"""Applications whose parsed texts are kept."""
LARGEST_FRAME = 1 << 31


@dataclass(frozen=True, slots=True)
class BuildOrder:
    """Everything a build depends on, as plain data."""

    key: str
    """Names the application; builds of one key share their caches."""
    application: str
    sources: tuple[dict[str, Any], ...]
    """Fields of `lang.source.Source`."""
    tasks: tuple[dict[str, Any], ...]
    """Fields of `project.sources.TaskDefinition`."""
    libraries: tuple[tuple[str, str, str], ...]
    """Name, version, namespace or ''."""
    previous: bytes | None
    """Package that runs now; unchanged data keep their places."""
    cache: str
    """Folder of compiled objects."""


class Compiler:
    """Builds orders one after the other."""

    def __init__(self) -> None:
        self._sessions: OrderedDict[str, BuildSession] = OrderedDict()

    def build(self, order: dict[str, Any]) -> dict[str, Any]:
        """Outcome of an order: package or None, diagnostics as maps, sizes, seconds."""
        started = time.perf_counter()
        session = self._sessions.pop(order["key"], None) or BuildSession()
        self._sessions[order["key"]] = session
        while len(self._sessions) > KEPT_SESSIONS:
            self._sessions.popitem(last=False)
        previous = CodePackage.from_bytes(order["previous"]) if order["previous"] else None
        options = BuildOptions(
            application=order["application"],
            libraries=tuple(LibraryReference(n, v, space or None) for n, v, space in order["libraries"]),
            cache=Path(order["cache"]),
        )
        sources = [Source(**{**source, "scope": Scope(source["scope"])}) for source in order["sources"]]
        tasks = [_task(task) for task in order["tasks"]]
        result = build_application(sources, tasks, options, previous, session)
        package = result.package
        return {
            "package": package.to_bytes() if package else None,
            "code_id": package.code_id if package else None,
            "data_id": package.data_id if package else None,
            "change_base": package.online_change.base_code_id if package and package.online_change else None,
            "change_reasons": (
                list(package.online_change.reasons) if package and package.online_change else []
            ),
            "code_size": result.code_size,
            "data_size": result.data_size,
            "diagnostics": [_fields(diagnostic) for diagnostic in result.diagnostics],
            "timings": result.timings,
            "seconds": time.perf_counter() - started,
        }


def _fields(diagnostic: Diagnostic) -> dict[str, Any]:
    span = diagnostic.span
    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "advice": diagnostic.advice,
        "uri": diagnostic.uri,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def _task(fields: dict[str, Any]) -> TaskDefinition:
    watchdog = WatchdogDefinition(**fields["watchdog"]) if fields["watchdog"] else None
    return TaskDefinition(**{**fields, "watchdog": watchdog, "programs": tuple(fields["programs"])})


def read_frame(stream: BinaryIO) -> dict[str, Any] | None:
    """The next map; None at the end of the stream."""
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        return None
    (length,) = LENGTH.unpack(head)
    body = stream.read(length)
    if len(body) < length:
        return None
    frame: dict[str, Any] = msgpack.unpackb(body, raw=False, max_bin_len=LARGEST_FRAME)
    return frame


def pack_frame(content: dict[str, Any]) -> bytes:
    """A map with its length in front."""
    body: bytes = msgpack.packb(content, use_bin_type=True)
    return LENGTH.pack(len(body)) + body


def main() -> None:
    """Serves orders until the input ends."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints in here must not get between the frames
    compiler = Compiler()
    while (order := read_frame(sys.stdin.buffer)) is not None:
        try:
            outcome = compiler.build(order)
        except Exception as error:
            traceback.print_exc()
            outcome = {"crash": f"{type(error).__name__}: {error}"}
        output.write(pack_frame(outcome))
        output.flush()


if __name__ == "__main__":
    main()
