"""Axes in the tree and what the compiler gets of them (devices.md AXIS-01, AXIS-04, AXIS-13, AXIS-17,
AXIS-20, AXIS-21; motion_semantics CAL-08)."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from tests.project.axis_projects import application_id, build, errors, moving, only, values, with_axes

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.lang.coding_settings import static_analysis
from tappet.lang.diagnostics import TABLE
from tappet.project import edit
from tappet.project.axes.literals import real
from tappet.project.axes.settings import AxisSettings, Scaling
from tappet.project.errors import InvalidDataError, NotPlaceableError
from tappet.project.model import Project
from tappet.project.sources import WrittenSources, application_sources, libraries, tasks


def test_the_pool_stands_once_below_an_application_and_takes_axes() -> None:
    project = with_axes("Drive")
    pool = only(project, "axis_pool")
    assert pool.name == "SoftMotion General Axis Pool"
    with pytest.raises(NotPlaceableError, match="only one is possible"):
        edit.add_object(project, application_id(project), "axis_pool")
    with pytest.raises(NotPlaceableError, match=r"belongs below axis pool"):
        edit.add_object(project, application_id(project), "axis", "Other")


def test_an_axis_brings_its_library() -> None:
    project = with_axes("Drive")
    assert "SM3_Basic" in [reference.name for reference in libraries(project, application_id(project))]
    assert errors(moving(project)) == []


def test_the_bus_task_calls_axes_around_its_programs_in_tree_order() -> None:
    project = with_axes("Drive", "Other")
    (task,) = tasks(project, application_id(project))
    assert task.programs == ("SM3_Begin_MainTask", "PLC_PRG", "SM3_End_MainTask")
    text = application_sources(project, application_id(project))[-1].text
    assert text.index("Drive.BeginCycle") < text.index("Other.BeginCycle") < text.index("Drive.EndCycle")
    assert text.index("Drive.EndCycle") < text.index("Other.EndCycle")
    assert "Drive.fTaskCycle := 0.02;" in text


def test_an_axis_is_moved_by_the_fastest_cyclic_task_unless_told_otherwise() -> None:
    project = moving(with_axes("Drive", "Other"))
    configuration = only(project, "task_configuration")
    fast = {"interval": "T#1ms", "pous": []}
    project, _ = edit.add_object(project, configuration.id, "task", "Fast", data=fast)
    main, other = tasks(project, application_id(project))
    assert main.programs == ("PLC_PRG",)
    assert other.programs == ("SM3_Begin_Fast", "SM3_End_Fast")
    pool = only(project, "axis_pool")
    project = edit.change_data(project, pool.id, {"bus_task": "maintask"})
    assert tasks(project, application_id(project))[0].programs[0] == "SM3_Begin_MainTask"
    axis = project.children(pool.id)[1]
    project = edit.change_data(project, axis.id, {**axis.data.model_dump(), "bus_task": "Fast"})
    assert [len(task.programs) for task in tasks(project, application_id(project))] == [3, 2]
    assert errors(project) == []


def test_a_chosen_bus_task_follows_its_name() -> None:
    project = with_axes("Drive", bus_task="MainTask")
    project = edit.rename_object(project, only(project, "task").id, "Motion")
    assert only(project, "axis").data.model_dump()["bus_task"] == "Motion"


@pytest.mark.parametrize(
    ("task", "chosen", "message"),
    [
        ({"type": "freewheeling"}, "MainTask", "The bus task MainTask of the axis Drive is not cyclic"),
        ({"type": "event", "event": "PLC_PRG.x"}, "", "The application has no cyclic task"),
        ({}, "Nowhere", "The bus task Nowhere of the axis Drive does not exist"),
    ],
)
def test_an_axis_without_a_cyclic_task_is_an_error_at_the_axis(
    task: dict[str, Any], chosen: str, message: str
) -> None:
    project = with_axes("Drive", bus_task=chosen)
    data = {**only(project, "task").data.model_dump(), **task}
    project = edit.change_data(project, only(project, "task").id, data)
    found = [d for d in build(project).diagnostics if d.severity == "error" and message in d.message]
    assert len(found) == 1
    source = next(s for s in application_sources(project, application_id(project)) if s.uri == found[0].uri)
    assert source.segments[0].object_id == only(project, "axis").id


def test_coding_rules_of_users_say_nothing_about_what_they_did_not_write() -> None:
    rules = {code: "warning" for code in TABLE if code.startswith("S")}
    (one,) = project_applications(moving(with_axes("Drive", "Other")))
    options = replace(one.options, level=1, static=static_analysis(rules, {}, {}))
    found = build_application(one.sources, one.tasks, options=options).diagnostics
    assert {d.uri for d in found} == {"PLC_PRG", ""}


def test_an_application_without_any_task_says_so() -> None:
    project = with_axes("Drive")
    project = edit.delete_object(project, only(project, "task").id)
    project = edit.delete_object(project, only(project, "pou").id)
    assert any("has no cyclic task" in message for message in errors(project))


def test_what_is_excluded_is_not_moved() -> None:
    project = with_axes("Drive", "Other")
    axes = project.find_kind("axis")
    project = edit.exclude_object(project, axes[0].id, True)
    assert all(
        "Drive.EndCycle" not in source.text
        for source in application_sources(project, application_id(project))
    )
    project = edit.exclude_object(project, only(project, "axis_pool").id, True)
    assert tasks(project, application_id(project))[0].programs == ("PLC_PRG",)


def test_equal_texts_stay_the_same_object() -> None:
    """An edit elsewhere does not have the analysis read them again."""
    project = with_axes("Drive")
    written = WrittenSources()
    first = application_sources(project, application_id(project), written)
    second = application_sources(moving(project), application_id(project), written)
    assert [a is b for a, b in zip(first, second, strict=True)] == [False, True, True]


@pytest.mark.parametrize(
    ("field", "value", "place"),
    [
        ("modulo", 0, "modulo"),
        ("modulo", math.nan, "modulo"),
        ("dynamic_limits", {"velocity": 0}, "velocity"),
        ("drive_limits", {"jerk": -1}, "jerk"),
        ("scaling", {"increments": 0}, "increments"),
        ("scaling", {"units": 0}, "units"),
        ("software_limits", {"enabled": True, "negative": 5, "positive": 5}, "negative software limit"),
        ("drive", "SM_Drive_Elsewhere", "drive"),
    ],
)
def test_impossible_settings_are_refused_by_name(field: str, value: Any, place: str) -> None:
    with pytest.raises(InvalidDataError, match=place):
        with_axes("Drive", **{field: value})


def test_scaling_as_in_the_manual() -> None:
    """devices EX-05: 3600 increments a turn in radians; 4096 increments a turn in degrees."""
    radians = Scaling(increments=3600, units=2 * math.pi)
    assert float(radians.units_per_increment) == pytest.approx(0.001745329, rel=1e-6)
    assert float(radians.ratio) == pytest.approx(2 * math.pi / 3600, rel=1e-9)
    degrees = Scaling(increments=4096, units=360)
    assert 1024 * degrees.units_per_increment == 90
    assert degrees.ratio == Fraction(360, 4096)
    assert Scaling(increments=4096, units=360, invert=True).ratio == Fraction(-360, 4096)
    geared = Scaling(increments=1000, gear_motor_turns=10, gear_output_turns=3, output_turns=2, units=5)
    assert geared.units_per_increment == Fraction(3, 10) * Fraction(5, 2) / 1000


@pytest.mark.parametrize("units", [1e-9, 1e-3, 1 / 3, math.e, 1e6, 1e12])
@pytest.mark.parametrize("increments", [1, 65536, 2**31 - 1])
def test_the_ratio_fits_into_its_members(units: float, increments: int) -> None:
    scaling = Scaling(increments=increments, units=units)
    ratio = scaling.ratio
    assert 1 <= ratio.numerator <= 2**31 - 1
    assert 1 <= ratio.denominator <= 2**32 - 1
    if 1e-6 < float(scaling.units_per_increment) < 1e6:
        assert float(ratio) == pytest.approx(float(scaling.units_per_increment), rel=1e-3)


@pytest.mark.parametrize("value", [0.0, 1e-05, 1e300, 0.1, -2.5, 123456789.0, 1e16])
def test_numbers_are_literals(value: float) -> None:
    text = real(value)
    assert "." in text.partition("E")[0]
    assert float(text) == value


def test_an_axis_of_a_drive_that_follows_a_speed() -> None:
    """AXIS-40 to AXIS-48."""
    control = {
        "gain": 20.0,
        "dead_time": 1.5,
        "bits": 16,
        "rated_velocity": 500.0,
        "rated_raw": 16384,
        "speed_from": "position",
    }
    project = moving(
        with_axes(
            "Drive",
            drive="SM_Drive_PosControl",
            axis_type="finite",
            position_lag=3.0,
            position_control=control,
        )
    )
    members = (
        "fKp",
        "fDeadTimeCycles",
        "byPositionBits",
        "fRatedVelocity",
        "diRatedRaw",
        "bSpeedFromPosition",
    )
    members += ("fMaxPositionLag", "bHWLimitEnable", "bVirtual", "out.bRegulatorOn")
    found = values(project, 20, *(f"Drive.{member}" for member in members))
    assert found == [20.0, 1.5, 16, 500.0, 16384, True, 3.0, True, False, True]
    text = application_sources(project, application_id(project))[0].text
    assert "Drive : SM3_Basic.AXIS_REF_POSCONTROL_SM3" in "".join(
        source.text for source in application_sources(project, application_id(project))
    ), text
    given = {"Drive__in__bRegulatorRealState": True, "Drive__in__bDriveStartRealState": True}
    (speed,) = values(project, 60, "Drive.out.diSetVelocity", **given)
    assert speed > 0


def _with_logical(**mirroring: Any) -> Project:
    project = with_axes(
        "Mirror", "Drive", drive="SM_Drive_Logical", mirroring={"master": "Drive", **mirroring}
    )
    return moving(project)


def test_a_logical_axis_mirrors_its_master() -> None:
    """AXIS-30 to AXIS-36; it stands in front of its master in the tree, and its cycle behind."""
    project = _with_logical(position_filter=0, velocity_filter=3)
    sources = application_sources(project, application_id(project))
    end = next(source.text for source in sources if "PROGRAM SM3_End_MainTask" in source.text)
    assert end.index("Drive.EndCycle") < end.index("Mirror.EndCycle")
    members = (
        "Drive.fSetPosition",
        "Mirror.fSetPosition",
        "Mirror.usiFilterDepthVelocity",
        "Mirror.nAxisState",
    )
    place, mirrored, depth, state = values(project, 100, *members)
    assert 0.0 < place < 50.0
    assert mirrored == pytest.approx(place, abs=1e-9)
    assert (depth, state) == (3, 6)


def test_the_master_of_a_logical_axis_follows_its_name() -> None:
    project = _with_logical()
    drive = next(item for item in project.find_kind("axis") if item.name == "Drive")
    project = edit.rename_object(project, drive.id, "Feed")
    mirror = next(item for item in project.find_kind("axis") if item.name == "Mirror")
    assert mirror.data_as(AxisSettings).mirroring.master == "Feed"
    assert errors(project) == []


@pytest.mark.parametrize(
    ("master", "text"),
    [
        ("", "The logical axis Mirror has no master; choose the axis that it mirrors"),
        ("Nobody", "The axis Nobody that Mirror mirrors does not exist; choose another master"),
        ("mirror", "The logical axis Mirror is its own master; choose another axis"),
    ],
)
def test_a_logical_axis_without_a_master_is_an_error_at_the_axis(master: str, text: str) -> None:
    assert text in errors(_with_logical(master=master))


def test_a_logical_axis_has_the_task_of_its_master() -> None:
    project = _with_logical()
    configuration = only(project, "task_configuration")
    slow = {"interval": "T#100ms", "pous": []}
    project, _ = edit.add_object(project, configuration.id, "task", "Slow", data=slow)
    mirror = next(item for item in project.find_kind("axis") if item.name == "Mirror")
    project = edit.change_data(project, mirror.id, {**mirror.data.model_dump(), "bus_task": "Slow"})
    assert errors(project) == [
        "The axis Mirror has another bus task than its master Drive; choose the same one"
    ]


@pytest.mark.parametrize("master", ["Drive)", "A.B", "1"])
def test_a_master_is_a_name(master: str) -> None:
    with pytest.raises(InvalidDataError):
        _with_logical(master=master)


@pytest.mark.parametrize("interval", ["T#1ms", "T#2ms", "T#2500us", "T#4ms", "T#20ms"])
def test_cycle_times_of_a_bus_task(interval: str) -> None:
    """ax3000 TASK-08: those of the manual, and the ends of the range."""
    project = moving(with_axes("Drive"))
    task = only(project, "task")
    project = edit.change_data(project, task.id, {**task.data.model_dump(), "interval": interval})
    cycle, place = values(project, 200, "Drive.fTaskCycle", "Drive.fSetPosition")
    assert cycle == {"T#2500us": 0.0025}.get(interval, int(interval[2:-2]) / 1000)
    assert place > 0.0


@pytest.mark.parametrize("drive", ["SM_Drive_Virtual", "SM_Drive_Simulated", "SM_Drive_PosControl"])
def test_another_drive_needs_no_other_program(drive: str) -> None:
    """AXIS-05, AXIS-10: the program that moves the axis is the same; a virtual drive is always virtual."""
    project = moving(with_axes("Drive", drive=drive))
    given = {"Drive__in__bRegulatorRealState": True, "Drive__in__bDriveStartRealState": True}
    virtual, place = values(
        project,
        60,
        "Drive.bVirtual",
        "Drive.fSetPosition",
        **(given if drive == "SM_Drive_PosControl" else {}),
    )
    assert virtual == (drive == "SM_Drive_Virtual")
    assert place > 0.0


def test_settings_become_members_of_the_axis() -> None:
    """AXIS-11, AXIS-12, AXIS-13, AXIS-15, AXIS-17: the fields of the editor, by their parameters."""
    settings = {
        "axis_type": "finite",
        "ramp_type": "sin2",
        "software_limits": {"enabled": True, "negative": -5.0, "positive": 700.0, "deceleration": 350.0},
        "dynamic_limits": {"velocity": 110.0, "acceleration": 120.0, "deceleration": 130.0, "jerk": 140.0},
    }
    wanted = {
        "iMovementType": 1,
        "eRampType": 1,
        "bSWLimitEnable": True,
        "fSWLimitNegative": -5.0,
        "fSWLimitPositive": 700.0,
        "fSWLimitDeceleration": 350.0,
        "fSWMaxVelocity": 110.0,
        "fSWMaxAcceleration": 120.0,
        "fSWMaxDeceleration": 130.0,
        "fSWMaxJerk": 140.0,
        "bVirtual": True,
    }
    found = values(moving(with_axes("Drive", **settings)), 5, *(f"Drive.{name}" for name in wanted))
    assert dict(zip(wanted, found, strict=True)) == wanted
    rotary = {"axis_type": "modulo", "modulo": 48.0, "ramp_type": "quadratic"}
    members = ("iMovementType", "fPositionPeriod", "eRampType", "fSWMaxVelocity", "fSWMaxAcceleration")
    found = values(moving(with_axes("Drive", **rotary)), 5, *(f"Drive.{name}" for name in members))
    assert found == [0, 48.0, 2, 100.0, 100.0]
