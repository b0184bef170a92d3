"""Traces of a loaded application, and their samples as numpy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from tappet.project.trace import TraceData
from tappet.runtime.local import LocalRuntime
from tappet.runtime.sampled import TraceSpec, TraceStatus
from tappet.runtime.trace_compiler import compile_trace, trace_tasks
from tappet.runtime.trace_record import TraceRecordStatus
from tappet.traces.samples import frame_dtype


def trace_data(*variables: str, **record: Any) -> TraceData:
    """A trace of one record."""
    channels = [{"variable": variable} for variable in variables]
    return TraceData.model_validate({"records": [{"channels": channels, **record}]})


def spec_of(runtime: LocalRuntime, data: TraceData, name: str = "Trace") -> TraceSpec:
    package = runtime.package
    return compile_trace(name, data, package.symbols, trace_tasks(package.tasks), package.code_id, "tester")


def traced(runtime: LocalRuntime, *variables: str, **record: Any) -> TraceStatus:
    """Downloads a trace of one record and starts it."""
    return runtime.plc.download_trace(spec_of(runtime, trace_data(*variables, **record)), True)


def status(runtime: LocalRuntime, name: str = "Trace") -> TraceRecordStatus:
    return next(trace for trace in runtime.plc.traces() if trace.name == name).records[0]


def samples(runtime: LocalRuntime, name: str = "Trace", record: int = 0) -> np.ndarray[Any, Any]:
    """What the ring shows: from the first sample of the picture to the last."""
    found = next(trace for trace in runtime.plc.traces() if trace.name == name).records[record]
    frames = runtime.plc.take_trace(name, record, found.first, found.samples)
    assert frames.first == found.first
    return np.frombuffer(frames.data, frame_dtype(found.sources, found.frame_size))


def column(runtime: LocalRuntime, number: int = 0, name: str = "Trace") -> list[Any]:
    found: list[Any] = samples(runtime, name)[str(number)].tolist()
    return found
