"""Absurd values at every input of every transformation of SM3_CNC: an error or held outputs, never NaN.

Spec CNCR-202.
"""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from tests.libraries.test_articulated_robot import DIMENSIONS, FORWARD, INVERSE
from tests.libraries.transformations import BLOCKS, DATA, INPUTS, OUTPUTS, Transformations

NUMBERS = (math.nan, math.inf, -math.inf, 1e300, -1e300, 5e-324, 0.0, -1.0, 1.0)
BY_TYPE = {"LREAL": NUMBERS, "BOOL": (0.0, 1.0), "INT": (0.0, -1.0, 1.0, 2.0, 3.0, 99.0, 32767.0, -32768.0)}
COORDINATES = {
    "SMC_TRAFO_Bipod_Arm": "XY",
    "SMC_TRAFO_Scara2": "XY",
    "SMC_TRAFO_Scara3": "XY",
    "SMC_TRAFO_Tripod": "XYZ",
    "SMC_TRAFO_Tripod_Arm": "XYZ",
    "SMC_Trafo_4AxisPalletizer": "XYZC",
    INVERSE: "XYZABC",
}
"""Of a position that can be out of reach."""
WITHOUT_EFFECT = {
    *("dDistance", "dMaxAngleBallJoint"),
    *(f"dQ{axis}_old" for axis in range(6)),
    *("pi.dA1", "pi.dA6"),
}
"""Inputs that do not count in any case, or not where they are no number; the distance of a bipod does."""


def _sane(block: str) -> dict[str, float]:
    """A good position of the examples, or of a robot."""
    if block in (INVERSE, FORWARD):
        given = {f"config.{name}": float(value) for name, value in DIMENSIONS["Z down"].items()}
        given["eOriConv"] = 2.0
        if block == INVERSE:
            given |= {"pi.dX": 400.0, "pi.dZ": -500.0, "pi.dB": 30.0, "armState": 1.0, "elbowState": 1.0}
        return given
    cases = json.loads((DATA / "kinematics_examples.json").read_text())["cases"]
    good = [case["inputs"] for case in cases if case["fb"] == block and "error" not in case["kind"]]
    given = good[0].get("calls", good)[0] if good else {}
    found: dict[str, float] = {}
    for name, value in given.items():
        if isinstance(value, dict):
            found |= {f"{name}.{member}": float(number) for member, number in value.items()}
        elif not isinstance(value, str):
            found[name] = float(value)
    return found


def _outputs(block: str) -> list[str]:
    """What a block computes; the other members of a position are copied."""
    copied = {f"piOut.d{name}" for name in ("A", "B", "C", "A1", "A6")}
    return [number.path for number in OUTPUTS[block] if number.path not in copied]


@pytest.mark.parametrize("block", BLOCKS)
def test_one_absurd_value(transform: Transformations, block: str) -> None:
    sane = _sane(block)
    rows: list[dict[str, float]] = []
    for number in INPUTS[block]:
        for value in BY_TYPE[number.type]:
            rows += [sane, {**sane, number.path: value}]
    given = {number.path: np.array([row.get(number.path, 0.0) for row in rows]) for number in INPUTS[block]}
    found = transform(block, given, _outputs(block))
    for name, values in found.items():
        assert np.all(np.isfinite(values)), (name, rows[int(np.argmax(~np.isfinite(values)))])
        assert np.all(values[::2] == values[0]), f"{name} is as before with the next good values"
    if block in COORDINATES:
        for row, error in zip(rows, found["bError"], strict=True):
            odd = [name for name, value in row.items() if not math.isfinite(value)]
            assert error == 1.0 or all(_may_be_odd(block, name) for name in odd), odd


def _may_be_odd(block: str, name: str) -> bool:
    if name == "dDistance" and "Bipod" in block:
        return False
    if name.startswith("pi."):
        return name.removeprefix("pi.d") not in COORDINATES[block]
    return name in WITHOUT_EFFECT


@pytest.mark.parametrize("block", BLOCKS)
def test_many_absurd_values_at_once(
    transform: Transformations, random: np.random.Generator, block: str
) -> None:
    sane = _sane(block)
    count = 3000
    given = {}
    for number in INPUTS[block]:
        odd = random.choice(BY_TYPE[number.type], count)
        scaled = sane.get(number.path, 0.0) * 10.0 ** random.choice(
            [0.0, 0.0, -9.0, 9.0, 140.0, -150.0], count
        )
        if number.type != "LREAL":
            scaled = np.full(count, sane.get(number.path, 0.0))
        given[number.path] = np.where(random.random(count) < 0.15, odd, scaled)
    for name, values in transform(block, given, _outputs(block)).items():
        assert np.all(np.isfinite(values)), name


@pytest.mark.parametrize("block", [block for block in BLOCKS if "TRAFOF" in block.upper()])
def test_a_forward_transformation_with_error_keeps_its_outputs(
    transform: Transformations, block: str
) -> None:
    outputs = _outputs(block)
    if "bError" not in outputs:
        return
    sane = _sane(block)
    drives = [number.path for number in INPUTS[block] if number.path.endswith("fSetPosition")]
    for drive in drives:
        given = {name: np.array([value, value]) for name, value in sane.items()}
        found = transform(block, {**given, drive: np.array([sane.get(drive, 0.0), math.nan])}, outputs)
        assert found["bError"].tolist() == [0.0, 1.0]
        assert all(values[0] == values[1] for name, values in found.items() if name != "bError")
