"""The articulated robot of SM3_CNC: its eight solutions, singular poses and Jacobian; against matrices."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from tests.libraries import kinematic_models as models
from tests.libraries.beyond_the_cnc_catalog import ENUMERATIONS
from tests.libraries.st_program import Program, run
from tests.libraries.transformations import RELATIVE, Given, Numbers, Transformations

INVERSE, FORWARD = "SMC_Trafo_ArticulatedRobot_6DOF", "SMC_TrafoF_ArticulatedRobot_6DOF"
CONVENTIONS = {name: number for name, number in ENUMERATIONS["SMC_ORI_CONVENTION"].items() if number > 0}
DIMENSIONS: dict[str, dict[str, float]] = {
    "offset wrist, Z up": {
        "dA1": 150,
        "dA2": 590,
        "dA3": 130,
        "dD1": 450,
        "dD3": 0,
        "dD4": 647,
        "dD6": 95,
        "bZUp": 1,
    },
    "Z down": {"dA1": 25, "dA2": 455, "dA3": 35, "dD1": -400, "dD3": 0, "dD4": 420, "dD6": 80, "bZUp": 0},
    "offset shoulder": {
        "dA1": 0,
        "dA2": 432,
        "dA3": -20,
        "dD1": 0,
        "dD3": 149,
        "dD4": 433,
        "dD6": 60,
        "bZUp": 1,
    },
    "arms of one length": {
        "dA1": 0,
        "dA2": 300,
        "dA3": 0,
        "dD1": 200,
        "dD3": 0,
        "dD4": 300,
        "dD6": 0,
        "bZUp": 1,
    },
}
AXES = range(6)
STATES = ("armState", "elbowState", "handState")
SOLUTIONS = list(itertools.product((1.0, -1.0), repeat=3))
ROWS = 4000
OFFSETS = tuple(10.0 * axis - 25.0 for axis in AXES)


@pytest.fixture(params=DIMENSIONS)
def size(request: pytest.FixtureRequest) -> dict[str, float]:
    return DIMENSIONS[request.param]


def _length(size: dict[str, float]) -> float:
    return sum(abs(value) for name, value in size.items() if name != "bZUp")


def _config(size: dict[str, float]) -> Given:
    offsets = {f"config.adOffset[{axis}]": offset for axis, offset in zip(AXES, OFFSETS, strict=True)}
    return {**{f"config.{name}": float(value) for name, value in size.items()}, **offsets}


def _joints(random: np.random.Generator) -> Numbers:
    return random.uniform(-180.0, 180.0, (6, ROWS))


def _pose(flange: Numbers, convention: str = "ZYX") -> Given:
    """A flange as a position; its angles by the textbook, away from where they are singular."""
    r = flange[..., :3, :3]
    if convention == "ZYX":
        angles = (
            np.arctan2(r[..., 1, 0], r[..., 0, 0]),
            np.arcsin(np.clip(-r[..., 2, 0], -1.0, 1.0)),
            np.arctan2(r[..., 2, 1], r[..., 2, 2]),
        )
    elif convention == "XYZ":
        angles = (
            np.arctan2(-r[..., 1, 2], r[..., 2, 2]),
            np.arcsin(np.clip(r[..., 0, 2], -1.0, 1.0)),
            np.arctan2(-r[..., 0, 1], r[..., 0, 0]),
        )
    else:
        angles = (
            np.arctan2(r[..., 1, 2], r[..., 0, 2]),
            np.arccos(np.clip(r[..., 2, 2], -1.0, 1.0)),
            np.arctan2(r[..., 2, 1], -r[..., 2, 0]),
        )
    given: Given = {f"pi.d{name}": flange[..., i, 3] for i, name in enumerate("XYZ")}
    given |= {f"pi.d{name}": np.degrees(angle) for name, angle in zip("ABC", angles, strict=True)}
    return given | {"eOriConv": float(CONVENTIONS[convention])}


def _flange(found: dict[str, Numbers], before: str = "pi.", convention: str = "ZYX") -> Numbers:
    """A position as a flange."""
    x, y, z, a, b, c = (found[f"{before}d{name}"] for name in "XYZABC")
    return models.translation(x, y, z) @ models.orientation(convention, a, b, c)


def _inverse(transform: Transformations, given: Given) -> tuple[dict[str, Numbers], Numbers]:
    """The outputs of the block, and its joints without offsets."""
    found = transform(INVERSE, given, ["bError", "bSingular", *(f"dQ{axis}" for axis in AXES)])
    return found, np.stack([found[f"dQ{axis}"] - OFFSETS[axis] for axis in AXES])


def _same_flange(found: Numbers, expected: Numbers, length: float) -> bool:
    moved = np.abs(found[..., :3, 3] - expected[..., :3, 3]) <= RELATIVE * length
    turned = np.abs(found[..., :3, :3] - expected[..., :3, :3]) <= RELATIVE
    return bool(np.all(moved) and np.all(turned))


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_the_flange_is_the_end_of_the_chain(
    transform: Transformations, random: np.random.Generator, size: dict[str, float], convention: str
) -> None:
    joints = _joints(random)
    drives: Given = {f"Drive{axis + 1}.fSetPosition": joints[axis] + OFFSETS[axis] for axis in AXES}
    outputs = [f"pi.d{name}" for name in "XYZABC"]
    given = {**_config(size), **drives, "eOriConv": float(CONVENTIONS[convention])}
    found = transform(FORWARD, given, ["bError", *outputs])
    assert not np.any(found["bError"])
    flange = _flange(found, convention=convention)
    assert _same_flange(flange, models.articulated(list(joints), size), _length(size))


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_poses_where_angles_are_not_determined(
    transform: Transformations, random: np.random.Generator, convention: str
) -> None:
    """The second angle is at an end of its range: one of the others is 0, all three give the orientation."""
    size = DIMENSIONS["arms of one length"]
    ends = {"ZYZ": (0.0, 180.0), "ZYX": (90.0, -90.0), "XYZ": (90.0, -90.0)}[convention]
    first, third = random.uniform(-180.0, 180.0, (2, ROWS))
    second = random.choice(ends, ROWS)
    wanted = models.orientation(convention, first, second, third)
    wanted[:, :3, 3] = [250.0, 100.0, 350.0]
    angles: Given = {"pi.dA": first, "pi.dB": second, "pi.dC": third}
    place = {"pi.dX": 250.0, "pi.dY": 100.0, "pi.dZ": 350.0, "eOriConv": float(CONVENTIONS[convention])}
    states = dict(zip(STATES, SOLUTIONS[0], strict=True))
    outputs, joints = _inverse(transform, {**_config(size), **place, **angles, **states})
    assert not np.any(outputs["bError"])
    assert _same_flange(models.articulated(list(joints), size), wanted, _length(size))
    drives: Given = {f"Drive{axis + 1}.fSetPosition": joints[axis] + OFFSETS[axis] for axis in AXES}
    names = [f"pi.d{name}" for name in "XYZABC"]
    found = transform(FORWARD, {**_config(size), **drives, "eOriConv": place["eOriConv"]}, names)
    assert _same_flange(_flange(found, convention=convention), wanted, _length(size))
    assert np.median(np.abs(found["pi.dC" if convention == "XYZ" else "pi.dA"])) == 0.0


def _solutions(
    transform: Transformations, size: dict[str, float], pose: Given, before: Given
) -> tuple[Numbers, Numbers]:
    """Which solutions there are (solution, row), and their joints (solution, axis, row)."""
    found = [
        _inverse(transform, {**_config(size), **pose, **before, **dict(zip(STATES, states, strict=True))})
        for states in SOLUTIONS
    ]
    return np.stack([outputs["bError"] == 0.0 for outputs, _ in found]), np.stack([q for _, q in found])


def test_eight_solutions(
    transform: Transformations, random: np.random.Generator, size: dict[str, float]
) -> None:
    joints = _joints(random)
    flange = models.articulated(list(joints), size)
    reached, found = _solutions(transform, size, _pose(flange), {})
    apart = np.abs(np.sin(np.radians(joints[4]))) > 1e-6
    assert np.any(np.all(reached, axis=0)), "some poses are reached in all eight ways"
    assert np.all(np.count_nonzero(reached, axis=0) % 4 == 0)
    turned = np.abs((found - joints + 180.0) % 360.0 - 180.0)
    matches = np.max(turned, axis=1) < 1e-4
    assert np.all(np.any(matches & reached, axis=0)[apart]), "the joints of the pose are one of them"
    for index, states in enumerate(SOLUTIONS):
        there = reached[index]
        assert np.all((found[index, :5] > -180.0 - 1e-9) & (found[index, :5] <= 180.0 + 1e-9))
        again = models.articulated([axis[there] for axis in found[index]], size)
        assert _same_flange(again, flange[there], _length(size))
        drives: Given = {f"Drive{axis + 1}.fSetPosition": found[index, axis] + OFFSETS[axis] for axis in AXES}
        said = transform(FORWARD, {**_config(size), **drives, "eOriConv": 2.0}, STATES)
        for name, state in zip(STATES, states, strict=True):
            assert np.all((said[name] == state)[there & apart]), name
    for first, second in itertools.combinations(range(8), 2):
        both = reached[first] & reached[second] & apart
        difference = np.abs((found[first] - found[second] + 180.0) % 360.0 - 180.0)
        assert np.all(np.max(difference, axis=0)[both] > 1e-6), "they are solutions of their own"


def test_robots_of_any_dimensions(transform: Transformations, random: np.random.Generator) -> None:
    """Each row is a robot of its own; its joints may not have a forearm of no length."""
    sizes = {
        name: random.choice([0.0, 1.0, -1.0], ROWS) * 10.0 ** random.uniform(-2.0, 3.0, ROWS)
        for name in ("dA1", "dA3", "dD1", "dD3", "dD4", "dD6")
    }
    sizes["dA2"] = 10.0 ** random.uniform(-2.0, 3.0, ROWS)
    length = np.asarray(sum(np.abs(value) for value in sizes.values()))
    flange = models.articulated(list(_joints(random)), {**sizes, "bZUp": 1.0})
    reached = np.zeros(ROWS, dtype=bool)
    for states in SOLUTIONS:
        given: Given = {f"config.{name}": value for name, value in sizes.items()} | {"config.bZUp": True}
        given |= _pose(flange) | dict(zip(STATES, states, strict=True))
        found = transform(INVERSE, given, ["bError", *(f"dQ{axis}" for axis in AXES)])
        good = found["bError"] == 0.0
        again = models.articulated([found[f"dQ{axis}"] for axis in AXES], {**sizes, "bZUp": 1.0})
        error = np.max(np.abs(again[:, :3, 3] - flange[:, :3, 3]), axis=1) / length
        assert np.all(error[good] <= RELATIVE)
        assert np.all(np.abs(again[good, :3, :3] - flange[good, :3, :3]) <= RELATIVE)
        reached |= good
    assert np.all(reached == ((sizes["dA3"] != 0.0) | (sizes["dD4"] != 0.0)))


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_poses_of_every_convention(
    transform: Transformations, random: np.random.Generator, convention: str
) -> None:
    size = DIMENSIONS["offset wrist, Z up"]
    flange = models.articulated(list(_joints(random)), size)
    reached, found = _solutions(transform, size, _pose(flange, convention), {})
    for index in range(8):
        there = reached[index]
        again = models.articulated([axis[there] for axis in found[index]], size)
        # The angles of the given pose are rounded near their own singular places
        moved = np.abs(again[:, :3, :] - flange[there][:, :3, :])
        assert np.quantile(moved, 0.99) <= RELATIVE * _length(size)
    outputs, _ = _inverse(transform, {**_config(size), **_pose(flange, convention), "eOriConv": 0.0})
    assert np.all(outputs["bError"] == 1.0), "additional axes are no orientation"


def test_wrist_in_line(
    transform: Transformations, random: np.random.Generator, size: dict[str, float]
) -> None:
    """Axis 3 stays where it was, axis 5 takes the rest."""
    joints = _joints(random)
    joints[4] = 0.0
    flange = models.articulated(list(joints), size)
    old = random.uniform(-170.0, 170.0, ROWS)
    before: Given = {"dQ3_old": old + OFFSETS[3]}
    states = {"armState": 0.0, "elbowState": 0.0, "handState": 0.0}
    given = {f"dQ{axis}_old": joints[axis] + OFFSETS[axis] for axis in (0, 1, 2, 4, 5)}
    outputs, found = _inverse(transform, {**_config(size), **_pose(flange), **before, **given, **states})
    good = outputs["bError"] == 0.0
    assert np.count_nonzero(good) > 0.99 * ROWS, "the border of the reach is met by rounding alone"
    assert np.all(outputs["bSingular"][good] == 1.0)
    again = models.articulated([axis[good] for axis in found], size)
    assert _same_flange(again, flange[good], 2.0 * _length(size))
    kept = np.abs(found[3] - old) < 1e-9
    assert np.all(np.abs(found[4][good]) < 1e-4)
    assert np.count_nonzero(kept & good) > 0.9 * ROWS, "others are not in line by the rounding of the pose"


def test_wrist_exactly_in_line(transform: Transformations) -> None:
    """At its zeros a robot is in line without any rounding."""
    size = DIMENSIONS["offset wrist, Z up"]
    flange = models.articulated([0.0] * 6, size)[None]
    old: Given = {f"dQ{axis}_old": OFFSETS[axis] for axis in AXES}
    old["dQ3_old"] = 35.0 + OFFSETS[3]
    for hand in (1.0, -1.0):
        outputs, found = _inverse(
            transform,
            {**_config(size), **_pose(flange), **old, "handState": hand, "armState": 1.0, "elbowState": 1.0},
        )
        assert outputs["bSingular"][0] == 1.0
        assert found[:, 0] == pytest.approx([0.0, 0.0, 0.0, 35.0, 0.0, -35.0], abs=1e-9)


def test_wrist_above_axis_0(transform: Transformations) -> None:
    """Axis 0 stays where it was."""
    size = {**DIMENSIONS["arms of one length"], "dD6": 50.0}
    # An arm of two equal lengths has its wrist above the shoulder where the bends cancel
    joints = [70.0, 40.0, 90.0 - 2 * 40.0, 40.0, 50.0, 60.0]
    flange = models.articulated(joints, size)
    wrist = flange @ models.translation(0.0, 0.0, -50.0)
    assert np.hypot(*wrist[:2, 3]) < 1e-9
    exact = flange.copy()
    exact[:2, 3] -= wrist[:2, 3]
    old: Given = {f"dQ{axis}_old": joints[axis] + OFFSETS[axis] for axis in AXES}
    for kept in (70.0, -20.0, 170.0):
        outputs, found = _inverse(
            transform,
            {
                **_config(size),
                **_pose(exact[None]),
                **old,
                "dQ0_old": kept + OFFSETS[0],
                "armState": 1.0,
                "elbowState": 1.0,
            },
        )
        assert not outputs["bError"][0]
        assert outputs["bSingular"][0] == 1.0
        assert found[0, 0] == pytest.approx(kept)
        assert _same_flange(models.articulated(list(found), size), exact[None], 2 * _length(size))


def test_stretched(transform: Transformations, size: dict[str, float]) -> None:
    """Both elbows are one at the border of the reach; beyond it is an error and the axes stay."""
    straight = float(np.degrees(np.arctan2(size["dD4"], size["dA3"])))
    joints = [20.0, -30.0, straight, 10.0, 40.0, 50.0]
    pose = _pose(models.articulated(joints, size)[None])
    states = {"armState": 1.0, "handState": -1.0}
    for elbow in (1.0, -1.0):
        outputs, found = _inverse(transform, {**_config(size), **pose, **states, "elbowState": elbow})
        assert not outputs["bError"][0]
        assert found[:, 0] == pytest.approx(joints, abs=1e-4)
    far = np.asarray(pose["pi.dZ"]) + np.array([0.0, 10.0, 1e4, np.nan, np.inf]) * (
        1.0 if size["bZUp"] else -1.0
    )
    outputs, found = _inverse(transform, {**_config(size), **pose, **states, "elbowState": 1.0, "pi.dZ": far})
    assert outputs["bError"].tolist() == [0, 1, 1, 1, 1]
    assert outputs["bSingular"][1:].tolist() == [0, 0, 0, 0]
    assert np.all(found == found[:, :1])


def test_states_as_before(
    transform: Transformations, random: np.random.Generator, size: dict[str, float]
) -> None:
    """STRAIGHT as a target takes the solution that the old axes are in; axis 5 goes to the nearest turn."""
    joints = _joints(random)
    joints[5] = random.uniform(-2000.0, 2000.0, ROWS)
    apart = np.abs(np.sin(np.radians(joints[4]))) > 1e-3
    flange = models.articulated(list(joints), size)
    before: Given = {f"dQ{axis}_old": joints[axis] + OFFSETS[axis] for axis in AXES}
    outputs, found = _inverse(
        transform, {**_config(size), **_pose(flange), **before, **dict.fromkeys(STATES, 0.0)}
    )
    good = (outputs["bError"] == 0.0) & apart
    assert np.count_nonzero(good) > 0.99 * np.count_nonzero(apart)
    close = np.max(np.abs(found - joints), axis=0)[good]
    assert np.quantile(close, 0.99) < 1e-6
    assert np.all(close < 0.5)


JACOBIAN = """
PROGRAM Main
VAR
    stArm    : SM3_Kinematics.ArmDimensions;
    afJoints : ARRAY [0..5] OF LREAL;
    afResult : ARRAY [0..5, 0..5] OF LREAL;
    xDone    : BOOL;
