"""Keyboard ways through the workbench: areas, menus, out of texts."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import (
    add_line,
    implementation,
    message_rows,
    open_object,
    open_panel,
    open_project,
    plc_prg,
    status_bar,
    text_of,
)

pytestmark = pytest.mark.e2e

AREA = """() => {
    const area = document.activeElement.closest(
        '[role=menubar], [role=toolbar], [data-panel-id], footer[role=status]');
    return area === null ? '' : area.dataset.panelId ?? area.getAttribute('role');
}"""


def test_f6_goes_round_all_areas_and_back(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    editor.locator(".view-line").first.click()
    start = page.evaluate(AREA)
    seen = []
    for _ in range(10):
        page.keyboard.press("F6")
        seen.append(page.evaluate(AREA))
        if seen[-1] == start:
            break
    assert seen[-1] == start
    assert {"menubar", "toolbar", "devices", "messages", "status"} <= set(seen)
    page.keyboard.press("Shift+F6")
    assert page.evaluate(AREA) == seen[-2]
    page.keyboard.press("F6")
    page.keyboard.press("Control+End")
    page.keyboard.type("// here")
    expect(editor).to_contain_text("//\xa0here")


def test_alt_and_a_letter_open_a_menu(page: Page) -> None:
    open_project(page)
    menus = {"F": "Close project", "B": "Build", "O": "Login", "I": "Next Area", "H": "About"}
    for letter, entry in menus.items():
        page.keyboard.press(f"Alt+{letter}")
        expect(page.get_by_role("menu").get_by_role("menuitem", name=entry).first).to_be_visible()
        page.keyboard.press("Escape")
        expect(page.get_by_role("menu")).to_have_count(0)


def test_tab_leaves_a_text_when_asked_to(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    editor.locator(".view-line").first.click()
    before = text_of(editor)
    page.keyboard.press("Control+M")
    expect(page.get_by_role("button", name="Tab: next field")).to_be_visible()
    page.keyboard.press("Tab")
    expect(editor.locator("textarea").first).not_to_be_focused()
    assert text_of(editor) == before
    page.get_by_role("button", name="Tab: next field").click()
    expect(page.get_by_role("button", name="Tab: indent")).to_be_visible()


def test_a_list_of_places_keeps_the_keyboard_until_enter(page: Page) -> None:
    editor = plc_prg(page)
    for name in ("nowhereA", "nowhereB"):
        add_line(page, editor, f"{name} := 1;")
    page.keyboard.press("F11")
    panel = open_panel(page, "Messages")
    first, second = (
        message_rows(page).filter(has_text=f"'{name}'").first for name in ("nowhereB", "nowhereA")
    )
    open_object(page, "GVL_IO")
    first.click()
    grid = panel.get_by_role("grid")
    expect(grid).to_be_focused()
    expect(status_bar(page)).to_contain_text("Ln 2, Col")
    page.keyboard.press("ArrowDown")
    expect(second).to_have_attribute("aria-selected", "true")
    expect(grid).to_be_focused()
    page.keyboard.press("Enter")
    expect(status_bar(page)).to_contain_text("Ln 3, Col")
    page.keyboard.press("End")
    page.keyboard.type(" // here")
    expect(editor).to_contain_text("nowhereA\xa0:=\xa01;\xa0//\xa0here")
    first.dblclick()
    expect(status_bar(page)).to_contain_text("Ln 2, Col")
    page.keyboard.press("End")
    page.keyboard.type(" // there")
    expect(editor).to_contain_text("nowhereB\xa0:=\xa01;\xa0//\xa0there")
