"""Looking back: the time bar leads through past cycles, and every view shows the values of that cycle."""

from __future__ import annotations

import os
import re
import time
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .conftest import Server, new_profile, start_page
from .workbench import (
    add_line,
    answer_to,
    choose_menu,
    log_in,
    objects_stored,
    open_object,
    open_project,
    plc_prg,
    prepare,
    status_bar,
    watch,
)

pytestmark = pytest.mark.e2e
CAPS = "GVL_IO.diCaps"
TIME = "PersistentVars.udiOperatingTime"


def _bar(page: Page) -> Locator:
    return page.get_by_role("region", name="Past Cycles")


def _cycle(page: Page) -> int:
    """The cycle that the bar names."""
    text = _bar(page).get_by_role("status").inner_text()
    found = re.search(r"cycle (\d+)", text)
    assert found is not None, text
    return int(found[1])


def _value(row: Locator) -> Locator:
    return row.get_by_role("gridcell").nth(2)


def _kept(page: Page, cycle: int, expression: str, runtime: str = "local") -> str:
    """The value at the end of a past cycle, as the server reads it for anybody."""
    answer = page.request.post(
        f"{page.url.split('#')[0]}api/v1/runtimes/{runtime}/flight/read",
        headers={"X-Tappet-Client": "1", "Origin": page.url.split("/#")[0]},
        data={"cycle": cycle, "expressions": [expression]},
    )
    assert answer.ok, answer.text()
    return str(answer.json()["values"][0]["literal"])


