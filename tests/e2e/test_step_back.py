"""Steps of the debugger lead back into past cycles, and forward again to the present."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from .test_debugger import go_to, picture
from .workbench import log_in, open_object, open_project, status_bar

pytestmark = pytest.mark.e2e
LINE = 4


def shown(page: Page) -> Locator:
    """What the bar of past cycles says of the one that is shown."""
    return page.get_by_role("region", name="Past Cycles").get_by_role("status")


def cycle(page: Page) -> int:
    found = re.search(r"cycle (\d+)", shown(page).inner_text())
    assert found is not None
    return int(found[1])


def test_a_running_machine_is_stepped_back_and_forward_again(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    toolbar = page.get_by_role("toolbar")
    toolbar.get_by_role("button", name="Step Back One Cycle").click()
    expect(shown(page)).to_contain_text("the last one")
    last = cycle(page)
    page.keyboard.press("Alt+F10")
    expect(shown(page)).to_contain_text(f"cycle {last - 1},")
    page.keyboard.press("F10")
    expect(shown(page)).to_contain_text(f"cycle {last},")
    page.keyboard.press("F8")
    expect(shown(page)).to_have_count(0)
    expect(status_bar(page).get_by_text("running")).to_be_visible()


def test_a_halted_task_is_left_for_the_past_and_come_back_to(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    go_to(page, LINE)
    page.keyboard.press("F9")
    expect(status_bar(page)).to_contain_text("halted: MainTask", timeout=60_000)
    for _ in range(5):
        page.keyboard.press("Alt+F10")
    expect(shown(page)).to_contain_text("before the last one")
    picture(page, "debugger-past")
    page.get_by_role("toolbar").get_by_role("button", name="Resume").click()
    expect(shown(page)).to_have_count(0)
    expect(status_bar(page)).to_contain_text("halted: MainTask")
    go_to(page, LINE)
    page.keyboard.press("F9")
    page.keyboard.press("F5")
    expect(status_bar(page).get_by_text("running")).to_be_visible()
