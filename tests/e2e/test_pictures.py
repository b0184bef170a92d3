"""The workbench in both themes and languages opens without a console error, and has its picture taken.

`make pictures` puts the pictures into docs/images; otherwise they go to the server's temporary folder.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from playwright.sync_api import Browser, ConsoleMessage, expect

from .conftest import Server, new_profile, start_page
from .workbench import implementation, log_in, open_object, open_project

pytestmark = [pytest.mark.e2e, pytest.mark.slow]

HARMLESS = ("THREE.", "GPU stall", "GL Driver")
"""Remarks of the 3D library and of a browser without a graphics card."""


@pytest.mark.parametrize(
    ("theme", "language"), [("dark", "en"), ("light", "en"), ("dark", "zh"), ("light", "zh")]
)
def test_workbench_and_plant(browser: Browser, server: Server, theme: str, language: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    suffix = theme if language == "en" else f"{theme}-{language}"
    errors: list[str] = []

    def on_console(message: ConsoleMessage) -> None:
        if message.type == "error" and not any(part in message.text for part in HARMLESS):
            errors.append(message.text)

    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        page.on("console", on_console)
        page.reload()
        open_project(page)
        open_object(page, "PLC_PRG")
        if language == "en":
            log_in(page)
            expect(implementation(page)).to_contain_text("Execute")
        page.wait_for_timeout(1500)
        page.screenshot(path=folder / f"workbench-{suffix}.png")
        if language == "en":
            open_object(page, "Plant3D")
            frame = page.frame_locator("[data-testid=scene-view]")
            expect(frame.locator("canvas").first).to_be_visible()
            remark = frame.locator(".mantine-Notification-closeButton")
            if remark.count():  # without a graphics card the 3D library says that it is slow
                remark.first.click()
            page.wait_for_timeout(15_000)
            page.screenshot(path=folder / f"plant-{suffix}.png", timeout=60_000)
            page.locator(".dv-tab").filter(has_text="Plant3D").locator("[class*=close]").click()
    assert errors == []
