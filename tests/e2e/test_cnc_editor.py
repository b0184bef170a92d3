"""The CNC editor: text and table are views of one program (cnc.md CNC-02, CNC-30 to CNC-47, CNC-85)."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import objects_stored, open_new_object

pytestmark = pytest.mark.e2e

PROJECT = "CNC machine"


def editor_of(page: Page) -> Locator:
    return page.locator(".dv-active-group [data-panel-id]:visible").last


def cell(page: Page, row: int, column: int) -> Locator:
    return (
        editor_of(page)
        .get_by_role("grid")
        .get_by_role("row")
        .nth(row + 1)
        .get_by_role("gridcell")
        .nth(column)
    )


def lines(page: Page) -> Locator:
    return editor_of(page).locator(".view-line")


@pytest.fixture
def program(page: Page, server: Server) -> tuple[str, str]:
    """A project with a new CNC program, which is open; the path of the project and the id of the object."""
    made = open_new_object(page, server, PROJECT, "cnc", "Contour")
    expect(lines(page).first).to_have_text(re.compile("N0.G0.X0.Y0.F100"))
    return made


def test_text_and_table_are_one_program(page: Page, server: Server, program: tuple[str, str]) -> None:
    """Typing shows messages and rows; a cell changes the text; undo takes it back."""
    path, object_id = program

    def stored() -> str:
        data: dict[str, Any] = fetch(page, server, "GET", f"{path}/objects/{object_id}")["data"]
        return str(data["implementation"])

    expect(page.get_by_role("treeitem", name="CNC settings")).to_be_visible()
    editor = editor_of(page)
    editor.get_by_role("button", name="Text and table").click()
    expect(cell(page, 0, 0)).to_have_text("G0")
    expect(cell(page, 2, 0)).to_have_text("G3")

    lines(page).nth(2).click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.insert_text("N30 G77 X1")
    expect(editor.get_by_role("status").filter(has_text="Errors")).to_contain_text("Errors: 1")
    expect(editor.locator(".squiggly-error")).to_be_visible()
    page.keyboard.press("End")
    for _ in range(len("77 X1")):
        page.keyboard.press("Backspace")
    page.keyboard.insert_text("1 X7")
    expect(editor.get_by_role("status").filter(has_text="Errors")).to_contain_text("Errors: 0")
    expect(cell(page, 3, 0)).to_have_text("G1")
    expect(cell(page, 3, 2)).to_have_text("7")

    cell(page, 3, 2).dblclick()
    page.keyboard.press("Control+a")
    page.keyboard.insert_text("42.5")
    with objects_stored(page):
        page.keyboard.press("Enter")
    expect(lines(page).nth(3)).to_have_text(re.compile(r"N30.G1.X42\.5"))
    assert stored().splitlines()[3] == "N30 G1 X42.5"

    cell(page, 3, 2).click()
    with objects_stored(page):
        page.keyboard.press("Control+z")
    expect(lines(page).nth(3)).to_have_text(re.compile(r"N30.G1.X7$"))
    expect(cell(page, 3, 2)).to_have_text("7")
    assert stored().splitlines()[3] == "N30 G1 X7"

    cell(page, 0, 2).click()
    with objects_stored(page):
        page.keyboard.press("Delete")
    editor.get_by_role("button", name="CNC", exact=True).click()
    with objects_stored(page):
        page.get_by_role("menuitem", name="Renumber Program").click()
    expect(lines(page).nth(0)).to_have_text(re.compile("N0.G1.X50"))
    assert [line.split()[0] for line in stored().splitlines()] == ["N0", "N10", "N20"]


def test_a_word_is_explained_and_the_properties_open(page: Page, program: tuple[str, str]) -> None:
    """CNC-05, CNC-30: a word says what it means in its block, and what is in force there."""
    lines(page).nth(2).get_by_text("X100").hover()
    told = page.locator(".monaco-hover-content", has_text="Target position of axis X")
    expect(told).to_contain_text("G1 G90 G99 F100")
    page.mouse.move(5, 5)
    editor_of(page).get_by_role("button", name="CNC", exact=True).click()
    page.get_by_role("menuitem", name="CNC Properties").click()
    expect(page.get_by_role("dialog")).to_be_visible()


def test_the_info_and_the_code_of_a_program(page: Page, server: Server, program: tuple[str, str]) -> None:
    """CNC-20, CNC-21, cnc EX-01: 11 s by the blocks of the controller; code only without errors."""
    path, object_id = program
    stored = fetch(page, server, "GET", f"{path}/objects/{object_id}")
    data = {**stored["data"], "implementation": "N0 G1 X100 F10 E10 E-10"}
    order = {"data": data, "base_revision": stored["revision"]}
    fetch(page, server, "PUT", f"{path}/objects/{object_id}", data=order)
    expect(lines(page).first).to_have_text(re.compile("N0.G1.X100"))
    editor_of(page).get_by_role("button", name="CNC").click()
    page.get_by_role("menuitem", name="CNC Info").click()
    dialog = page.get_by_role("dialog", name="CNC info of Contour")
    expect(dialog).to_contain_text("11 s", timeout=60_000)
    expect(dialog).to_contain_text("100 u")
    dialog.get_by_role("button", name="Show generated code").click()
    code = page.get_by_role("dialog", name="Generated code")
    expect(code).to_contain_text("Contour : SM3_CNC.SMC_CNC_REF")


def test_the_chain_of_the_settings_is_made_by_keys_and_buttons(
    page: Page, server: Server, program: tuple[str, str]
) -> None:
    """CNCS-03 to CNCS-10: add, order, parameters, remove, interpolation time."""
    path, _ = program
    page.get_by_role("treeitem", name="CNC settings").dblclick()
    settings = editor_of(page)
    offered = settings.get_by_role("grid", name="Blocks of the library")
    used = settings.get_by_role("grid", name="Chain, in the order of execution")
    expect(used.get_by_role("row")).to_have_count(4)
    offered.get_by_role("gridcell", name="SMC_SmoothPath").click()
    offered.press("Space")
    offered.get_by_role("gridcell", name="SMC_ToolCorr").click()  # the row comes into view
    offered.get_by_role("gridcell", name="SMC_ToolCorr").dblclick()
    cells = used.get_by_role("row")
    expect(cells.nth(2)).to_contain_text("SMC_SmoothPath")
    expect(cells.nth(3)).to_contain_text("SMC_ToolCorr")
    cells.nth(3).get_by_role("gridcell").first.click()
    used.press("Shift+ArrowUp")
    expect(cells.nth(2)).to_contain_text("SMC_ToolCorr")
    used.press("p")
    dialog = page.get_by_role("dialog", name="Parameters of SMC_ToolCorr")
    dialog.get_by_label("dToolRadius").fill("2.5")
    dialog.get_by_role("button", name="Apply").click()
    expect(cells.nth(2)).to_contain_text("dToolRadius := 2.5")
    cells.nth(3).get_by_role("gridcell").first.click()
    used.press("Delete")
    expect(used.get_by_role("row")).to_have_count(5)
    settings.get_by_role("tab", name="Pre-interpolation").click()
    settings.get_by_label("Interpolation time").fill("4000")

    def stored() -> object:
        objects = fetch(page, server, "GET", f"{path}/objects")
        found = next(one["id"] for one in objects if one["kind"] == "cnc_settings")
        data = fetch(page, server, "GET", f"{path}/objects/{found}")["data"]
        return [data["interpolation_time_us"], data["preprocessing"]]

    tool = {"block": "SMC_ToolCorr", "parameters": [{"name": "dToolRadius", "value": "2.5"}]}
    for _ in range(50):
        if stored() == [4000, [tool]]:
            break
        page.wait_for_timeout(200)
    assert stored() == [4000, [tool]]
