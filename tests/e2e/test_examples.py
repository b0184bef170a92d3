"""Examples begin from the start page: their machine moves in 3D a moment later."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .conftest import Server
from .workbench import log_in, open_object, tree_item

pytestmark = pytest.mark.e2e

MACHINES = {
    "flying_shear": ("Flying shear", "Machine3D"),
    "gantry": ("Gantry", "Machine3D"),
    "pick_and_place": ("Pick and place", "Machine3D"),
    "rotary_knife": ("Rotary knife", "Machine3D"),
    "winder": ("Winder", "Machine3D"),
}


def _begin(page: Page, title: str) -> None:
    page.get_by_role("button", name="New project").first.click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("radio", name=f"Example: {title}").click()
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


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(MACHINES))
def test_machines_move_in_3d(page: Page, server: Server, name: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    title, scene = MACHINES[name]
    _begin(page, title)
    log_in(page)
    open_object(page, scene)
    frame = page.frame_locator("[data-testid=scene-view]")
    expect(frame.locator("canvas").first).to_be_visible()
    remark = frame.locator(".mantine-Notification-closeButton")
    if remark.count():  # without a graphics card the 3D library says that it is slow
        remark.first.click()
    page.wait_for_timeout(15_000)
    page.screenshot(path=folder / f"example-{name}.png", timeout=60_000)
