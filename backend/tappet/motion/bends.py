"""Where the fourth derivative of a segment vanishes: between these places its jerk is monotonic.

From here the extremes of all curves are found, each derivative being monotonic between the zeros of the next.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from tappet.motion.cam_program import Numbers, Pieces
from tappet.project.cams.laws import coefficients, harmonic_coefficients

HALVINGS = 40
"""To a part of 1e-12 of a segment; what is missed of an extreme by that is its square."""
PLACES = 8
"""In a segment, at most: a harmonic is a polynomial of fourth degree on both sides of its middle."""


def bends(pieces: Pieces) -> Numbers:
    """The places by segment, as parts of its width; rows are filled up with 0.

    Of a modified sine these are the borders of its parts.
    """
    found = np.zeros((len(pieces), PLACES))
    rows: dict[str, list[int]] = {}
    for number, (_, segment, _) in enumerate(pieces):
        rows.setdefault(_FAMILIES.get(segment.law, ""), []).append(number)
    for family, numbers in rows.items():
        if family:
            places = _PLACES[family]([pieces[number] for number in numbers])
            found[numbers, : places.shape[1]] = places
    return found


def _of_polynomials(pieces: Pieces) -> Numbers:
    powers = _rows(coefficients(*piece) for piece in pieces)
    return unit_zeros(_derivative(_derivative(_derivative(_derivative(powers)))))


def _of_harmonics(pieces: Pieces) -> Numbers:
    """With u = tan(pi s / 2) the derivative is a polynomial, divided by (1 + u²)²; u > 1 by its inverse."""
    _, c2, c3, c4, c5 = _rows(harmonic_coefficients(*piece) for piece in pieces).T
    c4, c5 = 16 * c4, 16 * c5
    powers = np.column_stack([c2 + c4, 2 * c3 + 4 * c5, -6 * c4, 2 * c3 - 4 * c5, c4 - c2])
    first = 2 / np.pi * np.arctan(unit_zeros(powers))
    second = 1 - 2 / np.pi * np.arctan(unit_zeros(powers[:, ::-1]))
    return np.hstack([first, second])


def _of_modified_sines(pieces: Pieces) -> Numbers:
    part = np.array([segment.inflection for _, segment, _ in pieces])
    return np.column_stack([part / 4, part, 1 - (1 - part) / 4])


_FAMILIES = {
    "poly5": "polynomial5",
    "poly7": "polynomial7",
    "sine": "harmonic",
    "inclined_sine": "harmonic",
    "harmonic": "harmonic",
    "modified_sine": "modified_sine",
}
"""The fourth derivative of lines and of polynomials of third degree is 0 everywhere."""
_PLACES: dict[str, Callable[[Pieces], Numbers]] = {
    "polynomial5": _of_polynomials,
    "polynomial7": _of_polynomials,
    "harmonic": _of_harmonics,
    "modified_sine": _of_modified_sines,
}


def unit_zeros(powers: Numbers) -> Numbers:
    """Zeros from 0 to 1 of polynomials in rows, the coefficient of the lowest power first.

    Each row has as many places as its degree; those that are no zeros are borders between them, or ends.
    """
    if powers.shape[1] <= 1:
        return np.empty((len(powers), 0))
    ends = np.zeros((len(powers), 1)), np.ones((len(powers), 1))
    borders = np.sort(np.hstack([ends[0], unit_zeros(_derivative(powers)), ends[1]]), axis=1)
    low, high = borders[:, :-1].copy(), borders[:, 1:].copy()
    below = _value(powers, low) < 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        same = (_value(powers, middle) < 0) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high


def _rows(coefficients_of: Iterable[list[float]]) -> Numbers:
    return np.array(list(coefficients_of))


def _derivative(powers: Numbers) -> Numbers:
    return powers[:, 1:] * np.arange(1, powers.shape[1])


def _value(powers: Numbers, s: Numbers) -> Numbers:
    found = np.zeros_like(s)
    for factors in powers.T[::-1]:
        found = found * s + factors[:, None]
    return found
