"""Puts an exception report together: what happened, where, the call stack and the variables around it."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from dataclasses import replace

from tappet.codegen.symbol_map import SymbolError
from tappet.iec.places import SourceMap, Span
from tappet.runtime.application import LoadedApplication
from tappet.runtime.exception_report import CallFrame, ExceptionReport
from tappet.runtime.faults import Locator, RawFault, describe, fault_name
from tappet.runtime.logbook import Logbook

_MOST_VALUES = 200
"""Variables listed in a report."""


def build_report(application: LoadedApplication, log: Logbook) -> ExceptionReport:
    """Report on the fault that ended the application, or what was called beside its tasks."""
    number = application.contexts.faulted_task()
    is_task = number is not None and number >= 0
    task = application.contexts.tasks[number] if is_task else application.contexts.service  # type: ignore[index]
    name = application.package.tasks[number].name if is_task else application.called  # type: ignore[index]
    raw = application.contexts.fault(task)
    message, values = describe(raw)
    stack = stack_of(application, raw, log)
    made = _maker(application, raw.origin)
    values |= _heap_values(application, raw, made)
    here = stack[0] if stack else made or CallFrame("", "", 0)
    values |= _values_of(application, [frame.pou for frame in stack])
    return ExceptionReport(
        raw.code, fault_name(raw.code), message, name, here.pou, here.uri, here.line, raw.cycle,
        time.time_ns(), tuple(stack), values, here.place,
    )  # fmt: skip


def stack_of(application: LoadedApplication, raw: RawFault, log: Logbook) -> list[CallFrame]:
    """Call stack of a fault in the present code of the application; empty when it is not readable."""
    try:
        maps = application.package.source_maps
        return [_with_place(frame, maps) for frame in Locator(*application.codes).call_stack(raw)]
    except Exception as error:  # whatever is wrong with the debug information, the exception is reported
        log.add("error", "runtime", f"call stack not readable: {type(error).__name__}: {error}")
        return []


def _with_place(frame: CallFrame, maps: Mapping[str, SourceMap]) -> CallFrame:
    """A level of the call stack with the place that its line shows."""
    shown = maps.get(frame.uri.upper())
    if shown is None or frame.line < 1:
        return frame
    line = frame.line - 1
    return replace(frame, place=shown.place(Span(line, 0, line, 0)))


def _heap_values(application: LoadedApplication, raw: RawFault, made: CallFrame | None) -> dict[str, str]:
    """The __NEW that made the memory which is damaged; for other faults, memory that is damaged besides."""
    values = {}
    if not raw.origin and (block := application.heap.damaged()) is not None:
        values["damaged memory"] = f"16#{block.address:X}, {block.size} bytes"
        made = _maker(application, block.origin)
    if made is not None:
        line = made.place.span.line + 1 if made.place is not None else made.line
        values["made by __NEW in"] = f"{made.pou}, line {line}"
    return values


def _maker(application: LoadedApplication, origin: int) -> CallFrame | None:
    """Where the __NEW stands that returned to `origin`; None when that code is gone."""
    address = application.heap.maker(origin)
    frames = Locator(*application.codes).frames_at(address - 1) if address else []
    return _with_place(frames[0], application.package.source_maps) if frames else None


def _values_of(application: LoadedApplication, pous: Iterable[str]) -> dict[str, str]:
    """Simple variables of the programs in a call stack, as IEC literals."""
    symbols = application.package.symbols
    values: dict[str, str] = {}
    for pou in dict.fromkeys(p.upper() for p in pous):
        root = symbols.roots.get(pou)
        if root is None:
            continue
        for child in symbols.children(root.name):
            if not child.leaf or len(values) >= _MOST_VALUES:
                continue
            try:
                ref = symbols.resolve(child.path)
                data = application.image.read(ref.offset, ref.size)
                values[ref.path] = symbols.format_literal(ref, symbols.decode(ref, data))
            except (SymbolError, ValueError):
                continue
    return values
