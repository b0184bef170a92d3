"""Set positions on random lines, arcs, ellipses and splines against their geometry by numpy and scipy."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from tests.libraries.cnc_motion import Object, motion
from tests.libraries.cnc_paths import AXES, Geo
from tests.libraries.test_cnc_geometry import objects


def nearest(geo: Geo, place: np.ndarray, guess: float) -> float:
    """Distance of a place from the curve, near a share of it; by halving the search on a grid."""
    low, high = max(0.0, guess - 0.2), min(1.0, guess + 0.2)
    best = guess
    for _ in range(12):
        grid = np.linspace(low, high, 41)
        distances = [float(np.linalg.norm(geo.curve(float(u)) - place)) for u in grid]
        best = float(grid[int(np.argmin(distances))])
        step = (high - low) / 40
        low, high = max(0.0, best - step), min(1.0, best + step)
    return float(np.linalg.norm(geo.curve(best) - place))


@settings(max_examples=10, deadline=None)
@given(objects(), st.sampled_from(["TRAPEZOID", "SIGMOID", "QUADRATIC"]))
def test_set_positions_lie_on_the_path(geo: Geo, mode: str) -> None:
    """Spec 13: positions lie on the path (1e-9), at the length that the interpolator has gone."""
    length = geo.length()
    assume(1e-2 < length < 1e4)
    item = Object(
        members={**geo.values(), "dLength": length, "dVel": length / 2, "dAccel": length, "dDecel": length}
    )
    with motion([item], iVelMode=mode, dJerkMax=4 * length, dwIpoTime=20000) as running:
        for _ in range(4):
            running.calls(45)
            if running.program.literal("Main.ipo.bDone") == "TRUE":
                break
            place = np.array(
                [float(running.program.literal(f"Main.ipo.piSetPosition.{name}")) for name in AXES[:3]]
            )
            way = float(running.program.literal("Main.dWay"))
            if not geo.space and geo.kind != 101:
                place[2] = 0.0
            # The share at that length, by scipy
            share = float(brentq(lambda u, way=way: geo.length(u) - way, 0.0, 1.0, xtol=1e-9))
            scale = 1.0 + float(np.abs(geo.curve(0.5)).max()) + length
            assert np.linalg.norm(geo.curve(share) - place) <= 1e-6 * scale
            assert nearest(geo, place, share) <= 1e-9 * scale
