"""A cam with the points of a text that somebody brings (CAM-80, CAM-82)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tappet.project.cams.cam_file import FIRST_WORD, read_file
from tappet.project.cams.checks import TOLERANCE
from tappet.project.cams.point_lists import PointList, read_points
from tappet.project.cams.table import FARTHEST, CamPoint, CamTable, number_text
from tappet.project.cams.texts import CamTextError


@dataclass(frozen=True, slots=True)
class ImportedCam:
    """What a cam became."""

    cam: CamTable
    removed_tappets: int
    """They lay outside the new range of the master."""


def imported_cam(text: str, cam: CamTable) -> ImportedCam:
    """A cam file replaces points and tracks, lists of points the points alone. Raises CamTextError."""
    if text.lstrip("\ufeff").split(maxsplit=1)[:1] == [FIRST_WORD]:
        return ImportedCam(read_file(text, cam), 0)
    found = read_points(text)
    points = _smooth(found, cam) if found.positions_only and _derivatives_matter(found) else found.points
    first, last = points[0].x, points[-1].x
    tracks = tuple(
        track.model_copy(update={"tappets": tuple(one for one in track.tappets if first <= one.x <= last)})
        for track in cam.tracks
    )
    removed = sum(len(track.tappets) for track in cam.tracks) - sum(len(track.tappets) for track in tracks)
    changed = cam.model_copy(update={"points": points, "segments": found.segments, "tracks": tracks})
    return ImportedCam(CamTable.model_validate(changed.model_dump()), removed)


def _derivatives_matter(found: PointList) -> bool:
    return any(segment.law not in ("line", "sine", "inclined_sine") for segment in found.segments)


def _smooth(found: PointList, cam: CamTable) -> tuple[CamPoint, ...]:
    """Points with the derivatives of the cubic spline through them: velocity and acceleration do not jump.

    Between its points a polynomial of fifth degree with these derivatives is the spline itself. The spline of
    a periodic cam is periodic.
    """
    from scipy.interpolate import CubicSpline  # takes a while to load

    x = np.array([point.x for point in found.points])
    y = np.array([point.y for point in found.points])
    rise = y[-1] - y[0]
    turns = rise / cam.slave_period
    if cam.periodic and len(x) > 2 and abs(turns - round(turns)) <= TOLERANCE:
        slope = rise / (x[-1] - x[0])
        flat = y - slope * (x - x[0])
        flat[-1] = flat[0]
        spline = CubicSpline(x, flat, bc_type="periodic")
    else:
        slope = 0.0
        spline = CubicSpline(x, y)
    points = []
    for line, point, v, a in zip(found.lines, found.points, spline(x, 1) + slope, spline(x, 2), strict=True):
        if not max(abs(v), abs(a)) <= FARTHEST:
            raise CamTextError(line, f"the curve is too steep at X = {number_text(point.x)}")
        points.append(CamPoint(x=point.x, y=point.y, v=float(v), a=float(a)))
    return tuple(points)
