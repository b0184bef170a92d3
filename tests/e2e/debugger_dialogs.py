"""Tour of the dialogs of breakpoints."""

from __future__ import annotations

from collections.abc import Iterator

from .api import fetch
from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import implementation, log_in, open_object, open_project

DEBUG = "/runtimes/local/debug"


@tour("debugger.dataBreakpoint", "debugger.breakpoint")
def breakpoints(ui: Ui, server: Server) -> Iterator[str]:
    """What a breakpoint is to do, at a line and at a variable."""
    page = ui.page
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page, ui.text("runtime.state.run"))
    try:
        ui.command("panel.breakpoints")
        ui.button("debugger.newData").click()
        yield "debugger.dataBreakpoint"
        page.keyboard.press("Escape")
        implementation(page).click()
        page.keyboard.press("Alt+F9")
        yield "debugger.breakpoint"
        page.keyboard.press("Escape")
    finally:
        fetch(page, server, "DELETE", f"{DEBUG}/breakpoints")
        if fetch(page, server, "GET", DEBUG)["halted"]:
            fetch(page, server, "POST", f"{DEBUG}/control", data={"command": "continue"})
