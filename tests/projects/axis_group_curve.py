"""The picture of the example project of axis groups: its recorded run beside the curve of EX-AG-01.

`python tests/projects/axis_group_curve.py` writes it. The curve is computed from table 2 of the paper
(targets, velocities, acceleration, jerk), whose plot is lost: ramps with limited jerk between velocities
at the corners (axis_group.md, 6) that are 40 at A, 70 at B and 0 at C.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from pathlib import Path
from xml.sax.saxutils import escape

from tappet.cli.inputs import one_application
from tappet.codegen.build import build_application
from tappet.manual.simplified import simplified
from tappet.runtime.local import LocalRuntime

ROOT = Path(__file__).parents[2]
PICTURE = ROOT / "docs/motion/images/axis-group-table-2.svg"
EXAMPLE = ROOT / "projects/axis_group"
AXES = ("X", "Y", "Z")
CORNERS = ((0.0, 0.0, 0.0), (1600.0, 1200.0, 800.0), (2200.0, 3800.0, 5000.0), (4500.0, 4200.0, 4800.0))
VELOCITIES = (40.0, 55.0, 70.0)
AT_CORNERS = (0.0, 40.0, 70.0, 0.0)
ACCELERATION, JERK = 5.0, 2.0
STEP_S = 0.1
END_S = 195.0
NAMED_S = 115.0
"""Where the curves have the names of their axes."""
_NS_PER_S = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Motion:
    """Where the group was at a time, in s, mm/s and mm."""

    time: float
    velocity: float
    places: tuple[float, ...]


def recorded(example: Path = EXAMPLE) -> list[Motion]:
    """The run of the example on virtual time, from the start of its first block."""
    application = one_application([example])
    package = build_application(application.sources, application.tasks, application.options).package
    assert package is not None, f"{example} does not build"
    found: list[Motion] = []
    with LocalRuntime(package) as plc:
        while _number(plc, "GVL_Group.lrTime") <= 0.0:
            plc.run(cycles=1)
        while not found or (found[-1].time < END_S and plc.literal("PLC_PRG.eStep") == "Travel"):
            plc.run(time_ns=round(STEP_S * _NS_PER_S))
            places = tuple(_number(plc, f"{axis}.fSetPosition") for axis in AXES)
            velocity = _number(plc, "Machine.fPathVelocity")
            found.append(Motion(_number(plc, "GVL_Group.lrTime"), velocity, places))
    return found


def _number(plc: LocalRuntime, path: str) -> float:
    return float(str(plc.read(path)))


class Reference:
    """The curve of table 2 in closed form."""

    def __init__(self) -> None:
        self._phases: list[tuple[float, float, float, float, float, int]] = []
        """Begin, place on the block, velocity, acceleration, jerk, block."""
        time = 0.0
        self.ends = [0.0]
        """Times at O, A, B and C."""
        for block, (begin, end) in enumerate(pairwise(CORNERS)):
            place, velocity = 0.0, AT_CORNERS[block]
            for duration, acceleration, jerk in _phases(
                math.dist(begin, end), velocity, VELOCITIES[block], AT_CORNERS[block + 1]
            ):
                self._phases.append((time, place, velocity, acceleration, jerk, block))
                place += velocity * duration + acceleration * duration**2 / 2 + jerk * duration**3 / 6
                velocity += acceleration * duration + jerk * duration**2 / 2
                time += duration
            self.ends.append(time)

    def at(self, time: float) -> Motion:
        """The motion at a time; it rests behind C."""
        if time >= self.ends[-1]:
            return Motion(time, 0.0, CORNERS[-1])
        number = bisect_right([phase[0] for phase in self._phases], time) - 1
        begin, place, velocity, acceleration, jerk, block = self._phases[number]
        t = time - begin
        way = place + velocity * t + acceleration * t**2 / 2 + jerk * t**3 / 6
        first, last = CORNERS[block], CORNERS[block + 1]
        part = way / math.dist(first, last)
        places = tuple(a + (b - a) * part for a, b in zip(first, last, strict=True))
        return Motion(time, velocity + acceleration * t + jerk * t**2 / 2, places)


def _phases(length: float, first: float, target: float, last: float) -> list[tuple[float, float, float]]:
    """Duration, acceleration and jerk of the phases of a block: ramp, cruise, ramp (axis_group.md, 6)."""
    ramps = [_ramp(first, target), _ramp(target, last)]
    ways = [
        (a + b) / 2 * sum(duration for duration, _, _ in ramp)
        for ramp, (a, b) in zip(ramps, ((first, target), (target, last)), strict=True)
    ]
    return [*ramps[0], ((length - sum(ways)) / target, 0.0, 0.0), *ramps[1]]


def _ramp(first: float, last: float) -> list[tuple[float, float, float]]:
    """A ramp that reaches the acceleration; those of table 2 all do."""
    if first == last:
        return []
    sign = math.copysign(1.0, last - first)
    rise = ACCELERATION / JERK
    steady = abs(last - first) / ACCELERATION - rise
    assert steady >= 0.0
    top = sign * ACCELERATION
    return [(rise, 0.0, sign * JERK), (steady, top, 0.0), (rise, top, -sign * JERK)]


_LEFT, _WIDTH, _HEIGHT, _TOP, _GAP = 56.0, 820.0, 190.0, 26.0, 40.0
_RIGHT = 16.0
_STYLE = (
    "text{font:12px system-ui,sans-serif;fill:#57606a}path{fill:none;stroke-width:1.25}"
    ".g{stroke:#8c959f55;stroke-width:1}.r{stroke:#d4a72c88;stroke-width:6}.m{stroke:#0969da}"
    "@media(prefers-color-scheme:dark){text{fill:#9198a1}.m{stroke:#58a6ff}.r{stroke:#d4a72c66}}"
)


def picture(run: Sequence[Motion]) -> str:
    """Velocity along the path and positions of the axes as SVG: the paper's curve broad, the run thin."""
    reference = Reference()
    paper = [reference.at(time) for time in accumulate([STEP_S] * round(END_S / STEP_S), initial=0.0)]
    parts = [
        *_panel("Path velocity [mm/s]", 0, 80.0, 20.0, [[(m.time, m.velocity) for m in paper]], "r"),
        *_lines(0, 80.0, [[(m.time, m.velocity) for m in run]], "m"),
        *_panel("Positions [mm]", 1, 6000.0, 1000.0, _places(paper), "r"),
        *_lines(1, 6000.0, _places(run), "m"),
    ]
    for axis, place in zip(AXES, reference.at(NAMED_S).places, strict=True):
        parts.append(_text(_x(NAMED_S), _y(1, place / 6000.0) - 8, axis, "middle"))
    for name, time in zip("ABC", reference.ends[1:], strict=True):
        bottom = _y(1, 0.0)
        parts.append(f'<path class="g" stroke-dasharray="3 3" d="M{_x(time):.1f} {_TOP:g}V{bottom:.1f}"/>')
        parts.append(_text(_x(time), _TOP - 6, f"{name} {time:.4f} s", "end" if name == "C" else "middle"))
    bottom = _y(1, 0.0)
    parts += [_text(_x(tick), bottom + 16, f"{tick}", "middle") for tick in range(0, int(END_S) + 1, 20)]
    parts.append(_text(_WIDTH / 2, bottom + 34, "t [s] \N{EM DASH} broad: table 2, thin: the run", "middle"))
    size = f"{_WIDTH:g} {bottom + 44:g}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}">'
    return "\n".join([head, f"<style>{_STYLE}</style>", *parts, "</svg>"]) + "\n"


