"""Bookmarks: lines that one comes back to, in texts and in tables."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import (
    add_line,
    choose_menu,
    implementation,
    log_in,
    open_object,
    open_project,
    plc_prg,
    show_panel,
    status_bar,
    tree_item,
    watch,
)

pytestmark = pytest.mark.e2e

TOGGLE = "Control+F12"
NEXT = "Control+Alt+PageDown"


def _go_to_line(page: Page, editor: Locator, number: int) -> None:
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    for _ in range(number - 1):
        page.keyboard.press("ArrowDown")


def _marks(editor: Locator) -> Locator:
    return editor.locator(".margin [class*=mark]")


def _panel(page: Page) -> Locator:
    show_panel(page, "Bookmarks")
    return page.get_by_role("tabpanel", name="Bookmarks")


def test_bookmarks_follow_their_lines_and_outlast_the_page(page: Page) -> None:
    editor = plc_prg(page)
    expect(_panel(page)).to_contain_text("The project has no bookmarks")
    _go_to_line(page, editor, 3)
    page.keyboard.press(TOGGLE)
    expect(_marks(editor)).to_have_count(1)
    panel = page.get_by_role("tabpanel", name="Bookmarks")
    row = panel.get_by_role("row").filter(has_text="PLC_PRG")
    expect(row.get_by_role("gridcell").nth(2)).to_have_text("3")
    marked = row.get_by_role("gridcell").nth(3).inner_text()
    add_line(page, editor, "// above")
    expect(row.get_by_role("gridcell").nth(2)).to_have_text("4")
    expect(row.get_by_role("gridcell").nth(3)).to_have_text(marked)
    page.reload()
    expect(tree_item(page, "Application")).to_be_visible()
    expect(row.get_by_role("gridcell").nth(2)).to_have_text("4")
    expect(_marks(implementation(page))).to_have_count(1)


def test_next_bookmark_goes_through_the_project(page: Page) -> None:
    editor = plc_prg(page)
    _go_to_line(page, editor, 2)
    page.keyboard.press(TOGGLE)
    open_object(page, "GVL_IO")
    declaration = implementation(page)
    _go_to_line(page, declaration, 3)
    page.keyboard.press(TOGGLE)
    active = page.locator(".dv-active-group .dv-active-tab")
    for name, position in (("PLC_PRG", "Ln 2"), ("GVL_IO", "Ln 3"), ("PLC_PRG", "Ln 2")):
        page.keyboard.press(NEXT)
        expect(active.filter(has_text=name)).to_be_visible()
        expect(status_bar(page)).to_contain_text(position)
    page.keyboard.press(TOGGLE)
    expect(_marks(implementation(page))).to_have_count(0)
    panel = _panel(page)
    row = panel.get_by_role("row").filter(has_text="GVL_IO")
    row.dblclick()
    expect(active.filter(has_text="GVL_IO")).to_be_visible()
    choose_menu(page, "Edit", "Bookmarks", "Clear All Bookmarks")
    expect(panel).to_contain_text("The project has no bookmarks")


def test_rows_of_a_declaration_table_have_bookmarks(page: Page) -> None:
    plc_prg(page)
    page.get_by_role("button", name="Declaration as table").click()
    table = page.get_by_role("grid", name="Declaration of PLC_PRG as table")
    table.get_by_role("row").nth(2).get_by_role("gridcell").nth(2).click()
    page.keyboard.press(TOGGLE)
    expect(table.get_by_role("row").nth(2).get_by_role("img", name="Bookmark")).to_be_visible()
    page.keyboard.press(TOGGLE)
    expect(table.get_by_role("img", name="Bookmark")).to_have_count(0)


def test_rows_of_a_table_of_values_have_bookmarks(page: Page) -> None:
    """By key and by menu; the mark stands in the declaration, not where the cursor of the body stands."""
    editor = plc_prg(page)
    log_in(page)
    table = page.get_by_role("treegrid", name="Declaration of PLC_PRG")
    row = table.get_by_role("row").nth(2)
    name = row.get_by_role("gridcell").first
    name.click()
    page.keyboard.press(TOGGLE)
    mark = row.get_by_role("img", name="Bookmark")
    expect(mark).to_be_visible()
    expect(_marks(editor)).to_have_count(0)
    variable = name.inner_text().strip()
    listed = _panel(page).get_by_role("row").filter(has_text="PLC_PRG")
    expect(listed).to_have_count(1)
    expect(listed.get_by_role("gridcell").nth(3)).to_contain_text(variable)
    name.click(button="right")
    page.get_by_role("menuitem", name="Toggle Bookmark").click()
    expect(mark).to_have_count(0)
    expect(listed).to_have_count(0)


def test_a_row_of_a_table_of_values_leads_to_its_declaration(page: Page) -> None:
    plc_prg(page)
    log_in(page)
    table = page.get_by_role("treegrid", name="Declaration of PLC_PRG")
    name = table.get_by_role("row").nth(3).get_by_role("gridcell").first
    variable = name.inner_text().strip()
    name.click()
    page.keyboard.press("F12")
    line = page.locator(".dv-active-group .view-line").filter(has_text=variable).first
    expect(line).to_be_visible()
    expect(table).to_have_count(0)
    expect(status_bar(page)).to_contain_text("Ln ")


def test_a_row_of_a_watch_list_leads_to_its_declaration(page: Page) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    open_project(page)
    watched = watch(page, "GVL_Line.iRecipe")
    watched.get_by_role("gridcell").first.click()
    page.keyboard.press("F12")
    expect(page.locator(".dv-tab").filter(has_text="GVL_Line").first).to_be_visible()
    expect(page.locator(".dv-active-group .view-line").filter(has_text="iRecipe").first).to_be_in_viewport()
    expect(status_bar(page)).to_contain_text("Ln ")
    for key in ("Home", "Shift+End", "Control+c"):
        page.keyboard.press(key)
    assert page.evaluate("() => navigator.clipboard.readText()").strip().startswith("iRecipe")


def test_a_bookmark_of_the_body_is_reached_from_the_declaration_table(page: Page) -> None:
    editor = plc_prg(page)
    _go_to_line(page, editor, 3)
    page.keyboard.press(TOGGLE)
    _go_to_line(page, editor, 1)
    page.get_by_role("button", name="Declaration as table").click()
    table = page.get_by_role("grid", name="Declaration of PLC_PRG as table")
    table.get_by_role("row").nth(2).get_by_role("gridcell").nth(2).click()
    page.keyboard.press(NEXT)
    expect(status_bar(page)).to_contain_text("Ln 3")
