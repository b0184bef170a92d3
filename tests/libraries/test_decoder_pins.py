"""The pins of decoder, CNC files and viewer against the catalog of the specification."""

from __future__ import annotations

import pytest
from tests.libraries.transformations import CATALOG, OURS

_PLACE = ["errorPos", "sErrorProgram", "sErrorWord", "sErrorText"]
PINS_BEYOND: dict[str, dict[str, list[str]]] = {
    "SMC_NCDecoder": {"inputs": ["fTimeBudget"], "outputs": ["sErrorWord"]},
    "SMC_ReadNCFile2": {"inputs": ["pCustomFunTable", "aTokenModifier"], "outputs": _PLACE},
    "SMC_NCInterpreter": {"inputs": ["fTimeBudget"], "outputs": _PLACE},
}
"""The time a call may take (CNCR-04), the word at fault and where it is, and what today's SoftMotion has."""
TYPES = {
    ("SMC_GCodeViewer", "iActObjectSourceNo"): "DINT",
    ("SMC_GCodeViewer", "asGCode"): "ARRAY[0..c_uiLines]OFSTRING(255)",
}
"""Line numbers beyond 32,767 (CNCR-C20); lines longer than 80 characters."""
OPEN = {
    "piStartPosition",
    "vStartToolLength",
    "sentences",
    "aSubProgramDirs",
    "ncprog",
    "poqDataOut",
    "iStatus",
    "GCodeText",
    "asGCode",
}
"""Their initial values are those of their types."""
BLOCKS = (
    *("SMC_NCDecoder", "SMC_ReadNCFile", "SMC_ReadNCQueue", "SMC_GCodeViewer"),
    *("SMC_ReadNCFile2", "SMC_NCInterpreter"),
)


@pytest.mark.parametrize("name", BLOCKS)
@pytest.mark.parametrize("section", ["in_out", "inputs", "outputs"])
def test_pins_are_those_of_the_catalog(name: str, section: str) -> None:
    """Names in their order, types, initial values; what is beyond stands behind them."""
    said = {pin["name"]: pin for pin in CATALOG[name][section]}
    ours = {pin.name: pin for pin in getattr(OURS[name], section)}
    beyond = PINS_BEYOND.get(name, {}).get(section, [])
    assert [*ours] == [*said, *beyond]
    for pin, entry in said.items():
        wanted = TYPES.get((name, pin), entry["type"]).replace(" ", "").removeprefix("SM3_Basic.")
        assert ours[pin].type.replace(" ", "").removeprefix("SM3_Basic.") == wanted
        default = ours[pin].default
        if default and pin not in OPEN:
            assert default == entry["default"]
        elif pin not in OPEN:
            assert entry.get("default") in (None, "0", "FALSE", "''", "SMC_NO_ERROR")


@pytest.mark.parametrize("name", [*BLOCKS, "SMC_GCODE_TEXT"])
def test_every_pin_says_what_it_is(name: str) -> None:
    item = OURS[name]
    assert item.summary
    assert all(pin.comment for pin in (*item.inputs, *item.outputs, *item.in_out, *item.members))
