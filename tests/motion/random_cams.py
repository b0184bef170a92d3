"""Cams as hypothesis draws them, of all laws."""

from __future__ import annotations

from itertools import accumulate

from hypothesis import strategies as st

from tappet.project.cams.table import LAWS, CamPoint, CamSegment, CamTable

NUMBERS = st.floats(-5, 5).map(lambda number: round(number, 2))


@st.composite
def cams(draw: st.DrawFn, most: int = 5, laws: tuple[str, ...] = LAWS) -> CamTable:
    widths = draw(st.lists(st.floats(0.25, 4).map(lambda w: round(w, 2)), min_size=1, max_size=most))
    start = draw(st.sampled_from((0.0, -7.5, 1000.0)))
    points = tuple(
        CamPoint(x=x, y=draw(NUMBERS), v=draw(NUMBERS), a=draw(NUMBERS), j=draw(NUMBERS))
        for x in accumulate(widths, initial=start)
    )
    segments = tuple(
        CamSegment(law=draw(st.sampled_from(laws)), inflection=draw(st.sampled_from((0.5, 0.2, 0.75))))
        for _ in widths
    )
    return CamTable(points=points, segments=segments, tracks=())
