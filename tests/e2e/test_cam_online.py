"""A cam while its application runs: where the axes are on it, read back and written."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import log_in, objects_stored, open_object, open_project

pytestmark = pytest.mark.e2e

PROJECT = "Running cam"
DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower : MC_Power;
    fbPowerSlave : MC_Power;
    fbMove : MC_MoveVelocity;
    fbSelect : MC_CamTableSelect;
    fbCam : MC_CamIn;
    fbOther : MC_CamIn;
END_VAR"""
BODY = """fbPower(Axis := Feed, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbPowerSlave(Axis := Punch, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbSelect(Master := Feed, Slave := Punch, CamTable := Lift, Execute := fbPowerSlave.Status);
fbCam(Master := Feed, Slave := Punch, Execute := fbSelect.Done, CamTableID := fbSelect.CamTableID,
    StartMode := MC_StartMode.absolute);
fbMove(Axis := Feed, Execute := fbCam.InSync AND fbPower.Status, Velocity := 20, Acceleration := 100,
    Deceleration := 100);"""


@pytest.fixture
def panel(page: Page, server: Server) -> Locator:
    """The editor of the cam, logged in; a slave follows it."""
    made = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    path = f"/projects/{made['id']}"
    objects = fetch(page, server, "GET", f"{path}/objects")
    application = next(item for item in objects if item["kind"] == "application")

    def add(kind: str, parent: str, name: str | None = None) -> dict[str, Any]:
        data = {"kind": kind, "name": name, "parent_id": parent}
        return dict(fetch(page, server, "POST", f"{path}/objects", data=data))

    pool = add("axis_pool", application["id"])
    add("axis", pool["id"], "Feed")
    add("axis", pool["id"], "Punch")
    add("cam", application["id"], "Lift")
    program = next(item for item in objects if item["name"] == "PLC_PRG")
    data = {"declaration": DECLARATION, "implementation": BODY}
    fetch(
        page, server, "PUT", f"{path}/objects/{program['id']}",
        data={"base_revision": program["revision"], "data": data},
    )  # fmt: skip
    page.reload()
    open_project(page, PROJECT)
    open_object(page, "Lift")
    found = page.locator(".dv-active-group [data-panel-id]:visible").last
    expect(found.locator("[data-graph=y] path[data-curve]")).to_have_count(3)
    expect(found.get_by_role("group", name="The cam in the application")).to_have_count(0)
    log_in(page)
    return found


def test_the_slave_runs_along_the_curve_and_a_changed_cam_is_written(page: Page, panel: Locator) -> None:
    bar = panel.get_by_role("group", name="The cam in the application")
    expect(bar.get_by_role("listitem")).to_have_count(1)
    expect(bar.get_by_role("listitem")).to_contain_text("PLC_PRG.fbCam")
    expect(bar.get_by_role("status")).to_have_text("The application has this cam")
    dots = panel.locator("[data-run='PLC_PRG.fbCam'] circle")
    expect(dots).to_have_count(4)
    place = dots.first.get_attribute("cx")
    page.wait_for_function(
        "at => document.querySelector('[data-run] circle')?.getAttribute('cx') !== at", arg=place
    )
    # The dot lies on the curve: what the application says of the slave is what the editor draws.
    assert page.evaluate(
        """() => {
            const dot = document.querySelector('[data-graph=y] [data-run] circle');
            const at = [Number(dot.getAttribute('cx')), Number(dot.getAttribute('cy'))];
            const curves = [...document.querySelectorAll('[data-graph=y] path[data-curve]')];
            return Math.min(...curves.flatMap((path) =>
                Array.from({ length: 2001 }, (_, part) => {
                    const point = path.getPointAtLength((part / 2000) * path.getTotalLength());
                    return Math.hypot(point.x - at[0], point.y - at[1]);
                })));
        }"""
    ) < 1  # fmt: skip

    panel.get_by_role("tab", name="Tappets", exact=True).click()
    expect(panel.locator("[data-run='PLC_PRG.fbCam'] line")).to_have_count(2)
    panel.get_by_role("tab", name="Cam", exact=True).click()

    write, read = (bar.get_by_role("button", name=name, exact=True) for name in ("Write cam", "Read cam"))
    expect(write).to_have_attribute("aria-disabled", "true")
    bar.get_by_role("button", name="Edit").click()
    graph = panel.locator("[data-graph=y]")
    graph.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    with objects_stored(page):
        page.keyboard.press("Control+Shift+ArrowDown")
    expect(bar.get_by_role("status")).to_have_text("The application has another curve")
    write.click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("row")).to_have_count(2)
    expect(dialog.get_by_role("row").last).to_contain_text(re.compile(r"PLC_PRG\.fbCam.*u$"))
    dialog.get_by_role("button", name="Write cam").click()
    expect(dialog).to_have_count(0)
    expect(bar.get_by_role("status")).to_have_text("The application has this cam")

    # Back to the cam of before in the project: the one of the application is read again.
    with objects_stored(page):
        page.keyboard.press("Control+z")
    expect(bar.get_by_role("status")).to_have_text("The application has another curve")
    with objects_stored(page):
        read.click()
    expect(bar.get_by_role("status")).to_have_text("The application has this cam")


def test_commands_of_the_cam_are_in_the_palette(page: Page, panel: Locator) -> None:
    page.keyboard.press("Control+Shift+P")
    page.get_by_role("combobox").last.fill("cam code")
    page.get_by_role("combobox").last.fill("Show Generated Code")
    page.get_by_role("option").first.click()
    expect(page.get_by_role("dialog")).to_contain_text("Lift : MC_CAM_REF")
    page.keyboard.press("Escape")
    page.keyboard.press("Control+Shift+P")
    page.get_by_role("combobox").last.fill("Write to the Application")
    expect(page.get_by_role("option").first).to_contain_text("Write to the Application")
    page.keyboard.press("Escape")
    open_object(page, "PLC_PRG")
    page.keyboard.press("Control+Shift+P")
    page.get_by_role("combobox").last.fill("Show Generated Code")
    expect(page.get_by_role("option").filter(has_text="Show Generated Code")).to_have_count(0)


def test_who_logs_in_again_agrees_again_to_change_the_project(page: Page, panel: Locator) -> None:
    bar = panel.get_by_role("group", name="The cam in the application")
    edit = bar.get_by_role("button", name="Edit")
    edit.click()
    expect(edit).to_have_attribute("aria-pressed", "true")
    page.keyboard.press("Control+F8")
    expect(bar).to_have_count(0)
    log_in(page)
    expect(edit).to_have_attribute("aria-pressed", "false")
