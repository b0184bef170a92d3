"""The path of a CNC program in 3D (cnc.md CNC-50 to CNC-62): one model with the text, drawn by the server."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import objects_stored, open_new_object

pytestmark = [pytest.mark.e2e, pytest.mark.slow]

PROGRAM = """N0 G0 X10 Y10 F100 E400 E-400
N10 G1 X100 Y10 H1 L30
N20 G3 X140 Y50 R40
N30 G1 X140 Y80
N40 G2 X100 Y80 R20
N50 G5 X70 Y95
N60 G5 X40 Y70
N70 G5 X10 Y80
N80 G0 X10 Y10
"""
READY_MS = 90_000
"""The decoder is compiled for the first view of a server."""


def pane_of(page: Page) -> Locator:
    return page.get_by_test_id("path-pane").last


def line(page: Page, number: int) -> Locator:
    return page.locator(".dv-active-group .view-line").nth(number)


def picture(page: Page, name: str) -> None:
    folder = os.environ.get("TAPPET_VIEWS")
    if folder:
        page.wait_for_timeout(1500)
        page.screenshot(path=Path(folder) / f"{name}.png")


def drawn(page: Page, elements: int) -> None:
    pane = pane_of(page)
    expect(pane.get_by_test_id("path-facts")).to_contain_text(f"Elements: {elements}", timeout=READY_MS)
    expect(pane.get_by_test_id("path-overlay")).to_be_visible(timeout=READY_MS)


@pytest.fixture
def contour(page: Page, server: Server) -> tuple[str, str]:
    """A program with lines, arcs and a spline, opened; the path of its project and its id."""
    path, object_id = open_new_object(page, server, "Milling", "cnc", "Contour")
    drawn(page, 2)  # G0 does not move: it begins where the path begins
    expect(line(page, 0)).to_have_text(re.compile("N0.G0"))
    line(page, 0).click()
    page.keyboard.press("Control+a")
    with objects_stored(page):
        page.keyboard.insert_text(PROGRAM)
    drawn(page, 9)
    pane_of(page).get_by_role("button", name="Look along negative Z and show the whole path").click()
    expect(pane_of(page).locator("circle[data-line='7']")).to_be_visible()
    return path, object_id


def stored(page: Page, server: Server, contour: tuple[str, str]) -> list[str]:
    path, object_id = contour
    data = fetch(page, server, "GET", f"{path}/objects/{object_id}")["data"]
    return str(data["implementation"]).splitlines()


def test_text_and_path_are_one_model(page: Page, server: Server, contour: tuple[str, str]) -> None:
    """A line chooses its element, a click its line; an end that is dragged changes the text."""
    pane = pane_of(page)
    line(page, 2).click()
    expect(pane.get_by_test_id("path-position")).to_have_text(re.compile(r"X 140\.000\s+Y 50\.000"))
    picture(page, "path-chosen")
    end = pane.locator("circle[data-line='1']")
    box = end.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + 40, box["y"] + 30, steps=4)
    with objects_stored(page):
        page.mouse.up()
    moved = stored(page, server, contour)[1]
    found = re.fullmatch(r"N10 G1 X([\d.]+) Y(-?[\d.]+) H1 L30", moved)
    assert found is not None, moved
    assert float(found[1]) > 105
    assert float(found[2]) < 5
    with objects_stored(page):
        page.keyboard.press("Control+z")
    assert stored(page, server, contour)[1] == "N10 G1 X100 Y10 H1 L30"
    # A place on the last line, half way between two circles.
    ends = [pane.locator(f"circle[data-line='{n}']").bounding_box() for n in (7, 0)]
    assert ends[0] is not None
    assert ends[1] is not None
    x, y = ((ends[0][axis] + ends[1][axis]) / 2 + ends[0]["width"] / 2 for axis in ("x", "y"))
    page.mouse.click(x, y)
    expect(pane.get_by_test_id("path-position")).to_have_text(re.compile(r"X 10\.0"))
    expect(page.locator(".dv-active-group [class*=chosen]").first).to_be_visible()
    with objects_stored(page):
        page.keyboard.press("Delete")
    assert len(stored(page, server, contour)) == 8


def test_the_motion_is_played(page: Page, contour: tuple[str, str]) -> None:
    """The tool stands where the interpolator is at the time of the slider."""
    pane = pane_of(page)
    pane.get_by_role("button", name="Play the motion").click()
    motion = pane.get_by_test_id("path-motion")
    expect(motion.get_by_test_id("path-chart").locator("canvas")).to_be_visible(timeout=READY_MS)
    tool = pane.get_by_test_id("path-tool")
    expect(tool).to_be_visible()
    before = tool.bounding_box()
    slider = motion.get_by_role("slider", name="Time [s]")
    slider.focus()
    page.keyboard.press("End")
    page.keyboard.press("ArrowLeft")
    expect(motion).to_contain_text("Line 9")
    for _ in range(3):
        page.keyboard.press("PageDown")
    after = tool.bounding_box()
    assert before is not None
    assert after is not None
    assert abs(after["x"] - before["x"]) + abs(after["y"] - before["y"]) > 20
    picture(page, "path-motion")
    motion.get_by_role("button", name="To the beginning").click()
    motion.get_by_role("button", name="Play", exact=True).click()
    expect(motion).to_contain_text("Line 2")


def test_colours_and_camera(page: Page, contour: tuple[str, str]) -> None:
    """The legend says what colours stand for; the camera goes to a side and back."""
    pane = pane_of(page)
    first = pane.locator("circle[data-line='1']")
    place = first.get_attribute("cx")
    for colours in ("Velocity", "Curvature"):
        pane.get_by_role("combobox", name="Colours").click()
        page.get_by_role("option", name=colours).click()
        expect(pane.get_by_test_id("path-legend")).to_contain_text(colours, timeout=READY_MS)
        picture(page, f"path-{colours.lower()}")
    pane.get_by_role("button", name="Zoom in").click()
    expect(first).not_to_have_attribute("cx", re.compile(f"^{re.escape(str(place))}$"))
    for name in ("Look along Y and show the whole path", "Tilt camera up", "Tilt camera up"):
        pane.get_by_role("button", name=name).click()
    picture(page, "path-tilted")
    pane.get_by_role("button", name="Look along negative Z and show the whole path").click()
    expect(first).to_be_visible()
