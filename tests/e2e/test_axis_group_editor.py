"""An axis group from the tree to its motion: axes chosen, queue watched, stopped from its page."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .api import change, fetch, stored
from .conftest import Server, new_profile, start_page
from .test_axis_editor import editor
from .ui import texts
from .workbench import log_in, open_object, open_project

pytestmark = pytest.mark.e2e

PROJECT = "Portal"
DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower : SMC_GroupPower;
    fbFirst : MC_MoveLinearAbsolute;
    fbSecond : MC_MoveLinearAbsolute := (BufferMode := MC_BUFFER_MODE.BlendingLow);
END_VAR"""
BODY = """fbPower(AxisGroup := Machine, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbFirst.Position.a[0] := 3000.0;
fbSecond.Position.a[0] := 3000.0;
fbSecond.Position.a[1] := 400.0;
fbFirst(AxisGroup := Machine, Execute := Machine.eState <> SMC_AXIS_GROUP_STATE.GroupDisabled,
    CoordSystem := SMC_COORD_SYSTEM.ACS);
fbSecond(AxisGroup := Machine, Execute := fbFirst.Busy, CoordSystem := SMC_COORD_SYSTEM.ACS);"""
DEFAULTS = {"velocity": 20.0, "acceleration": 100.0, "deceleration": 100.0, "jerk": 1000.0}


def new_machine(page: Page, server: Server) -> tuple[str, str]:
    """A project with the axes X and Y and a program that moves a group Machine; its path and application."""
    made = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    project = f"/projects/{made['id']}"
    application = stored(page, server, project, "Application")["id"]
    pool = add(page, server, project, application, "axis_pool", "SoftMotion General Axis Pool")
    for name in ("X", "Y"):
        add(page, server, project, pool, "axis", name, axis_type="finite")
    change(page, server, project, "PLC_PRG", declaration=DECLARATION, implementation=BODY)
    return project, application


def add(page: Page, server: Server, project: str, parent: str, kind: str, name: str, **data: Any) -> str:
    """A new object; its id."""
    body = {"parent_id": parent, "kind": kind, "name": name, **({"data": data} if data else {})}
    return str(fetch(page, server, "POST", f"{project}/objects", data=body)["id"])


def choose(page: Page, panel: Locator, index: int, axis: str) -> None:
    panel.get_by_role("combobox", name=f"Axis of index {index}").click()
    page.get_by_role("option", name=axis, exact=True).click()


def saved(page: Page, server: Server, project: str, wanted: dict[str, Any]) -> None:
    """Until these settings of the group are stored."""
    for _ in range(50):
        data = stored(page, server, project, "Machine")["data"]
        if {name: data[name] for name in wanted} == wanted:
            return
        page.wait_for_timeout(100)
    pytest.fail(f"{data} is stored instead of {wanted}")


def test_a_group_is_made_watched_and_stopped(page: Page, server: Server) -> None:
    project, application = new_machine(page, server)
    add(page, server, project, application, "axis_group", "Machine")
    page.reload()
    open_project(page, PROJECT)
    open_object(page, "Machine")
    panel = editor(page)
    for _ in range(2):
        panel.get_by_role("button", name="Add axis").click()
    choose(page, panel, 2, "X")
    expect(panel.get_by_text("X is in the group twice.")).to_be_visible()
    choose(page, panel, 2, "Y")
    expect(panel.get_by_role("alert")).to_have_count(0)
    panel.get_by_role("button", name="Move index 2 up").click()
    saved(page, server, project, {"axes": ["Y", "X"]})
    panel.get_by_role("button", name="Move index 1 down").click()

    panel.get_by_role("tab", name="Limits").click()
    for name, value in DEFAULTS.items():
        panel.get_by_label(f"Defaults: {name.capitalize()}").fill(str(value))
    panel.get_by_label("Limits: Velocity").fill("10")
    expect(panel.get_by_text("must not exceed the limit")).to_be_visible()
    panel.get_by_label("Limits: Velocity").fill("50")
    none = dict.fromkeys(DEFAULTS, 0)
    saved(
        page, server, project, {"axes": ["X", "Y"], "defaults": DEFAULTS, "limits": none | {"velocity": 50}}
    )

    log_in(page)
    panel.get_by_role("tab", name="Commissioning").click()
    diagram = panel.get_by_role("img", name=re.compile("State diagram"))
    expect(diagram).to_have_attribute("data-state", "GroupDisabled")
    expect(panel.get_by_text("The queue is empty")).to_be_visible()
    panel.get_by_role("button", name="Enable").click()
    expect(diagram).to_have_attribute("data-state", "GroupMoving")
    rows = panel.get_by_role("table", name="Information queue").locator("tbody tr")
    expect(rows).to_have_count(2)
    first = rows.nth(0).locator("td")
    expect(first.nth(0)).to_have_text("PLC_PRG.fbFirst")
    expect(first.nth(1)).to_have_text("MC_MoveLinearAbsolute")
    expect(first.nth(4)).to_have_text("20")
    expect(first.nth(6)).to_have_text("Runs")
    expect(rows.nth(1).locator("td").nth(5)).to_have_text("400")
    expect(rows.nth(1).locator("td").nth(6)).to_have_text("Waits")
    panel.get_by_role("button", name="Stop").click()
    expect(diagram).to_have_attribute("data-state", "GroupStandby")
    expect(panel.get_by_text("The queue is empty")).to_be_visible()
    panel.get_by_role("button", name="Disable").click()
    expect(diagram).to_have_attribute("data-state", "GroupDisabled")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("theme", "language"), [("dark", "en"), ("light", "en"), ("dark", "zh"), ("light", "zh")]
)
def test_pictures_of_the_pages(browser: Browser, server: Server, theme: str, language: str) -> None:
    """Each page in both themes and languages; TAPPET_PICTURES says where the pictures go."""
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    words = texts(language)
    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        project, application = new_machine(page, server)
        axes = ["X", "Y", "Gone"] if theme == "light" else ["X", "Y"]
        data: dict[str, Any] = {"axes": axes, "defaults": DEFAULTS}
        if theme == "light":
            lengths = {"dArmLength1": 300.0, "dArmLength2": 200.0}
            data["kinematics"] = {"type": "Kin_Scara2_Z", "parameters": lengths}
        add(page, server, project, application, "axis_group", "Machine", **data)
        page.reload()
        open_project(page, PROJECT)
        open_object(page, "Machine")
        panel = editor(page)
        for name in ("axes", "kinematics", "limits", "frames"):
            panel.get_by_role("tab", name=words[f"axisGroup.page.{name}"], exact=True).click()
            page.screenshot(path=folder / f"axis-group-{name}-{language}-{theme}.png")
        if theme == "dark" and language == "en":
            log_in(page)
            panel.get_by_role("tab", name="Commissioning").click()
            panel.get_by_role("button", name="Enable").click()
            expect(panel.get_by_role("table", name="Information queue").locator("tr")).to_have_count(3)
            page.screenshot(path=folder / f"axis-group-online-{language}-{theme}.png")
        fetch(page, server, "DELETE", project)
