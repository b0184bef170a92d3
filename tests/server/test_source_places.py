"""From lines of the compiled text to lines in the editors."""

from __future__ import annotations

import pytest

from tappet.iec.places import Segment, SourceMap
from tappet.iec.source import Scope, Source
from tappet.server.builds.source_places import SourcePlaces


def _source(uri: str, scope: Scope, object_id: str) -> Source:
    segments = (Segment(0, object_id, "declaration"), Segment(4, object_id, "implementation"))
    return Source(uri, "", scope, body_line=4, map=SourceMap(segments))


SOURCES = (_source("A", Scope.APPLICATION, "mine"), _source("A", Scope.POUS, "hidden"))
PLACES = SourcePlaces.of(SOURCES, {"mine": "Application/A"})


@pytest.mark.parametrize(
    ("line", "part", "within"),
    [(1, "declaration", 1), (4, "declaration", 4), (5, "implementation", 1), (9, "implementation", 5)],
)
def test_lines_are_found_in_their_part(line: int, part: str, within: int) -> None:
    place = PLACES.locate("a", line)
    assert place is not None
    assert (place.object_id, place.object_path, place.part, place.line) == (
        "mine",
        "Application/A",
        part,
        within,
    )


def test_what_is_not_of_the_project_has_no_place() -> None:
    assert PLACES.locate("Standard/TON", 3) is None
    assert PLACES.locate("A", 0) is None
