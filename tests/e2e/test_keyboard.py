"""Keyboard ways through the workbench: areas, menus, out of texts."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import implementation, open_object, open_project, text_of

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
