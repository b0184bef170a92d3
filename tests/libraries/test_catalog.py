"""The libraries' pins against the catalogs of the specification."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest
from tests.cli.invoke import invoke

from tappet.libraries import load
from tappet.libraries.catalog import Item, items

DATA = Path(__file__).parents[1] / "spec" / "data"
LIBRARIES = ("Standard", "Util")
CATALOG = {
    (library, item["name"]): item
    for library in LIBRARIES
    for item in json.loads((DATA / f"{library}.json").read_text())["items"]
}
OURS = {(library, item.name): item for library in LIBRARIES for item in items(load(library))}
INITIAL = {"BOOL": "FALSE", "REAL": "0.0", "TIME": "T#0s", "STRING": "''", "GEN_MODE": "TRIANGLE"}
"""What a type begins with where no default is written, as the catalogs write it."""


def _type(text: str) -> str:
    # Without a length a parameter takes 80 characters; the functions work on up to 255 (LTYP-16)
    return text.replace("STRING(255)", "STRING")


def _pins(pins: list[dict[str, str]], defaults: bool) -> list[tuple[str, ...]]:
    found: list[tuple[str, ...]] = []
    for pin in pins:
        type_name = _type(pin["type"])
        # Where no default is written, that of the type holds
        default = pin.get("default") or INITIAL.get(type_name, "0")
        found.append((pin["name"], type_name, default.upper()) if defaults else (pin["name"], type_name))
    return found


def _check(ours: dict[str, Any], expected: dict[str, Any]) -> None:
    assert ours["kind"] == expected["kind"]
    simple = "DATE_AND_TIME" not in str(expected)  # its default is written in several ways
    for section, defaults in (("inputs", simple), ("outputs", False), ("in_out", False), ("members", False)):
        assert _pins(ours[section], defaults) == _pins(expected.get(section, []), defaults)
    values = [(value["name"], str(value["value"])) for value in expected.get("values", [])]
    assert [(value["name"], value["value"]) for value in ours["values"]] == values
    returns = _type(ours["returns"]) if ours["returns"] else None
    assert returns == expected.get("returns", expected.get("base_type"))


def test_nothing_is_missing_and_nothing_is_extra() -> None:
    assert set(OURS) == set(CATALOG)


@pytest.mark.parametrize("name", sorted(CATALOG), ids="/".join)
def test_pins_match_the_catalog(name: tuple[str, str]) -> None:
    _check(asdict(OURS[name]), CATALOG[name])


@pytest.mark.parametrize("library", LIBRARIES)
def test_the_command_shows_what_the_catalog_has(library: str) -> None:
    shown = invoke("library", "show", library, "--format", "json")
    assert shown.code == 0
    for item in json.loads(shown.output):
        _check(item, CATALOG[library, item["name"]])


@pytest.mark.parametrize("item", OURS.values(), ids=lambda item: item.name)
def test_every_item_and_pin_says_what_it_is(item: Item) -> None:
    assert item.summary
    pins = (*item.inputs, *item.outputs, *item.in_out, *item.members)
    assert all(part.comment for part in (*pins, *item.values))
