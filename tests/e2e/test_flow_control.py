"""Flow control in the editors: executed statements are tinted and have the values right after them."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .instructions import open_with_instructions
from .test_debugger import picture
from .workbench import implementation, log_in, open_object, status_bar, text_of

pytestmark = pytest.mark.e2e

PROJECT = "Flow"
DECLARATION = """PROGRAM PLC_PRG
VAR
    nStep : INT;
    nHalf : INT;
    xNever : BOOL;
END_VAR
VAR_TEMP
    nTemp : INT;
END_VAR"""
BODY = """nStep := nStep MOD 1000 + 1;
nHalf := nStep;
nHalf := nStep / 2;
nTemp := nHalf + 5;
IF xNever THEN
    nHalf := 0;
ELSIF nStep > 2000 THEN
    nHalf := 1;
ELSE
    nHalf := 7;
END_IF
REPEAT
    nTemp := nTemp + 1;
UNTIL nTemp > 20
END_REPEAT
Instructions();"""
EXECUTED = [1, 2, 3, 4, 5, 7, 10, 12, 13, 14, 16]


@pytest.fixture
def flow(page: Page, server: Server) -> Iterator[Page]:
    """A program in ST and one in IL, running, under flow control."""
    open_with_instructions(page, server, PROJECT, DECLARATION, BODY)
    open_object(page, "PLC_PRG")
    log_in(page)
    switch(page)
    expect(status_bar(page).get_by_role("button", name="Flow Control")).to_be_visible()
    yield page
    switch(page)
    expect(status_bar(page).get_by_role("button", name="Flow Control")).to_have_count(0)


def switch(page: Page) -> None:
    page.get_by_role("menuitem", name="Debug").click()
    page.get_by_role("menuitemcheckbox", name=re.compile("^Flow Control")).click()


def tinted(page: Page) -> Locator:
    return implementation(page).locator(".view-overlays [class*=executed]")


def values(page: Page, line: int) -> dict[str, int]:
    """The numbers behind the variables of a line."""
    text = text_of(implementation(page)).split("\n")[line - 1]
    return {name: int(value) for name, value in re.findall(r"(n[A-Z]\w+)\s+(\d+)", text)}


def is_recorded(page: Page, server: Server, name: str) -> bool:
    """Whether the controller records the statements of an object."""
    project = next(p for p in fetch(page, server, "GET", "/projects") if p["name"] == PROJECT)
    objects = fetch(page, server, "GET", f"/projects/{project['id']}/objects")
    found = next(item["id"] for item in objects if item["name"] == name)
    address = f"{server.address}/api/v1/runtimes/local/debug/flow"
    return page.request.get(address, params={"object_id": found}).status == 200


def until(page: Page, condition: Callable[[], bool]) -> None:
    end = time.monotonic() + 20
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        page.wait_for_timeout(50)


def test_executed_lines_are_tinted_and_have_their_values(flow: Page) -> None:
    page = flow
    expect(tinted(page)).to_have_count(len(EXECUTED), timeout=60_000)
    expect(implementation(page).locator("[class*=pill][class*=executed]").first).to_be_visible()
    picture(page, "flow-control")
    seen = set()

    def three_moments() -> bool:
        copied, halved, shown = values(page, 2), values(page, 3), values(page, 10)
        if {"nHalf", "nStep"} <= copied.keys():
            assert copied["nHalf"] == copied["nStep"], "after its line, not at the end of the cycle"
            seen.add(copied["nStep"])
        if {"nHalf", "nStep"} <= halved.keys():
            assert halved["nHalf"] == halved["nStep"] // 2
        assert shown.get("nHalf", 7) == 7
        assert 0 < values(page, 7).get("nStep", 1) <= 1000
        assert values(page, 14).get("nTemp", 21) > 20, "as the condition was looked at last"
        return len(seen) > 2

    until(page, three_moments)
    until(page, lambda: values(page, 4).get("nTemp", 0) == values(page, 4).get("nHalf", 0) + 5)


def test_the_table_of_instructions_shows_it_too(flow: Page) -> None:
    page = flow
    open_object(page, "Instructions")
    table = page.get_by_role("grid", name="Instructions of Instructions")
    row = table.get_by_role("row")
    expect(row.filter(has_text="nIdle").first).to_be_visible()
    passed = table.locator("[data-state~=executed]")
    expect(passed.filter(has_text="xAlways")).to_have_count(1, timeout=60_000)
    expect(passed.filter(has_text="nIdle")).to_have_count(0)
    expect(passed.filter(has_text="ADD")).to_have_count(1)
    # One at the first ST, whatever the cycle ends with.
    expect(row.filter(has_text="ST").filter(has_text="nCount").first).to_contain_text("1")
    picture(page, "flow-control-il")


def test_what_is_no_longer_on_screen_is_no_longer_recorded(flow: Page, server: Server) -> None:
    page = flow
    until(page, lambda: is_recorded(page, server, "PLC_PRG"))
    open_object(page, "Instructions")
    until(page, lambda: is_recorded(page, server, "Instructions"))
    until(page, lambda: not is_recorded(page, server, "PLC_PRG"))
    switch(page)
    until(page, lambda: not is_recorded(page, server, "Instructions"))
    expect(page.locator("[data-state~=executed]")).to_have_count(0)
    switch(page)
