"""Settings of a simulated drive: what is taken, and what the compiler gets of them."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.project.axis_projects import application_id, errors, moving, values, with_axes

from tappet import libraries
from tappet.libraries.catalog import items
from tappet.project import edit
from tappet.project.axes.simulated import DEFAULTS, SimulatedDrive, changed_members
from tappet.project.errors import InvalidDataError
from tappet.project.sources import application_sources


def declared(**drive: Any) -> str:
    """The variable of the drive of an axis with these settings."""
    project = moving(with_axes("Drive", drive="SM_Drive_Simulated", simulated_drive=drive))
    assert errors(project) == []
    texts = [source.text for source in application_sources(project, application_id(project))]
    return next(line.strip() for text in texts for line in text.splitlines() if "    Drive_Drive :" in line)


def test_defaults_are_those_of_the_library() -> None:
    """So that what is not in a declaration is what the editor shows."""
    (item,) = [one for one in items(libraries.load("SM3_Basic")) if one.name == "SimulatedDriveSettings"]
    known = {pin.name: float(pin.default or 0) for pin in item.members}
    assert {name: float(value) for name, value in DEFAULTS.items()} == known


def test_a_drive_with_defaults_has_no_values_in_its_declaration() -> None:
    assert declared() == "Drive_Drive : SM3_Basic.SimulatedDrive;"


@pytest.mark.parametrize(
    ("settings", "values"),
    [
        ({"motor": {"inertia": 1e-3}}, "fInertia := 0.001"),
        ({"motor": {"load_inertia": 1e-3, "stiffness": 40}}, "fStiffness := 40.0"),
        ({"motor": {"elastic": True, "load_inertia": 1e-3}}, "fLoadInertia := 0.001"),
        ({"limits": {"rated_torque": 2.0, "max_torque": 6}}, "fRatedTorque := 2.0, fMaxTorque := 6.0"),
        ({"limits": {"lag": 0}}, "diMaxLag := 0"),
        ({"switches": {"negative_at": -5}}, ""),
        (
            {"switches": {"negative": True, "negative_at": -5, "positive": True, "positive_at": 2.5}},
            "diNegativeLimit := -327680, diPositiveLimit := 163840",
        ),
        (
            {"switches": {"home": True}, "homing": {"method": 7}},
            "diHomeFrom := -16384, diHomeTo := 16384, iHomingMethod := 7",
        ),
        ({"switches": {"positive": True, "positive_at": 1e9}}, ""),
        ({"encoder": {"noise": 3}, "loops": {"feed_forward": 0}}, "fFeedForward := 0.0, fNoise := 3.0"),
    ],
)
def test_what_differs_from_defaults_is_declared(settings: dict[str, Any], values: str) -> None:
    text = f" := (stSettings := ({values}))" if values else ""
    assert declared(**settings) == f"Drive_Drive : SM3_Basic.SimulatedDrive{text};"


def test_places_of_switches_stay_when_the_encoder_changes() -> None:
    drive = SimulatedDrive.model_validate({"switches": {"home": True, "home_from": 1.5, "home_to": 2}})
    assert changed_members(drive, 1000) == {
        "diIncrements": "1000",
        "diMaxLag": "1000",
        "diHomeFrom": "1500",
        "diHomeTo": "2000",
    }


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"motor": {"inertia": 0}}, "inertia"),
        ({"loops": {"feed_forward": 1.5}}, "feed_forward"),
        ({"homing": {"method": 15}}, "method"),
        (
            {"switches": {"negative": True, "negative_at": 5, "positive": True, "positive_at": 5}},
            "the negative limit switch must lie below the positive one",
        ),
        ({"switches": {"home": True, "home_from": 1, "home_to": 0}}, "home switch must begin below its end"),
    ],
)
def test_impossible_settings_are_refused(settings: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidDataError, match=message):
        with_axes("Drive", drive="SM_Drive_Simulated", simulated_drive=settings)


@pytest.mark.parametrize(
    ("homing", "switches", "home"),
    [
        ({"method": 24}, {"home": True, "home_from": 2, "home_to": 3}, 20.0),
        ({"method": 17}, {"negative": True, "negative_at": -2}, -20.0),
        (
            {"method": 7},
            {"home": True, "home_from": -2.5, "home_to": -2, "positive": True, "positive_at": 1},
            -30.0,
        ),
    ],
)
def test_an_axis_homes_by_the_switches_of_its_settings(
    homing: dict[str, Any], switches: dict[str, Any], home: float
) -> None:
    """From the tree to the motion, a turn being 10 units.

    Limit switches, which stop a finite axis, belong to the way of the drive while it homes.
    """
    settings = {"switches": switches, "homing": {**homing, "velocity": 100, "zero_velocity": 5}}
    scaling = {"increments": 10000, "units": 10}
    body = """fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbHome(Axis := Drive, Execute := fbPower.Status, Position := 500.0);"""
    project = moving(
        with_axes(
            "Drive",
            drive="SM_Drive_Simulated",
            axis_type="finite",
            scaling=scaling,
            simulated_drive=settings,
        ),
        body,
    )
    (program,) = project.find_kind("pou")
    declaration = "PROGRAM PLC_PRG\nVAR\n    fbPower : MC_Power;\n    fbHome : MC_Home;\nEND_VAR"
    project = edit.change_data(project, program.id, {"declaration": declaration, "implementation": body})
    done, place, angle = values(
        project, 400, "PLC_PRG.fbHome.Done", "Drive.fActPosition", "Drive_Drive.fAngle"
    )
    assert done
    assert place == pytest.approx(500.0 - home + angle / (2 * math.pi) * 10, abs=0.01)
