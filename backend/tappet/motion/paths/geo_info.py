"""Path objects (SMC_GEOINFO) as an array of numpy, laid out as the compiled library has them (cnc.md 12)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Objects = npt.NDArray[np.void]
"""Of `GEO_INFO`."""
Numbers = npt.NDArray[np.float64]

LIN, CLW, CCLW, SPLINE, ELLCLW, ELLCCLW = 1, 2, 3, 5, 8, 9
LINPOS, LINNODELTA, LINADDAXES, INITPOS, MCOMMAND = 100, 101, 102, 110, 120
SWITCHES = 3
"""Switch points of an object."""

_COORDINATES = ("dX", "dY", "dZ", "dA", "dB", "dC", "dA1", "dA2", "dA3", "dA4", "dA5", "dA6")
_VECTOR = [(name, "<f8") for name in _COORDINATES[:3]]


def _aligned(fields: list[Any]) -> Any:
    return np.dtype(fields, align=True)


POSITION_INFO = _aligned(
    [
        ("iFrameNo", "<i4"),
        ("wAuxData", "<u2"),
        ("wSProfile", "<u2"),
        *((name, "<f8") for name in _COORDINATES),
    ]
)
"""SMC_POSINFO."""
GEO_INFO = _aligned(
    [
        ("iObjNo", "<i4"),
        ("iSourceLine_No", "<i4"),
        ("iMoveType", "<i2"),
        ("piStartPos", POSITION_INFO),
        ("piDestPos", POSITION_INFO),
        *((f"dP{n}", "<f8") for n in range(1, 9)),
        *((name, "<f8") for name in ("dT1", "dT2", "dToolRadius", "dVel", "dVelEnd", "dVelEndStored")),
        *((name, "<f8") for name in ("dAccel", "dDecel", "dLength")),
        ("byInternMark", "u1"),
        ("dHelpPos", "<f8", SWITCHES),
        ("iHelpID", "<i2", SWITCHES),
        *((name, "<f8", 7) for name in ("adVelAddAx", "adAccAddAx", "adDecAddAx")),
        ("vX", _aligned(_VECTOR)),
        ("vY", _aligned(_VECTOR)),
        ("b3D", "?"),
        ("adZ", "<f8", 4),
        ("v4", _aligned(_VECTOR)),
        ("v5", _aligned(_VECTOR)),
        ("vToolLength", _aligned(_VECTOR)),
        *((name, "<f8", 3) for name in ("adSlopeStart", "adSlopeEnd")),
        *((name, "<u2") for name in ("wCubic", "wSmoothAxes")),
        ("dwFlags", "<u4"),
        ("iProbe", "<i2"),
        ("pStopped", "<u8"),
        ("pPassed", "<u8"),
    ]
)
"""SMC_GEOINFO."""


def places(positions: npt.NDArray[np.void]) -> Numbers:
    """X, Y and Z of positions or vectors, in rows."""
    return np.column_stack([positions[name] for name in ("dX", "dY", "dZ")])
