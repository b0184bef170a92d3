"""Tour of the dialogs of CNC programs."""

from __future__ import annotations

from collections.abc import Iterator

from playwright.sync_api import expect

from .api import example, fetch
from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import open_object, tree_item

TITLES = {
    "cnc.move": "cnc.moveTitle",
    "cnc.rotate": "cnc.rotateTitle",
    "cnc.stretch": "cnc.stretchTitle",
    "cnc.array": "cnc.arrayTitle",
    "cnc.import": "cnc.importTitle",
    "cnc.variables": "cnc.offlineValues",
    "cnc.info": "cnc.infoOf",
    "cnc.properties": "cnc.propertiesOf",
}
"""Commands of the CNC menu that ask for something, and the titles of their dialogs."""


@tour(*TITLES.values(), "cnc.code", "cncSettings.parametersOf")
def cnc(ui: Ui, server: Server) -> Iterator[str]:
    """What the operations of a program ask for, its properties, and the values of its variables."""
    page = ui.page
    project = example(page, server)
    objects = fetch(page, server, "GET", f"{project}/objects")
    application = next(one for one in objects if one["kind"] == "application")
    data = {"implementation": "N0 G1 X10 Y0 F100\nN10 G1 X20\n"}
    program = {"kind": "cnc", "name": "ContourTour", "parent_id": application["id"], "data": data}
    own = fetch(page, server, "POST", f"{project}/objects", data=program)["id"]
    try:
        expect(tree_item(page, "ContourTour")).to_be_visible()
        open_object(page, "ContourTour")
        for command, title in TITLES.items():
            menu = ui.button("cnc.menu", ui.panel())
            menu.focus()
            menu.click()
            page.get_by_role("menuitem", name=ui.name(command)).click()
            yield title
            if command == "cnc.info":
                show = ui.button("cnc.showCode")
                expect(show).to_be_enabled(timeout=60_000)
                show.click()
                yield "cnc.code"
                page.keyboard.press("Escape")
            page.keyboard.press("Escape")
        settings = next(
            one for one in fetch(page, server, "GET", f"{project}/objects") if one["kind"] == "cnc_settings"
        )
        chain = {"preprocessing": [{"block": "SMC_SmoothPath"}]}
        fetch(
            page,
            server,
            "PUT",
            f"{project}/objects/{settings['id']}",
            data={"data": chain, "base_revision": settings["revision"]},
        )
        open_object(page, "CNC settings")
        used = page.get_by_role("grid", name=ui.name("cncSettings.used"))
        used.get_by_role("gridcell", name="SMC_SmoothPath").dblclick()
        yield "cncSettings.parametersOf"
        page.keyboard.press("Escape")
    finally:
        fetch(page, server, "DELETE", f"{project}/objects/{own}")
