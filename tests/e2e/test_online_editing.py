"""Editing, preparing and loading while logged in: the strip, the context menu, fields, Login again."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from .workbench import (
    add_line,
    change_online,
    choose_menu,
    implementation,
    log_in,
    message_rows,
    open_object,
    open_panel,
    open_project,
    plc_prg,
    prepare,
    status_bar,
    text_of,
    watch,
)

pytestmark = pytest.mark.e2e


def _logged_in(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    expect(implementation(page)).to_contain_text("xSafe")


def test_what_is_typed_online_is_kept_until_the_user_agrees(page: Page) -> None:
    _logged_in(page)
    editor = implementation(page)
    before = text_of(editor)
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    strip = page.get_by_role("alert").filter(has_text="Edit PLC_PRG while logged in?")
    page.keyboard.type("abc := 1;")
    page.keyboard.press("Enter")
    page.keyboard.type("x")
    page.keyboard.press("Backspace")
    expect(strip).to_contain_text("abc := 1;\u21b5")
    expect(strip).not_to_contain_text("x\u21b5x")
    assert page.get_by_role("dialog").count() == 0
    assert "abc" not in text_of(editor)

    page.keyboard.press("Escape")
    expect(strip).to_have_count(0)
    assert "abc" not in text_of(editor)
    page.keyboard.type("// one two")
    expect(strip).to_contain_text("// one two")
    page.keyboard.press("Control+Enter")
    expect(strip).to_have_count(0)
    expect(editor.locator(".view-line").first).to_contain_text("//\xa0one\xa0two")
    page.keyboard.type(" three")
    expect(editor.locator(".view-line").first).to_contain_text("//\xa0one\xa0two\xa0three")
    for _ in range(30):
        if text_of(editor) == before:
            break
        page.keyboard.press("Control+Z")


def test_the_context_menu_of_the_text_is_about_the_clicked_symbol(page: Page) -> None:
    _logged_in(page)
    editor = implementation(page)
    # The name, not the value behind it.
    name = editor.locator(".view-line span").filter(has_text=re.compile(r"^\s*xSafe\s*$")).first
    name.click(button="right", position={"x": 8, "y": 8})
    menu = page.get_by_role("menu")
    for entry in ("Go to Definition", "Add to Watch", "Prepare Value", "Write Values", "Rename", "Folding"):
        expect(menu.get_by_role("menuitem", name=re.compile(entry, re.IGNORECASE)).first).to_be_visible()
    menu.get_by_role("menuitem", name=re.compile("^Prepare Value")).click()
    expect(editor).to_contain_text(re.compile("<(TRUE|FALSE)>"))
    page.keyboard.press("Shift+F10")
    expect(menu).to_be_visible()
    page.keyboard.press("Escape")
    expect(menu).to_have_count(0)


def test_f7_takes_what_is_typed_into_the_open_field(page: Page) -> None:
    _logged_in(page)
    row = watch(page, "GVL_Line.iRecipe")
    expect(row.get_by_role("gridcell").nth(2)).not_to_have_text("")
    row.get_by_role("gridcell").nth(2).click()
    page.keyboard.type("3")
    page.keyboard.press("F7")
    expect(row.get_by_label("forced")).to_be_visible()
    expect(row.get_by_role("gridcell").nth(2)).to_contain_text("3")
    row.get_by_role("gridcell").nth(3).click()
    page.keyboard.type("many")
    page.keyboard.press("F7")
    expect(
        page.get_by_role("alert").filter(has_text=re.compile("whole number", re.IGNORECASE))
    ).to_be_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Alt+F7")
    expect(row.get_by_label("forced")).to_have_count(0)


def test_a_click_on_a_bool_prepares_it_and_a_double_click_is_one_click(page: Page) -> None:
    _logged_in(page)
    row = watch(page, "GVL_IO.xEmergencyStop")
    value, prepared = row.get_by_role("gridcell").nth(2), row.get_by_role("gridcell").nth(3)
    expect(value).to_contain_text("FALSE")
    value.click()
    expect(prepared).to_have_text("<TRUE>")
    page.wait_for_timeout(600)
    value.click()
    expect(prepared).to_have_text("<FALSE>")
    page.wait_for_timeout(600)
    value.click()
    expect(prepared).to_have_text("")
    page.wait_for_timeout(600)
    value.dblclick()
    expect(prepared).to_have_text("<TRUE>")
    choose_menu(page, "Online", "Discard prepared")
    expect(prepared).to_have_text("")


def test_the_status_bar_tells_what_is_forced(page: Page) -> None:
    _logged_in(page)
    row = watch(page, "GVL_Line.iRecipe")
    prepare(row, "3")
    force = status_bar(page).get_by_role("button", name="One variable is forced")
    expect(force).to_have_count(0)
    page.keyboard.press("F7")
    expect(force).to_have_text("FORCE 1")
    force.click()
    forces = page.get_by_role("tabpanel", name="Forces")
    expect(forces.get_by_role("row").filter(has_text="GVL_Line.iRecipe")).to_be_visible()
    page.keyboard.press("Alt+F7")
    expect(force).to_have_count(0)


def test_an_exception_stands_in_the_status_bar_and_not_over_the_values(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iLoaded := 7 / LEN('');")
    log_in(page, expected="exception")
    item = status_bar(page).get_by_role("button", name="Division by zero · PLC_PRG, line 2")
    expect(item).to_be_visible()
    expect(page.get_by_role("region", name="Notices").get_by_text("Division by zero")).to_have_count(0)
    editor.locator(".view-line").last.click()
    item.click()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()


def test_a_command_that_changes_the_text_asks_first_and_then_acts(page: Page) -> None:
    _logged_in(page)
    editor = implementation(page)
    first = editor.locator(".view-line").first
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    before = first.inner_text()
    strip = page.get_by_role("alert").filter(has_text="Edit PLC_PRG while logged in?")
    page.keyboard.press("Control+/")
    expect(strip).to_be_visible()
    page.keyboard.press("Escape")
    expect(strip).to_have_count(0)
    assert first.inner_text() == before
    page.keyboard.press("Control+/")
    page.keyboard.press("Control+Enter")
    expect(strip).to_have_count(0)
    expect(first).not_to_have_text(before)
    page.keyboard.press("Control+Z")


def test_the_declaration_as_text_shows_values(page: Page) -> None:
    _logged_in(page)
    page.get_by_role("button", name="Declaration as text").click()
    declaration = page.locator(".monaco-editor:visible").first
    line = declaration.locator(".view-line").filter(has_text=re.compile(r"xRun.*(TRUE|FALSE).*BOOL")).first
    expect(line.locator("[class*=pill]")).to_have_text(re.compile("TRUE|FALSE"))


def test_login_again_after_a_change_offers_the_online_change(page: Page) -> None:
    _logged_in(page)
    editor = implementation(page)
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.type("GVL_Line.iRecipe := GVL_Line.iRecipe; ")
    page.keyboard.press("Control+Enter")
    expect(editor.locator(".view-line").first).to_contain_text("iRecipe")
    page.keyboard.press("Escape")
    change_online(page)


def test_one_click_on_a_message_goes_to_its_place(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    editor.locator(".view-line").nth(2).click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type("GVL_Line.iRecipe := 4;")
    page.keyboard.press("Escape")
    page.keyboard.press("F11")
    open_panel(page, "Messages")
    line = message_rows(page).filter(has_text="4").first
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    line.dblclick()
    expect(page.get_by_text("Ln 4, Col")).to_be_visible()
    page.keyboard.press("Control+Z")


def test_a_watched_variable_leads_to_its_declaration_and_its_uses(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    row = watch(page, "PLC_PRG.xRun")
    row.get_by_role("gridcell").first.click(button="right")
    page.get_by_role("menuitem", name=re.compile("^Cross References")).click()
    uses = page.get_by_role("grid", name="Cross References").get_by_role("row")
    expect(uses.filter(has_text="Declaration").first).to_be_visible()
    row = watch(page, "PLC_PRG.xRun")
    row.get_by_role("gridcell").first.click(button="right")
    page.get_by_role("menuitem", name=re.compile("^Go to Definition")).click()
    expect(page.locator(".dv-tab.dv-active-tab").filter(has_text="PLC_PRG")).to_be_visible()
