"""Import with a tree to choose from and a report, export of parts and of the whole."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Locator, Page, expect
from tests.project.archives import archive
from tests.project.exchange.twincat_project import FILES

from .workbench import choose_menu, implementation, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e

PUMP = (
    b"FUNCTION_BLOCK FB_Pump\nVAR_INPUT\n  bOn : BOOL;\nEND_VAR\nMETHOD Start : BOOL\nEND_METHOD\n"
    b"METHOD Halt : BOOL\nEND_METHOD\nEND_FUNCTION_BLOCK\nTYPE E_Pump : (Idle, Busy); END_TYPE\n"
)


def file(name: str, content: bytes) -> FilePayload:
    return {"name": name, "mimeType": "application/octet-stream", "buffer": content}


def read_files(page: Page, *files: FilePayload) -> Locator:
    """The second page of the import dialog: what the files hold."""
    dialog = page.get_by_role("dialog", name="Import")
    dialog.locator("input[type=file]").first.set_input_files(list(files))
    expect(dialog.get_by_text(files[-1]["name"])).to_be_visible()
    dialog.get_by_role("button", name="Next").click()
    expect(dialog.get_by_role("tree", name="Objects in the files")).to_be_visible()
    return dialog


def node(dialog: Locator, name: str) -> Locator:
    return dialog.get_by_role("treeitem").filter(has_text=name)


def uncheck(dialog: Locator, name: str) -> None:
    node(dialog, name).locator("[data-state]").click()
    expect(node(dialog, name)).to_have_attribute("aria-checked", "false")


def test_chosen_objects_come_to_the_place_and_the_report_leads_to_them(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    expect(implementation(page)).to_contain_text("xSafe")
    tree_item(page, "Alarms").click()
    expect(tree_item(page, "Alarms")).to_have_attribute("aria-selected", "true")
    choose_menu(page, "File", "Import")
    expect(page.get_by_role("dialog").get_by_label("Place in the tree")).to_contain_text("Alarms")
    dialog = read_files(page, file("bad.xml", b"<project"), file("Pumps.st", PUMP))
    expect(dialog.get_by_role("region", name="What would be changed")).to_contain_text("bad.xml")
    expect(node(dialog, "FB_Pump")).to_have_attribute("aria-checked", "true")
    uncheck(dialog, "Halt")
    expect(node(dialog, "FB_Pump")).to_have_attribute("aria-checked", "mixed")
    uncheck(dialog, "E_Pump")
    dialog.get_by_role("button", name="Import", exact=True).click()
    report = page.get_by_role("dialog", name="Import into Bottling line")
    rows = report.get_by_role("row")
    expect(rows.filter(has_text="FB_Pump.Start")).to_be_visible()
    expect(rows.filter(has_text="bad.xml")).to_contain_text("refused")
    expect(rows.filter(has_text="Halt")).to_have_count(0)
    report.get_by_role("button", name="2 imported").click()
    expect(rows.filter(has_text="FB_Pump")).to_have_count(0)
    report.get_by_role("button", name="2 imported").click()
    with page.expect_download() as download:
        report.get_by_role("button", name="Save…").click()
    assert "imported FB_Pump.Start" in Path(download.value.path()).read_text()
    rows.filter(has_text="FB_Pump.Start").dblclick()
    expect(report).to_have_count(0)
    expect(page.locator(".dv-tab.dv-active-tab").filter(has_text="Start").first).to_be_visible()
    expect(tree_item(page, "FB_Pump")).to_have_attribute("aria-level", "5")
    expect(tree_item(page, "Start")).to_be_visible()
    expect(tree_item(page, "Halt")).to_have_count(0)


def test_a_solution_becomes_a_project_from_the_start_page(page: Page) -> None:
    page.get_by_role("button", name="Import…").first.click()
    dialog = read_files(page, file("solution.zip", archive(*FILES.items())))
    expect(node(dialog, "FB_Old").get_by_text("FB_Old")).to_have_attribute("data-excluded", "")
    dialog.get_by_role("button", name="Import", exact=True).click()
    report = page.get_by_role("dialog", name="Import into Imported line")
    report.get_by_role("button", name="Open project").click()
    expect(tree_item(page, "FB_Used")).to_be_visible()
    expect(tree_item(page, "FB_Old").get_by_text("FB_Old")).to_have_attribute("data-excluded", "")


def test_parts_and_the_whole_go_out_and_come_in_again(page: Page, tmp_path: Path) -> None:
    open_project(page)
    tree_item(page, "GVL_IO").click()

    def export(format_: str, scope: str) -> Path:
        choose_menu(page, "File", "Export")
        dialog = page.get_by_role("dialog", name="Export")
        for label, option in (("Format", format_), ("What", scope)):
            dialog.get_by_label(label, exact=True).click()
            page.get_by_role("option", name=option).click()
        with page.expect_download() as download:
            dialog.get_by_role("button", name="Export").click()
        target = tmp_path / download.value.suggested_filename
        download.value.save_as(target)
        return target

    text = export("Structured Text", "Selection: GVL_IO")
    assert text.name == "GVL_IO.st"
    assert "VAR_GLOBAL" in text.read_text()
    xml = export("PLCopen XML", "Selection: GVL_IO")
    assert b'globalVars name="GVL_IO"' in xml.read_bytes()
    archive = export("Project archive", "The whole project")
    assert archive.name == "Bottling line.zip"
    choose_menu(page, "File", "Import")
    page.get_by_role("dialog").get_by_label("Into").click()
    page.get_by_role("option", name="A new project").click()
    dialog = read_files(page, file(archive.name, archive.read_bytes()))
    dialog.get_by_role("button", name="None").click()
    dialog.get_by_label("Search objects").fill("FB_Alarm")
    node(dialog, "FB_Alarm").first.locator("[data-state]").click()
    dialog.get_by_role("button", name="Import", exact=True).click()
    report = page.get_by_role("dialog", name="Import into")
    report.get_by_role("button", name="Open project").click()
    tree_item(page, "Alarms").click()
    page.keyboard.press("ArrowRight")
    expect(tree_item(page, "FB_Alarm")).to_be_visible()
    expect(tree_item(page, "Library Manager")).to_be_visible()
    expect(tree_item(page, "GVL_IO")).to_have_count(0)
