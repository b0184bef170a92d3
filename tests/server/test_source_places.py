"""From lines of the compiled text to lines in the editors."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.iec.places import Segment, SourceMap
from tappet.iec.source import Scope, Source
from tappet.server.builds.source_places import SourcePlaces, shown_line


def _source(uri: str, scope: Scope, object_id: str) -> Source:
    segments = (Segment(0, object_id, "declaration"), Segment(4, object_id, "implementation"))
    return Source(uri, "", scope, body_line=4, map=SourceMap(segments))


SOURCES = (_source("A", Scope.APPLICATION, "mine"), _source("A", Scope.POUS, "hidden"))
PLACES = SourcePlaces.of("p", SOURCES, {"mine": "Application/A"})


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


def test_lines_of_other_texts_are_shown_as_they_are() -> None:
    assert shown_line(PLACES, "a", 6) == 2
    assert shown_line(PLACES, "Standard/TON", 6) == 6
    assert shown_line(None, "a", 6) == 6
    assert shown_line(PLACES, "", 0) == 0


def test_the_table_reads_back() -> None:
    assert SourcePlaces.from_json(PLACES.to_json()) == PLACES


@given(
    st.binary(max_size=40)
    | st.sampled_from([b"{}", b"[]", b'{"maps":{"a":[[1]]},"paths":{},"project_id":"p"}'])
)
def test_damaged_tables_are_value_errors(data: bytes) -> None:
    with pytest.raises(ValueError):  # noqa: PT011
        SourcePlaces.from_json(data)
