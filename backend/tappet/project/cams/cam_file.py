"""The text file that SMC_WriteCAM writes and SMC_ReadCAM reads (CAM-82; docs/cam-files.md)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

from tappet.project.cams.checks import POLYNOMIAL_LAWS, law_name
from tappet.project.cams.elements import xyva_points
from tappet.project.cams.laws import values_in
from tappet.project.cams.table import (
    LAST_TRACK,
    MOST_POINTS,
    MOST_TAPPETS,
    NARROWEST,
    CamPoint,
    CamSegment,
    CamTable,
    CamTappet,
    CamTrack,
    Law,
    TappetAction,
    number_text,
)
from tappet.project.cams.texts import CamTextError, lines_of, number_in
from tappet.project.data import Data
from tappet.project.errors import ProjectError

FIRST_WORD = "CAM"
_ACTIONS: tuple[TappetAction, ...] = ("on", "off", "invert")
_XYVA, _POLYNOMIALS = 3, 0
_COLUMNS = {_XYVA: 4, _POLYNOMIALS: 7}
_EQUAL = 1e-9
"""States of a point on both sides that differ by less than this part are the same."""
_LONGEST_NAME = 80


class NoCamFileError(ProjectError):
    """A cam that its file cannot hold."""

    code = "no_cam_file"


@dataclass(frozen=True, slots=True)
class _Piece:
    """A polynomial of fifth degree between two points."""

    left: CamPoint
    right: CamPoint
    line: int
    """Where it stands in the text."""
    law: Law = "poly5"

    @property
    def width(self) -> float:
        return self.right.x - self.left.x

    def is_(self, law: Law) -> bool:
        """Whether a simpler law gives the same curve."""
        simple = CamSegment(law=law)
        ends = [values_in(self.left, simple, self.right, at.x) for at in (self.left, self.right)]
        states = (self.left, self.right)
        return all(
            _same_v(found.v, state.v, self) and _same_a(found.a, state.a, self)
            for found, state in zip(ends, states, strict=True)
        )


def written_file(name: str, cam: CamTable) -> str:
    """The file of a cam. Raises NoCamFileError for laws that polynomials of fifth degree are not."""
    for left, segment, _ in cam.pieces():
        if segment.law not in POLYNOMIAL_LAWS:
            raise NoCamFileError(
                f"The segment behind X = {number_text(left.x)} is of the type {law_name(segment.law)}; a cam "
                "file has polynomials up to the fifth degree. Choose another type, or write points."
            )
    points = xyva_points(cam)
    tappets = list(_tappet_rows(cam))
    first, last = cam.domain
    rows = [
        f"{FIRST_WORD} 1",
        f"TYPE {_XYVA}",
        f"RANGE {number_text(first)} {number_text(last)}",
        f"NAME {name[:_LONGEST_NAME]}",
        f"ELEMENTS {len(points)}",
        *(" ".join(number_text(value) for value in (p.x, p.y, p.v, p.a)) for p in points),
        f"TAPPETS {len(tappets)}",
        *tappets,
        "END",
    ]
    return "\n".join(rows) + "\n"


def _tappet_rows(cam: CamTable) -> Iterator[str]:
    for track in cam.tracks:
        for one in track.tappets:
            passes = [(0, one.positive), (2, one.negative)]
            if one.positive == one.negative:
                passes = [(1, one.positive)]
            for direction, action in passes:
                if action != "none":
                    yield f"{track.id} {number_text(one.x)} {direction} {_ACTIONS.index(action)} 0 0"


def read_file(text: str, cam: CamTable) -> CamTable:
    """The cam with points, segments and tracks of a file. Raises CamTextError."""
    reader = _Reader(text)
    version = reader.words(FIRST_WORD, 1)
    if version != ["1"]:
        raise reader.wrong(f"version {version[0][:20]} is not known; 1 is")
    kind = reader.whole("TYPE", _XYVA)
    if kind not in _COLUMNS:
        raise reader.wrong(
            f"the type {kind} is not read; {_XYVA} (points) and {_POLYNOMIALS} (polynomials) are"
        )
    first, last = (number_in(word, reader.line) for word in reader.words("RANGE", 2))
    if not last - first >= NARROWEST:
        raise reader.wrong("the end of the range does not lie behind its start")
    reader.rest("NAME")
    count = reader.whole("ELEMENTS", 2 * MOST_POINTS)
    rows = [reader.numbers(_COLUMNS[kind]) for _ in range(count)]
    states = _joined(rows) if kind == _XYVA else _of_polynomials(rows, last)
    tracks = _tracks(reader, first, last)
    reader.words("END", 0)
    if not states:
        raise CamTextError(reader.line, "a cam has at least two points")
    ends = states[0].left.x, states[-1].right.x
    if ends != (first, last):
        raise CamTextError(
            states[0].line,
            f"the elements go from {number_text(ends[0])} to {number_text(ends[1])}, not over the range from "
            f"{number_text(first)} to {number_text(last)}",
        )
    points, segments = _points(states)
    if len(points) > MOST_POINTS:
        raise CamTextError(states[MOST_POINTS].line, f"a cam has at most {MOST_POINTS} points")
    fields = {"points": points, "segments": segments, "tracks": tracks}
    return CamTable.model_validate({**cam.model_dump(), **_plain(fields)})


def _plain(fields: Mapping[str, Sequence[Data]]) -> dict[str, object]:
    return {name: [one.model_dump() for one in rows] for name, rows in fields.items()}


class _Reader:
    """Goes through the lines."""

    def __init__(self, text: str) -> None:
        self._lines = [line.strip() for line in lines_of(text)]
        while self._lines and not self._lines[-1]:
            self._lines.pop()
        self.line = 1
        """The one that is read next; then the one that was read last."""
        self._next = 0

    def wrong(self, reason: str) -> CamTextError:
        """About the line that was read last."""
        return CamTextError(self.line, reason)

    def rest(self, keyword: str) -> str:
        """What stands behind the word that the next line begins with."""
        text = self._take()
        word, _, rest = text.partition(" ")
        if word != keyword:
            raise self.wrong(f"{keyword} is expected, not '{text[:40]}'")
        return rest

    def words(self, keyword: str, count: int) -> list[str]:
        """So many words behind one."""
        found = self.rest(keyword).split()
        if len(found) != count:
            raise self.wrong(f"{count} words are expected behind {keyword}, not {len(found)}")
        return found

    def whole(self, keyword: str, most: int) -> int:
        """A number from 0 behind a word."""
        (word,) = self.words(keyword, 1)
        if not (word.isascii() and word.isdigit() and len(word) < 10):
            raise self.wrong(f"'{word[:40]}' is no whole number")
        if int(word) > most:
            raise self.wrong(f"{keyword} is at most {most}")
        return int(word)

    def numbers(self, count: int) -> tuple[int, list[float]]:
        """The next line, of numbers, with its own."""
        found = self._take().split()
        if len(found) != count:
            raise self.wrong(f"{count} numbers are expected, not {len(found)}")
        return self.line, [number_in(word, self.line) for word in found]

    def _take(self) -> str:
        if self._next >= len(self._lines):
            raise CamTextError(self._next + 1, "the file ends too early; its last line is END")
        self._next += 1
        self.line = self._next
        return self._lines[self._next - 1]


def _joined(rows: list[tuple[int, list[float]]]) -> list[_Piece]:
    """Pieces between points; a point may stand twice, where the curve bends."""
    points = [(line, CamPoint(**dict(zip("xyva", row, strict=True)))) for line, row in rows]
    found = []
    for (start, left), (line, right) in pairwise(points):
        if right.x == left.x:
            if abs(right.y - left.y) > _EQUAL * max(abs(right.y), abs(left.y)):
                raise CamTextError(line, f"the position jumps at X = {number_text(right.x)}")
        elif not right.x - left.x >= NARROWEST:
            raise CamTextError(line, f"{number_text(right.x)} does not lie behind {number_text(left.x)}")
        else:
            found.append(_Piece(left, right, start))
    return found


def _of_polynomials(rows: list[tuple[int, list[float]]], last: float) -> list[_Piece]:
    """Pieces with the states at the ends of polynomials by the distance from where they start."""
    found: list[_Piece] = []
    ends = [row[0] for _, row in rows[1:]] + [last]
    for (line, (start, *powers)), end in zip(rows, ends, strict=True):
        if not end - start >= NARROWEST:
            raise CamTextError(line, f"{number_text(end)} does not lie behind {number_text(start)}")
        left, right = (_state(line, powers, start, x) for x in (start, end))
        if found and abs(found[-1].right.y - left.y) > _EQUAL * max(
            abs(left.y), abs(right.y), abs(found[-1].left.y)
        ):
            raise CamTextError(line, f"the position jumps at X = {number_text(start)}")
        found.append(_Piece(left, right, line))
    return found


def _state(line: int, powers: list[float], start: float, x: float) -> CamPoint:
    values = []
    for _ in range(3):
        value = 0.0
        for factor in reversed(powers):
            value = value * (x - start) + factor
        values.append(number_in(repr(value), line))
        powers = [n * factor for n, factor in enumerate(powers)][1:]
    return CamPoint(x=x, y=values[0], v=values[1], a=values[2])


def _same_v(one: float, other: float, *pieces: _Piece) -> bool:
    return abs(one - other) <= _EQUAL * max(_velocity(piece) for piece in pieces)


def _same_a(one: float, other: float, *pieces: _Piece) -> bool:
    """Rounding of positions and velocities shows in it, too."""
    sizes = [max(abs(p.left.a), abs(p.right.a), _velocity(p) / p.width) for p in pieces]
    return abs(one - other) <= _EQUAL * max(sizes)


def _velocity(piece: _Piece) -> float:
    rise = max(abs(piece.left.y), abs(piece.right.y)) / piece.width
    return max(abs(piece.left.v), abs(piece.right.v), rise)


def _points(pieces: list[_Piece]) -> tuple[tuple[CamPoint, ...], tuple[CamSegment, ...]]:
    """Points with one state each: where the curve bends, a simpler law beside it needs none."""
    points = [pieces[0].left]
    for number in range(1, len(pieces)):
        before, behind = pieces[number - 1], pieces[number]
        left, right = before.right, behind.left
        slope = _same_v(left.v, right.v, before, behind)
        if slope and _same_a(left.a, right.a, before, behind):
            points.append(right)
            continue
        if before.law == "line" or before.is_("line"):
            pieces[number - 1] = replace(before, law="line")
            points.append(right)
        elif behind.is_("line"):
            pieces[number] = replace(behind, law="line")
            points.append(left)
        elif slope and (before.law == "poly3" or before.is_("poly3")):
            pieces[number - 1] = replace(before, law="poly3")
            points.append(right)
        elif slope and behind.is_("poly3"):
            pieces[number] = replace(behind, law="poly3")
            points.append(left)
        else:
            what = "acceleration" if slope else "velocity"
            raise CamTextError(
                behind.line,
                f"the {what} jumps at X = {number_text(right.x)} between two polynomials; a point of the "
                "editor has one value of it",
            )
    points.append(pieces[-1].right)
    return tuple(points), tuple(CamSegment(law=piece.law) for piece in pieces)


def _tracks(reader: _Reader, first: float, last: float) -> tuple[CamTrack, ...]:
    """Both directions of a tappet stand in two rows, one behind the other."""
    found: list[tuple[int, CamTappet]] = []
    for _ in range(reader.whole("TAPPETS", 2 * MOST_TAPPETS)):
        group, x, direction, action, *times = reader.numbers(6)[1]
        if group != int(group) or not 1 <= group <= LAST_TRACK:
            raise reader.wrong(f"a track is a whole number from 1 to {LAST_TRACK}")
        if not first <= x <= last:
            raise reader.wrong(f"the tappet at {number_text(x)} lies outside the range")
        if direction not in (0, 1, 2):
            raise reader.wrong("the direction of a tappet is 0, 1 or 2")
        if action not in (0, 1, 2) or any(times):
            raise reader.wrong("tappets of the editor switch on, off or invert (0, 1 or 2), without times")
        switch = _ACTIONS[int(action)]
        track = int(group)
        if direction == 2 and found and _misses_negative(found[-1], track, x):
            found[-1] = track, found[-1][1].model_copy(update={"negative": switch})
        else:
            positive = switch if direction < 2 else "none"
            negative = switch if direction > 0 else "none"
            found.append((track, CamTappet(x=x, positive=positive, negative=negative)))
    ordered = sorted(found, key=lambda one: one[0])
    for track, rows in groupby(ordered, key=lambda one: one[0]):
        if sum(1 for _ in rows) > MOST_TAPPETS:
            raise reader.wrong(f"track {track} has more than {MOST_TAPPETS} tappets")
    return tuple(
        CamTrack(id=track, tappets=tuple(tappet for _, tappet in rows))
        for track, rows in groupby(ordered, key=lambda one: one[0])
    )


def _misses_negative(one: tuple[int, CamTappet], track: int, x: float) -> bool:
    tappet = one[1]
    return one[0] == track and tappet.x == x and tappet.positive != "none" and tappet.negative == "none"
