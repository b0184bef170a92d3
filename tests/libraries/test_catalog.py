"""The libraries' pins against the catalogs of the specification."""

import json
from pathlib import Path

import pytest

from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items

DATA = Path(__file__).parents[1] / "spec" / "data"
CATALOG = {item["name"]: item for item in json.loads((DATA / "Standard.json").read_text())["items"]}
OURS = {item.name: item for item in items(load("Standard"))}


def _pins(pins: tuple[Pin, ...]) -> list[tuple[str, str]]:
    # Without a length a parameter takes 80 characters; the functions work on up to 255 (LTYP-16)
    return [(pin.name, pin.type.replace("STRING(255)", "STRING")) for pin in pins]


def test_nothing_is_missing_and_nothing_is_extra() -> None:
    assert set(OURS) == set(CATALOG)


@pytest.mark.parametrize("name", sorted(CATALOG))
def test_pins_match_the_catalog(name: str) -> None:
    ours: Item = OURS[name]
    expected = CATALOG[name]
    assert ours.kind == expected["kind"]
    for section, pins in (("inputs", ours.inputs), ("outputs", ours.outputs), ("in_out", ours.in_out)):
        assert _pins(pins) == [(pin["name"], pin["type"]) for pin in expected[section]]
    returns = ours.returns.replace("STRING(255)", "STRING") if ours.returns else None
    assert returns == (expected.get("returns"))


@pytest.mark.parametrize("item", OURS.values(), ids=lambda item: item.name)
def test_every_item_and_pin_says_what_it_is(item: Item) -> None:
    assert item.summary
    assert all(pin.comment for pin in (*item.inputs, *item.outputs, *item.in_out))
