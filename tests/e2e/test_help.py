"""F1 and the help panel."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import add_line, open_panel, plc_prg

pytestmark = pytest.mark.e2e


def test_f1_explains_what_stands_at_the_cursor(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "IF xSafe THEN ; END_IF")
    for _ in range(2):
        page.keyboard.press("ArrowLeft")
    page.keyboard.press("F1")
    article = page.locator("[data-panel-id=help]").get_by_role("article")
    expect(article).to_contain_text("Executes the statements behind the first condition that is TRUE")
    page.keyboard.press("Home")
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    page.keyboard.press("F1")
    expect(article).to_contain_text("Declaration above, implementation below")
    page.locator("[data-panel-id=help]").get_by_role("button", name="Back").click()
    expect(article).to_contain_text("Executes the statements")


def test_f1_explains_blocks_and_messages(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "TON")
    page.keyboard.press("F1")
    expect(page.get_by_role("tabpanel", name="Library doc")).to_contain_text("TON")
    page.keyboard.press("Control+Shift+K")
    add_line(page, editor, "nowhere := 1;")
    messages = open_panel(page, "Messages")
    messages.get_by_role("row").filter(has_text="nowhere").first.click()
    page.keyboard.press("F6")
    messages.get_by_role("row").filter(has_text="nowhere").first.focus()
    messages.get_by_role("grid").focus()
    page.keyboard.press("F1")
    help_panel = page.locator("[data-panel-id=help]")
    expect(help_panel.get_by_role("article")).to_contain_text("E0201")


def test_the_help_is_searched(page: Page) -> None:
    plc_prg(page)
    page.locator("[data-panel-id=devices]").get_by_role("tree").focus()
    page.keyboard.press("F1")
    panel = page.locator("[data-panel-id=help]")
    expect(panel.get_by_role("article")).to_contain_text("The controllers of the project")
    panel.get_by_label("Search the help").fill("lreal")
    panel.get_by_role("button", name="LREAL Language").click()
    expect(panel.get_by_role("article")).to_contain_text("floating-point number of 64 bits")
