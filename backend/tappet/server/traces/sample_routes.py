"""What is asked of samples, the same of a running trace and of a stored recording."""

from collections.abc import Callable
from typing import Annotated, Any

from fastapi import Depends, Query
from fastapi.responses import Response

from tappet.server.dependencies import Viewer
from tappet.server.routing import Router
from tappet.server.traces.shapes import ChannelSpectrum, ChannelStatistics, ExportFormat
from tappet.server.traces.shown import BINARY, Shown, Span
from tappet.traces.questions import MOST_POINTS, MOST_SAMPLES, Operation, WindowFunction

RecordNumber = Annotated[int, Query(ge=0, le=1000)]
ChannelNumber = Annotated[int, Query(ge=0, le=1000, description="Among the sampled channels.")]
Moment = Annotated[int | None, Query(ge=0, lt=1 << 63, description="Unix time in ns.")]
Width = Annotated[int, Query(ge=1, le=MOST_POINTS, description="Points of the diagram.")]
Chosen = Annotated[str | None, Query(pattern=r"^\d{1,3}(,\d{1,3})*$", max_length=1000)]
First = Annotated[int, Query(ge=0, lt=1 << 53)]
Count = Annotated[int, Query(ge=1, le=MOST_SAMPLES)]
Format = Annotated[ExportFormat, Query(alias="format")]
WithFormulas = Annotated[
    bool,
    Query(description="Columns of the formulas, too; one without values is the problem `formula-invalid`."),
]
FILE_ANSWER: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
        "description": "File",
    }
}
_BINARY_ANSWER: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {BINARY: {"schema": {"type": "string", "format": "binary"}}},
        "description": "docs/trace.md",
    }
}


async def span(
    start: Annotated[Moment, Query(alias="from")] = None, end: Annotated[Moment, Query(alias="to")] = None
) -> Span:
    """The time that is asked for."""
    return Span(start, end)


SpanDep = Annotated[Span, Depends(span)]


def add_sample_routes(router: Router, path: str, of: str, find: Callable[..., Any]) -> None:
    """Adds them below `path`; `find` is the dependency that gives the samples of the record that is meant."""
    # What computes the answers loads numpy, which a server without traces does not need.

    @router.get(f"{path}/window", name=f"get_{of}_window", response_class=Response, responses=_BINARY_ANSWER)
    async def window(
        who: Viewer,
        found: Annotated[Shown, Depends(find)],
        within: SpanDep,
        width: Width = 1000,
        channels: Chosen = None,
    ) -> Response:
        """Samples of a time, or the least and largest values where they are many."""
        from tappet.server.traces import answers

        return await answers.window(found, within, width, channels)

    @router.get(
        f"{path}/samples", name=f"get_{of}_samples", response_class=Response, responses=_BINARY_ANSWER
    )
    async def samples(
        who: Viewer, found: Annotated[Shown, Depends(find)], first: First = 0, count: Count = 10_000
    ) -> Response:
        """Samples by number."""
        from tappet.server.traces import answers

        return await answers.samples(found, first, count)

    @router.get(f"{path}/statistics", name=f"get_{of}_statistics")
    async def statistics(
        who: Viewer, found: Annotated[Shown, Depends(find)], channel: ChannelNumber, within: SpanDep
    ) -> ChannelStatistics:
        """Least, largest and mean values."""
        from tappet.server.traces import answers

        return await answers.statistics(found, channel, within)

    @router.get(f"{path}/spectrum", name=f"get_{of}_spectrum")
    async def spectrum(
        who: Viewer,
        found: Annotated[Shown, Depends(find)],
        channel: ChannelNumber,
        within: SpanDep,
        window: Annotated[WindowFunction, Query()] = "hann",
    ) -> ChannelSpectrum:
        """Amplitudes of the sines that a span consists of."""
        from tappet.server.traces import answers

        return await answers.spectrum(found, channel, within, window)

    @router.get(
        f"{path}/derived", name=f"get_{of}_derived", response_class=Response, responses=_BINARY_ANSWER
    )
    async def derived(
        who: Viewer,
        found: Annotated[Shown, Depends(find)],
        channel: ChannelNumber,
        operation: Operation,
        within: SpanDep,
        width: Width = 1000,
    ) -> Response:
        """The derivative or the integral of a channel."""
        from tappet.server.traces import answers

        return await answers.derived(found, channel, operation, within, width)
