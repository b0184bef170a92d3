"""An axis from the tree to its motion: added, programmed, watched and moved by hand."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch, stored
from .conftest import Server
from .workbench import implementation, log_in, objects_stored, open_object, open_project, tree_item

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


def add_drive(page: Page, server: Server, project: str, name: str, drive: str) -> None:
    objects = fetch(page, server, "GET", f"{project}/objects")
    pool = next((item for item in objects if item["kind"] == "axis_pool"), None)
    if pool is None:
        application = next(item for item in objects if item["kind"] == "application")
        data = {"kind": "axis_pool", "parent_id": application["id"]}
        pool = fetch(page, server, "POST", f"{project}/objects", data=data)
    data = {"kind": "axis", "name": name, "subkind": drive, "parent_id": pool["id"]}
    fetch(page, server, "POST", f"{project}/objects", data=data)
    page.reload()
    expect(tree_item(page, name)).to_be_visible()


def test_a_drive_that_follows_a_speed_has_its_position_loop(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Spindle", "SM_Drive_PosControl")
    open_object(page, "Spindle")
    panel = editor(page)
    panel.get_by_role("tab", name="Position control").click()
    gain = panel.get_by_label("Gain Kp")
    gain.fill("-1")
    gain.press("Tab")
    expect(panel.get_by_text("must be 0 or a number above")).to_be_visible()
    gain.fill("25")
    panel.get_by_label("Dead time").fill("1.5")
    panel.get_by_label("Dead time").press("Tab")
    panel.get_by_label("Counter of the encoder").click()
    with objects_stored(page):
        page.get_by_role("option", name="16-bit").click()
    control = stored(page, server, project, "Spindle")["data"]["position_control"]
    assert (control["gain"], control["dead_time"], control["bits"]) == (25, 1.5, 16)
    panel.get_by_role("tab", name="Information").click()
    expect(panel.get_by_text("IoConfig_Globals.Spindle : AXIS_REF_POSCONTROL_SM3")).to_be_visible()


def test_a_simulated_drive_has_its_settings(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Servo", "SM_Drive_Simulated")
    open_object(page, "Servo")
    panel = editor(page)
    panel.get_by_role("tab", name="Drive").click()
    stiffness = panel.get_by_label("Stiffness")
    expect(stiffness).to_be_disabled()
    panel.get_by_label("Load behind an elastic shaft").click()
    stiffness.fill("0")
    expect(panel.get_by_text("must be a number above 0")).to_be_visible()
    expect(panel.get_by_test_id("eigenfrequency")).to_have_count(0)
    stiffness.fill("100")
    expect(panel.get_by_test_id("eigenfrequency")).to_contain_text("Eigenfrequency 290.6 Hz; 205.5 Hz")
    panel.get_by_label("Homing method").click()
    page.get_by_role("option", name=re.compile("^23: search")).click()
    missing = panel.get_by_text(
        "Method 23 needs what the drive does not have: Home switch, Positive limit switch"
    )
    expect(missing).to_be_visible()
    panel.get_by_label("Home switch").check()
    panel.get_by_label("Positive limit switch").check()
    expect(missing).to_have_count(0)
    panel.get_by_label("On until").fill("-1")
    expect(panel.get_by_text("The home switch must end above its start")).to_be_visible()
    panel.get_by_label("On until").fill("1.5")
    expect(panel.get_by_text("≙ 540 u")).to_be_visible()
    with objects_stored(page):
        page.keyboard.press("Control+s")
    drive = stored(page, server, project, "Servo")["data"]["simulated_drive"]
    assert (drive["motor"]["elastic"], drive["homing"]["method"]) == (True, 23)
    assert (drive["switches"]["home"], drive["switches"]["home_to"]) == (True, 1.5)
    page.keyboard.press("Control+z")
    expect(panel.get_by_label("On until")).not_to_have_value("1.5")


def test_channels_of_a_drive_are_bound_to_addresses(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Servo", "SM_Drive_GenericDSP402")
    open_object(page, "Servo")
    panel = editor(page)
    panel.get_by_role("tab", name="Scaling/Mapping").click()
    panel.get_by_label("Automatic mapping").uncheck()
    expect(
        panel.get_by_text("The axis cannot move without: in.wStatusWord, in.diActPosition")
    ).to_be_visible()
    place = panel.get_by_label("Address or variable of in.wStatusWord")
    place.fill("%IB0")
    expect(panel.get_by_text("%IB0 is no place of WORD; write one such as %IW0")).to_be_visible()
    place.fill("%IW0")
    expect(panel.get_by_text("is no place of")).to_have_count(0)
    panel.get_by_label("Type of in.wStatusWord").click()
    page.get_by_role("option", name="UINT").click()
    panel.get_by_label("Address or variable of out.diSetPosition").fill("PLC_PRG.nowhere")
    with objects_stored(page):
        page.keyboard.press("Control+s")
    channels = stored(page, server, project, "Servo")["data"]["mapping"]["channels"]
    assert channels["in.wStatusWord"] == {"place": "%IW0", "type": "UINT"}
    page.keyboard.press("F11")
    fault = page.get_by_role("alert").filter(has_text="'nowhere' is no component of 'PLC_PRG'")
    expect(fault).to_be_visible()
    page.get_by_role("tab", name="Basic").click()
    expect(fault).to_have_count(0)
    page.get_by_role("gridcell").filter(has_text="'nowhere' is no component").dblclick()
    expect(fault).to_be_visible()


def test_a_logical_axis_chooses_its_master(page: Page, server: Server, project: str) -> None:
    add_drive(page, server, project, "Feed", "SM_Drive_Virtual")
    add_drive(page, server, project, "Mirror", "SM_Drive_Logical")
    open_object(page, "Mirror")
    panel = editor(page)
    expect(panel.get_by_role("tab", name="Scaling")).to_have_count(0)
    expect(panel.get_by_text("Choose the axis that is mirrored")).to_be_visible()
    panel.get_by_label("Mirrored axis").click()
    with objects_stored(page):
        page.get_by_role("option", name="Feed").click()
    expect(panel.get_by_text("Choose the axis that is mirrored")).to_have_count(0)
    panel.get_by_label("Velocity filter").fill("10")
    panel.get_by_label("Velocity filter").press("Tab")
    expect(panel.get_by_text("must be a whole number from 0 to 9")).to_be_visible()
    panel.get_by_label("Velocity filter").fill("3")
    with objects_stored(page):
        panel.get_by_label("Velocity filter").press("Tab")
    mirroring = stored(page, server, project, "Mirror")["data"]["mirroring"]
    assert (mirroring["master"], mirroring["velocity_filter"]) == ("Feed", 3)
    log_in(page)
    panel.get_by_role("tab", name="Commissioning").click()
    diagram = panel.get_by_role("img", name=re.compile("State diagram"))
    expect(diagram).to_have_attribute("data-state", "synchronized_motion")
    expect(panel.get_by_text("A logical axis moves as its master does")).to_be_visible()
    expect(panel.get_by_role("button", name="Take control")).to_have_count(0)


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
