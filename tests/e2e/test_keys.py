"""Keys of commands: presets, keys of one's own, conflicts, files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import answer_to, open_project, plc_prg

pytestmark = pytest.mark.e2e


def _dialog(page: Page) -> Locator:
    page.keyboard.press("Control+Alt+k")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_label("Search by command or keys")).to_be_focused()
    return dialog


def _choose(dialog: Locator, command: str) -> None:
    dialog.get_by_label("Search by command or keys").fill(command)
    dialog.get_by_role("row").filter(has_text=command).first.click()


def test_a_preset_changes_menus_and_keys_and_stays(page: Page) -> None:
    open_project(page)
    dialog = _dialog(page)
    with answer_to(page, "/me/settings/keys"):
        dialog.get_by_role("combobox").click()
        page.get_by_role("option", name="VS Code").click()
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    with answer_to(page, "/build"):
        page.keyboard.press("Control+Shift+B")
    page.reload()
    expect(page.get_by_role("treeitem").first).to_be_visible()
    page.get_by_role("menuitem", name="Build", exact=True).click()
    expect(page.get_by_role("menuitem", name="Build Ctrl+Shift+B")).to_be_visible()


def test_a_combination_is_taken_from_another_command_and_given_back(page: Page, tmp_path: Path) -> None:
    open_project(page)
    dialog = _dialog(page)
    _choose(dialog, "Rebuild")
    dialog.get_by_label("Press the keys for Rebuild").press("F11")
    expect(dialog.get_by_role("alert")).to_contain_text("It belongs to Build")
    dialog.get_by_role("button", name="Assign").click()
    expect(dialog.get_by_role("row").filter(has_text="Rebuild")).to_contain_text("F11")
    with page.expect_download() as saved:
        dialog.get_by_role("button", name="Export").click()
    stored = json.loads(saved.value.path().read_text())
    assert stored == {"preset": "tappet", "own": {"build.build": [], "build.rebuild": ["F11"]}}
    page.keyboard.press("Escape")
    with answer_to(page, "/rebuild"):
        page.keyboard.press("F11")
    dialog = _dialog(page)
    dialog.get_by_role("button", name="Reset All").click()
    _choose(dialog, "Rebuild")
    expect(dialog.get_by_role("row").filter(has_text="Rebuild")).not_to_contain_text("F11")
    keys = tmp_path / "keys.json"
    keys.write_text(saved.value.path().read_text())
    dialog.locator("input[type=file]").set_input_files(keys)
    expect(dialog.get_by_role("row").filter(has_text="Rebuild")).to_contain_text("F11")
    keys.write_text("[]")
    dialog.locator("input[type=file]").set_input_files(keys)
    expect(page.get_by_text("This file holds no keys")).to_be_visible()


def test_acts_of_the_code_editor_have_keys_too(page: Page) -> None:
    editor = plc_prg(page)
    dialog = _dialog(page)
    _choose(dialog, "Delete Line")
    dialog.get_by_role("button", name="Remove").click()
    dialog.get_by_label("Press the keys for Delete Line").press("Control+Alt+d")
    dialog.get_by_role("button", name="Assign").click()
    page.keyboard.press("Escape")
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+End")
    page.keyboard.press("Enter")
    page.keyboard.type("// one too many")
    expect(editor).to_contain_text("one\xa0too\xa0many")
    page.keyboard.press("Control+Shift+k")
    page.keyboard.type("!")
    expect(editor).to_contain_text("one\xa0too\xa0many!")
    page.keyboard.press("Control+Alt+d")
    expect(editor).not_to_contain_text("one\xa0too\xa0many")
    page.keyboard.press("Enter")
    page.keyboard.type("//twice")
    page.keyboard.press("Shift+Alt+ArrowDown")
    expect(editor.locator(".view-line").filter(has_text="//twice")).to_have_count(2)
