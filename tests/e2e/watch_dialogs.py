"""Tour of the dialogs of watch lists."""

from __future__ import annotations

from collections.abc import Iterator

from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import log_in, open_panel, tree_item, watch


@tour("watch.newList", "watch.duplicateList", "watch.renameList", "watch.deleteTitle")
def watch_lists(ui: Ui, _server: Server) -> Iterator[str]:
    """The names of the user's own lists, and the question before one with lines is gone."""
    page = ui.page
    tree_item(page, "PLC_PRG").click()
    ui.command("watch.newListMore")
    yield "watch.newList"
    ui.command("watch.newListMore")
    ui.dialog("watch.newList").get_by_role("textbox").fill("Pumps")
    page.keyboard.press("Enter")
    page.locator(".dv-tab").filter(has_text="Pumps").wait_for()
    for command, title in (
        ("watch.duplicateListMore", "watch.duplicateList"),
        ("watch.renameListMore", "watch.renameList"),
    ):
        ui.command(command)
        yield title
    table = open_panel(page, "Pumps").get_by_role("treegrid")
    table.get_by_role("row").last.get_by_role("gridcell").first.dblclick()
    page.keyboard.type("GVL_IO.xStartButton")
    page.keyboard.press("Escape" if page.get_by_role("listbox").count() else "Shift")
    page.keyboard.press("Enter")
    table.get_by_role("row").filter(has_text="GVL_IO.xStartButton").wait_for()
    ui.command("watch.deleteList")
    yield "watch.deleteTitle"


@tour("online.goToIndex")
def array_index(ui: Ui, _server: Server) -> Iterator[str]:
    """Which element of an array to show."""
    tree_item(ui.page, "PLC_PRG").click()
    log_in(ui.page, ui.text("runtime.state.run"))
    open_panel(ui.page, ui.text("watch.title", number="1"))
    row = watch(ui.page, "GVL_Line.aRecipes")
    row.get_by_role("gridcell").nth(1).click()
    ui.page.keyboard.press("Control+g")
    yield "online.goToIndex"
