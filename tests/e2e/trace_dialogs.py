"""Tours of the dialogs of traces."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .api import example, fetch
from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import log_in, open_object

TRACE = "TraceTour"


def trace_in_example(ui: Ui, server: Server) -> dict[str, Any]:
    """A trace with one variable in the example."""
    project = example(ui.page, server)
    objects = fetch(ui.page, server, "GET", f"{project}/objects")
    application = next(one for one in objects if one["kind"] == "application")
    order = {"kind": "trace", "name": TRACE, "parent_id": application["id"]}
    made = dict(fetch(ui.page, server, "POST", f"{project}/objects", data=order))
    record = {"name": "Record1", "channels": [{"variable": "PLC_PRG.iLoaded"}]}
    body = {"base_revision": made["revision"], "data": made["data"] | {"records": [record]}}
    fetch(ui.page, server, "PUT", f"{project}/objects/{made['id']}", data=body)
    return made


@tour(
    "trace.configurationOf",
    "trace.axisTemplate",
    "trace.onlineList",
    "trace.export",
    "trace.longTermTitle",
    "trace.renameRecording",
    "trace.deleteRecording",
)
def traces(ui: Ui, server: Server) -> Iterator[str]:
    """The configuration of a trace, what runs in the controller, and what is stored."""
    page = ui.page
    made = trace_in_example(ui, server)
    try:
        open_object(page, TRACE)

        def choose(key: str) -> None:
            ui.button("trace.menu", ui.panel()).press("Enter")
            page.get_by_role("menuitem", name=ui.name(key)).click()

        choose("trace.configuration")
        yield "trace.configurationOf"
        page.keyboard.press("Escape")
        choose("trace.axisTemplate")
        yield "trace.axisTemplate"
        page.keyboard.press("Escape")
        log_in(page, ui.text("runtime.state.run"))
        ui.button("trace.download", ui.panel()).first.click()
        ui.panel().get_by_role("status").get_by_text("Record1").wait_for()
        choose("trace.onlineList")
        yield "trace.onlineList"
        page.keyboard.press("Escape")
        choose("trace.export")
        yield "trace.export"
        page.keyboard.press("Escape")
        ui.button("trace.longTerm", ui.panel()).first.click()
        yield "trace.longTermTitle"
        page.keyboard.press("Escape")
        choose("trace.snapshot")
        ui.panel().get_by_role("tab", name=ui.name("trace.panel.recordings")).click()
        rows = ui.panel().get_by_role("table").get_by_role("row")
        rows.nth(1).get_by_role("button").nth(-2).click()
        yield "trace.renameRecording"
        page.keyboard.press("Escape")
        rows.nth(1).get_by_role("button").nth(-1).click()
        yield "trace.deleteRecording"
    finally:
        fetch(page, server, "DELETE", f"{example(page, server)}/objects/{made['id']}")
        for one in fetch(page, server, "GET", "/recordings")["recordings"]:
            fetch(page, server, "DELETE", f"/recordings/{one['id']}")