END_VAR
xDone := SM3_Kinematics.ArmJacobian(stArm, afJoints, afJacobian => afResult);
END_PROGRAM
"""


def _rates(joints: Numbers, size: dict[str, float], axis: int) -> Numbers:
    """Velocity and angular velocity of the flange for one radian a second of an axis, by differences."""
    step = np.zeros(6)
    step[axis] = 1e-3
    ahead, behind = (models.articulated(list(joints + side * step), size) for side in (1, -1))
    seconds = 2 * np.radians(step[axis])
    spin = (ahead[:3, :3] - behind[:3, :3]) / seconds @ models.articulated(list(joints), size)[:3, :3].T
    return np.concatenate([(ahead[:3, 3] - behind[:3, 3]) / seconds, [spin[2, 1], spin[0, 2], spin[1, 0]]])


def test_the_jacobian_against_differences(random: np.random.Generator, size: dict[str, float]) -> None:
    with run(JACOBIAN, 1) as program:
        for name, value in size.items():
            program.set("Main.stArm", **{f"x{name[1:]}" if name == "bZUp" else f"f{name[1:]}": value})
        for row in random.uniform(-180.0, 180.0, (20, 6)):
            found = _jacobian(program, row)
            expected = np.stack([_rates(row, size, axis) for axis in AXES], axis=1)
            assert found == pytest.approx(expected, abs=1e-6 * _length(size))
        straight = float(np.degrees(np.arctan2(size["dD4"], size["dA3"])))
        for singular in ([10, 20, 30, 40, 0, 50], [10, 20, straight, 40, 60, 50]):
            columns = _jacobian(program, np.array(singular, dtype=float))
            columns[:3] /= _length(size)
            assert np.linalg.cond(columns) > 1e12


def _jacobian(program: Program, joints: Numbers) -> Numbers:
    program.set("Main", **{f"afJoints[{axis}]": float(joints[axis]) for axis in AXES})
    program.cycle()
    assert program.literal("Main.xDone") == "TRUE"
    return np.array(program.numbers("Main.afResult")).reshape(6, 6)
