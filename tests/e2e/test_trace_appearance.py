"""How a trace looks: commands of its menu, settings of axes and curves, and what is drawn of them."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, expect

from .api import change
from .conftest import Server
from .test_trace_editor import FILLED, TracePage, opened, record
from .workbench import objects_stored

pytestmark = pytest.mark.e2e

CURVE = "#ff00ff"
GRID = "#00c800"
LEVEL = {"variable": "80.0 + 0 * GVL_Line.lrRate", "name": "Level", "color": CURVE}
"""A curve at 80."""
FIXED = {
    "x": {"mode": "fixed", "minimum": "T#0s", "maximum": "T#10s", "major": "T#2s", "description": "time"},
    "y": {"mode": "fixed", "minimum": 0.0, "maximum": 100.0, "major": 50.0, "description": "level"},
}
KEEP = """() => {
    const canvas = document.querySelector('figure[data-diagram] canvas');
    window.keptPicture = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
}"""
CHANGED = """() => {
    const canvas = document.querySelector('figure[data-diagram] canvas');
    const { width, height } = canvas;
    const now = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    const before = window.keptPicture.data;
    let [left, top, right, bottom] = [width, height, -1, -1];
    for (let k = 0; k < now.length; k += 4)
        if ([0, 1, 2, 3].some((n) => now[k + n] !== before[k + n])) {
            const [x, y] = [(k / 4) % width, Math.floor(k / 4 / width)];
            [left, top] = [Math.min(left, x), Math.min(top, y)];
            [right, bottom] = [Math.max(right, x), Math.max(bottom, y)];
        }
    return right < 0 ? null : [left / width, top / height, right / width, bottom / height];
}"""
COLORED = """(color) => {
    const wanted = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
    const canvas = document.querySelector('figure[data-diagram] canvas');
    const { width, height } = canvas;
    const data = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    let [count, x, y] = [0, 0, 0];
    for (let k = 0; k < data.length; k += 4)
        if (data[k + 3] > 60 && wanted.every((value, n) => Math.abs(data[k + n] - value) < 60)) {
            count += 1;
            x += (k / 4) % width;
            y += Math.floor(k / 4 / width);
        }
    return { count, x: x / count / width, y: y / count / height };
}"""


class Drawn(TracePage):
    """A stopped trace, whose appearance somebody changes."""

    def look(self, **settings: Any) -> None:
        """The appearance: that of before with these settings of its axes, or of itself."""
        (one,) = self.stored()["records"]
        appearance = one["appearance"]
        for name, value in settings.items():
            appearance[name] = appearance[name] | value if name in ("x", "y") else value
        name = "Trace"
        change(self.page, self.server, self.path, name, records=[one | {"appearance": appearance}])

    def where(self, **settings: Any) -> tuple[float, float, float, float]:
        """The part of the diagram that some settings change: left, top, right, bottom of 0 to 1."""
        self.page.evaluate(KEEP)
        self.look(**settings)
        self.page.wait_for_function(f"() => ({CHANGED})() !== null", timeout=30_000)
        left, top, right, bottom = self.page.evaluate(CHANGED)
        return left, top, right, bottom

    def pixels(self, color: str) -> dict[str, float]:
        return dict(self.page.evaluate(COLORED, color))

    def until(self, color: str, condition: str) -> None:
        """`condition` holds for the pixels of a colour: `one.count`, and their middle `one.x`, `one.y`."""
        script = f"(color) => {{ const one = ({COLORED})(color); return {condition}; }}"
        self.page.wait_for_function(script, arg=color, timeout=30_000)


@pytest.fixture
def drawn(page: Page, server: Server) -> Drawn:
    found = opened(page, server, record(buffer=200, channels=[LEVEL], appearance=FIXED), refresh_rate=100)
    trace = Drawn(found.page, found.server, found.path, found.trace_id)
    trace.download()
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("200 / 200")
    trace.tool("Stop Trace").click()
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("stopped")
    trace.until(CURVE, "one.count > 20")
    while True:  # until the last samples are there
        page.evaluate(KEEP)
        page.wait_for_timeout(500)
        if page.evaluate(CHANGED) is None:
            return trace


def test_ticks_arrows_and_texts_of_the_axes_are_drawn_at_their_places(drawn: Drawn) -> None:
    """TRC-53, TRC-54, TRC-56, TRC-58, TRC-60."""
    left, _, right, _ = drawn.where(y={"minor": 10.0})
    assert right < 0.15, "short ticks of the values stand at their axis"
    left, top, right, _ = drawn.where(x={"minor": "T#500ms"})
    assert top > 0.7, "short ticks of the time stand at their axis"
    assert right - left > 0.6
    left, top, right, bottom = drawn.where(y={"major": 25.0})
    assert right - left > 0.6, "the grid goes on with the long ticks"
    assert bottom - top > 0.3
    left, top, right, bottom = drawn.where(x={"arrow": "open"})
    assert left > 0.8
    assert bottom - top < 0.1
    left, top, right, bottom = drawn.where(y={"arrow": "filled"})
    assert right < 0.15
    assert bottom < 0.3
    drawn.look(x={"description": "since the start"}, y={"description": "filling level"})
    figure = drawn.diagrams.first.bounding_box()
    level, time = (
        drawn.editor.get_by_text(text, exact=True).bounding_box()
        for text in ("filling level", "since the start")
    )
    assert figure
    assert level
    assert time
    assert level["x"] < figure["x"] + 0.2 * figure["width"], "above the axis of the values"
    assert level["y"] < figure["y"] + 0.2 * figure["height"]
    assert time["x"] + time["width"] > figure["x"] + 0.9 * figure["width"], (
        "at the end of the axis of the time"
    )
    assert time["y"] > figure["y"] + 0.6 * figure["height"]
    left, top, right, bottom = drawn.where(font_size=18)
    assert left < 0.1
    assert bottom > 0.9


def test_axes_are_turned_and_moved_and_the_grid_has_its_color(drawn: Drawn) -> None:
    """TRC-55, TRC-57, TRC-59, TRC-60."""
    before = drawn.pixels(CURVE)
    assert before["y"] < 0.35
    assert before["x"] < 0.5
    drawn.look(y={"reverse": True})
    drawn.until(CURVE, "one.y > 0.55")
    drawn.look(x={"reverse": True})
    drawn.until(CURVE, "one.x > 0.5")
    drawn.look(x={"reverse": False}, y={"reverse": False})
    drawn.until(CURVE, "one.x < 0.5 && one.y < 0.35")
    drawn.look(x={"grid_color": GRID}, y={"grid_color": GRID})
    drawn.until(GRID, "one.count > 200")
    drawn.look(x={"grid": False}, y={"grid": False})
    drawn.until(GRID, "one.count === 0")
    left, top, _, bottom = drawn.where(x={"position": "middle"})
    assert top < 0.55 < bottom
    left, _, right, _ = drawn.where(y={"position": "high"})
    assert left < 0.1
    assert right > 0.9
    drawn.look(background="#203040", selected_background="#405060")
    (one,) = drawn.stored()["records"]
    change(drawn.page, drawn.server, drawn.path, "Trace", records=[one, one | {"name": "Record2"}])
    expect(drawn.diagrams).to_have_count(2)
    for chosen, other in ((0, 1), (1, 0)):
        drawn.diagrams.nth(chosen).locator(".u-over").click()
        expect(drawn.diagrams.nth(chosen)).to_have_css("background-color", "rgb(64, 80, 96)")
        expect(drawn.diagrams.nth(other)).to_have_css("background-color", "rgb(32, 48, 64)")


def test_the_appearance_is_set_reset_and_used_for_new_records(page: Page, server: Server) -> None:
    """TRC-06, TRC-13, TRC-31, TRC-41, TRC-47."""
    trace = opened(page, server)
    trace.editor.get_by_role("button", name="Trace", exact=True).click()
    entry = page.get_by_role("menuitem", name="Appearance…")
    expect(entry).to_have_attribute("aria-disabled", "true")
    page.keyboard.press("Escape")
    change(page, server, trace.path, "Trace", records=[record(channels=[LEVEL | {"color": ""}])])
    expect(trace.tree.get_by_role("treeitem")).to_have_count(2)
    trace.tree.get_by_role("treeitem").first.click()
    trace.choose("Appearance…")
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Font size").fill("20")
    dialog.get_by_role("button", name="Use as Default").click()
    dialog.get_by_role("button", name="Reset Appearance").click()
    expect(dialog.get_by_label("Font size")).to_have_value("12")
    dialog.get_by_role("button", name="Record", exact=True).click()
    expect(dialog.get_by_label("Font size")).to_have_value("20")
    dialog.get_by_role("treeitem", name="Level").click()
    automatic = dialog.get_by_role("checkbox", name="Automatic").first
    expect(automatic).to_be_checked()
    automatic.uncheck()
    dialog.get_by_label("Graph color").first.fill("#ff8800")
    dialog.get_by_label("Major tick").fill("5")
    with objects_stored(page):
        dialog.get_by_role("button", name="Apply").click()
    first, second = trace.stored()["records"]
    assert (first["appearance"]["font_size"], second["appearance"]["font_size"]) == (12, 20)
    assert (first["channels"][0]["color"], first["channels"][0]["appearance"]["major"]) == ("#ff8800", 5.0)


def test_all_commands_are_in_the_menu_and_the_configuration_opens_online(page: Page, server: Server) -> None:
    """TRC-05, TRC-73."""
    trace = opened(page, server, record(FILLED, buffer=100))
    trace.download()
    trace.editor.get_by_role("button", name="Trace", exact=True).click()
    entries = page.get_by_role("menu").last.locator("[role^=menuitem]")
    shown = [text.split("\n")[0].strip() for text in entries.all_inner_texts()]
    for name in (
        "Add Variable…", "Appearance…", "Configuration…", "Start Trace", "Stop Trace", "Reset Trigger",
        "Download Trace", "Online List…", "Upload Trace", "Save Trace…", "Load Trace…", "Mouse Scroll",
        "Mouse Zoom", "Reset View", "Compress", "Stretch", "Multi-Channel",
    ):  # fmt: skip
        assert name in shown, shown
    page.keyboard.press("Escape")
    trace.tree.get_by_role("treeitem").nth(1).dblclick()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("treeitem").first.click()
    dialog.get_by_label("Buffer size").fill("300")
    with objects_stored(page):
        dialog.get_by_role("button", name="Apply").click()
    assert trace.stored()["records"][0]["buffer"] == 300
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("Record1")
    trace.editor.get_by_role("button", name="Download Trace").last.click()
    expect(trace.editor.get_by_role("status", name="State")).to_contain_text("/ 300")
