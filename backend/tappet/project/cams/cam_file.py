"""The text file that SMC_WriteCAM writes and SMC_ReadCAM reads (CAM-82; docs/cam-files.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tappet.project.cams.checks import POLYNOMIAL_LAWS, law_name
from tappet.project.cams.elements import xyva_points
from tappet.project.cams.pieces import joined, of_polynomials, points_of
from tappet.project.cams.table import MOST_POINTS, MOST_TAPPETS, NARROWEST, CamTable, number_text
from tappet.project.cams.tappets import entries, tracks_of
from tappet.project.cams.texts import CamTextError, lines_of, number_in
from tappet.project.data import Data
from tappet.project.errors import ProjectError

FIRST_WORD = "CAM"
_XYVA, _POLYNOMIALS = 3, 0
_COLUMNS = {_XYVA: 4, _POLYNOMIALS: 7}
_LONGEST_NAME = 80


class NoCamFileError(ProjectError):
    """A cam that its file cannot hold."""

    code = "no_cam_file"


def written_file(name: str, cam: CamTable) -> str:
    """The file of a cam. Raises NoCamFileError for laws that polynomials of fifth degree are not."""
    for left, segment, _ in cam.pieces():
        if segment.law not in POLYNOMIAL_LAWS:
            raise NoCamFileError(
                f"The segment behind X = {number_text(left.x)} is of the type {law_name(segment.law)}; a cam "
                "file has polynomials up to the fifth degree. Choose another type, or write points."
            )
    points = xyva_points(cam)
    tappets = [
        f"{id} {number_text(x)} {direction} {action} 0 0"
        for track in cam.tracks
        for tappet in track.tappets
        for id, x, direction, action in entries(track.id, tappet)
    ]
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
    states = joined(rows) if kind == _XYVA else of_polynomials(rows, last)
    tappets = [reader.numbers(6) for _ in range(reader.whole("TAPPETS", 2 * MOST_TAPPETS))]
    tracks = tracks_of(tappets, first, last)
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
    points, segments = points_of(states)
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