def test_a_running_machine_is_looked_back_at_and_runs_on(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    row = watch(page, TIME)
    expect(_value(row)).not_to_have_text("")
    page.keyboard.press("Control+Alt+H")
    bar = _bar(page)
    expect(bar.get_by_role("status")).to_contain_text("the last one")
    last = _cycle(page)
    stripe = page.locator("[data-tone=past]").filter(has_text="PLC_PRG").first
    expect(stripe).to_contain_text(f"cycle {last}")

    page.keyboard.press("Control+Alt+ArrowLeft")
    expect(bar.get_by_role("status")).to_contain_text(f"cycle {last - 1}")
    expect(bar.get_by_role("status")).to_contain_text("before the last one")
    expect(stripe).to_contain_text(f"cycle {last - 1}")
    bar.get_by_role("slider").press("Home")
    expect(bar.get_by_role("button", name="First Kept Cycle")).to_be_visible()
    expect(stripe).not_to_contain_text(f"cycle {last - 1}")
    first = _cycle(page)
    assert first < last - 1
    expect(_value(row)).to_contain_text(_kept(page, first, TIME))
    bar.get_by_role("button", name="Last Kept Cycle").click()
    expect(stripe).to_contain_text(f"cycle {last}")
    expect(_value(row)).to_contain_text(_kept(page, last, TIME))

    row.get_by_role("gridcell").nth(3).dblclick()
    expect(page.get_by_text("go back to live values first").first).to_be_visible()
    bar.get_by_role("button", name="Back to Live Values").click()
    expect(bar).to_have_count(0)
    expect(page.locator("[data-tone=past]")).to_have_count(0)
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    expect(_value(row)).not_to_have_text(_kept(page, last, TIME))


def _to_the_fault(page: Page) -> tuple[Locator, Locator]:
    """A machine that fails in the cycle in which 1234 is written; the row of that variable and the bar."""
    editor = plc_prg(page)
    add_line(page, editor, f"iLoaded := DINT_TO_INT(7 / ({CAPS} - 1234));")
    log_in(page)
    row = watch(page, CAPS)
    expect(_value(row)).not_to_contain_text("1234")
    prepare(row, "1234")
    page.keyboard.press("Control+F7")
    expect(status_bar(page).get_by_role("button", name=re.compile("Division by zero"))).to_be_visible()
    bar = _bar(page)
    expect(bar).to_be_visible()
    return watch(page, CAPS), bar


def test_an_exception_opens_the_bar_and_the_cycle_before_is_a_step_away(page: Page) -> None:
    row, bar = _to_the_fault(page)
    expect(_value(row)).to_contain_text("1234")
    page.get_by_role("toolbar").get_by_role("button", name="Step Back One Cycle").click()
    expect(bar.get_by_role("status")).to_contain_text("before the fault")
    shown = _cycle(page)
    expect(_value(row)).to_contain_text(_kept(page, shown, CAPS))
    for _ in range(4):  # the task that fails runs every other cycle
        page.keyboard.press("Control+Alt+ArrowLeft")
    expect(bar.get_by_role("status")).to_contain_text(f"cycle {shown - 4},")
    expect(_value(row)).not_to_contain_text("1234")
    page.keyboard.press("Control+Alt+End")
    expect(bar.get_by_role("status")).to_contain_text("the one of the fault")
    expect(_value(row)).to_contain_text("1234")

    bar.get_by_role("slider").press("Home")
    expect(bar.get_by_role("status")).not_to_contain_text("the one of the fault")
    bar.get_by_role("button", name="To the Fault").click()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()
    expect(_value(row)).to_contain_text("1234")

    bar.get_by_role("slider").press("Home")
    bar.get_by_role("button", name="Play Past Cycles").click()
    expect(bar.get_by_role("button", name="Pause")).to_be_visible()
    expect(bar.get_by_role("status")).to_contain_text("the one of the fault")
    bar.get_by_role("button", name="Back to Live Values").click()
    expect(bar).to_have_count(0)


def test_a_recording_is_kept_looked_into_and_replayed(page: Page, server: Server) -> None:
    _to_the_fault(page)
    with answer_to(page, "/recordings") as answer:
        choose_menu(page, "Debug", "Go Through Past Cycles", "Save Past Cycles")
    assert answer.value.ok, answer.value.text()
    tab = page.locator(".dv-tab").filter(has_text="Recording 20")
    expect(tab).to_be_visible()
    held = page.get_by_role("tabpanel").filter(has_text="Look into It")
    expect(held).to_contain_text("Division by zero · PLC_PRG, line 2")
    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()

    held.get_by_role("button", name="Look into It").click()
    bar = _bar(page)
    expect(bar).to_be_visible()
    row = watch(page, CAPS)  # the call stack came before it
    expect(_value(row)).to_contain_text("1234")
    expect(page.get_by_role("toolbar").get_by_role("button", name="Start")).to_have_attribute(
        "aria-disabled", "true"
    )
    bar.get_by_role("slider").press("Home")
    expect(bar.get_by_role("status")).to_contain_text("before the fault")
    expect(_value(row)).not_to_contain_text("1234")
    row.get_by_role("gridcell").nth(3).dblclick()
    expect(page.get_by_text("A recording is shown").first).to_be_visible()
    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()

    held.get_by_role("button", name="On the Present Program").click()
    expect(held.get_by_role("status")).to_contain_text("Division by zero", timeout=120_000)

    choose_menu(page, "Build", "Run Tests")
    results = page.get_by_role("tree", name="Unit Tests")
    failed = results.get_by_role("treeitem").filter(has_text="division by zero")
    expect(failed).to_contain_text("cycle", timeout=120_000)
    expect(results.get_by_role("treeitem").first).to_contain_text("Flight recordings")
    page.screenshot(path=Path(os.environ.get("TAPPET_PICTURES", server.data)) / "past-tests.png")
    failed.dblclick()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()
    held = page.get_by_role("tabpanel").filter(has_text="Look into It")
    page.locator(".dv-tab").filter(has_text="Recording 20").click()
    held.get_by_role("combobox", name="Passes when").click()
    page.get_by_role("option", name="the recorded fault comes again").click()
    with objects_stored(page):
        page.keyboard.press("Control+S")
    choose_menu(page, "Build", "Run Tests")
    expect(results.get_by_role("treeitem")).to_have_count(2, timeout=120_000)
    expect(page.get_by_role("tabpanel", name="Unit Tests")).to_contain_text("1 passed")


BOTTLE = "GVL_Plant.aBottles[1].lrPosition"
DRAWN_AT = """() => window.__viserMutable?.nodePoseData['/bottle_1']?.position[0] ?? null"""


def _bottle(page: Page, view: str) -> float | None:
    """Where the first bottle is drawn, in mm."""
    found = page.get_by_test_id(view)
    frame = found.element_handle().content_frame() if found.count() else None
    x = frame.evaluate(DRAWN_AT) if frame is not None else None
    return None if x is None else float(x) * 1000.0


def _drawn_as_kept(page: Page, cycle: int, runtime: str = "local") -> None:
    """The view of the past comes to show the bottle where it was in that cycle."""
    kept = float(_kept(page, cycle, BOTTLE, runtime))
    deadline = time.monotonic() + 30.0
    while (x := _bottle(page, "scene-view-past")) is None or abs(x - kept) > 0.01:
        assert time.monotonic() < deadline, f"cycle {cycle}: drawn at {x}, recorded at {kept}"
        page.wait_for_timeout(50)


def test_the_3d_view_shows_the_cycle_too(page: Page, server: Server) -> None:
    open_project(page)
    open_object(page, "Plant3D")
    live = page.get_by_test_id("scene-view")
    expect(page.frame_locator("[data-testid=scene-view]").locator("canvas").first).to_be_visible(
        timeout=30_000
    )
    log_in(page)
    page.keyboard.press("Control+Alt+H")
    bar = _bar(page)
    expect(bar.get_by_role("status")).to_contain_text("the last one")
    expect(page.get_by_test_id("scene-view-past")).to_be_visible(timeout=30_000)
    expect(live).to_be_hidden()
    last = _cycle(page)
    _drawn_as_kept(page, last)
    bar.get_by_role("slider").press("Home")
    expect(bar.get_by_role("status")).not_to_contain_text(f"cycle {last},")
    first = _cycle(page)
    assert abs(float(_kept(page, first, BOTTLE)) - float(_kept(page, last, BOTTLE))) > 1.0, "it has moved"
    _drawn_as_kept(page, first)
    page.keyboard.press("Control+Alt+ArrowRight")
    _drawn_as_kept(page, _cycle(page))
    stripe = page.locator("[data-tone=past]").filter(has_text="Plant3D").first
    expect(stripe).to_contain_text("before the last one")
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    page.screenshot(path=folder / "past-scene.png")

    bar.get_by_role("button", name="Back to Live Values").click()
    expect(live).to_be_visible()
    expect(page.get_by_test_id("scene-view-past")).to_be_hidden()


def test_the_3d_view_of_a_saved_recording(page: Page, server: Server) -> None:
    _to_the_fault(page)
    with answer_to(page, "/recordings") as answer:
        choose_menu(page, "Debug", "Go Through Past Cycles", "Save Past Cycles")
    assert answer.value.ok, answer.value.text()
    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()
    held = page.get_by_role("tabpanel").filter(has_text="Look into It")
    with answer_to(page, "/open") as opened:
        held.get_by_role("button", name="Look into It").click()
    runtime = opened.value.json()["runtime"]["id"]
    bar = _bar(page)
    expect(bar).to_be_visible()
    open_object(page, "Plant3D")
    expect(page.frame_locator("[data-testid=scene-view]").locator("canvas").first).to_be_visible(
        timeout=30_000
    )
    bar.get_by_role("slider").press("Home")
    expect(bar.get_by_role("status")).to_contain_text("before the fault")
    _drawn_as_kept(page, _cycle(page), runtime)
    shown = page.get_by_role("grid", name="Values at the exception")
    expect(shown).to_contain_text(f"In cycle {_cycle(page)}")
    loaded = shown.get_by_role("row").filter(has_text="PLC_PRG.iLoaded").get_by_role("gridcell").nth(2)
    expect(loaded).to_have_text(_kept(page, _cycle(page), "PLC_PRG.iLoaded", runtime))
    expect(page.get_by_text("refused")).to_have_count(0)  # nothing asks a recording for what it has not
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    page.screenshot(path=folder / "past-scene-recording.png")


@pytest.mark.slow
@pytest.mark.parametrize(("theme", "language"), [("dark", "en"), ("light", "zh")])
def test_pictures_of_the_bar(browser: Browser, server: Server, theme: str, language: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    with new_profile(browser, "en", theme) as profile, start_page(profile, server) as page:
        _, bar = _to_the_fault(page)
        page.screenshot(path=folder / f"past-fault-{theme}-{language}.png")
        for _ in range(40):
            page.keyboard.press("Control+Alt+ArrowLeft")
        expect(bar.get_by_role("status")).to_contain_text("before the fault")
        if language == "zh":
            page.get_by_role("banner").get_by_role("button").last.click()
            page.get_by_role("menuitem", name="Language").press("ArrowRight")
            page.get_by_role("menuitemcheckbox", name="简体中文").press("Enter")
            expect(page.get_by_role("button", name="返回实时值")).to_be_visible()
        page.screenshot(path=folder / f"past-{theme}-{language}.png")
