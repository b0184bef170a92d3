"""Tours of the dialogs of axes and cams."""

from __future__ import annotations

from collections.abc import Iterator

from playwright.sync_api import expect

from .api import example, fetch
from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import log_in, open_object, open_project, tree_item


@tour("cam.import", "cam.export", "cam.optimise", "cam.code", "cam.rangeTitle")
def cams(ui: Ui, server: Server) -> Iterator[str]:
    """Texts of a cam, and what is asked before points are removed."""
    page = ui.page
    project = example(page, server)
    objects = fetch(page, server, "GET", f"{project}/objects")
    application = next(one for one in objects if one["kind"] == "application")
    cam = {"kind": "cam", "name": "CamTour", "parent_id": application["id"]}
    made = fetch(page, server, "POST", f"{project}/objects", data=cam)
    try:
        open_object(page, "CamTour")
        for key in ("cam.import", "cam.export", "cam.optimise", "cam.code"):
            ui.button("cam.menu", ui.panel()).click()
            page.get_by_role("menuitem", name=ui.name(key)).click()
            yield key
            page.keyboard.press("Escape")
        ui.panel().get_by_role("tab", name=ui.text("cam.tab.settings")).click()
        end = ui.panel().get_by_label(ui.text("cam.masterEnd"))
        end.fill("100")
        end.press("Enter")
        yield "cam.rangeTitle"
    finally:
        fetch(page, server, "DELETE", f"{project}/objects/{made['id']}")


@tour("axis.forceTitle", "cam.writeRunning")
def axes(ui: Ui, server: Server) -> Iterator[str]:
    """What is asked before an axis is taken from its program, and before a cam is written to it."""
    page = ui.page
    made = fetch(page, server, "POST", "/projects", data={"name": "M1", "template": "motion"})
    objects = fetch(page, server, "GET", f"/projects/{made['id']}/objects")
    application = next(one for one in objects if one["kind"] == "application")
    cam = {"kind": "cam", "name": "Lift", "parent_id": application["id"]}
    fetch(page, server, "POST", f"/projects/{made['id']}/objects", data=cam)
    ui.command("command.closeProject")
    expect(page.get_by_role("button", name=ui.name("command.newProject")).first).to_be_visible()
    page.reload()
    open_project(page, "M1")
    tree_item(page, "PLC_PRG").click()
    log_in(page, ui.text("runtime.state.run"))
    open_object(page, "Drive")
    ui.panel().get_by_role("tab", name=ui.text("axis.page.commissioning")).click()
    ui.panel().get_by_role("button", name=ui.text("axis.take"), exact=True).click()
    yield "axis.forceTitle"
    page.keyboard.press("Escape")
    open_object(page, "Lift")
    ui.button("cam.menu", ui.panel()).click()
    page.get_by_role("menuitem", name=ui.name("cam.writeRunning")).click()
    yield "cam.writeRunning"
