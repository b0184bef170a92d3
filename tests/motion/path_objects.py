"""Objects of tests as arrays of SMC_GEOINFO."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from tests.libraries.cnc_paths import Geo

from tappet.motion.paths.geo_info import GEO_INFO, Objects


def geo_info(objects: Sequence[Geo]) -> Objects:
    """The objects, numbered by line from 1."""
    found = np.zeros(len(objects), GEO_INFO)
    found["dT2"] = 1.0
    for number, geo in enumerate(objects):
        found["iSourceLine_No"][number] = number + 1
        for name, value in geo.values().items():
            member, _, inner = name.partition(".")
            if "[" in member:
                member, _, index = member.rstrip("]").partition("[")
                found[member][number][int(index)] = value
            elif inner:
                found[member][inner][number] = value
            else:
                found[member][number] = value
    return found
