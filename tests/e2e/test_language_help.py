"""What the language server shows in the ST editor."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import add_line, delete_line, implementation, open_object, open_project

pytestmark = pytest.mark.e2e


def test_completion_offers_the_members_of_an_instance(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    add_line(page, editor, "xRun := fbFiller")
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    page.keyboard.type(".xDo")
    offered = page.locator(".suggest-widget .monaco-list-row")
    expect(offered.filter(has_text="xDone")).to_be_visible()
    page.keyboard.press("Enter")
    expect(editor).to_contain_text("fbFiller.xDone")


def test_an_error_is_marked_while_typing_and_goes_when_it_is_mended(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    expect(editor.locator(".squiggly-error")).to_have_count(0)
    add_line(page, editor, "xRunn := TRUE;")
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    delete_line(page, editor, 2)
    expect(editor.locator(".squiggly-error")).to_have_count(0)


def test_f12_leads_to_the_declaration_and_hover_tells_type_and_comment(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("F12")
    expect(page.get_by_text("Ln 12, Col 5")).to_be_visible()
    page.keyboard.press("Control+K")
    page.keyboard.press("Control+I")
    hover = page.locator(".monaco-hover:visible")
    expect(hover).to_contain_text("xSafe")
    expect(hover).to_contain_text("BOOL")
    expect(hover).to_contain_text("Nothing forbids movement".replace(" ", "\xa0"))
