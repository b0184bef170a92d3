"""Painted values of online tables: what assistive technology, the clipboard and displays get of them."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import log_in, open_object, open_project, watch

pytestmark = pytest.mark.e2e

NUMBER = re.compile(r"^\d+$")
COUNTER = "PersistentVars.udiOperatingTime"
"""Changes all the time."""
ZOOMS = (0.8, 0.9, 1.1, 1.25, 1.5, 2.0)
BOXES = """
table => [...table.querySelectorAll('canvas')].map((canvas) => {
  const own = canvas.getBoundingClientRect();
  const body = canvas.closest('[role=presentation]').getBoundingClientRect();
  const ratio = devicePixelRatio;
  return {
    box: [own.left - body.left, own.top - body.top, own.width, own.height].map((px) => px * ratio),
    size: [canvas.width, canvas.height],
    rendering: getComputedStyle(canvas).imageRendering,
  };
})
"""
"""Where the canvases of a table stand in its body, in device pixels, and how many pixels they have."""
INK = """
([table, row]) => {
  const whole = row.getBoundingClientRect();
  for (const canvas of table.querySelectorAll('canvas')) {
    const own = canvas.getBoundingClientRect();
    if (own.top > whole.top || own.bottom < whole.bottom) continue;
    const scale = canvas.height / own.height;
    const top = Math.round((whole.top - own.top) * scale);
    const height = Math.round(whole.height * scale);
    const { data } = canvas.getContext('2d').getImageData(0, top, canvas.width, height);
    let painted = 0;
    for (let at = 3; at < data.length; at += 4) if (data[at] > 0) painted += 1;
    return painted;
  }
  return null;
}
"""
"""Pixels of a row that are not clear."""


@pytest.fixture
def row(page: Page) -> Iterator[Locator]:
    """A row of the first watch list whose value changes."""
    open_project(page)
    log_in(page)
    watched = watch(page, COUNTER)
    expect(watched.get_by_role("gridcell").nth(2)).to_have_text(NUMBER)
    yield watched
    page.emulate_media(forced_colors="none")


def test_a_painted_value_has_a_name(row: Locator) -> None:
    """A canvas says nothing to a screen reader: the cell does, and again when its value has changed."""
    value = row.get_by_role("img")
    expect(value).to_have_accessible_name(NUMBER)
    first = value.get_attribute("aria-label")
    assert first is not None
    expect(value).not_to_have_accessible_name(first)
    expect(value).to_have_accessible_name(NUMBER)


def test_rows_are_copied_with_their_values(page: Page, row: Locator) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.evaluate("() => navigator.clipboard.writeText('')")  # another test may have copied a row
    row.get_by_role("gridcell").first.click()
    page.keyboard.press("Control+c")
    copied = re.compile(rf"^{re.escape(COUNTER)}\tUDINT\t\d+$")
    page.wait_for_function("async () => (await navigator.clipboard.readText()).includes('\\t')")
    assert copied.match(page.evaluate("() => navigator.clipboard.readText()"))


def test_values_are_sharp_at_every_zoom(page: Page) -> None:
    """A canvas that does not cover whole device pixels is stretched over them."""
    open_project(page)
    log_in(page)
    open_object(page, "PersistentVars")
    table = page.get_by_role("treegrid").filter(has_text="udiOperatingTime").first
    expect(table.locator("canvas").first).to_be_attached()
    session = page.context.new_cdp_session(page)
    for zoom in ZOOMS:
        # As the zoom of the browser does: less room, and more device pixels for each pixel.
        metrics = {"width": int(1440 / zoom), "height": int(900 / zoom), "deviceScaleFactor": zoom}
        session.send("Emulation.setDeviceMetricsOverride", {**metrics, "mobile": False})
        page.wait_for_function("zoom => Math.abs(devicePixelRatio - zoom) < 0.001", arg=zoom)
        page.evaluate(
            "() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))"
        )
        boxes = table.evaluate(BOXES)
        assert boxes
        for canvas in boxes:
            assert canvas["box"] == pytest.approx([round(px) for px in canvas["box"]], abs=0.05), zoom
            assert canvas["size"] == [round(px) for px in canvas["box"][2:]], zoom
            # The table itself may begin between device pixels: its pixels are not to be mixed there.
            assert canvas["rendering"] == "pixelated"
    session.send("Emulation.clearDeviceMetricsOverride")


def test_forced_colours_hide_no_value(page: Page, row: Locator) -> None:
    """A mark of a change that has the one colour of all texts would cover its value."""
    page.emulate_media(forced_colors="active")
    table = page.get_by_role("treegrid", name="Watch 1")
    handles = [table.element_handle(), row.element_handle()]
    width = len(row.get_by_role("gridcell").nth(2).text_content() or "")
    for _ in range(20):
        # Its digits cover a small part of their 8 by 18 pixels each; the mark would cover them whole.
        assert 0 < page.evaluate(INK, handles) < width * 8 * 18 * 0.6
        page.wait_for_timeout(100)
    row.get_by_role("gridcell").first.click()
    assert row.evaluate("row => getComputedStyle(row).outlineStyle") == "solid"
