"""What the language server shows in the ST editor."""

from __future__ import annotations

import re
import time

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import (
    add_line,
    delete_line,
    log_in,
    plc_prg,
)

pytestmark = pytest.mark.e2e


def test_completion_offers_the_members_of_an_instance(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "xRun := fbFiller")
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    page.keyboard.type(".xDo")
    offered = page.locator(".suggest-widget .monaco-list-row")
    expect(offered.filter(has_text="xDone")).to_be_visible()
    page.keyboard.press("Enter")
    expect(editor).to_contain_text("fbFiller.xDone")


def new_line(page: Page, text: str) -> None:
    """Types into a new line behind the first one, without a look at what is proposed."""
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type(text)


def offered_words(page: Page) -> Locator:
    return page.locator(".suggest-widget .monaco-list-row")


def test_completion_in_a_call_offers_its_parameters_and_writes_all_of_them(page: Page) -> None:
    editor = plc_prg(page)
    new_line(page, "fbHorn(")
    offered = offered_words(page)
    expect(offered.nth(0)).to_contain_text("IN :=, PT :=, Q =>")
    expect(offered.nth(1)).to_contain_text("IN :=")
    expect(offered.nth(2)).to_contain_text("PT :=")
    expect(page.locator(".suggest-widget .monaco-list-row.focused")).to_contain_text("IN :=, PT :=")
    page.keyboard.press("Tab")
    expect(editor).to_contain_text("fbHorn(IN := , PT := , Q => , ET =>".replace(" ", "\xa0"))
    page.keyboard.type("TRUE")
    expect(editor).to_contain_text("fbHorn(IN := TRUE, PT :=".replace(" ", "\xa0"))


def test_completion_offers_the_values_of_an_enumeration_first(page: Page) -> None:
    plc_prg(page)
    new_line(page, "GVL_Line.eMode := ")
    page.keyboard.press("Control+Space")
    expect(offered_words(page).nth(0)).to_contain_text("E_MachineMode.Stopped")


def test_signature_help_names_the_parameter_that_is_being_written(page: Page) -> None:
    plc_prg(page)
    new_line(page, "fbHorn(IN := TRUE, PT := ")
    page.keyboard.press("Escape")
    page.keyboard.press("Control+Shift+Space")
    help_ = page.locator(".parameter-hints-widget")
    expect(help_).to_contain_text("TON(IN : BOOL, PT : TIME")
    expect(help_.locator(".parameter.active")).to_have_text("PT : TIME")


def test_references_are_listed_in_place(page: Page) -> None:
    plc_prg(page)
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Shift+F12")
    tree = page.locator(".peekview-widget .ref-tree")
    expect(tree).to_contain_text("Stations")
    expect(tree).to_contain_text("PLC_PRG")


def test_cross_references_tell_access_and_place_and_lead_there(page: Page) -> None:
    plc_prg(page)
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Alt+Shift+F12")
    table = page.get_by_role("treegrid", name="Cross References").or_(
        page.get_by_role("grid", name="Cross References")
    )
    rows = table.get_by_role("row").filter(has_text="PLC_PRG.xSafe")
    expect(rows).to_have_count(6)
    expect(rows.filter(has_text="Write")).to_have_count(1)
    expect(rows.filter(has_text="Write")).to_contain_text("Implementation")
    rows.filter(has_text="Stations").first.dblclick()
    expect(page.get_by_text("Ln 28, Col")).to_be_visible()
    page.get_by_role("button", name="Read 4").click()
    expect(rows).to_have_count(2)
    field = page.get_by_role("textbox", name="Name or address")
    field.fill("GVL_Line.eMode")
    field.press("Enter")
    expect(table.get_by_role("row").filter(has_text="GVL_Line.eMode").first).to_be_visible()
    expect(rows).to_have_count(0)


def test_symbols_of_the_object_and_of_the_project_are_found_by_name(page: Page) -> None:
    plc_prg(page)
    page.keyboard.press("Control+Shift+O")
    options = page.get_by_role("option")
    expect(options.filter(has_text="fbConveyor")).to_contain_text("FB_Conveyor")
    expect(options.filter(has_text="Stations")).to_have_count(1)
    page.keyboard.type("fbHorn")
    page.keyboard.press("Enter")
    expect(page.get_by_text("Ln 10, Col")).to_be_visible()
    page.keyboard.press("Control+P")
    page.keyboard.type("xDone")
    member = options.filter(has_text="FB_Capper")
    expect(member).to_contain_text("xDone")
    member.click()
    expect(page.locator(".dv-tab").filter(has_text="FB_Capper")).to_be_visible()


def test_constructs_fold(page: Page) -> None:
    editor = plc_prg(page)
    line = editor.locator(".view-line").filter(has_text="Aborted;").first
    expect(line).to_be_visible()
    editor.get_by_text("IF", exact=True).first.click()
    page.keyboard.press("Control+Shift+BracketLeft")
    expect(line).to_have_count(0)
    page.keyboard.press("Control+Shift+BracketRight")
    expect(line).to_be_visible()


def test_semantic_colours_tell_what_a_name_is(page: Page) -> None:
    editor = plc_prg(page)

    def colour(word: str) -> str:
        return str(editor.get_by_text(word, exact=True).first.evaluate("e => getComputedStyle(e).color"))

    deadline = time.monotonic() + 20.0
    while len({colour(word) for word in ("Starting", "E_MachineMode", "xStarted")}) < 3:
        assert time.monotonic() < deadline, "value, type and variable have the same colour"
        page.wait_for_timeout(100)


def test_the_input_assistant_writes_what_is_chosen(page: Page) -> None:
    editor = plc_prg(page)
    new_line(page, "")
    page.keyboard.press("F2")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_be_visible()
    page.keyboard.type("fbRate")
    expect(dialog).to_contain_text("fbRate")
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(editor.locator(".view-line").filter(has_text=re.compile(r"^fbRate$"))).to_have_count(1)


def test_values_stand_in_the_lines_while_online_and_a_fault_marks_its_line(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iLoaded := 10 / (iLoaded - iLoaded);")
    log_in(page, expected="exception")
    mark = editor.locator("[class*='faultLine'], [class*='_line_']").first
    expect(mark).to_be_visible()
    fault = editor.locator(".view-overlays > div").filter(has=page.locator("[class*='_line_']"))
    expect(fault).to_have_count(1)
    expect(editor.locator("[class*='_pill_']").first).to_be_visible()


def test_an_error_is_marked_while_typing_and_goes_when_it_is_mended(page: Page) -> None:
    editor = plc_prg(page)
    expect(editor.locator(".squiggly-error")).to_have_count(0)
    add_line(page, editor, "xRunn := TRUE;")
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    delete_line(page, editor, 2)
    expect(editor.locator(".squiggly-error")).to_have_count(0)


def test_f12_leads_to_the_declaration_and_hover_tells_type_and_comment(page: Page) -> None:
    editor = plc_prg(page)
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
