"""Undo in the tree, the history, comparisons with merging, and undo after a reload."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import example, fetch, write
from .conftest import Server
from .workbench import (
    add_line,
    choose_menu,
    implementation,
    open_object,
    open_project,
    plc_prg,
    text_of,
    tree_item,
)

pytestmark = pytest.mark.e2e


def saved(page: Page) -> None:
    page.keyboard.press("Control+S")
    expect(page.locator(".dv-tab [data-dirty]")).to_have_count(0)


def difference(dialog: Locator, name: str) -> Locator:
    return dialog.get_by_role("tree", name="Differences").get_by_role("treeitem").filter(has_text=name).last


def test_deleting_renaming_and_pasting_are_undone_in_the_tree(page: Page) -> None:
    open_project(page)
    tree_item(page, "GVL_IO").click()
    page.keyboard.press("Delete")
    page.get_by_role("dialog").get_by_role("button", name="Delete").click()
    expect(tree_item(page, "GVL_IO")).to_have_count(0)
    tree_item(page, "PLC_PRG").click()
    page.keyboard.press("F2")
    page.keyboard.type("Main")
    page.keyboard.press("Enter")
    expect(tree_item(page, "Main")).to_be_visible()
    page.keyboard.press("Control+Z")
    expect(page.get_by_text("Undone: rename")).to_be_visible()
    expect(tree_item(page, "PLC_PRG")).to_be_visible()
    page.keyboard.press("Control+Z")
    expect(tree_item(page, "GVL_IO")).to_be_visible()
    page.keyboard.press("Control+Y")
    expect(tree_item(page, "GVL_IO")).to_have_count(0)
    choose_menu(page, "Project", "Deleted objects")
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("row").filter(has_text="GVL_IO").click()
    dialog.get_by_role("button", name="Restore").click()
    expect(dialog.get_by_text("Nothing was deleted")).to_be_visible()
    dialog.get_by_role("button", name="Close").last.click()
    expect(tree_item(page, "GVL_IO")).to_be_visible()


def test_a_revision_is_shown_beside_the_present_text_and_taken_back(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "nothing := 4711;")
    saved(page)
    tree_item(page, "PLC_PRG").click()
    choose_menu(page, "Project", "Object history")
    dialog = page.get_by_role("dialog", name="History of 'PLC_PRG'")
    expect(dialog.get_by_role("option").nth(1)).to_have_attribute("aria-selected", "true")
    expect(difference(dialog, "PLC_PRG")).to_contain_text("changed")
    expect(dialog.locator(".monaco-diff-editor")).to_contain_text("4711")
    dialog.get_by_role("listbox").press("ArrowUp")
    expect(dialog.get_by_text("No differences").first).to_be_visible()
    dialog.get_by_role("listbox").press("ArrowDown")
    dialog.get_by_role("button", name="Go back to this").click()
    page.get_by_role("dialog").last.get_by_role("button", name="Go back to this").click()
    expect(dialog.get_by_role("option").first).to_contain_text("go back")
    dialog.get_by_role("button", name="Close").last.click()
    expect(editor).not_to_contain_text("4711")


def test_the_history_of_the_project_is_there_whatever_is_selected(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "nothing := 4711;")
    saved(page)
    tree_item(page, "GVL_IO").click()
    choose_menu(page, "Project", "Project history")
    dialog = page.get_by_role("dialog", name="Project history")
    expect(dialog.get_by_role("option").first).to_contain_text("PLC_PRG")
    expect(difference(dialog, "PLC_PRG")).to_contain_text("changed")
    expect(dialog.get_by_role("button", name="Take over", exact=True)).to_be_disabled()


def test_differences_of_another_project_are_taken_over(page: Page, server: Server) -> None:
    project = example(page, server)
    archive = {"name": "line.zip", "mimeType": "application/zip"}
    content = fetch(page, server, "GET", f"{project}/export")
    sent = {"file": {**archive, "buffer": content}, "name": "Other line"}
    other = fetch(page, server, "POST", "/projects/import", multipart=sent)["id"]
    write(page, server, f"/projects/{other}", "PLC_PRG", "xSafe", "xSecure")
    write(page, server, f"/projects/{other}", "GVL_IO", "END_VAR", "    nCompared : INT;\nEND_VAR")
    open_project(page)
    choose_menu(page, "Project", "Compare")
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("combobox", name="Project").click()
    page.get_by_role("option", name="Other line").click()
    dialog.get_by_role("button", name="Compare").click()
    compared = page.get_by_role("dialog", name="Bottling line compared with Other line")
    expect(compared.get_by_role("button", name="changed")).to_contain_text("2")
    difference(compared, "PLC_PRG").click()
    expect(compared.locator(".monaco-diff-editor")).to_contain_text("xSecure")
    compared.get_by_role("button", name="Take the block over to the right").click()
    expect(difference(compared, "PLC_PRG")).not_to_have_attribute("aria-checked", "false")
    tree = compared.get_by_role("tree", name="Differences")
    difference(compared, "GVL_IO").click()
    tree.press(" ")
    expect(difference(compared, "GVL_IO")).to_have_attribute("aria-checked", "true")
    compared.get_by_role("button", name="Take over 2").click()
    expect(compared.get_by_text("No differences").first).to_be_visible()
    compared.get_by_role("button", name="Close").last.click()
    open_object(page, "PLC_PRG")
    expect(implementation(page)).to_contain_text("xSecure")
    tree_item(page, "GVL_IO").click()
    page.keyboard.press("Control+Z")
    expect(page.get_by_text("Undone: take over differences")).to_be_visible()
    expect(implementation(page)).not_to_contain_text("xSecure")


def test_an_export_is_compared_and_what_runs(page: Page, server: Server) -> None:
    project = example(page, server)
    content = fetch(page, server, "GET", f"{project}/export/plcopen")
    open_project(page)
    write(page, server, project, "PLC_PRG", "xSafe", "xSecure")
    choose_menu(page, "Project", "Compare")
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("radio", name="Files").click()
    file = {"name": "line.xml", "mimeType": "application/xml", "buffer": content}
    dialog.locator("input[type=file]").first.set_input_files([file])
    dialog.get_by_role("button", name="Compare").click()
    compared = page.get_by_role("dialog", name="Bottling line compared with line.xml")
    expect(difference(compared, "PLC_PRG")).to_contain_text("changed")
    compared.get_by_role("button", name="Close").last.click()
    choose_menu(page, "Project", "Compare")
    dialog.get_by_role("radio", name="What runs").click()
    dialog.get_by_role("button", name="Compare").click()
    expect(difference(page.get_by_role("dialog"), "PLC_PRG")).to_contain_text("changed")


def test_undo_goes_back_over_edits_made_before_a_reload(page: Page, server: Server) -> None:
    editor = plc_prg(page)
    before = text_of(editor)
    add_line(page, editor, "nothing := 4711;")
    saved(page)
    page.reload()
    expect(tree_item(page, "Application")).to_be_visible()
    expect(implementation(page)).to_contain_text("4711")
    implementation(page).locator(".view-line").first.click()
    for _ in range(4):
        page.keyboard.press("Control+Z")
    expect(implementation(page)).not_to_contain_text("4711")
    assert text_of(implementation(page)) == before
    add_line(page, implementation(page), "nothing := 1234;")
    saved(page)
    write(page, server, example(page, server), "PLC_PRG", "1234", "5678")
    page.reload()
    expect(implementation(page)).to_contain_text("5678")
    implementation(page).locator(".view-line").first.click()
    page.keyboard.press("Control+Z")
    page.wait_for_timeout(500)
    expect(implementation(page)).to_contain_text("5678")
