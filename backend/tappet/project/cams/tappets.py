"""Tappets of a cam as the library has them: an entry for each direction that does something (CAM-53)."""

from __future__ import annotations

from itertools import groupby

from tappet.project.cams.pieces import Rows
from tappet.project.cams.table import LAST_TRACK, MOST_TAPPETS, CamTappet, CamTrack, TappetAction, number_text
from tappet.project.cams.texts import CamTextError

ACTIONS: tuple[TappetAction, ...] = ("on", "off", "invert")
"""In the order of SMC_CAMTAPPETACTION."""
BOTH, NEGATIVE = 1, 2
"""Of SMC_CAMTAPPETTYPE; 0 is the positive direction."""


def entries(track: int, tappet: CamTappet) -> list[tuple[int, float, int, int]]:
    """Track, position, direction and action: one for both directions where they do the same."""
    if tappet.positive == tappet.negative:
        passes = [(BOTH, tappet.positive)]
    else:
        passes = [(0, tappet.positive), (NEGATIVE, tappet.negative)]
    return [
        (track, tappet.x, direction, ACTIONS.index(action))
        for direction, action in passes
        if action != "none"
    ]


def tracks_of(rows: Rows, first: float, last: float) -> tuple[CamTrack, ...]:
    """Tracks of tappets within a range of the master.

    A row is track, position, direction, action, delay and duration as they stand in SMC_CAMTappet; both
    directions of a tappet stand in two rows, one behind the other. Raises CamTextError.
    """
    found: list[tuple[int, CamTappet]] = []
    line = 1
    for line, (group, x, direction, action, *times) in rows:
        if group != int(group) or not 1 <= group <= LAST_TRACK:
            raise CamTextError(line, f"a track is a whole number from 1 to {LAST_TRACK}")
        if not first <= x <= last:
            raise CamTextError(line, f"the tappet at {number_text(x)} lies outside the range")
        if direction not in (0, 1, 2):
            raise CamTextError(line, "the direction of a tappet is 0, 1 or 2")
        if action not in (0, 1, 2) or any(times):
            raise CamTextError(
                line, "tappets of the editor switch on, off or invert (0, 1 or 2), without times"
            )
        switch = ACTIONS[int(action)]
        track = int(group)
        if direction == 2 and found and _misses_negative(found[-1], track, x):
            found[-1] = track, found[-1][1].model_copy(update={"negative": switch})
        else:
            positive = switch if direction < 2 else "none"
            negative = switch if direction > 0 else "none"
            found.append((track, CamTappet(x=x, positive=positive, negative=negative)))
    ordered = sorted(found, key=lambda one: one[0])
    tracks = {id: [tappet for _, tappet in group] for id, group in groupby(ordered, key=lambda one: one[0])}
    for id, tappets in tracks.items():
        if len(tappets) > MOST_TAPPETS:
            raise CamTextError(line, f"track {id} has more than {MOST_TAPPETS} tappets")
    return tuple(CamTrack(id=id, tappets=tuple(tappets)) for id, tappets in tracks.items())


def _misses_negative(one: tuple[int, CamTappet], track: int, x: float) -> bool:
    tappet = one[1]
    return one[0] == track and tappet.x == x and tappet.positive != "none" and tappet.negative == "none"
