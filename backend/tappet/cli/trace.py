"""`tappet trace`: record a trace object of a project, in a controller or here on virtual time, to a file."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project, one_application
from tappet.cli.output import show_json
from tappet.cli.run import duration
from tappet.cli.runtime_access import TOKEN_VARIABLE, runtime_token
from tappet.project.project_file import is_project

if TYPE_CHECKING:
    from tappet.project.trace import TraceData, TraceRecord
    from tappet.runtime.sampled import TraceSpec, TraceStatus
    from tappet.traces.reader import RecordReader
    from tappet.traces.recording import RecordInfo
    from tappet.traces.samples import Batch, Samples

FORMATS = ("csv", "parquet", "trace")
_PACE_S = 0.2
_SLICE_NS = 1_000_000_000
LONGEST_NS = 24 * 3_600_000_000_000
"""Of virtual time, in which a trigger has to come."""


def trace_arguments(parser: ArgumentParser) -> None:
    """Which trace, where it runs, for how long, and the file."""
    parser.add_argument(
        "path", type=Path, metavar="PROJECT/TRACE", help="project folder and name of the trace"
    )
    parser.path_option("--to", metavar="FILE", required=True, help="a .csv, .parquet or .trace file")
    parser.add_argument(
        "--runtime", metavar="URL", help="address of the runtime; without one it runs here on virtual time"
    )
    parser.path_option(
        "--token-file", metavar="FILE", help=f"file with the access token (else {TOKEN_VARIABLE})"
    )
    parser.add_argument("--time", metavar="T", help="how long to record; else until the triggers have come")
    parser.add_argument("--record", metavar="NAME", help="which record a .csv or .parquet file gets")
    parser.application_option("which application of the project")
    parser.format_option()


def trace(given: Namespace) -> int:
    """Records and writes."""
    form = given.to.suffix.lstrip(".").lower()
    if form not in FORMATS:
        raise UsageError(f"--to {given.to}: the name ends with .csv, .parquet or .trace")
    name, data = _find(given.path)
    time_ns = duration(given.time) if given.time is not None else None
    if time_ns is None and any(record.trigger.edge == "none" for record in data.records):
        raise UsageError(f"a record of '{name}' has no trigger: say with --time how long to record")
    chosen = _record_number(data, given.record)
    if form != "trace":
        _check_formulas(data.records[chosen])
    if given.runtime is None:
        status, readers, batches = _here(given, name, data, time_ns)
    else:
        import asyncio

        status, readers, batches = asyncio.run(_there(given, name, data, time_ns))
    records = _records(status, batches, whole=time_ns is not None)
    _write(given.to, form, status, data, records, chosen)
    return _show(given, status, readers, records)


def _find(path: Path) -> tuple[str, TraceData]:
    """The name and the settings of the trace object."""
    from tappet.project.kinds.trace import TRACE
    from tappet.project.trace import TraceData

    folder, wanted = (path, None) if is_project(path) else (path.parent, path.name)
    traces = load_project(folder).find_kind(TRACE.name)
    found = [t for t in traces if wanted is None or t.name.casefold() == wanted.casefold()]
    if len(found) != 1:
        names = ", ".join(t.name for t in traces) or "none"
        raise UsageError(f"name one trace as {folder}/NAME; the project has {names}")
    data = found[0].data_as(TraceData)
    if not data.records:
        raise UsageError(f"the trace '{found[0].name}' has no record; configure it first")
    return found[0].name, data


def _record_number(data: TraceData, wanted: str | None) -> int:
    for number, record in enumerate(data.records):
        if wanted is None or record.name.casefold() == wanted.casefold():
            return number
    names = ", ".join(record.name for record in data.records)
    raise UsageError(f"there is no record '{wanted}'; there is {names}")


def _check_formulas(record: TraceRecord) -> None:
    """Before anything is recorded: the file would not have what was asked for."""
    from tappet.traces.formula_channels import FormulasError, check_formulas

    try:
        check_formulas(record)
    except FormulasError as error:
        lines = [f"record '{record.name}', formula '{one.name}': {one.message}" for one in error.problems]
        raise UsageError("\n".join(lines)) from error


def _spec(name: str, data: TraceData, symbols: Any, tasks: Any, code_id: str) -> TraceSpec:
    from tappet.runtime.trace_compiler import TraceSettingsError, compile_trace

    try:
        return compile_trace(name, data, symbols, tasks, code_id, "tappet trace")
    except TraceSettingsError as error:
        raise UsageError(f"the trace '{name}': {error}") from error


def _readers(status: TraceStatus) -> list[RecordReader]:
    from tappet.traces.reader import RecordReader

    return [RecordReader(status.name, n, record, 0) for n, record in enumerate(status.records)]


Recorded = tuple["TraceStatus", "list[RecordReader]", "list[list[Batch]]"]


def _here(given: Namespace, name: str, data: TraceData, time_ns: int | None) -> Recorded:
    """In this process, on virtual time."""
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.runtime.local import ApplicationException, LocalRuntime
    from tappet.runtime.trace_compiler import trace_tasks
    from tappet.user_cache import cache_folder

    folder = given.path if is_project(given.path) else given.path.parent
    chosen = one_application([folder], given.application)
    options = replace(chosen.options, cache=cache_folder("objects"))
    package = (result := build_application(chosen.sources, chosen.tasks, options)).package
    if package is None:
        errors = [format_diagnostic(d) for d in result.diagnostics if d.severity == "error"]
        raise UsageError("\n".join(errors))
    with LocalRuntime(package, start=False) as runtime:
        tasks = trace_tasks(package.tasks)
        spec = _spec(name, data, package.symbols, tasks, package.code_id)
        status = runtime.plc.download_trace(spec, True)
        readers = _readers(status)
        batches: list[list[Batch]] = [[] for _ in readers]
        runtime.start()
        passed = 0
        while passed < (LONGEST_NS if time_ns is None else time_ns):
            part = min(_SLICE_NS, time_ns - passed) if time_ns is not None else _SLICE_NS
            try:
                runtime.run(time_ns=part)
            except ApplicationException as error:
                raise UsageError(str(error)) from error
            passed += part
            status = next(t for t in runtime.plc.traces() if t.name == name)
            for number, (reader, record) in enumerate(zip(readers, status.records, strict=True)):
                while reader.next < record.written:
                    frames = runtime.plc.take_trace(name, number, reader.next, record.written - reader.next)
                    batch = reader.take(frames, record.written)
                    if batch is not None:
                        batches[number].append(batch)
            if time_ns is None and all(record.state == "done" for record in status.records):
                break
        return status, readers, batches


async def _there(given: Namespace, name: str, data: TraceData, time_ns: int | None) -> Recorded:
    """In a controller, which runs the application."""
    import asyncio
    import time

    from tappet.runtime.client import RuntimeClient, RuntimeRefused
    from tappet.runtime.operations.life_cycle import GetInfo
    from tappet.runtime.operations.tasks import ListTasks
    from tappet.runtime.operations.traces import DownloadTrace, ListTraces
    from tappet.runtime.trace_compiler import TraceTask

    token = runtime_token(given.token_file)
    try:
        async with await RuntimeClient.connect(given.runtime, token) as client:
            info = await client.call(GetInfo())
            tasks = [
                TraceTask(t.name, t.interval_ns if t.kind == "cyclic" else 0)
                for t in await client.call(ListTasks())
            ]
            spec = _spec(name, data, await client.symbols(), tasks, info.code_id or "")
            status = await client.call(DownloadTrace(spec))
            downloaded = status.downloaded_ns
            readers = _readers(status)
            batches: list[list[Batch]] = [[] for _ in readers]
            end = None if time_ns is None else time.monotonic() + time_ns / 1e9
            while True:
                last = end is not None and time.monotonic() >= end
                known = await client.call(ListTraces())
                found = [t for t in known if t.name == name and t.downloaded_ns == downloaded]
                if not found:
                    raise UsageError(f"the trace '{name}' was ended: the application has changed")
                (status,) = found
                for number, (reader, record) in enumerate(zip(readers, status.records, strict=True)):
                    batches[number] += await reader.read(client, record.written)
                if last or (end is None and all(record.state == "done" for record in status.records)):
                    return status, readers, batches
                await asyncio.sleep(
                    _PACE_S if end is None else max(0.0, min(_PACE_S, end - time.monotonic()))
                )
    except (OSError, RuntimeRefused) as error:
        raise UsageError(f"{given.runtime}: {error}") from error


def _records(
    status: TraceStatus, batches: list[list[Batch]], *, whole: bool
) -> list[tuple[RecordInfo, Samples]]:
    """What was recorded: all of it, or what the rings show around their triggers."""
    from tappet.traces.recording import RecordInfo, channels_of
    from tappet.traces.samples import BatchSamples, empty_batch, joined

    records: list[tuple[RecordInfo, Samples]] = []
    for record, found in zip(status.records, batches, strict=True):
        channels = channels_of(record.sources)
        batch = joined(found) if found else empty_batch(channels)
        if not whole:
            batch = batch.part(max(0, len(batch) - record.samples), len(batch))
        info = RecordInfo(
            record.name, record.task, record.interval_ns, record.every, channels, record.trigger_ns
        )
        records.append((info, BatchSamples(channels, batch)))
    return records


def _write(
    path: Path,
    form: str,
    status: TraceStatus,
    data: TraceData,
    records: list[tuple[RecordInfo, Samples]],
    chosen: int,
) -> None:
    from tappet.traces.formats import csv_lines, write_parquet, write_trace
    from tappet.traces.formula_channels import with_formulas
    from tappet.whole_file import write_output

    if form == "csv":
        write_output(path, b"".join(csv_lines(with_formulas(records[chosen][1], data, chosen))))
        return
    unfinished = path.with_name(path.name + ".new")
    try:
        if form == "parquet":
            write_parquet(with_formulas(records[chosen][1], data, chosen), unfinished)
        else:
            write_trace(unfinished, status.name, status.application, data.model_dump(mode="json"), records)
        unfinished.replace(path)
    except OSError as error:
        unfinished.unlink(missing_ok=True)
        raise UsageError(f"--to {path}: {error.strerror or error}") from error


def _show(
    given: Namespace,
    status: TraceStatus,
    readers: list[RecordReader],
    records: list[tuple[RecordInfo, Samples]],
) -> int:
    rows = [
        {"record": info.name, "samples": samples.count, "lost": reader.lost, "state": record.state}
        for (info, samples), reader, record in zip(records, readers, status.records, strict=True)
    ]
    complete = all(row["lost"] == 0 for row in rows) and (
        given.time is not None or all(row["state"] == "done" for row in rows)
    )
    if given.format == "json":
        show_json({"ok": complete, "trace": status.name, "file": str(given.to), "records": rows})
    else:
        for row in rows:
            print(f"{row['record']}: {row['samples']} samples, {row['lost']} lost, {row['state']}")
    return 0 if complete else 1
