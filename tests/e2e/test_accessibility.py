"""axe-core finds nothing serious in any view, in both themes (WCAG 2.2 A and AA)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page, expect

from .axe import serious_in_both_themes
from .workbench import (
    choose_menu,
    implementation,
    log_in,
    open_object,
    open_panel,
    open_project,
    show_panel,
    tree_item,
)

pytestmark = pytest.mark.e2e


def _objects(page: Page) -> Iterator[str]:
    """Editors of every kind in the example."""
    for name in ("GVL_IO", "Task Configuration", "MainTask", "Library Manager", "Application", "PLC_PRG"):
        open_object(page, name)
        page.wait_for_timeout(400)
        yield name


def _panels(page: Page) -> Iterator[str]:
    for name in ("Messages", "Watch 1", "Forces", "Tasks", "Log"):
        open_panel(page, name)
        yield name


def _tools(page: Page) -> Iterator[str]:
    """Panels that a command opens; the search lies over the tree."""
    open_object(page, "PLC_PRG")
    implementation(page).locator(".view-line").first.click()
    page.keyboard.press("Control+F12")
    show_panel(page, "Bookmarks")
    expect(page.get_by_role("tabpanel", name="Bookmarks").get_by_role("row").last).to_be_visible()
    yield "Bookmarks"
    page.keyboard.press("Control+Shift+H")
    search = page.locator("[data-panel-id=search]")
    search.get_by_label("Search for").fill("xSafe")
    expect(search.get_by_role("treeitem").first).to_be_visible()
    yield "Search"
    search.get_by_role("button", name="Regular expression").click()
    search.get_by_label("Search for").fill("(")
    expect(search.get_by_role("alert")).to_be_visible()
    yield "Search with a fault"


def _help(page: Page) -> Iterator[str]:
    open_object(page, "PLC_PRG")
    implementation(page).locator(".view-line").first.click()
    page.keyboard.press("F1")
    panel = page.locator("[data-panel-id=help]")
    expect(panel.get_by_role("article")).to_be_visible()
    yield "Help"
    panel.get_by_label("Search the help").fill("time")
    expect(panel.get_by_role("listitem").first).to_be_visible()
    yield "Search of the help"


def _dialogs(page: Page) -> Iterator[str]:
    for menu, entry in (
        ("Project", "Add object"),
        ("Project", "Project settings"),
        ("Project", "Project information"),
        ("File", "Print"),
        ("Help", "About"),
        ("Help", "Keyboard"),
    ):
        choose_menu(page, menu, entry)
        page.wait_for_timeout(300)
        yield entry
        page.keyboard.press("Escape")
    choose_menu(page, "File", "Export")
    page.get_by_role("dialog").get_by_label("What", exact=True).click()
    page.get_by_role("option", name="Single objects").click()
    expect(page.get_by_role("dialog").get_by_role("treeitem").first).to_be_visible()
    yield "Single objects"
    page.keyboard.press("Escape")


def _comparisons(page: Page) -> Iterator[str]:
    """The project beside its first revision, after one object went."""
    tree_item(page, "GVL_IO").click()
    page.keyboard.press("Delete")
    page.get_by_role("dialog").get_by_role("button", name="Delete").click()
    expect(tree_item(page, "GVL_IO")).to_have_count(0)
    choose_menu(page, "Project", "Deleted objects")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("row").filter(has_text="GVL_IO")).to_be_visible()
    yield "deleted objects"
    dialog.get_by_role("tab", name="Revisions").click()
    expect(dialog.get_by_role("tree").get_by_role("treeitem").last).to_be_visible()
    page.wait_for_timeout(500)
    yield "history"
    page.keyboard.press("Escape")
    choose_menu(page, "Project", "Compare")
    page.wait_for_timeout(300)
    yield "compare"
    page.keyboard.press("Escape")


def _online(page: Page) -> Iterator[str]:
    open_object(page, "PLC_PRG")
    log_in(page)
    expect(implementation(page)).to_contain_text("Execute")
    yield "PLC_PRG online"
    open_object(page, "GVL_IO")
    page.wait_for_timeout(400)
    yield "GVL_IO online"


def _panel_entries(page: Page) -> list[str]:
    """The entries of the View menu that show a panel."""
    page.get_by_role("menuitem", name="View", exact=True).click()
    entries = page.get_by_role("menu").get_by_role("menuitemcheckbox").all_inner_texts()
    page.keyboard.press("Escape")
    return [entry.split("\n")[0] for entry in entries if "Full" not in entry]


def _every_panel(page: Page) -> Iterator[str]:
    open_object(page, "PLC_PRG")
    for online in (False, True):
        if online:
            log_in(page)
        entries = _panel_entries(page)
        assert len(entries) >= 8
        for entry in entries:
            page.get_by_role("menuitem", name="View", exact=True).click()
            page.get_by_role("menuitemcheckbox", name=re.compile(f"^{re.escape(entry)}")).first.click()
            page.wait_for_timeout(300)
            yield f"{entry}, {'online' if online else 'offline'}"


def _every_menu(page: Page) -> Iterator[str]:
    open_object(page, "PLC_PRG")
    for menu in page.get_by_role("menubar").get_by_role("menuitem").all_inner_texts():
        page.get_by_role("menuitem", name=menu, exact=True).click()
        yield f"menu {menu}"
        page.keyboard.press("Escape")
    for place in (tree_item(page, "PLC_PRG"), implementation(page).locator(".view-line").first):
        place.click(button="right")
        expect(page.get_by_role("menu").first).to_be_visible()
        yield "context menu"
        page.keyboard.press("Escape")
    for key in ("Control+Shift+P", "Control+p"):
        page.keyboard.press(key)
        expect(page.get_by_role("option").first).to_be_visible()
        yield f"palette by {key}"
        page.keyboard.press("Escape")


@pytest.mark.parametrize(
    "views",
    [_objects, _panels, _tools, _help, _dialogs, _comparisons, _online],
    ids=lambda views: views.__name__.strip("_"),
)
def test_nothing_serious(page: Page, views: Callable[[Page], Iterator[str]]) -> None:
    found = [f"start page, {line}" for line in serious_in_both_themes(page)]
    open_project(page)
    for name in views(page):
        found += [f"{name}, {line}" for line in serious_in_both_themes(page)]
    assert found == [], "\n".join(found)


@pytest.mark.slow
@pytest.mark.parametrize(
    "views",
    [_every_panel, _every_menu],
    ids=lambda views: views.__name__.strip("_"),
)
def test_nothing_serious_anywhere(page: Page, views: Callable[[Page], Iterator[str]]) -> None:
    """Every panel and menu that the workbench itself lists."""
    open_project(page)
    found = []
    for name in views(page):
        # What floats lies over the rest, which has been looked at.
        floating = "[role=dialog], [role=menu]"
        part = floating if page.locator(floating).count() else "main"
        found += [f"{name}, {line}" for line in serious_in_both_themes(page, part)]
    assert found == [], "\n".join(found)
