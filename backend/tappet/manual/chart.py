"""Timing charts as SVG: BOOLs and states as lanes, numbers as curves, over the time of a recorded run.

Same recording, same bytes. Colours follow the reader's light or dark scheme; there is no background.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from xml.sax.saxutils import escape

from tappet.codegen.values import Value
from tappet.manual.examples import CYCLE_MS
from tappet.manual.recording import HANDSHAKE, Recording
from tappet.manual.simplified import simplified

_STATES = (
    *("power_off", "errorstop", "stopping", "standstill"),
    *("discrete_motion", "continuous_motion", "synchronized_motion", "homing"),
)
_LEFT, _RIGHT, _WIDTH = 190.0, 14.0, 760.0
_TOP = 8.0
_LANE, _HIGH = 22.0, 13.0
_CURVE, _ROOM = 80.0, 10.0
_AXIS = 34.0
_STYLE = (
    "text{font:12px system-ui,sans-serif;fill:#57606a}.n{fill:#1f2328}path{fill:none;stroke-width:1.5}"
    ".b{stroke:#0969da}.p{stroke:#8250df}.s{fill:#8c959f33;stroke:none}.g{stroke:#8c959f55;stroke-width:1}"
    "@media(prefers-color-scheme:dark){text{fill:#9198a1}.n{fill:#e6edf3}.b{stroke:#58a6ff}.p{stroke:#bc8cff}}"
)
_FEW = 1e-9
_PIXELS_PER_LETTER = 6.0


def chart(recording: Recording) -> str:
    """The drawing; what never changes is left out, but for the pins of the handshake."""
    drawing = _Drawing(recording.example.cycles)
    chosen = bool(recording.example.chart)
    for expression, values in recording.traces.items():
        member = expression.rpartition(".")[2]
        if member == "nAxisState":
            if len(set(values)) > 1:
                drawing.states(expression, values)
        elif isinstance(values[0], bool):
            if chosen or len(set(values)) > 1 or HANDSHAKE.fullmatch(member):
                drawing.lane(expression, values)
        else:
            numbers = [float(value) for value in values if isinstance(value, int | float)]
            if chosen or max(numbers) - min(numbers) > _FEW:
                drawing.curve(expression, numbers)
    return drawing.finished()


class _Drawing:
    """Rows below each other, over one time axis."""

    def __init__(self, cycles: int) -> None:
        self._cycles = cycles
        self._parts: list[str] = []
        self._y = _TOP

    def _x(self, cycle: float) -> float:
        return _LEFT + cycle / self._cycles * (_WIDTH - _LEFT - _RIGHT)

    def _name(self, text: str, y: float) -> None:
        self._parts.append(
            f'<text class="n" x="{_n(_LEFT - 10)}" y="{_n(y)}" text-anchor="end">{escape(text)}</text>'
        )

    def lane(self, name: str, values: Sequence[Value]) -> None:
        """A BOOL: high is TRUE."""
        low, high = self._y + _LANE - 4, self._y + _LANE - 4 - _HIGH
        self._name(name, low)
        path, cycle = f"M{_n(self._x(0))} {_n(high if values[0] else low)}", 0
        for value, same in groupby(values):
            y = _n(high if value else low)
            cycle += len(list(same))
            path += f"V{y}H{_n(self._x(cycle))}"
        self._parts.append(f'<path class="b" d="{path}"/>')
        self._y += _LANE

    def states(self, name: str, values: Sequence[Value]) -> None:
        """The state of an axis, by its name where there is room."""
        top = self._y + _LANE - 4 - _HIGH - 2
        self._name(name, self._y + _LANE - 4)
        cycle = 0
        for number, (value, same) in enumerate(groupby(values)):
            begin, cycle = cycle, cycle + len(list(same))
            left, width = self._x(begin), self._x(cycle) - self._x(begin)
            if number % 2 == 0:
                size = f'width="{_n(width)}" height="{_n(_HIGH + 4)}"'
                self._parts.append(f'<rect class="s" x="{_n(left)}" y="{_n(top)}" {size}/>')
            text = _STATES[int(value)] if isinstance(value, int) and value < len(_STATES) else str(value)
            if len(text) * _PIXELS_PER_LETTER < width:
                place = f'x="{_n(left + width / 2)}" y="{_n(self._y + _LANE - 5)}"'
                self._parts.append(f'<text {place} text-anchor="middle">{escape(text)}</text>')
        self._y += _LANE

    def curve(self, name: str, values: Sequence[float]) -> None:
        """A number, with its smallest and largest value."""
        low, high = min(values), max(values)
        span = high - low or 1.0
        top, bottom = self._y + _ROOM, self._y + _CURVE - _ROOM
        self._name(name, (top + bottom) / 2 + 4)
        for value, y in ((high, top), (low, bottom)):
            self._parts.append(f'<path class="g" d="M{_n(_LEFT)} {_n(y)}H{_n(_WIDTH - _RIGHT)}"/>')
            place = f'x="{_n(_LEFT - 10)}" y="{_n(y + 4)}"'
            self._parts.append(f'<text {place} text-anchor="end">{_short(value)}</text>')
        path = ""
        for piece in _pieces(values, span):
            points = [
                (self._x(cycle + 1), bottom - (value - low) / span * (bottom - top)) for cycle, value in piece
            ]
            path += "M" + "L".join(f"{_n(x)} {_n(y)}" for x, y in simplified(points))
        self._parts.append(f'<path class="p" d="{path}"/>')
        self._y += _CURVE

    def finished(self) -> str:
        """The text of the file."""
        seconds = self._cycles * CYCLE_MS / 1000
        step = next(step for step in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10) if seconds / step <= 10)
        ticks = [number * step for number in range(int(seconds / step + 1e-9) + 1)]
        for tick in ticks:
            x = _n(self._x(tick / (CYCLE_MS / 1000)))
            self._parts.insert(0, f'<path class="g" d="M{x} {_n(_TOP)}V{_n(self._y)}"/>')
            self._parts.append(f'<text x="{x}" y="{_n(self._y + 15)}" text-anchor="middle">{tick:g}</text>')
        unit = f'<text x="{_n(_LEFT - 10)}" y="{_n(self._y + 15)}" text-anchor="end">t [s]</text>'
        size = f"{_WIDTH:g} {_n(self._y + _AXIS)}"
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}">'
        return "\n".join([head, f"<style>{_STYLE}</style>", *self._parts, unit, "</svg>"]) + "\n"


def _pieces(values: Sequence[float], span: float) -> list[list[tuple[int, float]]]:
    """Parts without a jump of more than half of what there is, as at the end of a period."""
    pieces: list[list[tuple[int, float]]] = [[]]
    for cycle, value in enumerate(values):
        if pieces[-1] and abs(value - pieces[-1][-1][1]) > span / 2:
            pieces.append([])
        pieces[-1].append((cycle, value))
    return [piece for piece in pieces if len(piece) > 1]


def _n(value: float) -> str:
    """A coordinate, to a tenth of a pixel."""
    return (
        f"{value:.1f}".removesuffix(".0").replace("-0", "0")
        if abs(value) < 0.05
        else f"{value:.1f}".removesuffix(".0")
    )


def _short(value: float) -> str:
    return f"{0.0 if abs(value) < _FEW else value:.6g}"
