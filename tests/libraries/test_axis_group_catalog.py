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
    assert _pins(OURS[name], section) == _said(CATALOG[name], section)


@pytest.mark.parametrize("name", ENUMERATIONS)
def test_values_are_those_of_the_catalog(name: str) -> None:
    ours = {value.name: int(value.value) for value in OURS[name].values}
    assert ours == {value["name"]: int(value["value"]) for value in CATALOG[name]["values"]}
