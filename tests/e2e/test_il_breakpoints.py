"""Breakpoints in the table of Instruction List."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .instructions import open_with_instructions
from .test_debugger import picture
from .workbench import log_in, open_object, status_bar

pytestmark = pytest.mark.e2e

PROJECT = "Breakpoints"
NUMBER, OPERATOR = 0, 1


@pytest.fixture
def table(page: Page, server: Server) -> Iterator[Locator]:
    """The table of a program in IL that runs."""
    open_with_instructions(page, server, PROJECT, "PROGRAM PLC_PRG", "Instructions();")
    open_object(page, "Instructions")
    log_in(page)
    yield page.get_by_role("grid", name="Instructions of Instructions")
    fetch(page, server, "DELETE", "/runtimes/local/debug/breakpoints")
    if fetch(page, server, "GET", "/runtimes/local/debug")["halted"]:
        fetch(page, server, "POST", "/runtimes/local/debug/control", data={"command": "continue"})


def breakpoint_of(row: Locator) -> Locator:
    return row.get_by_role("img", name="Breakpoint")


def test_a_click_on_the_number_halts_there_and_f9_takes_it_away(page: Page, table: Locator) -> None:
    row = table.get_by_role("row")
    load = row.filter(has_text="nCount").first
    load.get_by_role("button", name="Breakpoint in line 5").click()
    expect(status_bar(page)).to_contain_text("halted: MainTask", timeout=60_000)
    expect(breakpoint_of(load)).to_have_count(1)
    expect(table.locator("[data-state~=halted]")).to_have_count(1)
    expect(table.locator("[data-state~=halted]").get_by_role("gridcell").nth(OPERATOR)).to_have_text("LD")
    picture(page, "il-breakpoint")
    page.keyboard.press("F10")
    last = row.filter(has_text="LD").last
    expect(last).to_have_attribute("data-state", "halted")

    load.get_by_role("gridcell").nth(OPERATOR).click()
    page.keyboard.press("Control+F9")
    expect(breakpoint_of(load)).to_have_attribute("data-look", "disabled")
    page.keyboard.press("F9")
    expect(breakpoint_of(load)).to_have_count(0)
    page.keyboard.press("F5")
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    expect(table.locator("[data-state~=halted]")).to_have_count(0)


def test_a_row_that_makes_a_value_shares_the_breakpoint_of_the_one_that_takes_it(
    page: Page, table: Locator
) -> None:
    row = table.get_by_role("row")
    row.filter(has_text="xAlways").get_by_role("button", name="Breakpoint in line 1").click()
    jump = row.filter(has_text="JMPC")
    expect(breakpoint_of(jump)).to_have_count(1, timeout=60_000)
    expect(table.locator("[data-state~=halted]")).to_contain_text("JMPC")
