"""What diagrams ask of samples, the same for a running trace and for a stored recording."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any, TypeVar

from fastapi.responses import FileResponse, Response, StreamingResponse
from msgspec import structs
from starlette.background import BackgroundTask
from starlette.concurrency import run_in_threadpool

from tappet.project.trace import TraceData
from tappet.server.problems import Problem
from tappet.server.traces.shapes import ChannelSpectrum, ChannelStatistics, ExportFormat, TraceProblem
from tappet.server.traces.shown import BINARY, Shown, Span
from tappet.traces import analysis, formats, windows
from tappet.traces.formula_channels import FormulasError, with_formulas
from tappet.traces.questions import MOST_SAMPLES, Operation, WindowFunction
from tappet.traces.samples import BatchSamples, Samples

T = TypeVar("T")


async def _computed(shown: Shown, work: Callable[[], T]) -> T:
    def locked() -> T:
        with shown.lock:
            return work()

    return await run_in_threadpool(locked)


def _numbers(chosen: str | None) -> list[int] | None:
    return None if chosen is None else [int(text) for text in chosen.split(",")]


async def window(shown: Shown, span: Span, width: int, chosen: str | None) -> Response:
    """Samples of a time, or their extremes."""
    data = await _computed(
        shown,
        lambda: windows.window(
            shown.samples, span.start, span.end, width, _numbers(chosen),
            trigger_ns=shown.info.trigger_ns, first_number=shown.first_number,
        ),
    )  # fmt: skip
    return Response(data, media_type=BINARY)


async def samples(shown: Shown, first: int, count: int) -> Response:
    """Samples by number, each."""
    start = min(max(0, first - shown.first_number), shown.samples.count)
    stop = min(shown.samples.count, max(start, first - shown.first_number + count))
    data = await _computed(
        shown,
        lambda: windows.points(
            shown.samples, start, stop, 1, trigger_ns=shown.info.trigger_ns, first_number=shown.first_number
        ),
    )
    return Response(data, media_type=BINARY)


def _numbers_of(shown: Shown, span: Span) -> tuple[int, int]:
    """Numbers of the samples from a time to another one, both inclusive."""
    first = 0 if span.start is None else shown.samples.search(span.start)
    stop = shown.samples.count if span.end is None else shown.samples.search(span.end + 1)
    return first, max(first, stop)


async def statistics(shown: Shown, channel: int, span: Span) -> ChannelStatistics:
    """Least, largest and mean values of a span."""
    number = shown.channel(channel)
    found = await _computed(
        shown, lambda: analysis.statistics(shown.samples, number, *_numbers_of(shown, span))
    )
    return ChannelStatistics.model_validate(structs.asdict(found))


async def spectrum(shown: Shown, channel: int, span: Span, name: WindowFunction) -> ChannelSpectrum:
    """Amplitudes of the sines that a span consists of."""
    number = shown.channel(channel)
    found = await _computed(
        shown, lambda: analysis.spectrum(shown.samples, number, *_numbers_of(shown, span), name)
    )
    return ChannelSpectrum.model_validate(structs.asdict(found))


async def derived(shown: Shown, channel: int, operation: Operation, span: Span, width: int) -> Response:
    """The derivative or integral of a span."""
    number = shown.channel(channel)

    def work() -> bytes:
        first, stop = _numbers_of(shown, span)
        if stop - first > MOST_SAMPLES:
            raise Problem(
                422,
                "span-too-long",
                f"At most {MOST_SAMPLES} samples are computed at once; choose a shorter time.",
            )
        made = analysis.Derived(shown.samples, number, operation)
        curve = BatchSamples(made.channels, made.batch(first, stop))
        return windows.window(
            curve,
            None,
            None,
            width,
            trigger_ns=shown.info.trigger_ns,
            first_number=shown.first_number + first,
        )

    return Response(await _computed(shown, work), media_type=BINARY)


async def export(
    name: str,
    application: str,
    settings: dict[str, Any],
    records: Sequence[Shown],
    record: int,
    form: ExportFormat,
    *,
    formulas: bool,
) -> Response:
    """A file: CSV and Parquet of one record, with its formulas if wanted, a trace file of all. Raises the 422
    problem `formula-invalid` where a formula has no values."""
    plain = name.encode("ascii", "replace").decode()
    file_name = "".join(c if c.isalnum() or c in "-_ " else "_" for c in plain)[:100] or "trace"
    headers = {"Content-Disposition": f'attachment; filename="{file_name}.{form}"'}
    if form != "trace":
        computed = records[record].samples
        if formulas:
            computed = _with_formulas(computed, TraceData.model_validate(settings), record)
    if form == "csv":
        lines = _locked_lines(records[record], computed)
        return StreamingResponse(lines, media_type="text/csv; charset=utf-8", headers=headers)
    path = Path(tempfile.mkdtemp(prefix="tappet-export-")) / f"export.{form}"

    def write() -> None:
        if form == "parquet":
            with records[record].lock:
                formats.write_parquet(computed, path)
        else:
            with records[0].lock if records else nullcontext():
                formats.write_trace(path, name, application, settings, [(r.info, r.samples) for r in records])

    def remove() -> None:
        path.unlink(missing_ok=True)
        path.parent.rmdir()

    try:
        await run_in_threadpool(write)
    except BaseException:
        remove()
        raise
    media = "application/vnd.apache.parquet" if form == "parquet" else "application/octet-stream"
    return FileResponse(path, media_type=media, headers=headers, background=BackgroundTask(remove))


def _with_formulas(samples: Samples, settings: TraceData, record: int) -> Samples:
    try:
        return with_formulas(samples, settings, record)
    except FormulasError as error:
        first = error.problems[0]
        raise Problem(
            422,
            "formula-invalid",
            f"The formula '{first.name}' of the record '{settings.records[record].name}' has no values: "
            f"{first.message}. Correct it, or export without formulas.",
            problems=[
                TraceProblem(record=record, channel=one.channel, field="formula", message=one.message)
                for one in error.problems
            ],
        ) from error


def _locked_lines(shown: Shown, samples: Samples) -> Iterator[bytes]:
    """Lines of a recording that may grow meanwhile."""
    lines = formats.csv_lines(samples)
    while True:
        with shown.lock:
            line = next(lines, None)
        if line is None:
            return
        yield line
