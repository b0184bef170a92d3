"""Import with a tree to choose from and a report, export of parts and of the whole."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Browser, FilePayload, Locator, Page, expect
from tests.project.archives import archive
from tests.project.exchange.twincat_project import FILES

from .conftest import Server, new_profile, start_page
from .ui import Ui
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


def test_objects_that_exist_are_overwritten_renamed_merged_or_skipped(page: Page) -> None:
    open_project(page)
    tree_item(page, "Alarms").click()

    def choose_files(content: bytes) -> Locator:
        choose_menu(page, "File", "Import")
        return read_files(page, file("Pumps.st", content))

    dialog = choose_files(PUMP)
    expect(dialog.get_by_role("region", name="Objects that exist already")).to_have_count(0)
    dialog.get_by_role("button", name="Import", exact=True).click()
    report = page.get_by_role("dialog", name="Import into Bottling line")
    report.get_by_role("button", name="Close").last.click()
    changed = PUMP.replace(b"bOn : BOOL;", b"bOn : BOOL;\n  nSpeed : INT;")
    dialog = choose_files(changed)
    existing = dialog.get_by_role("region", name="Objects that exist already")
    expect(existing).to_contain_text("2 objects exist already")

    def act(name: str, what: str) -> None:
        dialog.get_by_label(f"What becomes of {name}").click()
        page.get_by_role("option", name=what).click()

    expect(dialog.get_by_label("What becomes of E_Pump")).to_contain_text("Skip")
    new_name = dialog.get_by_label("New name of FB_Pump")
    expect(new_name).to_have_value("FB_Pump_1")
    new_name.fill("fb_pump")
    expect(new_name).to_have_attribute("aria-invalid", "true")
    expect(dialog.get_by_role("button", name="Import", exact=True)).to_have_attribute("aria-disabled", "true")
    act("FB_Pump", "Merge")
    expect(existing).to_contain_text("4 objects exist already")
    row = existing.get_by_role("row").filter(has_text="Alarms / FB_Pump")
    row.get_by_role("button", name="Compare and merge").click()
    compare = page.get_by_role("dialog", name="FB_Pump in the project and in the file")
    right = compare.locator(".monaco-editor .modified-in-monaco-diff-editor, .editor.modified").first
    expect(right).to_contain_text("nSpeed")
    right.get_by_text("nSpeed").click()
    page.keyboard.press("End")
    page.keyboard.type(" // by hand")
    compare.get_by_role("button", name="Take the right side").click()
    expect(row).to_contain_text("merged by hand")
    dialog.get_by_role("button", name="Import", exact=True).click()
    rows = report.get_by_role("row")
    expect(rows.filter(has_text="FB_Pump").filter(has_text="merged").first).to_be_visible()
    expect(rows.filter(has_text="E_Pump")).to_contain_text("skipped")
    report.get_by_role("row").filter(has_text="as the user has joined it").dblclick()
    expect(page.locator(".monaco-editor:visible").first).to_contain_text("by\xa0hand")
    expect(tree_item(page, "FB_Pump_1")).to_have_count(0)


def test_a_chinese_workbench_reads_remarks_and_refusals_in_chinese(browser: Browser, server: Server) -> None:
    with new_profile(browser, "zh") as profile, start_page(profile, server) as page:
        ui = Ui(page, "zh")
        open_project(page)
        open_object(page, "Tappet Soft PLC")
        ui.button("runtime.add", page.locator("body")).click()
        dialog = page.get_by_role("dialog")
        for at, text in enumerate(("Local", "ws://127.0.0.1:9", "none")):
            dialog.get_by_role("textbox").nth(at).fill(text)
        ui.button("action.add", dialog).click()
        expect(page.get_by_text("已有运行时“Local”。").first).to_be_visible()
        page.keyboard.press("Escape")
        ui.command("command.import")
        dialog.locator("input[type=file]").first.set_input_files(
            [file("bad.xml", b"<project"), file("Cut.st", b"FUNCTION_BLOCK FB_Cut\nVAR\nEND_VAR\n")]
        )
        ui.button("exchange.next", dialog).click()
        expect(dialog.get_by_text("缺少 END_FUNCTION_BLOCK；对象在下一个对象开始处结束")).to_be_visible()
        ui.button("exchange.import", dialog).click()
        rows = page.get_by_role("dialog").get_by_role("row")
        expect(rows.filter(has_text="bad.xml")).to_contain_text("不是有效的 XML（")
        expect(rows.filter(has_text="FB_Cut").first).to_contain_text(
            "缺少 END_FUNCTION_BLOCK；对象在下一个对象开始处结束"
        )
