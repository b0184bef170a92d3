"""Files of samples: read back by the csv module, pyarrow, numpy and our own reader."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from sampled_batches import CHANNELS, batch

from tappet.traces.formats import TraceFileError, TraceReader, csv_lines, write_parquet, write_trace
from tappet.traces.recording import RecordInfo
from tappet.traces.samples import BatchSamples, joined

INFO = RecordInfo("Record1", "Main", 1_000_000, 1, CHANNELS, 1_700_000_000_000_000_123)
SETTINGS = {"refresh_rate": 500}


def test_csv_has_a_line_a_sample() -> None:
    whole = batch(70_000)
    rows = list(csv.reader(io.StringIO(b"".join(csv_lines(BatchSamples(CHANNELS, whole))).decode())))
    assert rows[0] == ["time_ns", "cycle", "P.r", "P.i", "P.x"]
    assert len(rows) == 70_001
    assert [int(row[0]) for row in rows[1:]] == whole.time.tolist()
    reals = np.array([float(row[2]) if row[2] else np.nan for row in rows[1:]])
    assert np.array_equal(reals, whole.values[0], equal_nan=True)
    assert [int(row[3]) for row in rows[1:]] == whole.values[1].tolist()


def test_parquet_keeps_types_and_values(tmp_path: Path) -> None:
    whole = batch(70_000)
    doubled = [*CHANNELS[:2], CHANNELS[2].__class__(7, "P.r", "BOOL", "u1")]
    write_parquet(BatchSamples(doubled, whole), tmp_path / "a.parquet")
    table = pq.read_table(tmp_path / "a.parquet")
    assert table.column_names == ["time", "cycle", "P.r", "P.i", "P.r (2)"]
    assert [str(t) for t in table.schema.types] == [
        "timestamp[ns, tz=UTC]",
        "int64",
        "double",
        "int16",
        "bool",
    ]
    assert table["time"].cast("int64").to_pylist() == whole.time.tolist()
    assert np.array_equal(table["P.r"].to_numpy(), whole.values[0], equal_nan=True)
    assert table["P.i"].to_pylist() == whole.values[1].tolist()
    assert table["P.r (2)"].to_pylist() == [v == 1 for v in whole.values[2].tolist()]


def _saved(path: Path, count: int = 70_000) -> Path:
    records = [(INFO, BatchSamples(CHANNELS, batch(count))), (INFO, BatchSamples(CHANNELS, batch(0)))]
    write_trace(path / "a.trace", "Trace", "App", SETTINGS, records)
    return path / "a.trace"


def test_a_trace_file_comes_back_and_numpy_reads_it_alone(tmp_path: Path) -> None:
    """TRC-90, TRC-91."""
    path = _saved(tmp_path)
    whole = batch(70_000)
    with path.open("rb") as file:
        reader = TraceReader(file)
        assert reader.head.records == [INFO, INFO]
        assert (reader.head.name, reader.head.settings, reader.head.samples) == (
            "Trace",
            SETTINGS,
            [70_000, 0],
        )
        again = joined(list(reader.batches(0)))
        assert list(reader.batches(1)) == []
    assert again.cycle.tolist() == whole.cycle.tolist()
    assert again.gap.tolist() == whole.gap.tolist()
    assert all(
        np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
        for a, b in zip(again.values, whole.values, strict=True)
    )
    with zipfile.ZipFile(path) as archive, archive.open("0/1.npy") as column:
        assert np.load(column).tolist() == whole.values[1].tolist()


def _changed(path: Path, name: str, data: bytes | None) -> io.BytesIO:
    """The archive with another content of one entry, or without it."""
    target = io.BytesIO()
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(target, "w") as copy:
        for entry in archive.namelist():
            if entry != name:
                copy.writestr(entry, archive.read(entry))
        if data is not None:
            copy.writestr(name, data)
    return target


def _npy(values: np.ndarray) -> bytes:
    data = io.BytesIO()
    np.save(data, values)
    return data.getvalue()


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("trace.json", None, "no archive with a trace.json"),
        ("trace.json", b"{", "cannot be read"),
        ("trace.json", b"[]", "cannot be read"),
        ("0/1.npy", None, "missing or damaged"),
        ("0/1.npy", b"PK", "missing or damaged"),
        ("0/1.npy", _npy(np.zeros(3, "i2")), "does not hold 100"),
        ("0/1.npy", _npy(np.zeros(100, "f8")), "does not hold 100"),
        ("0/1.npy", _npy(np.zeros(100, "i2"))[:-20], "ends before"),
        ("0/1.npy", _npy(np.array([{}] * 100)), "does not hold|missing or damaged"),
        ("0/time.npy", _npy(np.arange(100, 0, -1)), "fall"),
    ],
)
def test_what_is_no_trace_file_is_refused(tmp_path: Path, name: str, data: bytes | None, said: str) -> None:
    changed = _changed(_saved(tmp_path, 100), name, data)
    with pytest.raises(TraceFileError, match=said):
        list(TraceReader(changed).batches(0))


def test_other_versions_and_unknown_types_are_refused(tmp_path: Path) -> None:
    path = _saved(tmp_path, 10)
    with zipfile.ZipFile(path) as archive:
        head = json.loads(archive.read("trace.json"))
    for change in ({"version": 99}, {"format": "zip"}, {"samples": [1]}, {"samples": [-1, 0]}):
        with pytest.raises(TraceFileError):
            TraceReader(_changed(path, "trace.json", json.dumps({**head, **change}).encode()))
    head["records"][0]["channels"][0]["number"] = "O"
    with pytest.raises(TraceFileError, match="unknown type"):
        TraceReader(_changed(path, "trace.json", json.dumps(head).encode()))
    with pytest.raises(TraceFileError, match="no trace file"):
        TraceReader(io.BytesIO(b"no archive"))
