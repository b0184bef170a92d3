"""Symbols of the project by letters of their names, and the properties of objects."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import open_project, tree_item

pytestmark = pytest.mark.e2e


def test_a_symbol_of_the_project_is_gone_to(page: Page) -> None:
    open_project(page)
    page.keyboard.press("Control+Alt+t")
    palette = page.get_by_role("dialog", name="Go to symbol in project")
    palette.get_by_role("combobox").fill("xsfe")
    expect(palette.get_by_role("option").first).to_contain_text("xSafe")
    page.keyboard.press("Enter")
    declaration = page.locator(".monaco-editor:visible").first
    expect(declaration).to_contain_text("xSafe")
    expect(page.locator(".dv-tab").filter(has_text="PLC_PRG")).to_be_visible()
    expect(page.locator("footer[role=status]")).to_contain_text("5 selected")


def test_properties_tell_and_change_an_object(page: Page) -> None:
    open_project(page)
    tree_item(page, "GVL_Plant").click()
    page.keyboard.press("Alt+Enter")
    dialog = page.get_by_role("dialog", name="Properties of GVL_Plant")
    expect(dialog.get_by_text("Example from bottling")).to_be_visible()
    expect(dialog.get_by_role("button", name="Apply")).to_be_disabled()
    dialog.get_by_label("Name").fill("GVL_Line")
    dialog.get_by_role("button", name="Apply").click()
    expect(dialog.get_by_role("alert")).to_contain_text("GVL_Line")
    dialog.get_by_label("Name").fill("GVL_Machine")
    dialog.get_by_label("Exclude from Build").click()
    dialog.get_by_role("button", name="Apply").click()
    expect(dialog).to_have_count(0)
    tree_item(page, "GVL_Machine").click()
    page.keyboard.press("Alt+Enter")
    expect(page.get_by_role("dialog").get_by_label("Exclude from Build")).to_be_checked()
