"""The numeric cases of the specification for all transformations of SM3_CNC.

Spec CNCR-180 to CNCR-184, CNCR-200 to CNCR-206, KIN-001 to KIN-162.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from tests.libraries.transformations import (
    BLOCKS,
    DATA,
    OURS,
    OUTPUTS,
    ROBOT,
    Transformations,
)

CASES: list[dict[str, Any]] = json.loads((DATA / "kinematics_examples.json").read_text())["cases"]


def _flat(values: dict[str, Any], before: str = "") -> dict[str, float]:
    """Members of structures by their paths, names of enumerations by their numbers."""
    numbers = {value.name: int(value.value) for value in OURS["SMC_VECTORDIR"].values}
    found: dict[str, float] = {}
    for name, value in values.items():
        if isinstance(value, dict):
            found |= _flat(value, f"{before}{name}.")
        else:
            found[before + name] = float(numbers.get(value, value))
    return found


def _calls(case: dict[str, Any]) -> list[tuple[dict[str, float], dict[str, float]]]:
    if case["kind"] == "sequence":
        pairs = zip(case["inputs"]["calls"], case["expected"]["results"], strict=True)
        return [(_flat(given), _flat(expected)) for given, expected in pairs]
    return [(_flat(case["inputs"]), _flat(case["expected"]))]


def test_there_are_all_cases() -> None:
    assert [case["id"] for case in CASES] == [f"KIN-{number:03}" for number in range(1, 163)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["id"])
def test_a_case_of_the_specification(transform: Transformations, case: dict[str, Any]) -> None:
    for given, expected in _calls(case):
        found = transform(case["fb"], given, [*expected])
        for name, value in expected.items():
            assert found[name][0] == pytest.approx(value, abs=case["tolerance"]), name


WITH_ERROR = [case for case in CASES if case["expected"].get("bError") is True]


@pytest.mark.parametrize("case", WITH_ERROR, ids=lambda case: case["id"])
def test_an_error_leaves_the_other_outputs_and_ends_with_the_next_good_position(
    transform: Transformations, case: dict[str, Any]
) -> None:
    """Spec CNCR-202."""
    good = next(
        other for other in CASES if other["fb"] == case["fb"] and other["expected"].get("bError") is False
    )
    outputs = [number.path for number in OUTPUTS[case["fb"]]]
    rows = [_flat(good["inputs"]), _flat(case["inputs"]), _flat(good["inputs"])]
    given = {name: np.array([row.get(name, 0.0) for row in rows]) for name in {*rows[0], *rows[1]}}
    found = transform(case["fb"], given, outputs)
    assert found["bError"].tolist() == [0, 1, 0]
    for name in {*outputs} - {"bError", "nError"}:
        assert found[name][1] == found[name][0], name


def test_every_transformation_has_a_case() -> None:
    without = {*BLOCKS} - {case["fb"] for case in CASES}
    assert without == {"SMC_TRAFOF_Gantry3D", f"SMC_Trafo_{ROBOT}", f"SMC_TrafoF_{ROBOT}"}
