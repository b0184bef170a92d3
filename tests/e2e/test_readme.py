"""The five minutes of the README, step by step as they are written there."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import (
    change_online,
    implementation,
    log_in,
    message_rows,
    open_object,
    open_panel,
    open_project,
    status_bar,
    watch,
    watch_value,
)

pytestmark = pytest.mark.e2e


def _value(page: Page, name: str) -> Locator:
    """The row of a variable in the declaration in front, while logged in."""
    table = page.get_by_role("treegrid", name=re.compile("GVL_IO"))
    return table.get_by_role("row").filter(has=page.get_by_role("gridcell", name=name, exact=True))


def _prepare(page: Page, name: str, shown: str) -> None:
    """Clicks the value until the prepared one is shown."""
    row = _value(page, name)
    for _ in range(3):
        row.get_by_role("gridcell").nth(2).click()
        try:
            expect(row).to_contain_text(shown, timeout=2_000)
            return
        except AssertionError:
            page.wait_for_timeout(600)  # the next click is not the second of a double click
    raise AssertionError(f"{name} does not show {shown}: {row.text_content()}")


def test_the_five_minutes_of_the_readme(page: Page) -> None:
    open_project(page)
    open_object(page, "Plant3D")
    expect(page.frame_locator("[data-testid=scene-view]").locator("canvas").first).to_be_visible(
        timeout=60_000
    )

    open_object(page, "PLC_PRG")
    log_in(page)
    editor = implementation(page)
    expect(editor).to_contain_text("Execute")
    filled = int(watch_value(watch(page, "GVL_Line.udiFilled"), at_least=0))
    watch_value(watch(page, "GVL_Line.udiFilled"), at_least=filled + 1)

    open_object(page, "GVL_IO")
    _prepare(page, "xEmergencyStop", "<TRUE>")
    page.keyboard.press("F7")
    expect(_value(page, "xLampRed").get_by_role("gridcell").nth(2)).to_contain_text("TRUE")
    page.keyboard.press("Alt+F7")
    expect(_value(page, "xEmergencyStop").get_by_role("gridcell").nth(2)).to_contain_text("FALSE")
    _prepare(page, "xResetButton", "<TRUE>")
    page.keyboard.press("F7")
    expect(_value(page, "xLampRed").get_by_role("gridcell").nth(2)).to_contain_text("FALSE")
    page.keyboard.press("Alt+F7")
    _prepare(page, "xStartButton", "<TRUE>")
    page.keyboard.press("F7")
    expect(_value(page, "xLampGreen").get_by_role("gridcell").nth(2)).to_contain_text("TRUE")
    page.keyboard.press("Alt+F7")

    open_object(page, "PLC_PRG")
    editor = implementation(page)
    line = editor.locator(".view-line").filter(has_text="PT\xa0:=\xa0HORN_TIME")
    name = line.locator("span").filter(has_text=re.compile("^HORN_TIME$")).first
    name.dblclick()
    page.keyboard.type("T#3S")
    page.keyboard.press("Control+Enter")
    expect(editor).to_contain_text("PT\xa0:=\xa0T#3S")
    page.keyboard.press("Escape")
    change_online(page)

    editor.locator(".view-line").filter(has_text="fbHorn(").first.click()
    page.keyboard.press("F9")
    expect(status_bar(page)).to_contain_text("halted: MainTask", timeout=60_000)
    levels = page.get_by_role("grid", name="Call stack").get_by_role("row")
    expect(levels.filter(has_text="PLC_PRG").first).to_be_visible()
    page.keyboard.press("F10")
    expect(page.get_by_text("Halted after a step")).to_be_visible()
    editor.locator(".view-line").filter(has_text="fbHorn(").first.click()
    page.keyboard.press("F9")
    page.keyboard.press("F5")
    expect(status_bar(page)).to_contain_text("running")

    editor.locator(".view-line").first.click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type("GVL_Line.iRecipe := 4;")
    page.keyboard.press("Escape")
    page.keyboard.press("F11")
    open_panel(page, "Messages")
    message = message_rows(page).filter(has_text="4").first
    expect(message).to_be_visible()
    message.click()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()
