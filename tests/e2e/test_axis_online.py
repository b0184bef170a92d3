"""The online pages of an axis with a drive: homing and errors by hand, control taken away, and tuning."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .api import change, fetch, stored
from .conftest import Server, new_profile
from .test_axis_editor import add_drive, editor
from .workbench import log_in, objects_stored, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e

PROJECT = "Tuned machine"
DECLARATION = "PROGRAM PLC_PRG\nVAR\n    fSpeed : LREAL;\n    fPlace : LREAL;\nEND_VAR"
PLANT = """Spindle.in.bRegulatorRealState := Spindle.out.bRegulatorOn;
Spindle.in.bDriveStartRealState := Spindle.out.bDriveStart;
fSpeed := fSpeed + 0.4 * (DINT_TO_LREAL(Spindle.out.diSetVelocity) / 32.767 - fSpeed);
fPlace := fPlace + 0.02 * fSpeed;
Spindle.in.dwActPosition := DINT_TO_DWORD(LREAL_TO_DINT(fPlace * 65536.0 / 360.0));"""
"""A drive that follows its speed with a lag, in cycles of 20 ms."""


@pytest.fixture
def project(page: Page, server: Server) -> str:
    """A new project, open; its path in the API."""
    made = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    page.reload()
    open_project(page, PROJECT)
    return f"/projects/{made['id']}"


def write(page: Page, server: Server, expression: str, value: Any) -> None:
    body = {"values": [{"expression": expression, "value": value}]}
    fetch(page, server, "POST", "/runtimes/local/values/write", data=body)


def take_control(panel: Locator) -> None:
    """With power."""
    panel.get_by_role("button", name="Take control").click()
    expect(panel.get_by_text("This page has control")).to_be_visible()
    panel.get_by_role("button", name="Power on").click()


def commissioning(page: Page, name: str) -> tuple[Locator, Locator]:
    """The page, controlled, and its state diagram."""
    open_object(page, name)
    panel = editor(page)
    panel.get_by_role("tab", name="Commissioning").click()
    diagram = panel.get_by_role("img", name=re.compile("State diagram"))
    take_control(panel)
    expect(diagram).to_have_attribute("data-state", "standstill")
    return panel, diagram


def test_a_drive_is_homed_stopped_and_reset_from_the_page(page: Page, server: Server, project: str) -> None:
    """Where it is (method 37), and at index pulses in both directions (33 and 34)."""
    add_drive(page, server, project, "Servo", "SM_Drive_Simulated")
    log_in(page)
    panel, diagram = commissioning(page, "Servo")
    place = panel.locator("dd").nth(1)
    expect(panel.get_by_text("not homed")).to_be_visible()
    panel.get_by_label("Position", exact=True).fill("25")
    panel.get_by_role("button", name="Home").click()
    expect(panel.get_by_text("homed: that of a reference")).to_be_visible()
    expect(place).to_have_text("25.0 u")
    expect(diagram).to_have_attribute("data-state", "standstill")

    settings = "IoConfig_Globals.Servo_Drive.stSettings"
    write(page, server, f"{settings}.fHomingVelocity", 1.0)
    write(page, server, f"{settings}.fHomingZeroVelocity", 1.0)
    for method, reference in ((33, 200), (34, 300)):
        write(page, server, f"{settings}.iHomingMethod", method)
        panel.get_by_label("Distance", exact=True).fill("100")
        panel.get_by_label("Velocity", exact=True).fill("300")
        panel.get_by_role("button", name="Move by distance").click()
        expect(diagram).to_have_attribute("data-state", "discrete_motion")
        expect(diagram).to_have_attribute("data-state", "standstill")
        panel.get_by_label("Position", exact=True).fill(str(reference))
        panel.get_by_role("button", name="Home").click()
        expect(diagram).to_have_attribute("data-state", "homing")
        expect(diagram.locator("[data-lit=true]")).to_have_text("Homing")
        expect(diagram).to_have_attribute("data-state", "standstill")
        where = float(place.inner_text().removesuffix(" u"))
        assert where == pytest.approx(reference, abs=5)

    # An error while it moves: it says what happened and what to do, and is reset here.
    write(page, server, "IoConfig_Globals.Servo.fMaxPositionLag", 0.001)
    panel.get_by_role("button", name="Move by distance").click()
    expect(diagram).to_have_attribute("data-state", "errorstop")
    expect(
        panel.get_by_text("The actual position lags too far behind the set position.").first
    ).to_be_visible()
    expect(
        panel.get_by_text("Check load, tuning and the limit of the lag, then reset the axis.").first
    ).to_be_visible()
    write(page, server, "IoConfig_Globals.Servo.fMaxPositionLag", 0.0)
    panel.get_by_role("button", name="Reset error").click()
    expect(diagram).to_have_attribute("data-state", "standstill")

    panel.get_by_label("Velocity", exact=True).fill("20")
    panel.get_by_label("Distance", exact=True).fill("5000")
    panel.get_by_role("button", name="Move by distance").click()
    expect(diagram).to_have_attribute("data-state", "discrete_motion")
    panel.get_by_label("Deceleration", exact=True).fill("5")
    panel.get_by_role("button", name="Stop").click()
    expect(diagram).to_have_attribute("data-state", "standstill")


def test_who_controls_an_axis_is_said_on_other_pages(
    page: Page, browser: Browser, server: Server, project: str
) -> None:
    """Nobody takes control away from a page that is there; when that page goes, another one may."""
    add_drive(page, server, project, "Servo", "SM_Drive_Simulated")
    log_in(page)
    panel, _ = commissioning(page, "Servo")
    with new_profile(browser) as profile:
        profile.request.get(server.fresh_link())
        second = profile.new_page()
        second.goto(server.address)
        open_project(second, PROJECT)
        open_object(second, "Servo")
        log_in(second)
        other = editor(second)
        other.get_by_role("tab", name="Commissioning").click()
        expect(other.get_by_text("Another page has control of the axis")).to_be_visible()
        expect(other.get_by_role("button", name="Take control")).to_have_attribute("aria-disabled", "true")
        panel.get_by_role("button", name="Give back").click()
        expect(panel.get_by_text("The program moves the axis.")).to_be_visible()
        take_control(other)
        expect(panel.get_by_text("Another page has control of the axis")).to_be_visible()
        second.close()
    # The page is gone without a word: the controller gives the axis back.
    expect(panel.get_by_text("The program moves the axis.")).to_be_visible()


def test_a_measured_step_gives_gains_that_are_written(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Servo", "SM_Drive_Simulated")
    change(page, server, project, "MainTask", interval="T#4ms")
    open_object(page, "Servo")
    panel = editor(page)
    panel.get_by_role("tab", name="Tuning").click()
    expect(panel.get_by_text("Log in to measure the step response")).to_be_visible()
    log_in(page)
    expect(panel.get_by_text("No measurement yet")).to_be_visible()
    measure = panel.get_by_role("button", name="Measure")
    expect(measure).to_have_attribute("aria-disabled", "true")
    take_control(panel)
    expect(measure).not_to_have_attribute("aria-disabled", "true")

    height = panel.get_by_label("Height")
    height.fill("0")
    expect(panel.get_by_text("must be a number other than 0")).to_be_visible()
    height.fill("1000")
    measure.click()
    expect(page.get_by_text(re.compile("is half a period of the axis or more"))).to_be_visible()
    height.fill("5")
    measure.focus()
    page.keyboard.press("Enter")
    table = panel.get_by_role("table")
    expect(table).to_be_visible()
    gain = table.get_by_role("row", name=re.compile("Position gain"))
    expect(gain.get_by_role("cell").first).to_have_text("60 1/s")
    expect(panel.get_by_text("Rise time, 10 % to 90 %")).to_be_visible()
    expect(panel.locator("[data-look=predicted]").first).to_be_visible()
    panel.get_by_role("group", name=re.compile("Answer of the axis")).focus()
    page.keyboard.press("ArrowRight")
    expect(panel.locator("output").first).to_have_text("5")
    panel.get_by_role("radio", name=re.compile("^Fast")).click()
    proposed = gain.get_by_role("cell").nth(1).inner_text()
    assert proposed != "60 1/s"
    panel.get_by_role("button", name="Write to controller").click()
    expect(gain.get_by_role("cell").first).to_have_text(proposed)
    with objects_stored(page):
        panel.get_by_role("button", name="Take into project").click()
    loops = stored(page, server, project, "Servo")["data"]["simulated_drive"]["loops"]
    assert loops["position_gain"] == float(proposed.removesuffix(" 1/s"))
    acts = {(one["action"], one["subject"]) for one in fetch(page, server, "GET", "/audit")}
    assert ("axis-measured", "Servo") in acts
    assert ("write", "IoConfig_Globals.Servo_Drive.stSettings.fPositionGain") in acts


def test_measured_gains_are_taken_into_the_project_and_taken_back(
    page: Page, server: Server, project: str
) -> None:
    """A fast move tells the dead time of a drive whose gain is still 0 (devices EX-07)."""
    add_drive(page, server, project, "Spindle", "SM_Drive_PosControl")
    change(page, server, project, "PLC_PRG", declaration=DECLARATION, implementation=PLANT)
    page.reload()
    open_object(page, "Spindle")
    panel = editor(page)
    log_in(page)
    panel.get_by_role("tab", name="Tuning").click()
    take_control(panel)
    expect(panel.get_by_label("Excitation")).to_have_text("Fast move")
    measure = panel.get_by_role("button", name="Measure")
    expect(measure).not_to_have_attribute("aria-disabled", "true")
    panel.get_by_label("Duration").fill("2")
    measure.click()
    row = panel.get_by_role("row", name=re.compile("Dead time"))
    expect(row.get_by_role("cell").first).to_have_text("2 task cycles")
    gain = panel.get_by_role("row", name=re.compile("Position gain")).get_by_role("cell").nth(1)
    proposed = float(gain.inner_text().removesuffix(" 1/s"))
    with objects_stored(page):
        panel.get_by_role("button", name="Take into project").click()
    control = stored(page, server, project, "Spindle")["data"]["position_control"]
    assert control["gain"] == proposed > 0
    with objects_stored(page):
        page.keyboard.press("Control+z")
    assert stored(page, server, project, "Spindle")["data"]["position_control"]["gain"] == 0


def test_stop_ends_a_measurement(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Servo", "SM_Drive_Simulated")
    open_object(page, "Servo")
    log_in(page)
    panel = editor(page)
    panel.get_by_role("tab", name="Tuning").click()
    take_control(panel)
    measure = panel.get_by_role("button", name="Measure")
    expect(measure).not_to_have_attribute("aria-disabled", "true")
    panel.get_by_label("Duration").fill("10")
    measure.click()
    expect(panel.get_by_text("Recording the answer")).to_be_visible()
    panel.get_by_role("button", name="Stop").click()
    expect(page.get_by_text("The measurement was stopped; the axis rests where it was then.")).to_be_visible()
    expect(measure).not_to_have_attribute("aria-disabled", "true")
    assert tree_item(page, "Servo").is_visible()