def _places(motions: Sequence[Motion]) -> list[list[tuple[float, float]]]:
    return [[(motion.time, motion.places[axis]) for motion in motions] for axis in range(len(AXES))]


def _x(time: float) -> float:
    return _LEFT + time / END_S * (_WIDTH - _LEFT - _RIGHT)


def _y(panel: int, part: float) -> float:
    return _TOP + panel * (_HEIGHT + _GAP) + (1.0 - part) * _HEIGHT


def _panel(
    title: str,
    panel: int,
    top: float,
    step: float,
    curves: Sequence[Sequence[tuple[float, float]]],
    look: str,
) -> list[str]:
    """The grid of a panel with its curves."""
    parts = [_text(_LEFT, _y(panel, 1.0) - (20 if panel == 0 else 8), title, "start")]
    for number in range(round(top / step) + 1):
        y = _y(panel, number * step / top)
        parts.append(f'<path class="g" d="M{_LEFT:g} {y:.1f}H{_WIDTH - _RIGHT:g}"/>')
        parts.append(_text(_LEFT - 8, y + 4, f"{number * step:g}", "end"))
    return parts + _lines(panel, top, curves, look)


def _lines(panel: int, top: float, curves: Sequence[Sequence[tuple[float, float]]], look: str) -> list[str]:
    parts = []
    for curve in curves:
        points = [(_x(time), _y(panel, value / top)) for time, value in curve]
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in simplified(points))
        parts.append(f'<path class="{look}" d="M{path}"/>')
    return parts


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(text)}</text>'


if __name__ == "__main__":
    PICTURE.parent.mkdir(parents=True, exist_ok=True)
    PICTURE.write_text(picture(recorded()), encoding="utf-8")
