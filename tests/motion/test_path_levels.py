"""Levels of detail: what is drawn looks like the whole path, and is little."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.libraries.cnc_paths import line, position
from tests.motion.path_objects import geo_info

from tappet.motion.paths.geo_info import GEO_INFO, LIN, Numbers, Objects
from tappet.motion.paths.levels import Camera, Levels
from tappet.motion.paths.polyline import Polyline, polyline

coordinate = st.floats(-50.0, 50.0)
points = st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=2, max_size=40)
direction = st.tuples(*(st.floats(-1.0, 1.0),) * 3).map(np.array).filter(lambda v: np.linalg.norm(v) > 0.1)


def camera(place: tuple[float, ...], at: tuple[float, ...], pixel: float = 1e-3, cone: float = 0.5) -> Camera:
    way = np.subtract(at, place)
    return Camera(np.array(place, float), way / np.linalg.norm(way), pixel, cone)


def through(rows: Numbers) -> Objects:
    """Lines from point to point."""
    found = np.zeros(len(rows) - 1, GEO_INFO)
    found["iMoveType"] = LIN
    found["b3D"] = True
    for n, name in enumerate(("dX", "dY", "dZ")):
        found["piStartPos"][name], found["piDestPos"][name] = rows[:-1, n], rows[1:, n]
    return found


def from_segment(point: Numbers, a: Numbers, b: Numbers) -> float:
    way = b - a
    square = float(way @ way)
    share = 0.0 if square == 0 else min(1.0, max(0.0, float((point - a) @ way) / square))
    return float(np.linalg.norm(point - a - share * way))


def drawn_within(path: Polyline, levels: Levels, view: Camera) -> None:
    """Every point in the picture is seen at most half a pixel from a line that is drawn over it."""
    chosen = levels.choose(view)
    covering: dict[int, tuple[int, int]] = {}
    for start, end in zip(chosen.start, chosen.end, strict=True):
        for piece in range(start, end):
            assert piece not in covering
            covering[piece] = (int(start), int(end))
    for piece, owner in enumerate(path.of):
        if owner < 0:
            assert piece not in covering
            continue
        way = path.points[piece] - view.place
        distance = float(np.linalg.norm(way))
        seen = math.acos(max(-1.0, min(1.0, float(way @ view.ahead) / distance))) < view.cone * 0.99
        if piece not in covering:
            assert not seen
            continue
        start, end = covering[piece]
        off = from_segment(path.points[piece], path.points[start], path.points[end])
        assert off <= 0.5 * view.pixel * distance * 1.001 + 1e-9


@given(points, direction, st.floats(5.0, 500.0), st.sampled_from([1e-4, 1e-2, 1e-1]))
def test_points_are_drawn_within_half_a_pixel(
    rows: list[tuple[float, float, float]], way: Numbers, distance: float, pixel: float
) -> None:
    path = polyline([through(np.array(rows))], 1e-3)
    place = tuple(distance * way / np.linalg.norm(way))
    drawn_within(path, Levels(path), camera(place, (0, 0, 0), pixel))


def test_gaps_are_not_drawn() -> None:
    objects = [line(position(n, 0), position(n + 0.5, 0)) for n in range(20)]
    path = polyline([geo_info(objects)], 1e-3)
    chosen = Levels(path).choose(camera((0, 0, 1e6), (0, 0, 0)))
    drawn = sorted(
        (path.points[s, 0], path.points[e, 0]) for s, e in zip(chosen.start, chosen.end, strict=True)
    )
    assert drawn == [(n, n + 0.5) for n in range(20)]


def winding(count: int) -> Polyline:
    """A spiral of so many short lines, 100 wide."""
    turn = np.linspace(0, 200 * math.pi, count + 1)
    radius = np.linspace(1, 100, count + 1)
    return polyline(
        [through(np.column_stack([radius * np.cos(turn), radius * np.sin(turn), turn / 50]))], 1e-3
    )


def test_a_million_pieces_are_few_lines_from_afar_and_all_of_what_is_near() -> None:
    path = winding(1_000_000)
    levels = Levels(path)
    far = levels.choose(camera((0, 0, 300), (0, 0, 0), pixel=1e-3))
    assert len(far.start) <= 60_000
    near = camera((80, 0, 18), (80, 0, 10), pixel=1e-3, cone=0.05)
    chosen = levels.choose(near)
    assert 0 < len(chosen.start) < 5_000
    assert set(np.round(path.points[chosen.start, 0] / 5)) == {16}
    longest = np.linalg.norm(path.points[chosen.end] - path.points[chosen.start], axis=1).max()
    assert longest < 10
    noise = np.random.default_rng(1).uniform(-50, 50, (1_000_001, 3))
    crowded = Levels(polyline([through(noise)], 1e-3)).choose(camera((0, 0, 300), (0, 0, 0)))
    assert len(crowded.start) <= 60_000


@given(points, direction, st.integers(0, 38), st.floats(0.0, 1.0))
def test_the_nearest_piece_is_found(
    rows: list[tuple[float, float, float]], way: Numbers, number: int, share: float
) -> None:
    path = polyline([through(np.array(rows))], 1e-3)
    number %= len(path.of)
    target = path.points[number] + share * (path.points[number + 1] - path.points[number])
    place = target + 200 * way / np.linalg.norm(way)
    ahead = (target - place) / 200
    found = Levels(path).nearest(place, ahead, 0.01)
    assert found is not None
    # It may be another one that the ray meets too, but then it goes through that one.
    samples = path.points[found] + np.linspace(0, 1, 2001)[:, None] * (
        path.points[found + 1] - path.points[found]
    )
    to = samples - place
    across = np.linalg.norm(to - (to @ ahead)[:, None] * ahead, axis=1)
    assert across.min() < 0.06


def test_nothing_is_near() -> None:
    path = polyline([through(np.array([[0, 0, 0], [10, 0, 0]]))], 1e-3)
    levels = Levels(path)
    down = np.array([0.0, 0.0, -1.0])
    assert levels.nearest(np.array([5.0, 0.4, 100.0]), down, 0.005) == 0
    assert levels.nearest(np.array([5.0, 0.6, 100.0]), down, 0.005) is None
    assert levels.nearest(np.array([5.0, 0.0, -100.0]), down, 0.005) is None
    assert Levels(polyline([], 1e-3)).nearest(np.zeros(3), down, 0.1) is None


def test_nothing_is_drawn_of_an_empty_path() -> None:
    assert len(Levels(polyline([], 1e-3)).choose(camera((0, 0, 1), (0, 0, 0))).start) == 0
