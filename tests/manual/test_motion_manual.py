"""The manual of the motion library is what the library, its examples and their runs make it."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tappet.libraries import load
from tappet.libraries.catalog import items
from tappet.manual.examples import Example
from tappet.manual.library_errors import errors_of
from tappet.manual.pages import CNC, FOLDERS, group_of, items_of, state_of
from tappet.manual.recording import ExampleError, Recording, record
from tappet.manual.simplified import simplified
from tappet.manual.written import all_examples, made, stored, write

MANUAL = Path(__file__).parents[2] / "docs" / "motion"
LARGEST = 15_000
"""Bytes of a chart."""


@cache
def recordings() -> tuple[Recording, ...]:
    return tuple(record(all_examples(MANUAL)))


@cache
def written() -> dict[str, str]:
    return made(recordings())


def test_the_manual_is_current() -> None:
    wanted, there = written(), stored(MANUAL)
    stale = sorted(name for name in wanted.keys() | there.keys() if wanted.get(name) != there.get(name))
    assert stale == [], "run: make generate"


def test_every_item_has_a_page_in_both_languages() -> None:
    names = [item.name for item in items(load("SM3_Basic"))]
    assert len(names) > 140
    for folder in ("blocks", "blocks/zh"):
        assert [name for name in names if f"{folder}/{name}.md" not in written()] == []
        index = written()[f"{folder}/README.md"]
        assert [name for name in names if f"[{name}]({name}.md)" not in index] == []


def test_every_item_of_the_cam_builder_has_a_page_in_both_languages() -> None:
    names = [item.name for item in items(load("SM3_CamBuilder"))]
    assert len(names) > 12
    for folder in ("cam-builder", "cam-builder/zh"):
        assert [name for name in names if f"{folder}/{name}.md" not in written()] == []
        index = written()[f"{folder}/README.md"]
        assert [name for name in names if f"[{name}]({name}.md)" not in index] == []
    page = written()["cam-builder/CamBuilder.md"]
    assert [
        name for name in ("Init", "Append", "CheckContinuity", "Write") if f": {name}\n" not in page
    ] == []
    assert "| `camRef` | [MC_CAM_REF](../blocks/MC_CAM_REF.md) |" in page
    assert "](../../blocks/zh/MC_CAM_REF.md)" in written()["cam-builder/zh/CamBuilder.md"]


def test_every_transformation_has_a_page_in_both_languages() -> None:
    names = {item.name for item in items(load(CNC)) if item.name.upper().startswith("SMC_TRAFO")}
    assert len(names) > 40
    assert names <= {item.name for item in items_of(CNC)}
    for folder in ("cnc", "cnc/zh"):
        index = written()[f"{folder}/README.md"]
        for name in names:
            assert f"{folder}/{name}.md" in written()
            assert f"[{name}]({name}.md)" in index
    page = written()["cnc/SMC_TRAFO_GantryCutter2.md"]
    assert "| `dOffsetX` | `LREAL` | `0` | Additional offset of the X axis |" in page, "of the INTERNAL base"
    assert "[AXIS_REF_SM3](../blocks/AXIS_REF_SM3.md)" in written()["cnc/SMC_TRAFOF_Gantry2.md"]
    assert [item.name for item in items_of(CNC) if group_of(item) == "other"] == []


def test_every_function_block_with_an_example_has_a_chart() -> None:
    blocks = {item.name for item in items(load("SM3_Basic")) if item.kind == "function_block"}
    names = {one.example.name for one in recordings()} & blocks
    assert [name for name in sorted(names) if f"blocks/charts/{name}.svg" not in written()] == []


def test_every_block_has_a_group() -> None:
    """In `blocks.csv`, with what it does to the state of its axis."""
    known = {item.name: group_of(item) for item in items(load("SM3_Basic"))}
    assert [name for name, group in known.items() if group == "other"] == []


def test_pins_are_those_of_the_library() -> None:
    page = written()["blocks/MC_MoveAbsolute.md"]
    for row in (
        "| `Axis` | [AXIS_REF_SM3](AXIS_REF_SM3.md) |  | The axis |",
        "| `Velocity` | `LREAL` | `0.0` | Largest velocity, not necessarily reached [u/s] |",
        "| `BufferMode` | [MC_BUFFER_MODE](MC_BUFFER_MODE.md) | `MC_BUFFER_MODE.Aborting` |"
        " How the command follows the one before it |",
        "| 201 | `SMC_MA_INVALID_VELACC_VALUES` | Invalid velocity or acceleration values |",
    ):
        assert row in page.splitlines()
    assert "Spec" not in page
    assert "| `stopping` | 2 |" in written()["blocks/SMC_AXIS_STATE.md"]


def test_errors_of_inner_parts_are_told_and_those_of_every_command_are_not() -> None:
    library = load("SM3_Basic")
    assert "SMC_CI_NO_CAM_SELECTED" in errors_of(library, "MC_CamIn"), "of CamUseFault"
    assert errors_of(library, "MC_MoveAbsolute") == {"SMC_MA_INVALID_VELACC_VALUES"}


def test_what_examples_expect_comes_true() -> None:
    assert [message for one in recordings() for message in one.wrong] == []


def test_every_block_has_an_example() -> None:
    blocks = {
        item.name
        for library in FOLDERS
        for item in items_of(library)
        if item.kind in ("function_block", "function")
    }
    examples = {one.example.name for one in recordings()}
    assert examples - blocks == set()
    assert blocks - examples == {
        *("AXIS_REF_SM3", "AXIS_REF_VIRTUAL_SM3", "AXIS_REF_MAPPING_SM3", "AxisPanel"),
        *("GroupedAxis", "LedAxis", "WatchedAxis"),
    }


HOLD_THE_AXIS = {"MC_Stop", "MC_CamOut", "MC_GearOut", "MC_VelocityProfile"}
"""They are busy behind their end: their page says so."""


def test_at_most_one_output_says_how_a_command_stands() -> None:
    """EXE-01 to EXE-10, in each cycle of each example."""
    seen = set()
    for one in recordings():
        name = one.example.name
        outputs = [
            values
            for pin in ("Busy", "Done", "CommandAborted", "Error")
            for prefix in ("", "b")
            if (values := one.traces.get(f"{one.example.instance}.{prefix}{pin}")) is not None
        ]
        together = {sum(map(bool, cycle)) for cycle in zip(*outputs, strict=True)}
        if len(outputs) > 1 and together - {0, 1}:
            seen.add(name)
    assert seen == HOLD_THE_AXIS


POWER_OFF, ERRORSTOP, STOPPING, STANDSTILL, DISCRETE, CONTINUOUS, SYNCHRONIZED, HOMING = range(8)
LEADS_TO = {
    "discrete": {DISCRETE},
    "continuous": {CONTINUOUS},
    "jog": {CONTINUOUS, DISCRETE},
    "through": {DISCRETE, CONTINUOUS},
    "synchronized": {SYNCHRONIZED},
    "release": {SYNCHRONIZED, CONTINUOUS},
    "halt": {DISCRETE},
    "stop": {STOPPING},
    "homing": {HOMING},
    "reset": {ERRORSTOP, STANDSTILL},
    "power": {POWER_OFF, STANDSTILL},
    "none": set(),
    "overlay": set(),
    "superimposed": set(),
}
ALONE = {
    *("MC_ReadParameter", "MC_WriteParameter", "MC_ReadBoolParameter", "MC_WriteBoolParameter"),
    *("SMC3_BrakeControl", "SMC3_BrakeStatus", "SMC_CheckAxisCommunication"),
}
"""Blocks whose examples have no other block that could change the state of the axis."""


def test_axes_come_into_the_states_that_pages_tell() -> None:
    """STA-06 to STA-14: one axis of the example has been in all states that its block leads to."""
    wrong = []
    for one in recordings():
        key = state_of(one.example.name)
        leads_to = LEADS_TO[key] if key else set()
        if leads_to and not any(leads_to <= states for states in one.states):
            wrong.append((one.example.name, key, one.states))
        if one.example.name in ALONE:
            assert (key, one.states) == ("none", (frozenset({POWER_OFF}),)), one.example.name
    within_a_cycle = ("MC_Home", "homing", (frozenset({POWER_OFF, STANDSTILL}),))
    assert wrong == [within_a_cycle], "an axis without a drive takes its position at once"


def test_a_wrong_expectation_is_told() -> None:
    one = next(one for one in recordings() if one.example.name == "MC_MoveAbsolute")
    other = tuple(replace(expected, value="99.9") for expected in one.example.expectations)
    assert replace(one, example=replace(one.example, expectations=other)).wrong == [
        "MC_MoveAbsolute, cycle 3: Move.Busy is TRUE, not 99.9",
        "MC_MoveAbsolute, cycle 500: Move.Done is TRUE, not 99.9",
        "MC_MoveAbsolute, cycle 500: Axis.fSetPosition is 100.0, not 99.9",
    ]


def test_an_example_with_a_warning_is_refused() -> None:
    program = "PROGRAM Probe\nVAR\n    Power : MC_Power;\nEND_VAR\nPower;\nEND_PROGRAM"
    with pytest.raises(ExampleError, match="W11"):
        list(record({"MC_Power": Example("MC_Power", "", program, 1, ())}))


def test_charts_are_small_drawings_without_a_background() -> None:
    charts = {name: text for name, text in written().items() if name.endswith(".svg")}
    assert charts
    for name, text in charts.items():
        assert len(text.encode()) < LARGEST, name
        assert "prefers-color-scheme:dark" in text
        root = ElementTree.fromstring(text)
        width, height = (float(number) for number in root.attrib["viewBox"].split()[2:])
        covering = [
            part
            for part in root.iter("{http://www.w3.org/2000/svg}rect")
            if float(part.attrib["height"]) > height / 2
        ]
        assert covering == [], name
        for part in root.iter("{http://www.w3.org/2000/svg}text"):
            assert 0 < float(part.attrib["x"]) < width, name
            assert 0 < float(part.attrib["y"]) <= height, name


def test_a_lane_goes_up_where_the_pin_does() -> None:
    """Busy of MC_MoveAbsolute: one cycle behind the power, until the cycle in which Done comes."""
    text = written()["blocks/charts/MC_MoveAbsolute.svg"]
    lanes = dict(
        zip(
            re.findall(r'class="n"[^>]*>Move\.(\w+)<', text),
            re.findall(r'class="b" d="([^"]+)"', text),
            strict=True,
        )
    )
    assert len(re.findall("V", lanes["Busy"])) == 3, "low, high, low"
    rise, fall, end = (float(x) for x in re.findall(r"H([\d.]+)", lanes["Busy"]))
    begin, last = (float(x) for x in re.findall(r"H([\d.]+)", lanes["Done"]))
    assert rise < fall == begin < end == last


def test_simplified_lines_stay_near_their_points() -> None:
    points = [(float(x), 50.0 if x < 100 else 150.0 - x) for x in range(200)]
    assert simplified(points) == [(0.0, 50.0), (100.0, 50.0), (199.0, -49.0)]


def test_pages_of_blocks_that_are_gone_are_removed(tmp_path: Path) -> None:
    (tmp_path / "blocks").mkdir()
    (tmp_path / "blocks" / "MC_Gone.md").write_text("old")
    write(tmp_path)
    assert not (tmp_path / "blocks" / "MC_Gone.md").exists()
    assert (tmp_path / "blocks" / "MC_Power.md").read_text().startswith("# MC_Power\n")
