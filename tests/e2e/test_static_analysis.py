"""Coding rules in the editor, in the build and on demand; objects left out of the build."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import (
    add_line,
    answer_to,
    choose_menu,
    implementation,
    open_object,
    open_panel,
    open_project,
    tree_item,
)

pytestmark = pytest.mark.e2e


def settings(page: Page) -> Locator:
    choose_menu(page, "Project", "Static Analysis Settings")
    dialog = page.get_by_role("dialog", name="Static Analysis Settings")
    expect(dialog.get_by_role("group", name="S1211")).to_be_visible()
    return dialog


def set_level(page: Page, dialog: Locator, code: str, level: str) -> None:
    dialog.get_by_label(f"Severity of {code}").click()
    page.get_by_role("option", name=level, exact=True).click()


def apply(dialog: Locator) -> None:
    dialog.get_by_role("button", name="Apply").click()
    expect(dialog).to_have_count(0)


def magic_rows(page: Page) -> Locator:
    return open_panel(page, "Messages").get_by_role("row").filter(has_text="S1211").filter(has_text="4711")


def test_a_rule_is_seen_in_the_editor_and_stops_the_build_as_an_error(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    add_line(page, editor, "iLoaded := 4711;")
    page.keyboard.press("Control+s")
    dialog = settings(page)
    dialog.get_by_label("Search rules").fill("magic")
    expect(dialog.get_by_role("group", name="S1001")).to_have_count(0)
    set_level(page, dialog, "S1211", "Error")
    apply(dialog)
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    assert not built.value.json()["ok"]
    expect(magic_rows(page).first).to_be_visible()
    dialog = settings(page)
    expect(dialog.get_by_label("Severity of S1211")).to_contain_text("Error")
    dialog.get_by_role("button", name="Defaults").click()
    expect(dialog.get_by_label("Severity of S1211")).to_contain_text("Off")
    apply(dialog)
    expect(editor.locator(".squiggly-error")).to_have_count(0)


def test_static_analysis_runs_on_demand_with_the_prefixes_of_the_project(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    add_line(page, implementation(page), "iLoaded := 4711;")
    page.keyboard.press("Control+s")
    choose_menu(page, "Build", "Run Static Analysis")
    dialog = page.get_by_role("dialog", name="Static Analysis Settings")
    dialog.get_by_label("Check with every build and in the editors").click()
    set_level(page, dialog, "S1211", "Warning")
    set_level(page, dialog, "S1001", "Warning")
    prefix = dialog.get_by_role("group", name="S1001").get_by_label("FUNCTION_BLOCK")
    expect(prefix).to_have_value("FB_")
    prefix.fill("a b")
    expect(dialog.get_by_role("button", name="Apply")).to_have_attribute("aria-disabled", "true")
    prefix.fill("blk")
    with answer_to(page, "/static-analysis") as answered:
        apply(dialog)
    report = answered.value.json()
    codes = {d["code"] for d in report["diagnostics"]}
    assert {"S1001", "S1211"} <= codes
    assert any("'blk'" in d["message"] for d in report["diagnostics"] if d["code"] == "S1001")
    expect(magic_rows(page).first).to_be_visible()
    magic_rows(page).first.dblclick()
    expect(page.locator(".dv-tab.dv-active-tab").filter(has_text="PLC_PRG").first).to_be_visible()
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    assert built.value.json()["ok"]
    assert not any(d["code"].startswith("S") for d in built.value.json()["diagnostics"])


def test_an_object_is_excluded_from_the_build_and_taken_in_again(page: Page) -> None:
    open_project(page)
    tree_item(page, "GVL_Line").click()
    choose_menu(page, "Project")
    page.get_by_role("menuitemcheckbox", name="Exclude from Build").click()
    name = tree_item(page, "GVL_Line").get_by_text("GVL_Line")
    expect(name).to_have_attribute("data-excluded", "")
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    assert not built.value.json()["ok"], "PLC_PRG needs the list"
    tree_item(page, "GVL_Line").click(button="right")
    entry = page.get_by_role("menuitemcheckbox", name="Exclude from Build")
    expect(entry).to_have_attribute("aria-checked", "true")
    entry.click()
    expect(name).not_to_have_attribute("data-excluded", "")
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    assert built.value.json()["ok"]
