"""The cam editor: graphs, tables, tappets, texts and preview of the same cam."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import objects_stored, open_new_object

pytestmark = pytest.mark.e2e

PROJECT = "Cam machine"


@dataclass
class CamPage:
    """A project with the default cam, which is open."""

    page: Page
    server: Server
    path: str
    cam_id: str

    @property
    def editor(self) -> Locator:
        return self.page.locator(".dv-active-group [data-panel-id]:visible").last

    def tab(self, name: str) -> None:
        self.editor.get_by_role("tab", name=name, exact=True).click()

    def graph(self, name: str) -> Locator:
        return self.editor.locator(f"[data-graph={name}]")

    def point(self, graph: str, index: int) -> Locator:
        return self.graph(graph).locator(f"[data-point='{index}']")

    def centre(self, place: Locator) -> tuple[float, float]:
        box = place.bounding_box()
        assert box is not None
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def stored(self) -> dict[str, Any]:
        return dict(fetch(self.page, self.server, "GET", f"{self.path}/objects/{self.cam_id}")["data"])

    def expect_points(self, count: int) -> None:
        expect(self.graph("y").locator("[data-point]")).to_have_count(count)

    def cell(self, row: int, column: int) -> Locator:
        return self.editor.get_by_role("row").nth(row + 1).get_by_role("gridcell").nth(column)


@pytest.fixture
def cam(page: Page, server: Server) -> CamPage:
    path, cam_id = open_new_object(page, server, PROJECT, "cam", "Cam")
    found = CamPage(page, server, path, cam_id)
    expect(found.graph("y").locator("path[data-curve]")).to_have_count(3)
    return found


def test_a_point_is_dragged_shown_in_the_table_and_undone(cam: CamPage) -> None:
    page = cam.page
    x, y = cam.centre(cam.point("y", 1))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y - 25, steps=4)
    expect(cam.graph("y").get_by_text(re.compile(r"^X 1[2-9]\d"))).to_be_visible()
    with objects_stored(page):
        page.mouse.up()
    moved = cam.stored()["points"][1]
    assert moved["x"] > 120
    assert moved["y"] > 120
    assert moved["x"] == round(moved["x"]), "it snaps"
    assert cam.stored()["points"][0]["y"] == 0

    cam.tab("Cam table")
    expect(cam.cell(2, 2)).to_have_text(f"{moved['x']:g}")
    expect(cam.cell(2, 3)).to_have_text(f"{moved['y']:g}")
    page.keyboard.press("Control+z")
    expect(cam.cell(2, 2)).to_have_text("120")
    expect(cam.cell(2, 3)).to_have_text("120")
    page.keyboard.press("Control+y")
    expect(cam.cell(2, 2)).to_have_text(f"{moved['x']:g}")


def test_escape_gives_up_a_drag(cam: CamPage) -> None:
    page = cam.page
    x, y = cam.centre(cam.point("v", 1))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 20, steps=4)
    page.keyboard.press("Escape")
    page.mouse.up()
    cam.tab("Cam table")
    expect(cam.cell(2, 4)).to_have_text("1")


def test_points_are_inserted_with_the_values_of_the_curve_and_deleted(cam: CamPage) -> None:
    """cam EX-03."""
    page = cam.page
    cam.tab("Cam table")
    expect(cam.cell(1, 10)).to_have_text("1.512")
    cam.cell(1, 0).get_by_role("button").click()
    for column, value in ((2, "60"), (3, "41.25"), (4, "1.4375"), (5, "0.0125"), (6, "-0.0010417")):
        expect(cam.cell(2, column)).to_have_text(value)
    cam.tab("Cam")
    cam.expect_points(5)
    cam.graph("y").focus()
    page.keyboard.press("Delete")
    cam.expect_points(4)
    cam.tab("Cam table")
    expect(cam.cell(1, 10)).to_have_text("1.512")


def test_a_click_with_the_tool_inserts_a_point(cam: CamPage) -> None:
    page = cam.page
    cam.editor.get_by_role("button", name="Add point").click()
    box = cam.graph("v").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    cam.expect_points(5)
    page.keyboard.press("Escape")
    expect(cam.editor.get_by_role("button", name="Select", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )


def test_the_keyboard_chooses_and_moves(cam: CamPage) -> None:
    page = cam.page
    cam.graph("y").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    panel = cam.editor.get_by_label("Element properties")
    expect(panel).to_contain_text("Point 2")
    with objects_stored(page):
        page.keyboard.press("Control+ArrowUp")
    raised = cam.stored()["points"][1]["y"]
    assert raised > 120
    with objects_stored(page):
        page.keyboard.press("Control+ArrowRight")
    assert cam.stored()["points"][1]["x"] > 120
    assert cam.stored()["points"][1]["y"] == raised


def test_cells_take_what_fits_and_say_what_does_not(cam: CamPage) -> None:
    """CAM-44, CAM-47 and cam EX-05."""
    page = cam.page
    cam.tab("Cam table")
    cam.cell(2, 2).dblclick()
    page.keyboard.type("400")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert").filter(has_text="X must lie between 0 and 240")).to_be_visible()
    page.keyboard.press("Escape")
    expect(cam.cell(2, 2)).to_have_text("120")
    cam.cell(2, 3).click()
    page.keyboard.type("130")
    page.keyboard.press("Enter")
    expect(cam.cell(2, 3)).to_have_text("130")
    page.keyboard.press("Control+z")
    expect(cam.cell(2, 3)).to_have_text("120")

    cam.cell(3, 7).dblclick()
    cam.cell(3, 7).get_by_role("combobox").click()
    page.get_by_role("option", name="Straight line").click()
    expect(cam.cell(3, 7)).to_have_text("Straight line")
    for column, value in ((8, "120"), (9, "240"), (10, "1"), (11, "0")):
        expect(cam.cell(3, column)).to_have_text(value)


def test_a_jump_is_told_and_leads_to_its_place(cam: CamPage) -> None:
    cam.tab("Cam table")
    for row in (1, 3):
        cam.cell(row, 7).dblclick()
        cam.cell(row, 7).get_by_role("combobox").click()
        cam.page.get_by_role("option", name="Straight line").click()
    cam.cell(2, 3).click()
    cam.page.keyboard.type("100")
    cam.page.keyboard.press("Enter")
    finding = cam.editor.get_by_role("button", name=re.compile("The velocity jumps .* at X = 120"))
    expect(finding).to_be_visible()
    finding.click()
    expect(cam.editor.get_by_role("row", selected=True)).to_contain_text("Point 2")


def test_the_border_of_two_graphs_is_dragged(cam: CamPage) -> None:
    """CAM-31: one becomes higher by what the other loses; the keyboard moves it too."""
    page = cam.page
    border = cam.editor.get_by_role("separator", name="Border between Position and Velocity")

    def heights() -> list[float]:
        boxes = [cam.graph(name).bounding_box() for name in ("y", "v", "a", "j")]
        return [box["height"] for box in boxes if box is not None]

    before = heights()
    x, y = cam.centre(border)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 40, steps=5)
    page.mouse.up()
    page.mouse.move(x, y + 90)
    after = heights()
    assert after[0] - before[0] == pytest.approx(40, abs=4)
    assert before[1] - after[1] == pytest.approx(40, abs=4)
    assert after[2:] == pytest.approx(before[2:], abs=1)
    border.focus()
    page.keyboard.press("ArrowUp")
    assert heights()[0] < after[0]
    border.dblclick()
    assert heights() == pytest.approx(before, abs=1)


def test_a_chosen_property_is_described(cam: CamPage) -> None:
    """CAM-62: by a click or the keyboard, also one that is only shown; its row is marked, and no other."""
    page = cam.page
    cam.point("y", 1).click()
    panel = cam.editor.get_by_label("Element properties")
    panel.get_by_label("Y", exact=True).click()
    description = panel.get_by_text("Position of the slave there")
    expect(description).to_be_visible()
    chosen = panel.locator("[data-chosen]")
    expect(chosen).to_have_count(1)
    expect(chosen).to_contain_text("Y")
    frame = chosen.evaluate("row => getComputedStyle(row).outlineStyle")
    assert frame == "solid"
    page.keyboard.press("Tab")
    expect(panel.get_by_text("Velocity of the slave by that of the master")).to_be_visible()
    expect(description).to_have_count(0)
    panel.get_by_text("J", exact=True).click()
    expect(panel.get_by_text("J follows from the curve")).to_be_visible()
    expect(chosen).to_have_count(1)


def test_tools_belong_to_their_view_and_the_jerk_is_only_shown(cam: CamPage) -> None:
    """cam CAM-20 to CAM-23, CAM-14, CAM-15."""
    page = cam.page
    expect(cam.editor.get_by_role("button", name="Add point")).to_be_visible()
    cam.editor.get_by_role("button", name="Add point").click()
    box = cam.graph("j").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    cam.expect_points(4)
    expect(cam.graph("j").locator("[data-point]")).to_have_count(0)
    page.keyboard.press("Escape")
    cam.point("y", 1).click()
    expect(cam.point("y", 1)).to_have_attribute("data-selected", "true")
    cam.graph("y").locator("path[data-curve]").nth(2).click(position={"x": 40, "y": 4}, force=True)
    for name in ("Cam", "Cam table", "Tappets", "Tappet table"):
        expect(cam.editor.get_by_role("tab", name=name, exact=True)).to_be_visible()
    cam.tab("Tappets")
    expect(cam.editor.get_by_role("button", name="Add point")).to_have_count(0)
    expect(cam.editor.get_by_role("button", name="Add tappet")).to_be_visible()
    cam.tab("Cam table")
    for tool in ("Add point", "Add tappet"):
        expect(cam.editor.get_by_role("button", name=tool)).to_have_count(0)


def test_graphs_are_closed_opened_zoomed_and_fitted(cam: CamPage) -> None:
    page = cam.page
    cam.graph("j").get_by_role("button", name="Close the graph: Jerk").click()
    expect(cam.graph("j")).to_have_count(0)
    cam.editor.get_by_role("button", name="Jerk", exact=True).click()
    expect(cam.graph("j")).to_be_visible()
    page.mouse.move(*cam.centre(cam.point("y", 1)))
    page.mouse.wheel(0, -600)
    expect(cam.point("y", 3)).to_have_count(0)
    fit = cam.editor.get_by_role("button", name="Show the whole range of the master")
    fit.click()
    expect(cam.point("y", 3)).to_have_count(1)


def test_tappets_are_added_moved_switched_and_deleted(cam: CamPage) -> None:
    page = cam.page
    cam.tab("Tappets")
    track = cam.editor.get_by_role("application", name=re.compile("^Track 2"))
    signs = track.locator("[data-positive]")
    cam.editor.get_by_role("button", name="Add tappet").click()
    x, y = cam.centre(track)
    with objects_stored(page):
        page.mouse.click(x, y)
    expect(signs).to_have_count(1)
    placed = cam.stored()["tracks"][1]["tappets"][0]
    assert (placed["positive"], placed["negative"]) == ("on", "off")

    centre_x, centre_y = cam.centre(signs.locator("circle"))
    page.mouse.move(centre_x, centre_y)
    page.mouse.down()
    page.mouse.move(centre_x + 60, centre_y, steps=3)
    with objects_stored(page):
        page.mouse.up()
    moved = cam.stored()["tracks"][1]["tappets"][0]["x"]
    assert moved > placed["x"]

    centre_x, centre_y = cam.centre(signs.locator("circle"))
    page.mouse.click(centre_x - 14, centre_y)
    expect(signs.first).to_have_attribute("data-positive", "off")
    page.mouse.click(centre_x + 14, centre_y)
    expect(signs.first).to_have_attribute("data-negative", "invert")

    cam.tab("Tappet table")
    expect(cam.cell(4, 2)).to_have_text(f"{moved:g}")
    expect(cam.cell(4, 3)).to_have_text("switch OFF")
    cam.cell(4, 2).click()
    page.keyboard.type("999")
    page.keyboard.press("Enter")
    refusal = page.get_by_role("alert").filter(has_text="X must lie in the range of the master, 0 to 360")
    expect(refusal).to_be_visible()
    page.keyboard.press("Escape")
    cam.cell(4, 0).get_by_role("button", name="Delete tappet").click()
    expect(cam.editor.get_by_role("row")).to_have_count(1 + 4)


def test_tappets_stay_in_the_range_and_are_added_at_the_start(cam: CamPage) -> None:
    """CAM-52, CAM-56: a drag ends where the master does; Del deletes; the table adds at 0, ON and OFF."""
    page = cam.page
    cam.tab("Tappets")
    signs = cam.editor.get_by_role("application", name=re.compile("^Track 1")).locator("[data-positive]")
    x, y = cam.centre(signs.nth(1).locator("circle"))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 900, y, steps=4)
    with objects_stored(page):
        page.mouse.up()
    assert [tappet["x"] for tappet in cam.stored()["tracks"][0]["tappets"]] == [90, 360]
    signs.nth(1).locator("circle").click()
    with objects_stored(page):
        page.keyboard.press("Delete")
    assert [tappet["x"] for tappet in cam.stored()["tracks"][0]["tappets"]] == [90]
    cam.tab("Tappet table")
    with objects_stored(page):
        cam.cell(0, 0).get_by_role("button", name="Add tappet").click()
    assert cam.stored()["tracks"][0]["tappets"][0] == {"x": 0, "positive": "on", "negative": "off"}


def test_a_text_replaces_the_points_and_one_that_is_none_does_not(cam: CamPage) -> None:
    page = cam.page
    cam.editor.get_by_role("button", name="Cam", exact=True).click()
    page.get_by_role("menuitem", name="Read Points from a Text").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("textbox").fill("0 0\n100 abc\n")
    dialog.get_by_role("button", name="Replace points").click()
    expect(dialog.get_by_role("alert")).to_contain_text("2")
    cam.expect_points(4)
    dialog.get_by_role("textbox").fill("0 0\n100 50\n200 80\n")
    dialog.get_by_role("button", name="Replace points").click()
    expect(dialog).to_have_count(0)
    cam.expect_points(3)
    page.keyboard.press("Control+z")
    cam.expect_points(4)


def test_a_cam_is_written_as_ascii_table(cam: CamPage) -> None:
    """cam EX-08."""
    page = cam.page
    cam.editor.get_by_role("button", name="Cam", exact=True).click()
    page.get_by_role("menuitem", name="Write Points to a File").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Number of points").fill("7")
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save file").click()
    lines = Path(download.value.path()).read_text().splitlines()
    numbers = [float(number) for line in lines for number in line.split()]
    assert numbers == pytest.approx([0, 0, 60, 41.25, 120, 120, 180, 180, 240, 240, 300, 318.75, 360, 360])
    assert download.value.suggested_filename == "Cam.txt"


def test_the_generated_code_is_shown(cam: CamPage) -> None:
    page = cam.page
    cam.editor.get_by_role("button", name="Cam", exact=True).click()
    page.get_by_role("menuitem", name="Show Generated Code").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("MC_CAM_REF")
    expect(dialog).to_contain_text("Cam_A")


def test_a_smaller_range_asks_before_it_removes(cam: CamPage) -> None:
    """CAM-71, CAM-72."""
    page = cam.page
    cam.tab("Properties")
    end = cam.editor.get_by_label("Master end")
    end.fill("200")
    end.press("Enter")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("points: 1, tappets: 1")
    with objects_stored(page):
        dialog.get_by_role("button", name="Remove them").click()
    assert [point["x"] for point in cam.stored()["points"]] == [0, 120, 200]
    end.fill("-5")
    end.press("Enter")
    expect(cam.editor.get_by_role("alert")).to_have_text("The end must lie above the start")
    expect(end).to_have_value("200")
    with objects_stored(page):
        cam.editor.get_by_label("Smooth to the next cycle").click()
    assert cam.stored()["points"][-1]["y"] == 360


def test_the_preview_draws_the_limits_of_an_axis(cam: CamPage) -> None:
    """By the chain rule of cam.md section 1: 1.512 times the velocity of the master."""
    page = cam.page
    objects = fetch(page, cam.server, "GET", f"{cam.path}/objects")
    application = next(item for item in objects if item["kind"] == "application")
    pool = fetch(
        page, cam.server, "POST", f"{cam.path}/objects",
        data={"kind": "axis_pool", "parent_id": application["id"]},
    )  # fmt: skip
    fetch(
        page, cam.server, "POST", f"{cam.path}/objects",
        data={"kind": "axis", "name": "Slave", "parent_id": pool["id"], "subkind": "SM_Drive_Virtual"},
    )  # fmt: skip
    cam.tab("Preview")
    speed = cam.editor.get_by_label("Master velocity")
    speed.fill("50")
    speed.press("Enter")
    expect(cam.editor.get_by_role("row", name=re.compile("^Velocity"))).to_contain_text("75.6 u/s")
    cam.editor.get_by_role("combobox").click()
    page.get_by_role("option", name="Slave").click()
    expect(cam.editor.locator("[data-limit=upper]")).not_to_have_count(0)
    # The least of 100 / 1.512, sqrt(100 / 0.0328353) and cbrt(1e5 / 0.0025): the acceleration.
    expect(cam.editor.get_by_role("status")).to_contain_text("55.186")
    speed.fill("60")
    speed.press("Enter")
    expect(cam.editor.get_by_role("row", name=re.compile("^Acceleration"))).to_have_attribute(
        "data-beyond", "true"
    )


def test_points_are_optimised_shown_and_taken(cam: CamPage) -> None:
    page = cam.page
    cam.editor.get_by_role("button", name="Cam", exact=True).click()
    page.get_by_role("menuitem", name="Optimise Points").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Make least").click()
    page.get_by_role("option", name="Jerk").click()
    dialog.get_by_role("button", name="Optimise", exact=True).click()
    expect(dialog.get_by_role("status")).to_contain_text("0.0025 before")
    expect(dialog.get_by_role("img", name="The curve before")).to_be_visible()
    with objects_stored(page):
        dialog.get_by_role("button", name="Take").click()
    points = cam.stored()["points"]
    assert [point["x"] for point in points] == [0, 120, 240, 360]
    assert points[1]["y"] < 120
    page.keyboard.press("Control+z")
    cam.tab("Cam table")
    expect(cam.cell(2, 3)).to_have_text("120")
