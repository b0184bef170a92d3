"""Context menus by the keyboard: into them, and back to where it was."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from .workbench import add_line, implementation, message_rows, open_object, open_project, tree_item, watch

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


def _tree(page: Page) -> None:
    tree_item(page, "GVL_IO").click()


def _program(page: Page) -> None:
    tree_item(page, "PLC_PRG").click()


def _symbol(page: Page) -> None:
    open_object(page, "PLC_PRG")
    implementation(page).locator(".view-line").nth(1).get_by_text("xSafe").first.click()


def _text(page: Page) -> None:
    open_object(page, "PLC_PRG")
    implementation(page).locator(".view-line").nth(1).click()


def _messages(page: Page) -> None:
    open_object(page, "PLC_PRG")
    add_line(page, implementation(page), "abc := ;")
    row = message_rows(page).first
    expect(row).to_be_visible()
    row.click()


def _declaration(page: Page) -> None:
    open_object(page, "PLC_PRG")
    page.get_by_role("button", name="Table", exact=False).first.click()
    page.get_by_role("gridcell").filter(has_text="fbFiller").first.click()


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


@pytest.mark.parametrize("go", [_watch, _tab, _tree, _text, _declaration, _messages])
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


@pytest.mark.parametrize(
    ("go", "entries"),
    [
        (_program, ("Add Object", "Method")),
        (_tree, ("Properties",)),
        (_tree, ("Delete",)),
        (_symbol, ("Rename",)),
    ],
)
def test_a_dialog_from_a_context_menu_leads_back(
    page: Page, go: Callable[[Page], None], entries: tuple[str, ...]
) -> None:
    open_project(page)
    go(page)
    page.evaluate(KEEP)
    page.keyboard.press("Shift+F10")
    for entry in entries:
        page.get_by_role("menuitem", name=re.compile(f"^{entry}")).last.focus()
        page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_be_visible()
    page.wait_for_timeout(150)
    _close(page)
    expect(dialog).to_have_count(0)
    assert _back(page) == ""
