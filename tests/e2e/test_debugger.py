"""Debugging in the browser: breakpoints, steps, the call stack with its variables."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Server
from .workbench import implementation, log_in, open_object, open_project, show_panel, status_bar, watch

pytestmark = pytest.mark.e2e

CALL, NEXT = 3, 4
"""Lines of PLC_PRG: a call of a block of a library, and the statement behind it."""


@pytest.fixture
def debugged(page: Page) -> Page:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    return page


def picture(page: Page, name: str) -> None:
    folder = os.environ.get("TAPPET_PICTURES")
    if folder:
        for theme in ("light", "dark"):
            page.emulate_media(color_scheme=theme)
            page.evaluate("theme => { document.documentElement.dataset.theme = theme }", theme)
            page.screenshot(path=str(Path(folder) / f"{name}-{theme}.png"))


def go_to(page: Page, line: int) -> Locator:
    editor = implementation(page)
    editor.click()
    page.keyboard.press("Control+g")
    page.keyboard.type(str(line))
    page.keyboard.press("Enter")
    return editor


def stack(page: Page) -> Locator:
    return page.get_by_role("grid", name="Call stack").get_by_role("row")


def test_a_breakpoint_halts_and_the_program_is_stepped_through(debugged: Page) -> None:
    page = debugged
    go_to(page, CALL)
    page.keyboard.press("F9")
    expect(status_bar(page)).to_contain_text("halted: MainTask", timeout=60_000)
    level = stack(page).filter(has_text="PLC_PRG").first
    expect(level).to_contain_text(str(CALL))
    expect(page.get_by_text("Halted at a breakpoint")).to_be_visible()
    expect(page.get_by_text("outputs: kept")).to_be_visible()
    picture(page, "debugger-halted")
    page.keyboard.press("F10")
    expect(level).to_contain_text(str(NEXT))
    expect(page.get_by_text("Halted after a step")).to_be_visible()
    variables = page.get_by_role("grid", name="Variables of the level")
    row = variables.get_by_role("row", name=re.compile(r"^iLoaded"))
    row.dblclick()
    field = variables.get_by_role("textbox")
    field.fill("3")
    field.press("Enter")
    expect(row).to_contain_text("3")
    show_panel(page, "Breakpoints")
    breakpoints = page.get_by_role("grid", name="Breakpoints")
    expect(breakpoints.get_by_role("row").filter(has_text="PLC_PRG")).to_have_count(1)
    picture(page, "debugger-breakpoints")
    page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("halted: MainTask")
    go_to(page, CALL)
    page.keyboard.press("F9")
    expect(breakpoints.get_by_role("row").filter(has_text="PLC_PRG")).to_have_count(0)
    page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("running")


def test_a_breakpoint_with_conditions_is_edited_in_its_dialog(debugged: Page, server: Server) -> None:
    page = debugged
    go_to(page, NEXT)
    page.keyboard.press("Alt+F9")
    dialog = page.get_by_role("dialog", name="Breakpoint")
    expect(dialog).to_be_visible(timeout=60_000)
    expect(dialog.get_by_label("Task")).to_contain_text("All tasks")
    picture(page, "debugger-dialog")
    dialog.get_by_label("Condition").fill("iLoaded = 77")
    dialog.get_by_role("button", name="Apply").click()
    expect(dialog).to_be_hidden()
    show_panel(page, "Breakpoints")
    breakpoints = page.get_by_role("grid", name="Breakpoints")
    expect(breakpoints.get_by_role("row").filter(has_text="iLoaded = 77")).to_have_count(1)
    if "halted" in status_bar(page).inner_text():
        page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("running")


def test_all_breakpoints_are_disabled_and_enabled(debugged: Page) -> None:
    """From the keyboard, the bar of the list, its menu, and the Debug menu, which fits into the window; the
    program stays halted meanwhile, as the call stack would come to the front."""
    page = debugged
    go_to(page, CALL)
    page.keyboard.press("F9")
    expect(status_bar(page)).to_contain_text("halted: MainTask", timeout=60_000)
    go_to(page, NEXT)
    page.keyboard.press("F9")
    show_panel(page, "Breakpoints")
    table = page.get_by_role("grid", name="Breakpoints")
    boxes = table.get_by_role("checkbox")
    expect(boxes).to_have_count(2)

    def enabled(*expected: bool) -> None:
        for at, wanted in enumerate(expected):
            expect(boxes.nth(at)).to_be_checked(checked=wanted)

    page.keyboard.press("Alt+Shift+F9")
    enabled(False, False)
    panel = page.locator("[data-panel-id=breakpoints]")
    disable = panel.get_by_role("button", name="Disable All Breakpoints")
    expect(disable).to_have_attribute("aria-disabled", "true")
    row = table.get_by_role("row").filter(has_text="PLC_PRG").first
    row.get_by_role("gridcell").nth(1).click()
    page.keyboard.press("Space")
    enabled(True, False)
    row.get_by_role("gridcell").nth(1).click(button="right")
    page.get_by_role("menuitem", name="Disable breakpoint").click()
    enabled(False, False)
    row.get_by_role("gridcell").nth(1).click(button="right")
    page.get_by_role("menuitem", name="Enable All Breakpoints").click()
    enabled(True, True)
    disable.click()
    enabled(False, False)
    page.get_by_role("menuitem", name=re.compile("^Debug")).click()
    menu = page.get_by_role("menu")
    assert menu.evaluate("menu => menu.scrollHeight <= menu.clientHeight"), "it scrolls"
    page.get_by_role("menuitem", name="Remove All Breakpoints").click()
    expect(boxes).to_have_count(0)
    page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("running")


def test_a_variable_halts_the_program_when_it_changes(debugged: Page) -> None:
    """From the menu of a watch list, of the declaration and of the text."""
    page = debugged
    dialog = page.get_by_role("dialog", name="Data breakpoint")
    entry = page.get_by_role("menuitem", name="Break When Value Changes")
    row = watch(page, "PersistentVars.udiOperatingTime")
    expect(row.get_by_role("gridcell").nth(2)).not_to_have_text("")
    row.get_by_role("gridcell").first.click(button="right")
    entry.click()
    expect(dialog.get_by_label("Variable")).to_have_value("PersistentVars.udiOperatingTime")
    dialog.get_by_role("button", name="Apply").click()
    expect(status_bar(page)).to_contain_text("halted", timeout=60_000)
    expect(page.get_by_text("'PersistentVars.udiOperatingTime' has changed")).to_be_visible()
    show_panel(page, "Breakpoints")
    page.get_by_role("grid", name="Breakpoints").get_by_role("row").filter(
        has_text="udiOperatingTime"
    ).click()
    page.keyboard.press("Delete")
    page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("running")

    open_object(page, "PLC_PRG")
    declared = page.get_by_role("treegrid", name="PLC_PRG").get_by_role("row")
    declared.filter(has_text="iLoaded").get_by_role("gridcell").first.click(button="right")
    entry.click()
    expect(dialog.get_by_label("Variable")).to_have_value("PLC_PRG.iLoaded")
    page.keyboard.press("Escape")
    declared.filter(has_text="HORN_TIME").get_by_role("gridcell").first.click(button="right")
    expect(entry).to_have_attribute("aria-disabled", "true")
    page.keyboard.press("Escape")

    go_to(page, 1)
    implementation(page).get_by_text("xSafe").first.click(button="right")
    entry.click()
    expect(dialog.get_by_label("Variable")).to_have_value("PLC_PRG.xSafe")
    page.keyboard.press("Escape")
