"""Watch lists and the table of forces: expressions, formats, snapshots, history, origin of forces."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import log_in, open_panel, open_project, prepare, watch, watch_value

pytestmark = pytest.mark.e2e

COUNTER = "PersistentVars.udiOperatingTime"
"""Counts all the time."""
BUTTON = "GVL_IO.xEmergencyStop"


@pytest.fixture
def panel(page: Page) -> Iterator[Locator]:
    open_project(page)
    log_in(page)
    yield open_panel(page, "Watch 1")
    page.keyboard.press("Alt+F7")


def cell(row: Locator, number: int) -> Locator:
    return row.get_by_role("gridcell").nth(number)


def test_expressions_are_computed_from_variables(page: Page, panel: Locator) -> None:
    watch_value(watch(page, COUNTER), at_least=1)
    row = watch(page, f"({COUNTER} * 0 + 7) MOD 4 = 3")
    expect(cell(row, 2)).to_have_text("TRUE")
    wrong = watch(page, "GVL_IO.nNowhere + 1")
    expect(cell(wrong, 2)).to_contain_text("nNowhere")


def test_a_line_has_a_number_format_of_its_own(page: Page, panel: Locator) -> None:
    row = watch(page, COUNTER)
    watch_value(row, at_least=1)
    cell(row, 0).click(button="right")
    page.get_by_role("menuitem", name="Number format").hover()
    page.get_by_role("menuitemcheckbox", name="Hexadecimal").click()
    expect(cell(row, 2)).to_have_text(re.compile(r"^16#[0-9A-F]{8}$"))
    other = watch(page, "PersistentVars.udiOperatingTime + 0")
    expect(cell(other, 2)).to_have_text(re.compile(r"^[0-9]+$"))
    cell(row, 0).click(button="right")
    page.get_by_role("menuitem", name="Number format").hover()
    page.get_by_role("menuitemcheckbox", name="Format of the list").click()
    expect(cell(row, 2)).to_have_text(re.compile(r"^[0-9]+$"))


def test_snapshots_are_compared_and_saved(page: Page, panel: Locator) -> None:
    row = watch(page, COUNTER)
    first = int(watch_value(row, at_least=1))
    panel.get_by_role("button", name="Take a snapshot").click()
    expect(cell(row, 3)).to_have_text(re.compile(r"^[0-9]+$"))
    watch_value(row, at_least=first + 3)
    panel.get_by_role("button", name="Take a snapshot").click()
    changed = cell(row, 4).locator("[data-differs]")
    expect(changed).to_be_visible()
    with page.expect_download() as download:
        panel.get_by_role("button", name="Save snapshots as CSV").click()
    text = download.value.path().read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if line.startswith(COUNTER))
    values = line.split(",")[2:4]
    assert values == [cell(row, 3).inner_text(), changed.inner_text()]
    assert int(values[0]) < int(values[1])
    panel.get_by_role("button", name="Discard snapshots").click()
    expect(panel.get_by_role("columnheader")).to_have_count(5)


def test_the_last_minute_is_drawn(page: Page, panel: Locator) -> None:
    watch_value(watch(page, COUNTER), at_least=1)
    toggle = panel.get_by_role("button", name="Last minute")
    toggle.click()
    curve = panel.get_by_role("img", name=f"History of {COUNTER}")
    expect(curve).to_be_visible()
    page.wait_for_function(
        "canvas => new Uint32Array(canvas.getContext('2d')"
        ".getImageData(0, 0, canvas.width, canvas.height).data.buffer).some(Boolean)",
        arg=curve.element_handle(),
    )
    toggle.click()
    expect(curve).to_have_count(0)


def test_forces_say_where_they_come_from(page: Page, panel: Locator) -> None:
    prepare(watch(page, BUTTON))
    page.keyboard.press("F7")
    forces = open_panel(page, "Forces")
    row = forces.get_by_role("row").filter(has_text=BUTTON)
    expect(row).to_contain_text("Workbench")
    expect(cell(row, 4)).to_have_text("FALSE")
    with page.expect_download() as download:
        forces.get_by_role("button", name="Export forces").click()
    saved = download.value.path()
    assert saved.read_text(encoding="utf-8") == f"{BUTTON} := TRUE;\n"
    page.keyboard.press("Alt+F7")
    expect(row).to_have_count(0)
    forces.locator("input[type=file]").set_input_files(
        {"name": "forces.txt", "mimeType": "text/plain", "buffer": saved.read_bytes()}
    )
    page.keyboard.press("F7")
    expect(row).to_contain_text("Workbench")
