"""What SM3_Basic offers against both catalogs of the specification: the pins of both are pins of a block."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.cli.invoke import invoke
from tests.libraries.beyond_the_catalogs import BLOCKS, ENUMERATIONS, PINS_ADDED
from tests.libraries.beyond_the_catalogs import STRUCTURES as NEW_STRUCTURES
from tests.libraries.st_program import run

from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items

DATA = Path(__file__).parents[1] / "spec" / "data"
INHERITED = {"AXIS_REF_LOGICAL_SM3": ("iMovementType", "wDriveId")}
"""Members that a catalog lists again, of the type below; the case of a name does not count in ST."""
OPAQUE = {"SMC_CAMElement", "SMC_TAPPETDATA"}
"""Types whose members the catalogs leave open."""
BEYOND = {
    *("SMC_CAM_TYPE", "SMC_CAM_SEGMENT_TYPE", "SMC_CAM_SEGMENT"),
    *("SMC_CAMEvaluate", "SMC_CAMValues", "MC_INPUT_REF"),
    *("AxisPanel", "AxisPanelCommand", "AxisPanelPhase", "AxisPanelState"),
    *("CiA402State", "CiA402StateOf", "CiA402Drive", "CiA402Control"),
    "AXIS_REF_POSCONTROL_SM3",
    *("GroupedAxis", "IAxisGroup", "LedAxis", "WatchedAxis"),
    *("SMC_CAMSWITCH_TOGGLE_EVENT", "SMC_CAMSWITCH_TRACK_EVENTS"),
    *("DriveIn", "DriveOut", "SMC3_CaptureDescription", "SimulatedDrive", "SimulatedDriveSettings"),
}
"""What the library has beyond the catalogs."""
PINS_BEYOND: dict[str, set[str]] = {name: {*pins} for name, pins in PINS_ADDED.items()}
PINS_BEYOND["MC_CAM_REF"] = {"nMaxElements"}
PINS_BEYOND["AXIS_REF_MAPPING_SM3"] = {
    *("byPositionBits", "fRatedTorque", "fDeadTimeCycles", "fMaxPositionLag", "byDriveMode"),
}
PINS_BEYOND["AXIS_REF_LOGICAL_SM3"] = {"pMaster"}
"""Pins that a block has beyond the catalogs."""
OURS = {item.name: item for item in items(load("SM3_Basic"))}
STRUCTURES = {"in": "DRIVEIN", "out": "DRIVEOUT", "aCaptDesc": "ARRAY[0..1]OFSMC3_CAPTUREDESCRIPTION"}
"""Members of AXIS_REF_SM3 whose types the catalogs leave open."""
ZERO = {"BOOL": "FALSE", "TIME": "T#0S", "SMC_ERROR": "SMC_NO_ERROR", "LREAL": "0.0"}
"""What a type begins with, as we write it."""
STARTS_WITHOUT_POWER = {"nAxisState": "POWER_OFF"}
"""The catalogs contradict each other; motion_semantics 21 decides."""


def _instances(items: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """The items of a catalog, families of types by their members."""
    for item in items:
        if not item.get("template"):
            yield item
            continue
        for name in item["instances"]:
            variable_type, count = name.split("_")[2:4]
            members = json.dumps(item["members"]).replace("<variable type>", variable_type)
            members = members.replace("<number of elements>-1", str(int(count) - 1))
            yield {**item, "name": name, "members": json.loads(members)}


CATALOGS = [
    {
        item["name"].upper(): item
        for item in _instances(json.loads((DATA / f"{name}.json").read_text())["items"])
    }
    for name in ("errors_AX3000", "AX3000", "SM3_Basic")
]
"""Of entries that differ the last one counts."""


def _expected(name: str, section: str) -> dict[str, dict[str, Any]]:
    pins: dict[str, dict[str, Any]] = {}
    for catalog in CATALOGS:
        for pin in catalog.get(name.upper(), {}).get(section) or []:
            pins[pin["name"]] = pin
    return pins


def _default(text: str | None, type_name: str) -> str:
    enumeration = OURS[type_name].values if type_name in OURS else ()
    for value in enumeration:
        if value.value == text:
            text = value.name
    text = (text or ZERO.get(type_name, "0")).upper().rpartition(".")[2] if not _is_number(text) else text
    return str(float(text)) if _is_number(text) else str(text)


def _is_number(text: str | None) -> bool:
    try:
        float(text or "")
    except ValueError:
        return False
    return True


def _check(name: str, ours: tuple[Pin, ...], expected: dict[str, dict[str, Any]], defaults: bool) -> None:
    beyond = PINS_BEYOND.get(name, set())
    assert not beyond & {*expected}
    assert [pin.name for pin in ours if pin.name not in {*expected, *beyond}] == []
    assert {*expected} - {pin.name for pin in ours} == set()
    for pin in ours:
        if pin.name in beyond:
            continue
        said = expected[pin.name]
        wanted_type = STRUCTURES.get(pin.name, said["type"].upper().replace(" ", ""))
        assert pin.type.upper().replace(" ", "") == wanted_type, pin.name
        if defaults and said.get("default") is not None:
            wanted = STARTS_WITHOUT_POWER.get(pin.name) or _default(said["default"], pin.type)
            assert _default(pin.default, pin.type) == wanted, pin.name


def _enumerated(item: Item) -> dict[str, int]:
    return {value.name: int(value.value) for value in item.values}


@pytest.mark.parametrize("name", sorted(NEW_STRUCTURES))
def test_structures_beyond_the_catalogs_have_the_members_of_their_sources(name: str) -> None:
    assert {member.name: member.type for member in OURS[name].members} == NEW_STRUCTURES[name]


@pytest.mark.parametrize("name", sorted({*OURS} - {*BLOCKS} - {*ENUMERATIONS}))
def test_items_have_the_pins_of_both_catalogs(name: str) -> None:
    ours = OURS[name]
    if name in BEYOND:
        assert not any(name.upper() in catalog for catalog in CATALOGS)
        return
    if ours.kind == "parameter_list":
        for parameter in ours.members:
            said = CATALOGS[-1][parameter.name.upper()]
            assert parameter.type == said["type"]
            assert said["default"] in (None, parameter.default), parameter.name
        return
    assert any(name.upper() in catalog for catalog in CATALOGS)
    values = _expected(name, "values")
    if ours.values:
        numbered = {text: int(value["value"]) for text, value in values.items() if value["value"] is not None}
        found = _enumerated(ours)
        assert {text: found[text] for text in numbered} == numbered
        assert all(number >= 10_000 for text, number in found.items() if text not in numbered)
        return
    if name in OPAQUE:
        assert _expected(name, "members") == {}
        return
    if ours.kind == "struct":
        _check(name, ours.members, _expected(name, "members"), defaults=True)
        return
    inputs = _expected(name, "inputs") | _expected(name, "members")
    for inherited in INHERITED.get(name, ()):
        below = next(pin for pin in OURS["AXIS_REF_SM3"].inputs if pin.name == inherited)
        listed = next(pin for pin in inputs if pin.upper() == inherited.upper())
        assert inputs.pop(listed)["type"] == below.type
    _check(name, ours.inputs, inputs, defaults=True)
    _check(name, ours.outputs, _expected(name, "outputs"), defaults=False)
    _check(name, ours.in_out, _expected(name, "in_out"), defaults=False)


@pytest.mark.parametrize("name", sorted({*OURS} - {*BLOCKS} - {*ENUMERATIONS} - BEYOND - {"LibParams"}))
def test_items_are_of_the_kind_and_type_of_both_catalogs(name: str) -> None:
    """A function block, a function with its result, a structure, an enumeration or an alias."""
    said = [catalog[name.upper()] for catalog in CATALOGS if name.upper() in catalog]
    assert OURS[name].kind in {item["kind"] for item in said}
    results = {result.upper() for item in said if (result := item.get("returns") or item.get("type"))}
    if results:
        assert results == {str(OURS[name].returns).upper()}


def test_library_show_has_what_is_compared_here() -> None:
    """`tappet library show` is held against the catalogs: the same items, pins, types and defaults."""
    found = json.loads(invoke("library", "show", "SM3_Basic", "--format", "json").output)
    shown = {item["name"]: item for item in found}
    assert {*shown} == {*OURS}
    for name, item in OURS.items():
        for section in ("inputs", "outputs", "in_out", "members"):
            ours = [(pin.name, pin.type, pin.default) for pin in getattr(item, section)]
            assert [(pin["name"], pin["type"], pin["default"]) for pin in shown[name][section]] == ours, name
        assert [(value["name"], value["value"]) for value in shown[name]["values"]] == [
            (value.name, value.value) for value in item.values
        ]
        assert (shown[name]["kind"], shown[name]["returns"]) == (item.kind, item.returns)


@pytest.mark.parametrize("name", sorted(BLOCKS))
def test_blocks_beyond_the_catalogs_have_the_pins_of_their_source(name: str) -> None:
    ours, expected = OURS[name], BLOCKS[name]
    assert {pin.name: pin.type for pin in ours.inputs} == expected["inputs"]
    assert {pin.name: pin.type for pin in ours.outputs} == expected["outputs"]
    assert {pin.name: pin.type for pin in ours.in_out} == expected["in_out"]


@pytest.mark.parametrize("name", sorted(ENUMERATIONS))
def test_enumerations_beyond_the_catalogs_have_the_numbers_of_their_source(name: str) -> None:
    assert _enumerated(OURS[name]) == ENUMERATIONS[name]


@pytest.mark.parametrize("name", sorted(PINS_ADDED))
def test_pins_that_plcopen_adds_are_there(name: str) -> None:
    ours = {pin.name: pin.type for pin in (*OURS[name].inputs, *OURS[name].outputs)}
    assert {pin: ours.get(pin) for pin in PINS_ADDED[name]} == PINS_ADDED[name]


def test_every_error_number_of_the_specification_has_its_name() -> None:
    expected = {value["name"]: value["value"] for value in CATALOGS[-1]["SMC_ERROR"]["values"]}
    found = _enumerated(OURS["SMC_ERROR"])
    assert {name: found[name] for name in expected} == expected
    assert len(set(found.values())) == len(found)


@pytest.mark.parametrize("item", OURS.values(), ids=lambda item: item.name)
def test_every_item_and_pin_says_what_it_is(item: Item) -> None:
    assert item.summary
    assert all(
        part.comment for part in (*item.inputs, *item.outputs, *item.in_out, *item.members, *item.values)
    )


def test_the_library_has_every_item_of_both_catalogs() -> None:
    parameters = {member.name.upper() for item in OURS.values() for member in item.members}
    with run(
        "PROGRAM Main\nVAR\n    n : INT := SM3_Basic.g_SMC_NUMBER_FB_ERRORS;\nEND_VAR\nEND_PROGRAM", 1
    ) as program:
        assert int(program.literal("Main.n")) > 0  # the catalog leaves the number open
    ours = {name.upper() for name in OURS} | parameters | {"G_SMC_NUMBER_FB_ERRORS"}
    assert sorted(name for catalog in CATALOGS for name in catalog if name not in ours) == []
