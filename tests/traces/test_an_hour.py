"""64 variables every millisecond for an hour of machine time: no sample is lost, memory stays bounded."""

from __future__ import annotations

import resource
from pathlib import Path

import numpy as np
import pytest

from tappet.codegen.build import BuildOptions, build_application
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.project.trace import TraceData
from tappet.runtime.local import LocalRuntime
from tappet.runtime.trace_compiler import compile_trace, trace_tasks
from tappet.traces.chunks import StoredSamples
from tappet.traces.reader import RecordReader
from tappet.traces.recording import channels_of

MS = 1_000_000
TEXT = """
PROGRAM PLC_PRG
VAR n : LINT; v : ARRAY [1..63] OF LREAL; i : INT; END_VAR
n := n + 1;
FOR i := 1 TO 63 DO v[i] := v[i] + i; END_FOR
END_PROGRAM
"""


def _recorded(folder: Path, seconds: int, slice_s: int = 2) -> tuple[StoredSamples, RecordReader]:
    """Reads the ring every `slice_s` seconds, as the server does, but at other times than the task writes."""
    task = Task("Fast", interval_ns=MS, programs=("PLC_PRG",))
    built = build_application([Source("PLC_PRG", TEXT)], (task,), BuildOptions("App"))
    assert built.package is not None
    names = ["PLC_PRG.n", *(f"PLC_PRG.v[{i}]" for i in range(1, 64))]
    data = TraceData.model_validate({"records": [{"channels": [{"variable": name} for name in names]}]})
    with LocalRuntime(built.package) as runtime:
        package = runtime.package
        tasks = trace_tasks(package.tasks)
        spec = compile_trace("Trace", data, package.symbols, tasks, package.code_id, "tester")
        status = runtime.plc.download_trace(spec, True).records[0]
        reader = RecordReader("Trace", 0, status, 0)
        stored = StoredSamples(folder, 0, channels_of(status.sources))
        for _ in range(seconds // slice_s):
            runtime.run(time_ns=slice_s * 1000 * MS)
            written = runtime.plc.traces()[0].records[0].written
            while reader.next < written:
                frames = runtime.plc.take_trace("Trace", 0, reader.next, written - reader.next)
                batch = reader.take(frames, written)
                assert batch is not None
                stored.append(batch)
    return stored, reader


def _check(stored: StoredSamples, reader: RecordReader, count: int) -> None:
    assert (stored.count, reader.lost) == (count, 0)
    for start in range(0, count, 100_000):
        stop = min(count, start + 100_000)
        expected = np.arange(start + 1, stop + 1)
        assert np.array_equal(stored.native(0, start, stop), expected)
        assert np.array_equal(stored.native(63, start, stop), expected * 63.0)
        assert not stored.gaps(start, stop).any()


def test_a_minute_loses_no_sample(tmp_path: Path) -> None:
    _check(*_recorded(tmp_path, 60), 60_000)


@pytest.mark.slow
def test_an_hour_loses_no_sample(tmp_path: Path) -> None:
    warm = tmp_path / "warm"
    warm.mkdir()
    _recorded(warm, 60)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    stored, reader = _recorded(tmp_path, 3600)
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    _check(stored, reader, 3_600_000)
    assert grown < 100 * 1024, f"memory grew by {grown >> 10} MiB for {stored.bytes >> 20} MiB of samples"
