"""Examples begin from the start page: their machine moves in 3D a moment later."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .conftest import Server, new_profile, start_page
from .workbench import log_in, open_object, status_bar, tree_item

pytestmark = pytest.mark.e2e

MACHINES = {
    "flying_shear": ("Flying shear", "Machine3D"),
    "gantry": ("Gantry", "Machine3D"),
    "pick_and_place": ("Pick and place", "Machine3D"),
    "rotary_knife": ("Rotary knife", "Machine3D"),
    "router": ("Router", "Machine3D"),
    "winder": ("Winder", "Machine3D"),
}


def _begin(page: Page, title: str) -> None:
    page.get_by_role("navigation", name="Start").get_by_role("button", name=title).click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("radio", name=f"Example: {title}")).to_be_checked()
    expect(dialog.get_by_role("radio", name=f"Example: {title}")).to_be_in_viewport()
    expect(dialog.get_by_role("textbox").first).to_have_value(title)
    dialog.locator("button[type=submit]").click()
    expect(dialog).to_have_count(0)
    expect(tree_item(page, "Application")).to_be_visible()


def test_an_example_begins_from_the_start_page_and_runs(page: Page) -> None:
    _begin(page, "Flying shear")
    log_in(page)
    open_object(page, "GVL_Shear")
    row = page.locator("[data-testid=online-declaration], .dv-view, main").first
    expect(row).to_contain_text("udiPieces")


def test_the_trace_of_an_example_is_downloaded_and_shows_a_cut(browser: Browser, server: Server) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    with new_profile(browser, "en", "dark") as profile, start_page(profile, server) as page:
        _begin(page, "Flying shear")
        log_in(page)
        open_object(page, "CutTrace")
        page.get_by_role("button", name="Download Trace").last.click()
        expect(page.get_by_role("status", name="State")).to_contain_text("done", timeout=60_000)
        page.wait_for_timeout(1_000)
        page.screenshot(path=folder / "example-trace.png")


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", sorted(MACHINES))
def test_machines_move_in_3d(browser: Browser, server: Server, name: str, theme: str) -> None:
    """The picture changes while the machine runs, and stands still when it is stopped."""
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    title, scene = MACHINES[name]
    with new_profile(browser, "en", theme) as profile, start_page(profile, server) as page:
        _begin(page, title)
        log_in(page)
        open_object(page, scene)
        frame = page.frame_locator("[data-testid=scene-view]")
        canvas = frame.locator("canvas").first
        expect(canvas).to_be_visible()
        remark = frame.locator(".mantine-Notification-closeButton")
        if remark.count():  # without a graphics card the 3D library says that it is slow
            remark.first.click()
        page.wait_for_timeout(15_000)
        for _ in range(5):  # it may stand for a while: a tool is changed, a plate is laid on the table
            moving = _pictures(page, canvas)
            if len(set(moving)) == len(moving):
                break
        assert len(set(moving)) == len(moving)
        suffix = "" if theme == "light" else "-dark"
        page.screenshot(path=folder / f"example-{name}{suffix}.png", timeout=60_000)
        page.keyboard.press("Shift+F8")
        expect(status_bar(page)).to_contain_text("stopped")
        page.wait_for_timeout(5_000)
        assert len(set(_pictures(page, canvas))) == 1


def _pictures(page: Page, canvas: Locator) -> list[bytes]:
    """Three pictures of a scene, a while apart."""
    pictures = []
    for _ in range(3):
        page.wait_for_timeout(1_300)
        pictures.append(canvas.screenshot(timeout=60_000))
    return pictures
