"""Rows that the compiled program gives, whose fields are named as in a queue file, as path objects."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.geo_info import GEO_INFO, Objects

PART = 65_536


def as_objects(rows: npt.NDArray[np.void]) -> Iterator[Objects]:
    """The objects in parts; fields such as `piStartPos.dX` or `adZ[2]` by their names."""
    names = rows.dtype.names or ()
    for start in range(0, len(rows), PART):
        part = rows[start : start + PART]
        found = np.zeros(len(part), GEO_INFO)
        for name in names:
            member, _, inner = name.partition(".")
            member, bracket, index = member.partition("[")
            place = found[member]
            if bracket:
                place[:, int(index.rstrip("]"))] = part[name]
            elif inner:
                place[inner] = part[name]
            else:
                place[:] = part[name]
        yield found
