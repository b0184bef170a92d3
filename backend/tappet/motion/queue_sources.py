"""Fills the queues of CNC programs that are compiled as path objects (DAT-03), before a build.

Contract: the text of such a program holds the order (`project.cnc.code`); here its lines become the objects
that decoder, preprocessing and velocity check of the library make, one line for one, so that the source map
stays. What the blocks refuse is an error at its line and word. Texts of other objects come back as they are.
Cost: a program is run when it, its properties or the settings have changed since the last build.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from tappet.cnc.parser import parse
from tappet.cnc.words import Problem
from tappet.iec.places import Segment, SourceMap
from tappet.iec.source import Source
from tappet.motion.path_program import Rows
from tappet.motion.path_service import PathFault, PathObjects, PathService, PathSettingsError
from tappet.project.cnc.code import (
    PROGRAM_ORDER,
    SETTINGS_ORDER,
    QueueOrder,
    attribute_in,
    message_pragma,
    queue_lines,
    queue_order,
)
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData

MOST_QUEUED = 131_072
"""Objects of a queue in memory: some 90 MB."""
KEPT_QUEUES = 32
_ORDER = f"{{attribute '{PROGRAM_ORDER}' :="


@dataclass(frozen=True, slots=True)
class _Queue:
    """What stands in place of an order."""

    lines: tuple[str, ...]
    """None where the path has a fault: the queue stays empty."""
    fault: PathFault | None


def with_queues(sources: Iterable[Source], cache: Path | None = None) -> list[Source]:
    """The texts of an application with its queues filled; `cache`: a folder of compiled objects."""
    found = list(sources)
    if not any(_ORDER in source.text for source in found):
        return found
    settings = next(
        (data for source in found if (data := attribute_in(source.text.split("\n", 1)[0], SETTINGS_ORDER))),
        b"{}",
    )
    return [_filled(source, settings, cache) if _ORDER in source.text else source for source in found]


def _filled(source: Source, settings: bytes, cache: Path | None) -> Source:
    order = queue_order(source.text)
    if order is None:
        return source
    queue = _queue(order.name, order.data.model_dump_json(), settings, cache)
    lines = source.text.split("\n")
    lines[order.line : order.line + len(queue.lines)] = queue.lines
    text = "\n".join(lines)
    if queue.fault is None:
        return replace(source, text=text)
    return _with_fault(replace(source, text=text), order, queue.fault)


def _with_fault(source: Source, order: QueueOrder, fault: PathFault) -> Source:
    """A function at the end that holds the message; not where the checks of the text have said it already."""
    if "{error cnc " in source.text or source.map is None:
        return source
    number = source.text.count("\n") + 3
    problem = Problem(fault.line or 0, fault.column, fault.length, fault.message)
    text = (
        f"{source.text}\n{{attribute 'hide'}}\nFUNCTION SM3_{order.name}_Path : BOOL\n"
        f"{message_pragma(problem)}\nSM3_{order.name}_Path := TRUE;\nEND_FUNCTION"
    )
    segments = source.map.segments
    about = Segment(
        number,
        segments[0].object_id,
        "implementation",
        part_line=problem.line,
        about=(problem.column, problem.column + problem.length),
    )
    return replace(source, text=text, map=SourceMap((*segments, about)))


@lru_cache(maxsize=KEPT_QUEUES)
def _queue(name: str, data: str, settings: bytes, cache: Path | None) -> _Queue:
    program = CncProgramData.model_validate_json(data)
    try:
        path = _service(cache).preprocessed(program, CncSettingsData.model_validate_json(settings))
    except PathSettingsError as error:
        return _Queue((), PathFault(str(error)))
    fault = path.fault
    if fault is None and len(path.rows) > MOST_QUEUED:
        fault = PathFault(
            f"The path has {len(path.rows)} objects; a queue in memory has at most {MOST_QUEUED}. Compile "
            "the program as SMC_CNC_REF, or exclude it from the build and read its file"
        )
    if fault is not None:
        return _Queue((), fault)
    text = parse(program.implementation)
    rows = _with_numbers(path, [line.number for line in text.lines])
    lines = queue_lines(QueueOrder(name, program, 0), rows.tobytes(), len(rows), rows.itemsize)
    return _Queue(tuple(lines), None)


@lru_cache(maxsize=1)
def _service(cache: Path | None) -> PathService:
    """Of this process; a build takes one queue after the other."""
    return PathService(cache)


def _with_numbers(path: PathObjects, numbers: Sequence[int | None]) -> Rows:
    """The objects with the numbers behind N, which SMC_Interpolator shows, where their lines have one."""
    rows = np.zeros(len(path.rows), path.rows.dtype)
    for field in rows.dtype.names or ():
        rows[field] = path.rows[field]
    shown = np.array([place + 1 if number is None else number for place, number in enumerate(numbers)])
    known = path.lines >= 0
    rows["iSourceLine_No"][known] = shown[path.lines[known]]
    return rows
