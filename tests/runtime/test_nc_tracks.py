"""SMC_PathCopierFile and SMC_PositionTracker: tracks of points for a picture of the path."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from file_programs import FileProgram

POINTS = 60
PROGRAM = f"""PROGRAM PLC_PRG
VAR
    pcf      : SMC_PathCopierFile;
    pt       : SMC_PositionTracker;
    aPoints  : ARRAY[0..{POINTS - 1}] OF VisuStruct3DPathPoint;
    aTrack   : ARRAY[0..3] OF VisuStruct3DPathPoint;
    afPoints : ARRAY[0..{POINTS * 4 - 1}] OF LREAL;
    afTrack  : ARRAY[0..3] OF LREAL;
    xExecute, xEnable, xClear : BOOL;
    nRoom    : UDINT := {POINTS};
    fX       : LREAL;
    n        : UDINT;
END_VAR
pcf(bExecute := xExecute, sFileName := 'main.cnc', pBuffer := ADR(aPoints),
    udiNumberOfPointsInArray := nRoom);
FOR n := 0 TO {POINTS - 1} DO
    afPoints[4 * n] := aPoints[n].v.dX;
    afPoints[4 * n + 1] := aPoints[n].v.dY;
    afPoints[4 * n + 2] := aPoints[n].udiSourceElementID;
    afPoints[4 * n + 3] := aPoints[n].dwAddInfo;
END_FOR
pt(bEnable := xEnable, bClear := xClear, dX := fX, pBuffer := ADR(aTrack), udiNumberOfPointsInArray := 4);
FOR n := 0 TO 3 DO
    afTrack[n] := -1;
    IF n < pt.vs3dt.udiNumberOfPointsToDraw THEN
        afTrack[n] := aTrack[(pt.vs3dt.udiFirstPoint + n) MOD 4].v.dX;
    END_IF
END_FOR
END_PROGRAM
"""


class Tracks(FileProgram):
    text = PROGRAM

    def copy(self, text: str) -> np.ndarray:
        """X, Y, line and mark of the points of a program."""
        (self.folder / "main.cnc").write_text(text)
        self.set(xExecute=False)
        self.runtime.run(cycles=2)
        self.set(xExecute=True)
        for _ in range(600):
            self.runtime.run(cycles=3)
            if self.literal("pcf.bBusy") == "FALSE":
                break
        count = int(self.literal("pcf.vs3dt.udiNumberOfPointsToDraw"))
        numbers = np.array(ast.literal_eval(self.literal("afPoints")), dtype=float)
        return numbers.reshape(-1, 4)[:count]


@pytest.fixture
def tracks(tmp_path: Path) -> Iterator[Tracks]:
    with Tracks.running(tmp_path) as running:
        yield running


def test_lines_and_curves_of_a_file(tracks: Tracks) -> None:
    """Ends of lines with their N; an arc in pieces of one unit; a subprogram, and a synchronisation."""
    (tracks.folder / "side.cnc").write_text("SUBPROGRAM Side{#y : LREAL}\nN7 G1 Y#y\nEND_SUBPROGRAM")
    points = tracks.copy("N1 G0 X10\nN2 G1 Y5\nN3 G75\nN4 Side{0}\nN5 G2 X30 Y0 R10\nN6 G31 X40")
    assert tracks.literal("pcf.bDone") == "TRUE"
    assert points[:4].tolist() == [[0, 0, 0, 0], [10, 0, 1, 1], [10, 5, 2, 0], [10, 0, 7, 0]]
    arc = points[4:-1]
    assert len(arc) == 31  # whole units of pi * 10
    assert np.hypot(arc[:, 0] - 20, arc[:, 1]) == pytest.approx(np.full(31, 10.0))
    assert np.degrees(np.arctan2(arc[:, 1], arc[:, 0] - 20))[:-1] == pytest.approx(
        180 - 180 * np.arange(1, 31) / 31
    )
    assert points[-1].tolist() == [40, 0, 6, 0]


@pytest.mark.parametrize(("count", "step"), [(59, 1), (60, 2), (500, 16), (40, 1)])
def test_a_path_with_more_points_than_room(tracks: Tracks, count: int, step: int) -> None:
    """Each second, fourth ... one stays, and the last one."""
    points = tracks.copy("".join(f"G1 X{n} Y{n % 3}\n" for n in range(1, count + 1)))
    assert points[:-1, 0].tolist() == list(range(0, count, step))
    assert points[-1, 0] == count


def test_errors_of_the_copier(tracks: Tracks) -> None:
    """What the reader and the interpreter say; the track goes up to there. No room is an error."""
    points = tracks.copy("G1 X5\nG1 X6\nG77")
    assert (tracks.literal("pcf.bError"), tracks.literal("pcf.iErrorID")) == (
        "TRUE",
        "SMC_DEC_INVALID_SYNTAX",
    )
    assert points[:, 0].tolist() == [0, 5, 6]
    tracks.set(nRoom=1)
    tracks.copy("G1 X5")
    assert tracks.literal("pcf.iErrorID") == "SMC_RNCF_BUFFER_TOO_SMALL"


def test_the_last_positions_of_a_machine(tracks: Tracks) -> None:
    """The oldest go; a position that stays is kept once; cleared, and not enabled."""

    def track() -> list[float]:
        return [x for x in ast.literal_eval(tracks.literal("afTrack")) if x >= 0]

    tracks.set(xEnable=True)
    for x in (1.0, 1.0, 2.0, 3.0):
        tracks.set(fX=x)
        tracks.runtime.run(cycles=1)
    assert track() == [1, 2, 3]
    for x in (4.0, 5.0, 6.0):
        tracks.set(fX=x)
        tracks.runtime.run(cycles=1)
    assert track() == [3, 4, 5, 6]
    tracks.set(xEnable=False, fX=7.0)
    tracks.runtime.run(cycles=1)
    assert track() == [3, 4, 5, 6]
    tracks.set(xClear=True)
    tracks.runtime.run(cycles=1)
    assert track() == []
