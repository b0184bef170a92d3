"""Context menus by the keyboard: into them, and back to where it was."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from .workbench import open_object, open_project, watch

pytestmark = pytest.mark.e2e

KEYS = ("Shift+F10", "ContextMenu")
KEEP = "() => { window.place = document.activeElement; }"
BACK = "() => window.place !== document.body && document.activeElement === window.place"
WHERE = "() => document.activeElement.outerHTML.slice(0, 160)"


def _watch(page: Page) -> None:
    watch(page, "GVL_Line.iRecipe").get_by_role("gridcell").first.click()


def _tab(page: Page) -> None:
    open_object(page, "PLC_PRG")
    page.locator(".dv-tab").filter(has_text="PLC_PRG").first.focus()


def _close(page: Page) -> None:
    """The menu, after the tooltip of one of its entries."""
    page.wait_for_timeout(150)
    if page.get_by_role("tooltip").count():
        page.keyboard.press("Escape")
        expect(page.get_by_role("tooltip")).to_have_count(0)
    page.keyboard.press("Escape")
    expect(page.get_by_role("menu")).to_have_count(0)


def _back(page: Page) -> str:
    """Nothing when the keyboard is where it was, else where it is."""
    page.wait_for_timeout(150)
    return "" if page.evaluate(BACK) else str(page.evaluate(WHERE))


@pytest.mark.parametrize("go", [_watch, _tab])
def test_menu_keys_open_a_menu_and_escape_leads_back(page: Page, go: Callable[[Page], None]) -> None:
    open_project(page)
    go(page)
    page.evaluate(KEEP)
    menu, wrong = page.get_by_role("menu"), []
    for key in KEYS:
        page.keyboard.press(key)
        expect(menu, key).to_be_visible()
        _close(page)
        wrong += [f"{key}, Escape: {place}" for place in [_back(page)] if place]
    assert wrong == [], "\n".join(wrong)
