"""Search and replace in the project."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import answer_to, implementation, open_object, open_project, text_of

pytestmark = pytest.mark.e2e


def _search(page: Page, text: str, *, replacing: bool = False) -> Locator:
    """The panel with the places of a text."""
    page.keyboard.press("Control+Shift+H" if replacing else "Control+Shift+F")
    panel = page.locator("[data-panel-id=search]")
    field = panel.get_by_label("Search for")
    expect(field).to_be_focused()
    with answer_to(page, "/search"):
        field.fill(text)
    return panel


def _row(panel: Locator, text: str) -> Locator:
    return panel.get_by_role("treeitem").filter(has_text=re.compile(text))


def test_a_hit_leads_to_its_place(page: Page) -> None:
    open_project(page)
    panel = _search(page, "xSafe :=")
    expect(panel.get_by_role("status")).to_have_text(re.compile(r"1 hit in 1 object"))
    _row(panel, "xSafe :=").click()
    expect(page.locator(".dv-tab").filter(has_text="PLC_PRG")).to_be_visible()
    expect(implementation(page)).to_contain_text("xSafe")
    panel.get_by_label("Search for").fill("PLC_PRG")
    expect(_row(panel, r"^PLC_PRG").first).to_be_visible()
    panel.get_by_role("button", name="Names").click()
    panel.get_by_role("button", name="Declarations").click()
    expect(_row(panel, r"^MainTask").first).to_be_visible()


def test_what_is_no_regular_expression_is_said_at_the_field(page: Page) -> None:
    open_project(page)
    panel = _search(page, "(a")
    expect(panel.get_by_role("alert")).to_have_count(0)
    with answer_to(page, "/search"):
        panel.get_by_role("button", name="Regular expression").click()
    expect(panel.get_by_role("alert")).to_have_text("This is no regular expression: missing ): (a")
    expect(panel.get_by_label("Search for")).to_have_attribute("aria-invalid", "true")


def test_hits_are_replaced_but_those_left_out_and_taken_back(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    before = text_of(editor)
    panel = _search(page, "xSafe", replacing=True)
    panel.get_by_label("Replace with").fill("xAllSafe")
    expect(panel.get_by_role("status")).to_contain_text("to be replaced")
    expect(_row(panel, "xSafexAllSafe").first).to_be_visible()
    hits = _row(panel, "xSafexAllSafe").count()
    boxes = panel.get_by_role("checkbox", name="Replace this hit")
    boxes.last.uncheck()
    expect(panel.get_by_role("status")).to_contain_text(f"{hits - 1} to be replaced")
    panel.get_by_role("button", name="Replace", exact=True).click()
    expect(page.get_by_text(f"{hits - 1} hits replaced")).to_be_visible()
    expect(editor).to_contain_text("xAllSafe")
    expect(_row(panel, "xSafexAllSafe")).to_have_count(1)
    page.get_by_role("button", name="Undo").last.click()
    expect(editor).not_to_contain_text("xAllSafe")
    assert text_of(editor) == before
