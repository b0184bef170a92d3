"""The trace editor: configuration, diagrams of what the controller records, cursors, recordings and files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import example, fetch
from .conftest import Server
from .workbench import log_in, objects_stored, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e

RATE = "GVL_Line.lrRate"
RUN = "PLC_PRG.xRun"
FILLED = "GVL_Line.udiFilled"


@dataclass
class TracePage:
    """The example with a trace, which is open."""

    page: Page
    server: Server
    path: str
    trace_id: str

    @property
    def editor(self) -> Locator:
        return self.page.locator(".dv-active-group [data-panel-id]:visible").last

    @property
    def tree(self) -> Locator:
        return self.editor.get_by_role("tree", name="Trace configuration")

    @property
    def diagrams(self) -> Locator:
        return self.editor.locator("figure[data-diagram]")

    def stored(self) -> dict[str, Any]:
        return dict(fetch(self.page, self.server, "GET", f"{self.path}/objects/{self.trace_id}")["data"])

    def tool(self, name: str) -> Locator:
        return self.editor.get_by_role("toolbar").get_by_role("button", name=name, exact=True)

    def choose(self, name: str) -> None:
        self.editor.get_by_role("button", name="Trace", exact=True).click()
        self.page.get_by_role("menuitem", name=name).or_(
            self.page.get_by_role("menuitemcheckbox", name=name)
        ).first.click()

    def panel(self, name: str) -> Locator:
        tab = self.editor.get_by_role("tab", name=name, exact=True)
        if tab.get_attribute("aria-selected") != "true":
            tab.click()
        return self.editor.get_by_role("tabpanel", name=name, exact=True)

    def download(self) -> None:
        log_in(self.page)
        self.editor.get_by_role("button", name="Download Trace").last.click()
        expect(self.editor.get_by_role("status", name="State")).to_contain_text("Record1")

    def drawn(self, diagram: Locator, left: float, right: float) -> None:
        """The pixels of the canvas from one part of its width to another hold more than the grid."""
        expect(diagram.locator("canvas")).to_be_visible()
        self.page.wait_for_function(
            COLORED, arg=[diagram.get_attribute("data-diagram"), left, right], timeout=30_000
        )


COLORED = """([key, left, right]) => {
    const canvas = document.querySelector(`figure[data-diagram="${key}"] canvas`);
    const { width, height } = canvas;
    const from = Math.round(left * width);
    const data = canvas.getContext('2d').getImageData(from, 0, Math.round(right * width) - from, height).data;
    let found = 0;
    for (let k = 0; k < data.length; k += 4) {
        const rgb = [data[k], data[k + 1], data[k + 2]];
        const spread = Math.max(...rgb) - Math.min(...rgb);
        if (data[k + 3] > 128 && spread > 80) found += 1;
    }
    return found > 40;
}"""


def opened(page: Page, server: Server, *records: dict[str, Any], **settings: Any) -> TracePage:
    path = example(page, server)
    objects = fetch(page, server, "GET", f"{path}/objects")
    application = next(item for item in objects if item["kind"] == "application")
    order = {"kind": "trace", "name": "Trace", "parent_id": application["id"]}
    made = fetch(page, server, "POST", f"{path}/objects", data=order)
    if records:
        data = made["data"] | {"records": list(records)} | settings
        body = {"base_revision": made["revision"], "data": data}
        fetch(page, server, "PUT", f"{path}/objects/{made['id']}", data=body)
    page.reload()
    open_project(page)
    open_object(page, "Trace")
    return TracePage(page, server, path, made["id"])


def record(*variables: str, **settings: Any) -> dict[str, Any]:
    return {"name": "Record1", "channels": [{"variable": one} for one in variables], **settings}


def test_a_trace_is_configured(page: Page, server: Server) -> None:
    """TRC-01, TRC-07, TRC-08, TRC-20 to TRC-28, TRC-40, TRC-42."""
    trace = opened(page, server)
    expect(trace.editor.get_by_text("The trace is not configured")).to_be_visible()
    trace.editor.get_by_role("button", name="Add Variable…").first.click()
    assistant = page.get_by_role("dialog")
    assistant.get_by_role("textbox").fill("lrRate")
    assistant.get_by_role("row").filter(has_text="lrRate").first.dblclick()
    if assistant.count():
        page.keyboard.press("Enter")
    item = trace.tree.get_by_role("treeitem").nth(1)
    expect(item).to_contain_text("lrRate")
    with objects_stored(page):
        trace.tree.get_by_role("button", name=re.compile("^Show ")).click()
    assert trace.stored()["records"][0]["channels"][0]["visible"] is False

    item.dblclick()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("combobox", name="Graph type").click()
    page.get_by_role("option", name="Steps").click()
    dialog.get_by_role("treeitem").first.click()
    dialog.get_by_label("Buffer size").fill("0")
    expect(dialog.get_by_role("alert")).to_have_text("A whole number from 1 to 1000000.")
    expect(dialog.get_by_role("button", name="Apply")).to_have_attribute("aria-disabled", "true")
    dialog.get_by_label("Buffer size").fill("500")
    dialog.get_by_label("Trigger variable").fill(RUN)
    dialog.get_by_role("combobox", name="Trigger edge").click()
    page.get_by_role("option", name="Positive edge").click()
    dialog.get_by_label("Trigger position").fill("25")
    with objects_stored(page):
        dialog.get_by_role("button", name="Apply").click()
    (stored,) = trace.stored()["records"]
    assert stored["buffer"] == 500
    assert stored["trigger"] == {"variable": RUN, "edge": "positive", "level": "", "position": 25}
    assert stored["channels"][0]["graph"] == "step"

    trace.tree.focus()
    page.keyboard.press("End")
    with objects_stored(page):
        page.keyboard.press("Delete")
    assert trace.stored()["records"][0]["channels"] == []
    with objects_stored(page):
        page.keyboard.press("Control+z")
    assert len(trace.stored()["records"][0]["channels"]) == 1


def test_the_controller_records_and_the_curve_is_drawn(page: Page, server: Server) -> None:
    """TRC-70, TRC-71, TRC-74, TRC-75, TRC-82."""
    trace = opened(page, server, record(FILLED, RUN, buffer=200), refresh_rate=200)
    trace.download()
    state = trace.editor.get_by_role("status", name="State")
    expect(state).to_contain_text("enabled")
    expect(state).to_contain_text("200 / 200")
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    expect(tree_item(page, "Trace")).to_contain_text("recording")
    trace.tool("Stop Trace").click()
    expect(state).to_contain_text("stopped")
    expect(trace.tool("Stop Trace")).to_have_attribute("aria-disabled", "true")
    trace.tool("Start Trace").click()
    expect(state).to_contain_text("enabled")


def test_variables_that_are_not_there_are_told_at_their_place(page: Page, server: Server) -> None:
    trace = opened(page, server, record("PLC_PRG.notThere"))
    log_in(page)
    trace.editor.get_by_role("button", name="Download Trace").last.click()
    problem = trace.editor.get_by_role("alert").filter(has_text="notThere")
    expect(problem).to_be_visible()
    problem.get_by_role("button").click()
    expect(page.get_by_role("dialog").get_by_label("Variable", exact=True)).to_have_value("PLC_PRG.notThere")


def test_views_are_zoomed_and_come_back(page: Page, server: Server) -> None:
    """TRC-77 to TRC-79, TRC-81."""
    trace = opened(page, server, record(FILLED, buffer=100))
    trace.download()
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("100 / 100")
    trace.tool("Stop Trace").click()
    back = trace.tool("Previous View")
    expect(back).to_have_attribute("aria-disabled", "true")
    box = trace.diagrams.first.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, -300)
    expect(back).not_to_have_attribute("aria-disabled", "true")
    expect(trace.editor.get_by_label("Time", exact=True)).to_contain_text("Time: T#")
    back.click()
    expect(back).to_have_attribute("aria-disabled", "true")
    trace.editor.get_by_role("group", name="Diagrams").focus()
    page.keyboard.press("Alt+ArrowLeft")
    page.keyboard.press("ArrowUp")
    expect(trace.tool("Next View")).to_have_attribute("aria-disabled", "true")
    trace.tool("Reset View").click()
    for count in (1, 2, 0):
        trace.tool("Cursor").click()
        expect(trace.diagrams.first.locator("[data-cursor]")).to_have_count(count)
    trace.tool("Cursor").click()
    trace.tool("Cursor").click()
    table = trace.panel("Cursors").get_by_role("table")
    expect(table.get_by_role("row").nth(1)).to_contain_text(re.compile(r"GVL_Line\.udiFilled\d"))


def test_what_was_recorded_is_stored_saved_and_loaded(page: Page, server: Server, tmp_path: Path) -> None:
    """TRC-90, TRC-91."""
    trace = opened(page, server, record(FILLED, buffer=100))
    trace.download()
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("100 / 100")
    trace.tool("Store the Samples as a Recording").click()
    rows = trace.panel("Recordings").get_by_role("row")
    expect(rows).to_have_count(2)
    rows.nth(1).get_by_role("rowheader").get_by_role("button").click()
    expect(trace.editor.get_by_text(re.compile("^Recording: Trace"))).to_be_visible()
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    with page.expect_download() as saving:
        trace.tool("Save Trace…").click()
    saved = tmp_path / saving.value.suggested_filename
    assert saved.suffix == ".trace"
    saving.value.save_as(saved)
    trace.editor.get_by_role("button", name="Back to the Controller").click()
    with page.expect_file_chooser() as choosing:
        trace.tool("Load Trace…").click()
    choosing.value.set_files(saved)
    expect(trace.editor.get_by_text("Recording: Trace", exact=True)).to_be_visible()
    expect(trace.panel("Recordings").get_by_role("row")).to_have_count(3)
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    for one in fetch(page, server, "GET", "/recordings")["recordings"]:
        fetch(page, server, "DELETE", f"/recordings/{one['id']}")


def test_each_variable_has_its_own_diagram_as_multi_channel(page: Page, server: Server) -> None:
    """TRC-03, TRC-62, TRC-78."""
    trace = opened(page, server, record(FILLED, RATE, RUN))
    expect(trace.diagrams).to_have_count(1)
    trace.tool("Multi-Channel").click()
    expect(trace.diagrams).to_have_count(3)
    trace.tree.get_by_role("treeitem").nth(1).click()
    trace.choose("Derivative")
    expect(trace.diagrams).to_have_count(4)
    expect(trace.diagrams.last).to_contain_text("d/dt")
