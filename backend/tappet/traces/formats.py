"""Samples as files: CSV, Parquet, and `*.trace`, which holds the settings and the samples of all records.

A `*.trace` file is a ZIP archive of `trace.json` and one NPY array a column, `<record>/<column>.npy`, which
numpy reads without this product. All are written and read in blocks: memory does not grow with their length.
"""

from __future__ import annotations

import csv
import io
import json
import math
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

import msgspec
import numpy as np
import numpy.typing as npt
from msgspec import Struct

from tappet.traces.recording import RecordInfo
from tappet.traces.samples import Batch, Samples

BLOCK = 65_536
"""Samples that are in memory at once."""
VERSION = 1
_MOST_JSON = 8 << 20
_FIXED = ("cycle", "time", "gap")
_NUMBERS = frozenset(["u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8"])


class TraceFileError(ValueError):
    """This is no trace file that can be read; the message says why."""


class TraceFile(Struct, frozen=True):
    """`trace.json`."""

    format: str
    version: int
    name: str
    application: str
    settings: dict[str, Any]
    """Of the trace object."""
    records: list[RecordInfo]
    samples: list[int]
    """Of each record."""


def _blocks(count: int) -> Iterator[tuple[int, int]]:
    for start in range(0, count, BLOCK):
        yield start, min(count, start + BLOCK)


def _shown(value: Any) -> Any:
    return "" if isinstance(value, float) and math.isnan(value) else value


def csv_lines(samples: Samples) -> Iterator[bytes]:
    """Time in ns, cycle and values; a line a sample, without a value where there is none."""
    names = [channel.name for channel in samples.channels]
    yield _csv([["time_ns", "cycle", *names]])
    for start, stop in _blocks(samples.count):
        columns = [samples.times(start, stop), samples.cycles(start, stop)]
        columns += [samples.native(number, start, stop) for number in range(len(names))]
        rows = zip(*(column.tolist() for column in columns), strict=True)
        yield _csv([[_shown(value) for value in row] for row in rows])


