"""Text of a queue file, which SMC_ReadNCQueue reads. Described in docs/cnc-data.md. Spec CNC-93, CNCR-32."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from tappet.cnc.writer import number_text

_AXES = ("dX", "dY", "dZ", "dA", "dB", "dC", *(f"dA{n}" for n in range(1, 7)))
_SHAPE = (*(f"dP{n}" for n in range(1, 9)), "dT1", "dT2", "dToolRadius", "dVel", "dVelEnd", "dVelEndStored")

FIELDS: tuple[str, ...] = (
    *("iMoveType", "iSourceLine_No", "byInternMark", "b3D", "piDestPos.wAuxData", "piDestPos.wSProfile"),
    *(f"piStartPos.{axis}" for axis in _AXES),
    *(f"piDestPos.{axis}" for axis in _AXES),
    *_SHAPE,
    *("dAccel", "dDecel", "dLength"),
    *(f"iHelpID[{n}]" for n in range(3)),
    *(f"dHelpPos[{n}]" for n in range(3)),
    *(f"{limit}[{n}]" for limit in ("adVelAddAx", "adAccAddAx", "adDecAddAx") for n in range(7)),
    *(f"{vector}.d{axis}" for vector in ("vX", "vY") for axis in "XYZ"),
    *(f"adZ[{n}]" for n in range(4)),
    *(f"{vector}.d{axis}" for vector in ("v4", "v5") for axis in "XYZ"),
)
"""Members of SMC_GEOINFO in the order of the numbers of a line."""


def queue_text(name: str, objects: Iterable[Mapping[str, float]]) -> str:
    """The file. Members that an object does not have are 0."""
    lines = [" ".join(number_text(geo.get(field, 0.0)) for field in FIELDS) for geo in objects]
    title = "".join(character for character in name if character.isprintable())[:80]
    return "\n".join(["QUEUE 1", f"NAME {title}", f"OBJECTS {len(lines)}", *lines, "END", ""])
