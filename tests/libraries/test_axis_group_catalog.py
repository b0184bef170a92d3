"""What SM3_AxisGroup offers against the catalog of the specification: pins, types, values of enumerations."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items

CATALOG: dict[str, dict[str, Any]] = {
    item["name"]: item
    for item in json.loads((Path(__file__).parents[1] / "spec/data/AxisGroup.json").read_text())["items"]
}
OURS = {item.name: item for item in items(load("SM3_AxisGroup"))}
ELSEWHERE = {"MC_BUFFER_MODE": "SM3_Basic"}
EXTENDED = {"CommandAccepted", "CommandID"}
"""Outputs of PLCopen part 4, version 2.0, beyond the catalog, at blocks whose commands wait in the queue."""
BLOCKS = sorted(name for name, item in CATALOG.items() if item["kind"] == "function_block" and name in OURS)
ENUMERATIONS = sorted(name for name, item in CATALOG.items() if item["kind"] == "enum" and name in OURS)


def _plain(text: str) -> str:
    return text.upper().replace(" ", "").replace("MAX_AXIS", "5")


def _types(pins: tuple[Pin, ...]) -> dict[str, str]:
    return {pin.name: _plain(pin.type) for pin in pins}


def _said(item: dict[str, Any], section: str) -> dict[str, str]:
    return {pin["name"]: _plain(pin["type"]) for pin in item.get(section) or []}


def test_nothing_of_the_catalog_is_forgotten() -> None:
    """AG-01, AG-07."""
    assert {name for name in CATALOG if name not in OURS and name not in ELSEWHERE} == set()


def _pins(item: Item, section: str) -> dict[str, str]:
    return _types({"inputs": item.inputs, "outputs": item.outputs, "in_out": item.in_out}[section])


@pytest.mark.parametrize("section", ["in_out", "inputs", "outputs"])
@pytest.mark.parametrize("name", BLOCKS)
def test_pins_are_those_of_the_catalog(name: str, section: str) -> None:
    ours = _pins(OURS[name], section)
    assert {pin: type for pin, type in ours.items() if pin not in EXTENDED} == _said(CATALOG[name], section)


@pytest.mark.parametrize("name", ENUMERATIONS)
def test_values_are_those_of_the_catalog(name: str) -> None:
    ours = {value.name: int(value.value) for value in OURS[name].values}
    assert ours == {value["name"]: int(value["value"]) for value in CATALOG[name]["values"]}


VERSION_2 = {
    *("MC_GroupPower", "MC_ReadAxisGroupInfo", "MC_GroupWaitTime", "MC_GroupJog", "MC_GroupJogVector"),
    *("MC_GroupReadVelocity", "MC_GroupReadAcceleration", "MC_GroupTransformPosition"),
    *("MC_GroupReadPosition", "MC_GroupReadMotionState", "MC_GroupReadParameter", "MC_GroupWriteParameter"),
    *("MC_GroupReadBoolParameter", "MC_GroupWriteBoolParameter", "MC_GroupReadSWLimits"),
    *("MC_GroupWriteSWLimits", "MC_GroupReadDefaultDynamics", "MC_GroupWriteDefaultDynamics"),
    *("MC_GroupReadReferenceDynamics", "MC_GroupWriteReferenceDynamics", "MC_GroupReadJoggingDynamics"),
    "MC_GroupWriteJoggingDynamics",
}
"""Blocks of PLCopen part 4, version 2.0, beyond the catalog."""


def test_blocks_of_version_2() -> None:
    assert {name for name in VERSION_2 if name in OURS and OURS[name].kind == "function_block"} == VERSION_2


def test_who_says_that_a_command_was_accepted() -> None:
    """The blocks whose commands wait in the queue."""
    named = {name for name, item in OURS.items() if {pin.name for pin in item.outputs} >= EXTENDED}
    moving = {name for name in OURS if name.startswith(("MC_MoveLinear", "MC_MoveCircular", "MC_MoveDirect"))}
    assert named >= moving | {"MC_GroupHalt", "MC_GroupWaitTime", "SMC_GroupWait"}
