"""The pins of the transformations of SM3_CNC against the catalog of the specification."""

from __future__ import annotations

from typing import Any

import pytest
from tests.libraries.beyond_the_cnc_catalog import BLOCKS as BEYOND
from tests.libraries.beyond_the_cnc_catalog import ENUMERATIONS, STRUCTURES
from tests.libraries.transformations import BLOCKS, CATALOG, OTHERS, OURS

from tappet.libraries.catalog import Pin

INITIAL = {"LREAL": "0", "BOOL": "FALSE", "INT": "0", "WORD": "0"}
EXPECTED = {name for name in CATALOG if "TRAFO" in name.upper() or name in OTHERS}


def _default(text: str | None, type_name: str) -> str | None:
    """What a pin begins with; the catalog leaves some open, where the type decides."""
    text = (text or INITIAL.get(type_name, "")).rpartition(".")[2]
    return str(float(text)) if text.lstrip("-").isdigit() else text


def _pins(pins: tuple[Pin, ...]) -> dict[str, tuple[str, str | None]]:
    return {pin.name: (pin.type, _default(pin.default, pin.type)) for pin in pins}


def _said(pins: list[dict[str, Any]]) -> dict[str, tuple[str, str | None]]:
    return {pin["name"]: (pin["type"], _default(pin.get("default"), pin["type"])) for pin in pins}


def test_every_transformation_of_the_catalog_is_there() -> None:
    structures = {name for name in EXPECTED if CATALOG[name]["kind"] == "struct"}
    assert {*BLOCKS} == (EXPECTED - structures) | {*BEYOND}
    assert structures <= {*OURS}


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_pins_are_those_of_the_catalog(name: str) -> None:
    ours, said = OURS[name], CATALOG[name]
    assert ours.kind == said["kind"]
    for section in ("in_out", "inputs", "outputs", "members"):
        assert _pins(getattr(ours, section)) == _said(said.get(section, []))


@pytest.mark.parametrize("name", sorted({*BLOCKS, *STRUCTURES}))
def test_every_pin_says_what_it_is(name: str) -> None:
    item = OURS[name]
    assert item.summary
    assert all(pin.comment for pin in (*item.inputs, *item.outputs, *item.in_out, *item.members))


@pytest.mark.parametrize("name", sorted(BEYOND))
def test_blocks_beyond_the_catalog_have_the_pins_of_their_source(name: str) -> None:
    for section, pins in BEYOND[name].items():
        assert {pin.name: pin.type for pin in getattr(OURS[name], section)} == pins


@pytest.mark.parametrize("name", sorted(STRUCTURES))
def test_structures_beyond_the_catalog_have_the_members_of_their_source(name: str) -> None:
    assert {member.name: member.type for member in OURS[name].members} == STRUCTURES[name]


@pytest.mark.parametrize("name", sorted(ENUMERATIONS))
def test_enumerations_beyond_the_catalog_have_the_numbers_of_their_source(name: str) -> None:
    assert {value.name: int(value.value) for value in OURS[name].values} == ENUMERATIONS[name]
    assert all(value.comment for value in OURS[name].values)