def _csv(rows: Sequence[Sequence[Any]]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue().encode()


def write_parquet(samples: Samples, path: Path) -> None:
    """Columns `time` (ns, UTC), `cycle` and the channels in their own types; BOOL as boolean."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    names = _unique([channel.name for channel in samples.channels])
    types = [
        pa.bool_() if c.type == "BOOL" else pa.from_numpy_dtype(np.dtype(c.number)) for c in samples.channels
    ]
    fields = [("time", pa.timestamp("ns", "UTC")), ("cycle", pa.int64()), *zip(names, types, strict=True)]
    schema = pa.schema(fields)
    with pq.ParquetWriter(path, schema, compression="zstd") as writer:
        for start, stop in _blocks(samples.count):
            arrays = [
                pa.array(samples.times(start, stop), schema.types[0]),
                pa.array(samples.cycles(start, stop)),
            ]
            for number, type_ in enumerate(types):
                column = samples.native(number, start, stop)
                arrays.append(pa.array(column.astype(bool) if type_ == pa.bool_() else column, type_))
            writer.write_table(pa.Table.from_arrays(arrays, schema=schema), row_group_size=BLOCK)


def _unique(names: Sequence[str]) -> list[str]:
    """Column names of a table must differ."""
    found: list[str] = ["time", "cycle"]
    for name in names:
        number, free = 2, name
        while free in found:
            free, number = f"{name} ({number})", number + 1
        found.append(free)
    return found[2:]


def write_trace(
    path: Path,
    name: str,
    application: str,
    settings: Mapping[str, Any],
    records: Sequence[tuple[RecordInfo, Samples]],
) -> None:
    """A `*.trace` file (TRC-90)."""
    head = TraceFile(
        "tappet-trace", VERSION, name, application, dict(settings),
        [info for info, _ in records], [samples.count for _, samples in records],
    )  # fmt: skip
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr("trace.json", msgspec.json.format(msgspec.json.encode(head), indent=1))
        for number, (_, samples) in enumerate(records):
            readers: dict[str, tuple[str, Callable[[int, int], npt.NDArray[Any]]]] = {
                "cycle": ("i8", samples.cycles), "time": ("i8", samples.times), "gap": ("u1", samples.gaps),
            }  # fmt: skip
            for channel, known in enumerate(samples.channels):
                readers[str(channel)] = (known.number, _reader(samples, channel))
            for column, (kind, read) in readers.items():
                with archive.open(f"{number}/{column}.npy", "w", force_zip64=True) as file:
                    _write_column(file, np.dtype(f"<{kind}"), samples.count, read)


def _reader(samples: Samples, channel: int) -> Callable[[int, int], npt.NDArray[Any]]:
    return lambda start, stop: samples.native(channel, start, stop)


def _write_column(
    file: IO[bytes], dtype: np.dtype[Any], count: int, read: Callable[[int, int], npt.NDArray[Any]]
) -> None:
    head = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": (count,)}
    np.lib.format.write_array_header_1_0(file, head)
    for start, stop in _blocks(count):
        file.write(read(start, stop).astype(dtype, copy=False).tobytes())


class TraceReader:
    """A `*.trace` file that is open. TraceFileError at any part that is none."""

    def __init__(self, file: IO[bytes]) -> None:
        try:
            self._archive = zipfile.ZipFile(file)
            info = self._archive.getinfo("trace.json")
            if info.file_size > _MOST_JSON:
                raise TraceFileError("the description of the trace is too long")
            self.head = msgspec.json.decode(self._archive.read(info), type=TraceFile)
        except (zipfile.BadZipFile, KeyError, OSError, NotImplementedError, RuntimeError) as error:
            raise TraceFileError("this is no trace file: it is no archive with a trace.json") from error
        except (msgspec.MsgspecError, json.JSONDecodeError, UnicodeDecodeError) as error:
            raise TraceFileError(f"the description in the file cannot be read: {error}") from error
        head = self.head
        if head.format != "tappet-trace" or head.version > VERSION:
            raise TraceFileError("the file is of a newer version, or of another program")
        if len(head.records) != len(head.samples) or min(head.samples, default=0) < 0:
            raise TraceFileError("the file does not say how many samples each record has")
        for channel in (c for record in head.records for c in record.channels):
            if channel.number not in _NUMBERS:
                raise TraceFileError(f"the channel '{channel.name}' has values of an unknown type")

    def batches(self, record: int) -> Iterator[Batch]:
        """The samples of a record, in blocks."""
        info, count = self.head.records[record], self.head.samples[record]
        kinds = ["i8", "i8", "u1", *(channel.number for channel in info.channels)]
        names = [*_FIXED, *(str(number) for number in range(len(info.channels)))]
        files = [
            self._column(f"{record}/{name}.npy", kind, count) for name, kind in zip(names, kinds, strict=True)
        ]
        last = -(1 << 63)
        for start, stop in _blocks(count):
            columns = [_read_block(file, kind, stop - start) for file, kind in zip(files, kinds, strict=True)]
            cycle, time, gap, *values = columns
            if time[0] < last or (np.diff(time) < 0).any():
                raise TraceFileError(f"the times of the record '{info.name}' fall")
            last = int(time[-1])
            yield Batch(cycle, time, gap, values)

    def _column(self, name: str, kind: str, count: int) -> IO[bytes]:
        try:
            file = self._archive.open(name)
            version = np.lib.format.read_magic(file)
            shape, fortran, dtype = np.lib.format.read_array_header_1_0(file)
        except (
            KeyError,
            ValueError,
            OSError,
            zipfile.BadZipFile,
            NotImplementedError,
            RuntimeError,
        ) as error:
            raise TraceFileError(f"the column {name} is missing or damaged") from error
        if version != (1, 0) or fortran or shape != (count,) or dtype != np.dtype(f"<{kind}"):
            raise TraceFileError(f"the column {name} does not hold {count} values of its type")
        return file


def _read_block(file: IO[bytes], kind: str, count: int) -> npt.NDArray[Any]:
    dtype = np.dtype(f"<{kind}")
    try:
        data = file.read(count * dtype.itemsize)
    except (zipfile.BadZipFile, EOFError, OSError, ValueError) as error:
        raise TraceFileError("the samples of the file are damaged") from error
    if len(data) != count * dtype.itemsize:
        raise TraceFileError("the file ends before its last sample")
    return np.frombuffer(data, dtype)
