"""What SM3_CNC offers against the catalog of the specification: pins, types, defaults, numbers."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from tests.libraries.beyond_the_cnc_catalog import PROGRAM_ITEMS

from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items
from tappet.libraries.repository import ROOT

CATALOG: dict[str, dict[str, Any]] = {
    item["name"]: item
    for item in json.loads((Path(__file__).parents[1] / "spec" / "data" / "SM3_CNC.json").read_text())[
        "items"
    ]
}
OURS: dict[str, Item] = {item.name: item for item in items(load("SM3_CNC"))}
ELSEWHERE = {"SMC_INT_STATUS"}
"""In SM3_Basic."""
VARIABLES = {"gSMC_MParameters", "MAX_SWITCHES", "c_uiLines", "g_CNCProgManager", "g_CNCQueueManager"}
"""And constants, which no type has."""
LINE_NUMBERS = {"iLine", "iLineNumber", "iActObjectSourceNo"}
"""DINT instead of INT. Spec CNCR-C20."""
SAYS = {"errorPos", "sErrorProgram", "sErrorText", "sErrorWord"}
"""Where a program is wrong, and why."""
BEYOND: dict[str, set[str]] = {
    "SMC_GCODE_TEXT": {"aiNumbers", "asLines", "iLines"},
    "SMC_GEOINFO": {
        *("vX", "vY", "b3D", "adZ", "v4", "v5", "pPassed", "vToolLength", "adSlopeStart", "adSlopeEnd"),
        *("wCubic", "wSmoothAxes", "dwFlags", "iProbe", "pStopped"),
    },
    "SMC_INT_VELMODE": {"SIGMOID_LIMIT", "QUADRATIC", "QUADRATIC_SMOOTH"},
    "SMC_Interpolator": {"dJerkMax", "bProbe", "bAcknProbe", "iProbe", "piProbePosition"},
    "SMC_Interpolator2Dir": {"dJerkMax"},
    "SMC_NCDecoder": {"fTimeBudget", "sErrorWord"},
    "SMC_NCInterpreter": {"fTimeBudget", *SAYS},
    "SMC_OUTQUEUE": {"nStored", "nHeld", "nChecked", "nPlans"},
    "SMC_ReadNCFile2": {"aTokenModifier", "pCustomFunTable", *SAYS},
    "SMC_RecomputeABCSlopes": {"dAngleTol"},
    "SMC_SmoothMerge": {"piMaxDifference", "dMinCurvatureRadius", "nFeatureFlag"},
    "SMC_VARTYPE": {"SMC_TYPE_M_PARAMETERS"},
}
"""Pins, members and values that the manuals do not have."""
INITIAL = {"BOOL": "FALSE", "STRING": "''"}
OTHER_DEFAULTS = {("SMC_VARLIST", "wVarListID")}
"""The tag is there from the start."""


def _type(text: str) -> str:
    return text.upper().replace(" ", "").replace("SM3_BASIC.", "").replace("STRING(255)", "STRING")


def _default(text: str | None, type_name: str) -> str:
    """As a number, or the name of a value; what the type begins with where none is written."""
    values = OURS[type_name].values if type_name in OURS else ()
    text = text or INITIAL.get(_type(type_name), "0")
    for value in values:
        if value.name == text.rpartition(".")[2]:
            text = value.value
    try:
        return str(float(text))
    except ValueError:
        return text.rpartition(".")[2].upper()


def _pins(name: str, ours: tuple[Pin, ...], said: list[dict[str, Any]], defaults: bool) -> None:
    beyond = BEYOND.get(name, set())
    found = {pin.name: pin for pin in ours if pin.name not in beyond}
    assert {*found} == {pin["name"] for pin in said}
    for pin in said:
        our = found[pin["name"]]
        assert _type(our.type) == ("DINT" if our.name in LINE_NUMBERS else _type(pin["type"])), pin["name"]
        if defaults and (name, our.name) not in OTHER_DEFAULTS:
            assert _default(our.default, our.type) == _default(pin.get("default"), our.type), pin["name"]


def test_every_item_of_the_catalog_is_there() -> None:
    assert {*CATALOG} - {*OURS} - ELSEWHERE == VARIABLES
    texts = [path.read_text("utf-8") for path in (ROOT / "SM3_CNC").glob("*.st")]
    declared = {name for text in texts for name in re.findall(r"^    (\w+) +: ", text, re.MULTILINE)}
    assert declared >= VARIABLES


@pytest.mark.parametrize("name", sorted({*CATALOG} & {*OURS}))
def test_items_have_the_pins_of_the_catalog(name: str) -> None:
    ours, said = OURS[name], CATALOG[name]
    assert ours.kind == said["kind"]
    for section, defaults in (("in_out", False), ("inputs", True), ("outputs", False), ("members", True)):
        _pins(name, getattr(ours, section), said.get(section) or [], defaults)
    values = {
        value.name: int(value.value) for value in ours.values if value.name not in BEYOND.get(name, set())
    }
    assert values == {value["name"]: int(value["value"]) for value in said.get("values") or []}
    assert ours.summary
    pins = (*ours.inputs, *ours.outputs, *ours.in_out, *ours.members, *ours.values)
    assert all(part.comment for part in pins)


@pytest.mark.parametrize("name", sorted(PROGRAM_ITEMS))
def test_items_beyond_the_catalog(name: str) -> None:
    """Names of pins, members and values in their order."""
    ours = OURS[name]
    pins = [pin.name for pin in (*ours.inputs, *ours.outputs, *ours.in_out, *ours.members)]
    assert [*pins, *(value.name for value in ours.values)] == PROGRAM_ITEMS[name]
    assert ours.summary
