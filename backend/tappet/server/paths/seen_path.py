"""What one looks at in a view of a path: objects, how they are drawn, what is chosen, the motion on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from tappet.motion.path_service import Motion, PathFault, PathObjects, PathService, PathSettingsError
from tappet.motion.paths.compiled_rows import as_objects
from tappet.motion.paths.geo_info import INITPOS, LINADDAXES, MCOMMAND, Numbers
from tappet.motion.paths.levels import Levels
from tappet.motion.paths.marks import Switches, switches_of
from tappet.motion.paths.polyline import Polyline, polyline, tolerance_for
from tappet.motion.paths.shades import SCALE, Colours, Legend, by_kind, by_value, moved, programmed
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.server.paths.picture import Layer, Picture
from tappet.server.paths.shapes import (
    ChosenElements,
    PathElement,
    PathLegend,
    PathLooks,
    PathMark,
    PathSamples,
    PathSummary,
    PickedElement,
)

if TYPE_CHECKING:
    import viser

MOST_MARKS = 400
"""Ends of elements and switch points that are shown as circles."""
MOST_CHOSEN = 2000
"""Elements of a line, in a loop for instance, that are shown as chosen."""
MOST_SAMPLES = 20_000
"""Of a motion, for the chart and the tool."""


@dataclass(slots=True)
class _Drawn:
    """One path."""

    path: Polyline
    switches: Switches
    fault: PathFault | None
    levels: Levels = field(init=False)

    def __post_init__(self) -> None:
        self.levels = Levels(self.path)


class SeenPath:
    """One view: takes programs, draws them, answers. Not for several threads."""

    def __init__(self, server: viser.ViserServer, service: PathService, looks: PathLooks) -> None:
        self._service = service
        self._looks = looks
        self._picture = Picture(server, dark=looks.dark)
        self._program: CncProgramData | None = None
        self._settings = CncSettingsData()
        self._paths: dict[bool, _Drawn] = {}
        """By whether they are preprocessed."""
        self._motion: Motion | None = None
        self._motion_of = False
        """Whether the motion is on the preprocessed path."""
        self._line: int | None = None

    def take(self, program: CncProgramData, settings: CncSettingsData, looks: PathLooks) -> PathSummary:
        """Draws another program. Raises PathSettingsError."""
        self._program, self._settings = program, settings
        self._paths, self._motion = {}, None
        return self.look(looks)

    def look(self, looks: PathLooks) -> PathSummary:
        """Draws the program in another way. Raises PathSettingsError."""
        self._looks = looks
        self._picture.look(dark=looks.dark, grid=looks.grid)
        front = self._drawn(preprocessed=looks.preprocessed)
        colours, legend = self._colours(front.path)
        layers = {"path": Layer(front.path, front.levels, colours)}
        if looks.preprocessed:
            behind = self._drawn(preprocessed=False)
            faint = np.broadcast_to(np.array(self._picture.theme.faint, np.uint8), (len(behind.path.of), 3))
            layers["original"] = Layer(behind.path, behind.levels, faint)
        self._picture.show(layers)
        if self._line is not None:
            self.choose(self._line)
        return self._summary(front, legend)

    def choose(self, line: int | None) -> ChosenElements:
        """Shows the elements of a line in red; these are returned."""
        self._line = line
        path = self._front.path
        found = [] if line is None else np.flatnonzero(path.line == line + 1)[:MOST_CHOSEN].tolist()
        elements = [self._element(path, number) for number in found]
        self._picture.mark([path.points_of(one.number) for one in elements if _moves(one.kind)])
        return ChosenElements(elements=elements)

    def pick(self, origin: Sequence[float], ahead: Sequence[float], angle: float) -> PickedElement:
        """The element that a ray meets within an angle [rad]; the ray in path units."""
        front = self._front
        place, way = np.array(origin, float), np.array(ahead, float)
        size = float(np.linalg.norm(way))
        piece = front.levels.nearest(place, way / size, angle) if size > 0 else None
        if piece is None:
            return PickedElement(element=None, place=None)
        path = front.path
        a, b = path.points[piece], path.points[piece + 1]
        element = self._element(path, int(path.of[piece]))
        return PickedElement(element=element, place=_on(a, b, place, way / size).tolist())

    def motion(self) -> PathSamples:
        """The interpolated motion on the path that is in front. Raises PathSettingsError."""
        motion = self._moved()
        count = len(motion.velocity)
        step = max(1, -(-count // MOST_SAMPLES))
        kept = np.unique(np.append(np.arange(0, count, step), count - 1)) if count else np.zeros(0, int)
        time = (kept + 1) * motion.interval_s
        rise = np.gradient(motion.velocity, motion.interval_s) if count > 1 else np.zeros(count)
        return PathSamples(
            time=time.tolist(),
            place=motion.positions[kept, :3].tolist(),
            velocity=motion.velocity[kept].tolist(),
            acceleration=rise[kept].tolist(),
            line=motion.lines[kept].tolist(),
            duration=motion.duration_s,
            fault=None if motion.fault is None else motion.fault.message,
        )

    @property
    def _front(self) -> _Drawn:
        return self._drawn(preprocessed=self._looks.preprocessed)

    def _drawn(self, *, preprocessed: bool) -> _Drawn:
        known = self._paths.get(preprocessed)
        if known is None:
            known = self._paths[preprocessed] = self._made(preprocessed)
        return known

    def _made(self, preprocessed: bool) -> _Drawn:
        if self._program is None:
            return _Drawn(polyline([], 1.0), switches_of([], polyline([], 1.0)), None)
        found: PathObjects = (
            self._service.preprocessed(self._program, self._settings)
            if preprocessed
            else self._service.objects_of(self._program)
        )
        path = polyline(as_objects(found.rows), tolerance_for(len(found.rows)))
        return _Drawn(path, switches_of(as_objects(found.rows), path, MOST_MARKS), found.fault)

    def _moved(self) -> Motion:
        if self._motion is None or self._motion_of != self._looks.preprocessed:
            if self._program is None:
                raise PathSettingsError("No program is drawn in the view yet; draw one first")
            self._motion_of = self._looks.preprocessed
            self._motion = self._service.interpolated(
                self._program, self._settings, preprocessing=self._looks.preprocessed
            )
        return self._motion

    def _colours(self, path: Polyline) -> tuple[Colours, PathLegend | None]:
        colouring = self._looks.colouring
        if colouring == "kind" or self._program is None:
            return by_kind(path, self._picture.theme), None
        values: npt.NDArray[Any] = programmed(path, colouring)
        by_motion = False
        if colouring != "curvature":
            motion = self._moved()
            speed = motion.velocity
            if len(speed) > 1:
                wanted = speed if colouring == "velocity" else np.gradient(speed, motion.interval_s)
                values, by_motion = moved(path, motion.positions[:, :3], wanted), True
        colours, legend = by_value(path, values)
        return colours, _scale(legend, by_motion)

    def _summary(self, front: _Drawn, legend: PathLegend | None) -> PathSummary:
        path, frame = front.path, self._picture.frame
        moving = np.flatnonzero(~np.isin(path.kind, (INITPOS, MCOMMAND, LINADDAXES)))
        ends = [
            PathMark(place=path.points_of(int(n))[-1].tolist(), line=int(path.line[n]) - 1)
            for n in moving[:MOST_MARKS]
        ]
        marks = zip(front.switches.place, front.switches.line, front.switches.number, strict=True)
        fault = front.fault
        drawn = np.flatnonzero(path.of >= 0)
        return PathSummary(
            centre=frame.centre.tolist(),
            scale=frame.scale,
            objects=path.count,
            length=float(path.length.sum()),
            low=front.levels.low.tolist(),
            high=front.levels.high.tolist(),
            start=path.points[drawn[0]].tolist() if len(drawn) else None,
            end=path.points[drawn[-1] + 1].tolist() if len(drawn) else None,
            ends=ends if len(moving) <= MOST_MARKS else [],
            switches=[
                PathMark(place=place.tolist(), line=int(line) - 1, number=int(number))
                for place, line, number in marks
            ],
            fault=None if fault is None else fault.message,
            fault_line=None if fault is None else fault.line,
            legend=legend,
        )

    def _element(self, path: Polyline, number: int) -> PathElement:
        points = path.points_of(number)
        return PathElement(
            number=number,
            line=int(path.line[number]) - 1,
            kind=int(path.kind[number]),
            start=points[0].tolist(),
            end=points[-1].tolist(),
            leave=_unit(points[min(1, len(points) - 1)] - points[0]).tolist(),
            arrive=_unit(points[-1] - points[-min(2, len(points))]).tolist(),
            length=float(path.length[number]),
        )


def _moves(kind: int) -> bool:
    return kind not in (INITPOS, MCOMMAND, LINADDAXES)


def _unit(way: Numbers) -> Numbers:
    size = float(np.linalg.norm(way))
    return way / size if size > 0 else way


def _on(a: Numbers, b: Numbers, place: Numbers, ahead: Numbers) -> Numbers:
    """The place of a segment that is nearest to a ray."""
    way, start = b - a, a - place
    along = float(way @ ahead)
    wide = float(way @ way) - along * along
    share = (along * float(start @ ahead) - float(way @ start)) / wide if wide > 0 else 0.0
    return np.asarray(a + min(1.0, max(0.0, share)) * way)


def _scale(legend: Legend, by_motion: bool) -> PathLegend:
    colours = ["#{:02x}{:02x}{:02x}".format(*stop) for stop in SCALE]
    return PathLegend(low=legend.low, high=legend.high, colours=colours, by_motion=by_motion)
