"""An axis from the tree to its motion: added, programmed, watched and moved by hand."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import implementation, log_in, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e

PROJECT = "Axis machine"
DECLARATION = "PROGRAM PLC_PRG\nVAR\n    fbPower : MC_Power;\n    fbMove : MC_MoveAbsolute;\nEND_VAR"
BODY = """fbPower(Axis := Axis, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Axis, Execute := fbPower.Status, Position := 3000, Velocity := 10, Acceleration := 100,
    Deceleration := 100);"""


@pytest.fixture
def project(page: Page, server: Server) -> str:
    """A new project, open; its path in the API."""
    made = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    page.reload()
    open_project(page, PROJECT)
    return f"/projects/{made['id']}"


def add(page: Page, parent: str, kind: str) -> None:
    """Add Object below an object of the tree."""
    tree_item(page, parent).click()
    page.keyboard.press("Control+Shift+P")
    page.get_by_role("combobox").last.fill("Add Object")
    page.get_by_role("option").filter(has_text=re.compile("^Add Object")).first.click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("option", name=re.compile(f"^{kind}")).or_(
        dialog.get_by_role("radio", name=re.compile(f"^{kind}"))
    ).first.click()
    dialog.locator("button[type=submit]").click()
    expect(dialog).to_have_count(0)


def stored(page: Page, server: Server, project: str, name: str) -> dict[str, Any]:
    objects = fetch(page, server, "GET", f"{project}/objects")
    item = next(one for one in objects if one["name"] == name)
    return dict(fetch(page, server, "GET", f"{project}/objects/{item['id']}"))


def editor(page: Page) -> Locator:
    return page.locator(".dv-active-group [data-panel-id]:visible").last


def test_an_axis_is_added_programmed_and_seen_moving(page: Page, server: Server, project: str) -> None:
    add(page, "Application", "SoftMotion General Axis Pool")
    add(page, "SoftMotion General Axis Pool", "Axis")
    expect(tree_item(page, "Axis")).to_be_visible()

    open_object(page, "PLC_PRG")
    for at, text in ((0, DECLARATION), (-1, BODY)):
        pane = page.locator(".monaco-editor:visible").nth(at)
        pane.locator(".view-line").first.click()
        page.keyboard.press("Control+A")
        page.keyboard.insert_text(text)
    expect(implementation(page)).to_contain_text("fbMove")
    page.keyboard.press("Control+s")
    log_in(page)

    open_object(page, "Axis")
    panel = editor(page)
    panel.get_by_role("tab", name="Commissioning").click()
    diagram = panel.get_by_role("img", name=re.compile("State diagram"))
    expect(diagram).to_have_attribute("data-state", "discrete_motion")
    expect(panel.get_by_text("The program moves the axis.")).to_be_visible()

    panel.get_by_role("button", name="Take control").click()
    page.get_by_role("dialog").get_by_role("button", name="Take control by force").click()
    expect(panel.get_by_text("This page has control")).to_be_visible()
    expect(diagram).to_have_attribute("data-state", re.compile("standstill|stopping"))
    panel.get_by_role("button", name="Power on").click()
    expect(diagram).to_have_attribute("data-state", "standstill")
    jog = panel.get_by_role("button", name="Jog +")
    jog.focus()
    page.keyboard.down(" ")
    expect(diagram).to_have_attribute("data-state", "continuous_motion")
    page.keyboard.up(" ")
    expect(diagram).to_have_attribute("data-state", "standstill")
    panel.get_by_label("Position", exact=True).fill("100")
    panel.get_by_role("button", name="Set position here").click()
    expect(panel.locator("dd").first).to_have_text("100.0 u")
    panel.get_by_role("button", name="Move by distance").click()
    expect(diagram).to_have_attribute("data-state", "discrete_motion")
    expect(panel.locator("dd").first).to_have_text("110.0 u")
    panel.get_by_role("button", name="Jog +").focus()
    page.keyboard.down(" ")
    expect(diagram).to_have_attribute("data-state", "continuous_motion")

    # The page goes while the axis moves: nobody has to ask for the stop.
    page.goto(f"{server.address}/favicon.svg")
    runtime = fetch(page, server, "GET", "/runtimes")[0]["id"]

    def value(path: str) -> str:
        answer = fetch(page, server, "POST", f"/runtimes/{runtime}/values/read", data={"expressions": [path]})
        return str(answer["values"][0]["value"])

    for _ in range(100):
        if value("IoConfig_AxisPanels.Axis.xUsed") == "False":
            break
        page.wait_for_timeout(100)
    assert value("IoConfig_AxisPanels.Axis.eState") in ("0", "Free")


def test_settings_are_checked_field_by_field(page: Page, server: Server, project: str) -> None:
    add(page, "Application", "SoftMotion General Axis Pool")
    add(page, "SoftMotion General Axis Pool", "Axis")
    open_object(page, "Axis")
    panel = editor(page)
    modulo = panel.get_by_label("Modulo value")
    modulo.fill("0")
    expect(panel.get_by_text("The modulo value must be above 0")).to_be_visible()
    modulo.fill("720")
    expect(panel.get_by_text("The modulo value must be above 0")).to_have_count(0)
    velocity = panel.get_by_label("Program: Velocity")
    velocity.fill("-1")
    expect(panel.get_by_text("Program, Velocity: must be a number above 0")).to_be_visible()
    velocity.fill("20000")
    expect(panel.get_by_text("Beyond what the drive can do: Velocity")).to_be_visible()
    panel.get_by_role("tab", name="Scaling/Mapping").click()
    panel.get_by_label("increments", exact=True).fill("4096")
    expect(panel.get_by_test_id("scaling-result")).to_contain_text("1 u = 11.37777778 inc")
    with page.expect_response(lambda answer: answer.request.method == "PUT" and "/objects/" in answer.url):
        page.keyboard.press("Control+s")
    data = stored(page, server, project, "Axis")["data"]
    assert data["modulo"] == 720
    assert data["dynamic_limits"]["velocity"] == 20000
    assert data["scaling"]["increments"] == 4096
    for tab in ("Commissioning", "All parameters", "Status"):
        panel.get_by_role("tab", name=tab).click()
        expect(panel.get_by_text("Not logged in")).to_be_visible()
    panel.get_by_role("tab", name="Information").click()
    expect(panel.get_by_text("IoConfig_Globals.Axis : AXIS_REF_VIRTUAL_SM3")).to_be_visible()
