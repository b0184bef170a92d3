"""Elements of large arrays by their indices: pages open, the row gets the cursor."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Server
from .instructions import open_with_instructions
from .workbench import log_in, watch

pytestmark = pytest.mark.e2e

DECLARATION = """PROGRAM PLC_PRG
VAR
    anLarge : ARRAY [-5..49999] OF DINT;
    anField : ARRAY [0..99, 1..40] OF DINT;
    nCount : DINT;
    i : DINT;
    j : DINT;
END_VAR"""
BODY = """nCount := nCount + 1;
FOR i := -5 TO 49999 DO anLarge[i] := i * 2; END_FOR
FOR i := 0 TO 99 DO FOR j := 1 TO 40 DO anField[i, j] := i * 100 + j; END_FOR END_FOR"""


@pytest.fixture
def table(page: Page, server: Server) -> Locator:
    """Watch 1 with both arrays, online."""
    open_with_instructions(page, server, "Arrays", DECLARATION, BODY)
    log_in(page)
    for name in ("anLarge", "anField"):
        watch(page, f"PLC_PRG.{name}")
    return page.get_by_role("treegrid", name="Watch 1")


def place_cursor(table: Locator, text: str) -> None:
    table.get_by_role("row").filter(has_text=text).get_by_role("gridcell").nth(1).click()


def go_to(page: Page, indices: str) -> Locator:
    """By the keyboard alone; gives the dialog."""
    page.keyboard.press("Control+g")
    dialog = page.get_by_role("dialog", name="Go to index")
    expect(dialog.get_by_label("Index")).to_be_focused()
    page.keyboard.type(indices)
    page.keyboard.press("Enter")
    return dialog


def value_at_cursor(table: Locator, name: str) -> Locator:
    """The value of the row with the cursor, which is on the screen and has this name."""
    expect(table).to_be_focused()
    row = table.locator("[role=row][aria-selected=true]")
    expect(row.get_by_role("gridcell").first).to_have_text(name)
    expect(row).to_be_in_viewport()
    return row.get_by_role("gridcell").nth(2)


def test_an_element_of_a_large_array_by_its_index(page: Page, table: Locator) -> None:
    place_cursor(table, "PLC_PRG.anLarge")
    expect(go_to(page, "31415")).to_have_count(0)
    expect(value_at_cursor(table, "[31415]")).to_have_text("62830")
    # From an element on: the array is the same, and another page opens beside the first one.
    expect(go_to(page, "[-5]")).to_have_count(0)
    expect(value_at_cursor(table, "[-5]")).to_have_text("-10")
    # 1,001 elements, pages and the two arrays: what is not on the screen is not in the page.
    assert table.get_by_role("row").count() < 100


def test_a_wrong_index_names_the_bounds(page: Page, table: Locator) -> None:
    place_cursor(table, "PLC_PRG.anField")
    dialog = go_to(page, "[12, 41]")
    alert = dialog.get_by_role("alert")
    expect(alert).to_have_text("[12, 41] lies outside of [0..99, 1..40].")
    for wrong, why in (
        ("7", "The array has 2 dimensions: [0..99, 1..40]."),
        ("i, 3", "'i, 3' is no index: write whole numbers, such as 5 or [2, 7]."),
    ):
        dialog.get_by_label("Index").fill(wrong)
        page.keyboard.press("Enter")
        expect(alert).to_have_text(why)
    dialog.get_by_label("Index").fill("12, 40")
    page.keyboard.press("Enter")
    expect(value_at_cursor(table, "[12, 40]")).to_have_text("1240")


def test_the_menu_offers_it_inside_of_arrays(page: Page, table: Locator) -> None:
    watch(page, "PLC_PRG.nCount").click(button="right")
    entry = page.get_by_role("menuitem", name=re.compile("^Go to Index"))
    expect(entry).to_have_attribute("aria-disabled", "true")
    page.keyboard.press("Escape")
    table.get_by_role("row").filter(has_text="PLC_PRG.anLarge").click(button="right")
    entry.click()
    page.keyboard.type("49999")
    page.keyboard.press("Enter")
    expect(value_at_cursor(table, "[49999]")).to_have_text("99998")
