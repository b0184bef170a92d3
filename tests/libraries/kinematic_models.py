"""Models of kinematics by products of matrices and by distances, not as the library computes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]


def rotation(axis: int, degrees: Numbers | float) -> Numbers:
    """Homogeneous matrices of turns about a coordinate axis, one for each angle."""
    angle = np.radians(np.asarray(degrees, dtype=float))
    turn = np.zeros((*angle.shape, 4, 4))
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turn[..., axis, axis] = turn[..., 3, 3] = 1.0
    turn[..., first, first] = turn[..., second, second] = np.cos(angle)
    turn[..., second, first] = np.sin(angle)
    turn[..., first, second] = -np.sin(angle)
    return turn


def translation(x: Numbers | float, y: Numbers | float, z: Numbers | float) -> Numbers:
    """Homogeneous matrices of displacements."""
    x, y, z = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (x, y, z)))
    move = np.zeros((*x.shape, 4, 4))
    move[..., range(4), range(4)] = 1.0
    move[..., :3, 3] = np.stack([x, y, z], axis=-1)
    return move


def chain(links: Sequence[tuple[Numbers | float, Numbers | float, Numbers | float, float]]) -> Numbers:
    """The end of links by their Denavit-Hartenberg parameters: angle, offset, length, twist."""
    pose: Numbers = np.eye(4)
    for theta, d, a, alpha in links:
        pose = pose @ rotation(2, theta) @ translation(0.0, 0.0, d) @ translation(a, 0.0, 0.0)
        pose = pose @ rotation(0, alpha)
    return pose


def orientation(convention: str, first: Numbers, second: Numbers, third: Numbers) -> Numbers:
    """Turns about moving axes, as `ZYX`."""
    axes = ["XYZ".index(letter) for letter in convention]
    return rotation(axes[0], first) @ rotation(axes[1], second) @ rotation(axes[2], third)


def scara(joints: Sequence[Numbers], lengths: Sequence[float]) -> Numbers:
    """The end of arms in a plane."""
    return chain([(joint, 0.0, length, 0.0) for joint, length in zip(joints, lengths, strict=True)])


def palletizer(
    axes: Sequence[Numbers], a1: float, d1: float, l1: float, l2: float, a4: float, d4: float
) -> Numbers:
    """The flange of a four-axis palletizer, whose fourth joint is passive."""
    q0, q1, q2, q3 = axes
    return chain(
        [
            (q0, d1, a1, -90.0),
            (q1 - 90.0, 0.0, l1, 0.0),
            (q2 + 90.0, 0.0, l2, 0.0),
            (-(q1 + q2), 0.0, a4, 90.0),
            (q3, -d4, 0.0, 0.0),
        ]
    )


def articulated(joints: Sequence[Numbers | float], dimensions: Mapping[str, Numbers | float]) -> Numbers:
    """The flange of an articulated robot with six axes."""
    of = dimensions
    q = joints
    twist = 90.0 if of["bZUp"] else -90.0
    return chain(
        [
            (q[0], of["dD1"], of["dA1"], twist),
            (q[1] + 90.0, 0.0, of["dA2"], 0.0),
            (q[2], of["dD3"], of["dA3"], 90.0),
            (q[3], of["dD4"], 0.0, 90.0),
            (q[4], 0.0, 0.0, -90.0),
            (q[5], of["dD6"], 0.0, 0.0),
        ]
    )


def five_axes(axes: Sequence[Numbers], tool: float) -> Numbers:
    """The tip of the tool of a portal with azimuth and inclination."""
    x, y, z, inclination, azimuth = axes
    head = translation(x, y, z) @ rotation(2, azimuth) @ rotation(1, -inclination)
    return head @ translation(0.0, 0.0, -tool)


def bipod_rods(
    point: Sequence[Numbers], angles: Sequence[Numbers], arm: float, distance: float
) -> list[Numbers]:
    """How far the point is from both elbows; an angle turns the arm downwards from outwards."""
    found = []
    for side, angle in zip((-1.0, 1.0), angles, strict=True):
        motor = translation(side * distance / 2, 0.0, 0.0)
        elbow = (motor @ rotation(2, -side * angle) @ translation(side * arm, 0.0, 0.0))[..., :2, 3]
        found.append(np.hypot(point[0] - elbow[..., 0], point[1] - elbow[..., 1]))
    return found


def delta_rods(
    point: Sequence[Numbers],
    angles: Sequence[Numbers],
    arm: Numbers | float,
    motors: Numbers | float,
    platform: Numbers | float,
    turned: Numbers | float,
    pair: float,
) -> Numbers:
    """Lengths of the six rods of a delta robot, axis and rod of the pair in the last two dimensions."""
    found = []
    for axis, angle in enumerate(angles):
        base = rotation(2, turned + 120.0 * axis)
        elbow = base @ translation(motors, 0.0, 0.0) @ rotation(1, angle) @ translation(arm, 0.0, 0.0)
        joint = translation(*point) @ base @ translation(platform, 0.0, 0.0)
        sides = [
            (elbow @ translation(0.0, side, 0.0))[..., :3, 3]
            - (joint @ translation(0.0, side, 0.0))[..., :3, 3]
            for side in (-pair / 2, pair / 2)
        ]
        found.append(np.stack([np.linalg.norm(rod, axis=-1) for rod in sides], axis=-1))
    return np.stack(found, axis=-2)


def tripod_rods(
    point: Sequence[Numbers],
    heights: Sequence[Numbers],
    inner: float,
    outer: float,
    turned: float,
    pair: float,
) -> Numbers:
    """Lengths of the six rods of a tripod with linear drives, axis and rod in the last dimensions."""
    found = []
    for axis, height in enumerate(heights):
        base = rotation(2, turned + 120.0 * axis)
        sides = []
        for side in (-pair / 2, pair / 2):
            carriage = (base @ translation(outer, side, height))[..., :3, 3]
            joint = (translation(*point) @ base @ translation(inner, side, 0.0))[..., :3, 3]
            sides.append(np.linalg.norm(carriage - joint, axis=-1))
        found.append(np.stack(sides, axis=-1))
    return np.stack(found, axis=-2)
