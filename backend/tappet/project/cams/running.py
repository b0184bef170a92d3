"""A cam of an application that runs: read back into the editor, and a changed one written to its variables.

The program may change the elements of a compiled cam (CAM-94), and so does the cam editor online. There is
room for as many elements and tappets as the cam had when it was compiled, and its format stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

from tappet.project.cams.checks import findings
from tappet.project.cams.elements import equal_steps
from tappet.project.cams.pieces import Piece, joined, points_of
from tappet.project.cams.table import (
    FARTHEST,
    LAWS,
    NARROWEST,
    CamPoint,
    CamSegment,
    CamTable,
    CompileFormat,
    Law,
    number_text,
)
from tappet.project.cams.tappets import tracks_of
from tappet.project.cams.texts import CamTextError
from tappet.project.cams.variables import BY_TYPE, CamVariables, variables_of
from tappet.project.errors import ProjectError

Curve = tuple[Sequence[CamPoint], Sequence[CamSegment]]
_USED: Mapping[Law, str] = {
    "line": "",
    "poly3": "v",
    "poly5": "va",
    "poly7": "vaj",
    "sine": "",
    "inclined_sine": "",
    "modified_sine": "v",
    "harmonic": "va",
}
"""Derivatives of its ends that the curve of a law depends on."""
_WORDS = {"v": "velocity", "a": "acceleration", "j": "jerk"}
_EQUAL = 1e-9
"""Values of both sides of a point that differ by less than this part are the same."""


class RunningCamError(ProjectError):
    """A cam of an application that the editor cannot take, or one that the application has no room for."""

    code = "running_cam"


@dataclass(frozen=True, slots=True)
class RunningCam:
    """The variables of a cam as the application has them."""

    format: CompileFormat
    room: int
    """Elements that the array was compiled with; of a table its size."""
    tappet_room: int
    cam: Mapping[str, Any]
    """Members of MC_CAM_REF."""
    elements: Sequence[Mapping[str, Any]]
    """All of the array, or the one table."""
    tappets: Sequence[Mapping[str, Any]]


def read_back(name: str, running: RunningCam, cam: CamTable) -> CamTable:
    """`cam` with the curve and the tappets of the application; itself where they are its own.

    Raises RunningCamError for what is no cam, or none that the editor can show.
    """
    count = running.cam["nElements"]
    least = 1 if running.format == "segments" else 2
    if running.cam["byType"] != BY_TYPE[running.format] or not least <= count <= running.room:
        raise RunningCamError(
            f"The program has changed '{name}': byType is {running.cam['byType']} and nElements is {count}, "
            f"but the elements that were compiled are {running.room} of type {BY_TYPE[running.format]}"
        )
    if _holds(running, cam):
        return cam
    try:
        _check_numbers(running)
        points, segments = _curve(running, count, cam)
        first, last = running.cam["xStart"], running.cam["xEnd"]
        rows = [
            (number + 1, [row[member] for member in ("iGroupID", "x", "ctt", "cta", "dwDelay", "dwDuration")])
            for number, row in enumerate(running.tappets[: running.cam["nTappets"]])
        ]
        found = {
            "points": [one.model_dump() for one in points],
            "segments": [one.model_dump() for one in segments],
            "tracks": [one.model_dump() for one in tracks_of(rows, first, last)],
        }
        return CamTable.model_validate({**cam.model_dump(), **found})
    except CamTextError as error:
        raise RunningCamError(
            f"Element {error.line} of '{name}' in the application: {error.reason}"
        ) from error


def to_write(name: str, running: RunningCam, cam: CamTable) -> CamVariables:
    """The values that make the application run `cam`. Raises RunningCamError when there is no room for it."""
    fitted = _fitted(running, cam)
    for one in findings(fitted):
        if one.severity == "error":
            raise RunningCamError(one.text)
    values = variables_of(fitted)
    if len(values.elements) > running.room:
        raise RunningCamError(
            f"The application has room for {running.room} elements of '{name}', and the cam has "
            f"{len(values.elements)}; load it by an online change"
        )
    if len(values.tappets) > running.tappet_room:
        raise RunningCamError(
            f"The application has room for {running.tappet_room} tappets of '{name}', and the cam has "
            f"{len(values.tappets)}; load it by an online change"
        )
    return values


def _fitted(running: RunningCam, cam: CamTable) -> CamTable:
    """The cam in the format that the application has it in."""
    update: dict[str, Any] = {"compile_format": running.format}
    if running.format in ("one_dimensional", "two_dimensional"):
        update |= {"table_size": running.room, "cubic": running.cam["byInterpolationQuality"] == 3}
    return cam.model_copy(update=update)


def _holds(running: RunningCam, cam: CamTable) -> bool:
    """Whether the variables are those of the cam."""
    values = variables_of(_fitted(running, cam))
    return (
        _same(values.cam, running.cam)
        and all(_same(*both) for both in zip(values.elements, running.elements, strict=False))
        and all(_same(*both) for both in zip(values.tappets, running.tappets, strict=False))
    )


def _same(wanted: Mapping[str, Any], found: Mapping[str, Any]) -> bool:
    return all(found[name] == value for name, value in wanted.items())


def _check_numbers(running: RunningCam) -> None:
    """Raises CamTextError for what the program has made of a number."""
    for number, row in enumerate((*running.elements, running.cam), 1):
        for name, value in row.items():
            for one in _numbers(value):
                if not abs(one) <= FARTHEST:
                    raise CamTextError(number, f"{name} is {one}; positions and derivatives are at most 1e12")


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, list):
        for one in value:
            yield from _numbers(one)
    elif isinstance(value, float):
        yield value


def _curve(running: RunningCam, count: int, cam: CamTable) -> Curve:
    """Points and segments over the range of the master. Raises CamTextError with the number of an element."""
    if running.format == "polynomial":
        points, segments = _polynomials(running.elements[:count], cam)
    elif running.format == "segments":
        points, segments = _segments(running.elements[:count])
    else:
        points, segments = _table(running, count)
    ends = points[0].x, points[-1].x
    if ends != (running.cam["xStart"], running.cam["xEnd"]):
        wanted = (number_text(running.cam["xStart"]), number_text(running.cam["xEnd"]))
        raise CamTextError(1, f"the elements do not go from xStart = {wanted[0]} to xEnd = {wanted[1]}")
    return points, segments


def _polynomials(elements: Sequence[Mapping[str, Any]], cam: CamTable) -> Curve:
    """A segment of the editor keeps its law where that gives the curve of the application."""
    rows = [(number + 1, [row[f"d{name}"] for name in "XYVA"]) for number, row in enumerate(elements)]
    laws = {(left.x, right.x): segment.law for left, segment, right in cam.pieces()}
    return points_of([_by_law(piece, laws) for piece in joined(rows)])


def _by_law(piece: Piece, laws: Mapping[tuple[float, float], Law]) -> Piece:
    law = laws.get((piece.left.x, piece.right.x), "poly5")
    return replace(piece, law=law) if law in ("line", "poly3") and piece.is_(law) else piece


def _segments(elements: Sequence[Mapping[str, Any]]) -> Curve:
    segments = [_segment(number, row) for number, row in enumerate(elements, 1)]
    starts = [_end(row, 0) for row in elements]
    ends = [_end(row, 1) for row in elements]
    sides = zip(ends, segments, starts[1:], segments[1:], strict=False)
    joints = [_joint(number + 2, *side) for number, side in enumerate(sides)]
    return [starts[0], *joints, ends[-1]], segments


def _segment(element: int, row: Mapping[str, Any]) -> CamSegment:
    if not row["dX1"] - row["dX0"] >= NARROWEST:
        raise CamTextError(
            element, f"{number_text(row['dX1'])} does not lie behind {number_text(row['dX0'])}"
        )
    if not 0 <= row["eType"] < len(LAWS):
        raise CamTextError(element, f"eType is {row['eType']}; laws have numbers from 0 to {len(LAWS) - 1}")
    if not 0 < row["dLambda"] < 1:
        raise CamTextError(element, f"dLambda is {number_text(row['dLambda'])}; it lies between 0 and 1")
    return CamSegment(law=LAWS[row["eType"]], inflection=row["dLambda"])


def _end(row: Mapping[str, Any], end: int) -> CamPoint:
    return CamPoint(**{name: row[f"d{name.upper()}{end}"] for name in "xyvaj"})


def _joint(element: int, left: CamPoint, before: CamSegment, right: CamPoint, behind: CamSegment) -> CamPoint:
    """A point has the derivatives that the segments beside it depend on."""
    if left.x != right.x or not _equal(left.y, right.y):
        raise CamTextError(
            element,
            f"it begins at X = {number_text(right.x)}, Y = {number_text(right.y)}, and the one before ends "
            f"at X = {number_text(left.x)}, Y = {number_text(left.y)}",
        )
    values = {}
    for name, word in _WORDS.items():
        of_left, of_right = getattr(left, name), getattr(right, name)
        used = name in _USED[before.law], name in _USED[behind.law]
        if all(used) and not _equal(of_left, of_right):
            raise CamTextError(
                element,
                f"the {word} jumps from {number_text(of_left)} to {number_text(of_right)}; a point of the "
                "editor has one value of it",
            )
        values[name] = of_left if used == (True, False) else of_right
    return right.model_copy(update=values)


def _equal(one: float, other: float) -> bool:
    return abs(one - other) <= _EQUAL * max(abs(one), abs(other))


def _table(running: RunningCam, count: int) -> Curve:
    """The points of a table, with lines between them or the cubic polynomials of the library."""
    (table,) = running.elements
    limits = [name for name in table if name.startswith("fEditor")]
    if count != running.room or any(table[name] != table[f"fTable{name[7:]}"] for name in limits):
        raise CamTextError(1, "the program has changed the size or the ranges of the table")
    if running.format == "two_dimensional":
        places = [(x, y) for x, y in table["Table"]]
        for number, (left, right) in enumerate(pairwise(places), 2):
            if not right[0] - left[0] >= NARROWEST:
                raise CamTextError(
                    number, f"{number_text(right[0])} does not lie behind {number_text(left[0])}"
                )
    else:
        steps = equal_steps(running.cam["xStart"], running.cam["xEnd"], count)
        places = list(zip(steps, table["Table"], strict=True))
    cubic = running.cam["byInterpolationQuality"] == 3
    slopes = _slopes(places) if cubic else [0.0] * count
    law: Law = "poly3" if cubic else "line"
    points = [CamPoint(x=x, y=y, v=v) for (x, y), v in zip(places, slopes, strict=True)]
    return points, [CamSegment(law=law)] * (count - 1)


def _slopes(places: Sequence[tuple[float, float]]) -> list[float]:
    """At each point that of the parabola through it and its neighbours, as the library has it."""
    rises = [(right[1] - left[1]) / (right[0] - left[0]) for left, right in pairwise(places)]
    if len(places) == 2:
        return rises * 2
    inner = [
        ((places[n][0] - places[n - 1][0]) * rises[n] + (places[n + 1][0] - places[n][0]) * rises[n - 1])
        / (places[n + 1][0] - places[n - 1][0])
        for n in range(1, len(places) - 1)
    ]
    return [2 * rises[0] - inner[0], *inner, 2 * rises[-1] - inner[-1]]
