"""A cam of a thousand points is shown, chosen from and changed as a small one."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, ViewportSize, expect

from .api import change, fetch, stored
from .conftest import Server, new_profile, start_page
from .workbench import objects_stored, open_object, open_project

pytestmark = [pytest.mark.e2e, pytest.mark.slow]

PROJECT = "Large cam"
CAM = "A_Cam_Of_Many_Points"
COUNT = 1_000
SIZES: dict[str, ViewportSize] = {
    "small": {"width": 1280, "height": 800},
    "large": {"width": 2560, "height": 1440},
}


def _stored_cam(page: Page, server: Server) -> str:
    """A project with a rising cam of many points, by a law and its derivatives."""
    made = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    path = f"/projects/{made['id']}"
    objects = fetch(page, server, "GET", f"{path}/objects")
    application = next(item for item in objects if item["kind"] == "application")
    cam = {"kind": "cam", "name": CAM, "parent_id": application["id"]}
    fetch(page, server, "POST", f"{path}/objects", data=cam)
    turn = 2 * math.pi / 360
    places = [360 * index / (COUNT - 1) for index in range(COUNT)]
    points = [
        {
            "x": x,
            "y": x - math.sin(x * turn) / turn,
            "v": 1 - math.cos(x * turn),
            "a": turn * math.sin(x * turn),
        }
        for x in places
    ]
    change(page, server, path, CAM, points=points, segments=[{"law": "poly5"}] * (COUNT - 1))
    return path


def _points(page: Page, server: Server, path: str) -> list[dict[str, Any]]:
    return list(stored(page, server, path, CAM)["data"]["points"])


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize(("theme", "language"), [("light", "en"), ("dark", "zh")])
def test_a_thousand_points(browser: Browser, server: Server, size: str, theme: str, language: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        page.set_viewport_size(SIZES[size])
        path = _stored_cam(page, server)
        page.reload()
        open_project(page, PROJECT)
        open_object(page, CAM)
        editor = page.locator(".dv-active-group [data-panel-id]:visible").last

        def graph(name: str) -> Locator:
            return editor.locator(f"[data-graph={name}]")

        expect(graph("y").locator("path[data-curve]")).not_to_have_count(0)
        page.screenshot(path=folder / f"cam-{COUNT}-{size}-{theme}.png")
        graph("y").focus()
        page.keyboard.press("Home")
        for _ in range(3):
            page.keyboard.press("ArrowRight")
        before = _points(page, server, path)
        with objects_stored(page):
            page.keyboard.press("Control+ArrowUp")
        after = _points(page, server, path)
        changed = [index for index in range(COUNT) if before[index] != after[index]]
        assert len(changed) == 1
        assert after[changed[0]]["y"] > before[changed[0]]["y"]
        page.wait_for_timeout(1_500)  # for the picture: the curves of the changed cam
        page.screenshot(path=folder / f"cam-{COUNT}-changed-{size}-{theme}.png")
        editor.get_by_role("tab").nth(1).click()
        expect(editor.get_by_role("row").nth(1)).to_be_visible()
        assert editor.get_by_role("row").count() < 200, "rows out of sight are not drawn"
        page.screenshot(path=folder / f"cam-{COUNT}-table-{size}-{theme}.png")
        with objects_stored(page):
            page.keyboard.press("Control+z")
        assert _points(page, server, path) == before
