"""Points of a cam as lists of numbers: ASCII tables and CSV (CAM-80, CAM-81; cam EX-08).

An ASCII table has a pair of positions in a line. A CSV has a heading and columns for the derivatives and the
law of the segment behind a point; it comes back as it was to the last bit.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, cast, get_args

from tappet.project.cams.elements import equidistant
from tappet.project.cams.laws import value_at
from tappet.project.cams.table import (
    MOST_POINTS,
    NARROWEST,
    CamPoint,
    CamSegment,
    CamTable,
    Law,
    number_text,
)
from tappet.project.cams.texts import CamTextError, lines_of, number_in

ListFormat = Literal["ascii", "csv"]
COLUMNS = ("x", "y", "v", "a", "j", "law", "inflection")
_NUMBERS = 5
_HEADINGS = {"segment": "law", "type": "law", "lambda": "inflection"}
_BLANKS = re.compile(r"[ \t]+")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class PointList:
    """What was read."""

    points: tuple[CamPoint, ...]
    segments: tuple[CamSegment, ...]
    positions_only: bool
    """The derivatives are not known."""
    lines: tuple[int, ...]
    """Where the points stand in the text."""


def written_points(cam: CamTable, format: ListFormat, count: int, *, points_only: bool) -> str:
    """So many points at equal distances of the master, or those of the cam."""
    if points_only:
        points, segments = cam.points, cam.segments
    else:
        places = [x for x, _ in equidistant(cam, count)]
        points = tuple(_point_at(cam, x) for x in places)
        segments = (CamSegment(),) * (count - 1)
    if format == "ascii":
        return "".join(f"{number_text(point.x)} {number_text(point.y)}\n" for point in points)
    rows = [",".join(COLUMNS)]
    for number, point in enumerate(points):
        cells = [number_text(getattr(point, name)) for name in COLUMNS[:_NUMBERS]]
        if number < len(segments):
            cells += [segments[number].law, number_text(segments[number].inflection)]
        rows.append(",".join(cells))
    return "\n".join(rows) + "\n"


def read_points(text: str) -> PointList:
    """Points of either format; what separates columns is blanks, tabs, semicolons or commas.

    Raises CamTextError.
    """
    rows = _rows(text)
    if not rows:
        raise CamTextError(1, "there are no numbers; a cam has at least two pairs of positions")
    columns = _heading(*rows[0])
    if columns is None:
        columns = _columns(*rows[0])
    else:
        rows = rows[1:]
    points: list[CamPoint] = []
    segments: list[CamSegment] = []
    for line, cells in rows:
        point, segment = _read_row(line, cells, columns)
        if points and not point.x - points[-1].x >= NARROWEST:
            raise CamTextError(
                line,
                f"{number_text(point.x)} does not lie behind {number_text(points[-1].x)}, the position of "
                "the master before it",
            )
        if len(points) == MOST_POINTS:
            raise CamTextError(line, f"a cam has at most {MOST_POINTS} points")
        points.append(point)
        segments.append(segment)
    if len(points) < 2:
        raise CamTextError(rows[-1][0] if rows else 1, "a cam has at least two pairs of positions")
    laws = () if "law" in columns else (_law_of(columns),) * (len(points) - 1)
    lines = tuple(line for line, _ in rows)
    return PointList(tuple(points), laws or tuple(segments[:-1]), "v" not in columns, lines)


def _point_at(cam: CamTable, x: float) -> CamPoint:
    values = value_at(cam, x)
    return CamPoint(x=x, y=values.y, v=values.v, a=values.a, j=values.j)


def _rows(text: str) -> list[tuple[int, list[str]]]:
    """Cells of the lines that are not empty and no comment, with their numbers from 1."""
    kept = [
        (number, line.strip())
        for number, line in enumerate(lines_of(text), 1)
        if line.strip() and not line.lstrip().startswith(("#", "//"))
    ]
    body = "\n".join(line for _, line in kept)
    for separator in (";", "\t", ","):
        if separator in body:
            return [(number, [cell.strip() for cell in line.split(separator)]) for number, line in kept]
    return [(number, _BLANKS.split(line)) for number, line in kept]


def _heading(line: int, cells: Sequence[str]) -> list[str] | None:
    names = [_HEADINGS.get(cell.strip('"').lower(), cell.strip('"').lower()) for cell in cells]
    if not names[0].isalpha():
        return None
    for name, cell in zip(names, cells, strict=True):
        if name not in COLUMNS or names.count(name) > 1:
            raise CamTextError(line, f"'{cell[:40]}' is no column; columns are {', '.join(COLUMNS)}")
    if "x" not in names or "y" not in names:
        raise CamTextError(line, "the columns x and y are missing")
    return names


def _columns(line: int, cells: Sequence[str]) -> list[str]:
    """By their number, where no heading names them."""
    if not 2 <= len(cells) <= _NUMBERS:
        raise CamTextError(line, f"{len(cells)} columns without a heading; a pair of positions is expected")
    return list(COLUMNS[: len(cells)])


def _law_of(columns: Sequence[str]) -> CamSegment:
    """The highest polynomial that the derivatives are known for; positions alone get theirs afterwards."""
    return CamSegment(law="poly3" if "v" in columns and "a" not in columns else "poly5")


def _read_row(line: int, cells: Sequence[str], columns: Sequence[str]) -> tuple[CamPoint, CamSegment]:
    optional = sum(name in ("law", "inflection") for name in columns)
    if not len(columns) - optional <= len(cells) <= len(columns):
        raise CamTextError(line, f"{len(columns)} columns are expected, not {len(cells)}")
    given = {name: cell.strip('"') for name, cell in zip(columns, cells, strict=False)}
    numbers = {
        name: number_in(_with_point(given[name]), line) for name in COLUMNS[:_NUMBERS] if name in given
    }
    law = given.get("law", "") or "poly5"
    if law not in get_args(Law):
        raise CamTextError(line, f"'{law[:40]}' is no law; laws are {', '.join(get_args(Law))}")
    inflection = number_in(_with_point(given.get("inflection", "") or "0.5"), line)
    if not 0 < inflection < 1:
        raise CamTextError(line, "the inflection point lies between 0 and 1")
    return CamPoint(**numbers), CamSegment(law=cast(Law, law), inflection=inflection)


def _with_point(word: str) -> str:
    """Spreadsheets of many countries write a comma for the decimal point."""
    return word.replace(",", ".") if _DECIMAL_COMMA.fullmatch(word) else word
