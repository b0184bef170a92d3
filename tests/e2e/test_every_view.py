"""The editor of every kind of object and every dialog: read by all in both themes, left by keys."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, expect

from . import cnc_dialogs as cnc_dialogs  # its tour
from . import debugger_dialogs as debugger_dialogs
from . import motion_dialogs as motion_dialogs  # its tours
from . import recipe_dialogs as recipe_dialogs  # its tour
from . import trace_dialogs as trace_dialogs
from . import watch_dialogs as watch_dialogs
from .axe import serious_in_both_themes
from .conftest import Server, new_profile, start_page
from .dialog_titles import dialog_titles
from .every_dialog import TOURS, Tour
from .every_editor import every_object, open_editors
from .ui import Ui
from .untranslated import still_english, words_of_project
from .workbench import open_project

pytestmark = pytest.mark.e2e

LANGUAGES = ("en", "zh")
DIALOGS = "[role=dialog]"
FOLLOW_FOCUS = """() => {
    const inside = '[role=dialog], [role=menu], [role=listbox]';
    document.addEventListener('focusin', ({target}) => {
        if (target.closest(inside) === null) window.focusedOutside = target;
    }, true);
}"""
KEEP_FOCUS = """() => {
    window.focusedBefore = window.focusedOutside;
    window.focusedAtFirst = document.activeElement;
}"""
FOCUS_IS_BACK = """() => document.activeElement === window.focusedBefore
    || (window.focusedBefore?.isConnected !== true && document.activeElement !== document.body)"""
SAME_FOCUS = """() => {
    const same = window.focusedLast === document.activeElement;
    window.focusedLast = document.activeElement;
    return same;
}"""
STOPS = 25
"""So many times Tab is pressed: no field keeps the keyboard twice in a row."""


def in_both_themes(ui: Ui, name: str, part: str) -> list[str]:
    """What axe finds in a part of the page, in light colours and in dark ones, with pictures if wanted."""
    pictures = os.environ.get("TAPPET_VIEWS")

    def picture(theme: str) -> None:
        if pictures:
            ui.page.screenshot(path=Path(pictures) / f"{name.replace(' ', '-')}-{ui.language}-{theme}.png")

    return [f"{name}, {line}" for line in serious_in_both_themes(ui.page, part, picture)]


def ways_out(ui: Ui, object_id: str) -> list[str]:
    """What is wrong with F6, Shift+F6 and Tab in the editor in front."""
    page, wrong = ui.page, []
    if object_id not in ui.area():
        wrong.append(f"opening it leaves the keyboard in '{ui.area()}'")
    page.keyboard.press("F6")
    if object_id in ui.area():
        wrong.append("F6 does not leave it")
    page.keyboard.press("Shift+F6")
    if object_id not in ui.area():
        wrong.append(f"Shift+F6 does not come back but to '{ui.area()}'")
    for _ in range(60):
        page.keyboard.press("Tab")
        if object_id not in ui.area():
            return wrong
    return [*wrong, "Tab does not leave it"]


def in_own_language(ui: Ui, server: Server, name: str) -> list[str]:
    """What is shown in English where it should be Chinese."""
    if ui.language == "en":
        return []
    return [f"{name}: {line}" for line in still_english(ui.page, words_of_project(ui.page, server))]


@pytest.mark.slow
@pytest.mark.parametrize("language", LANGUAGES)
def test_editors_of_all_kinds(browser: Browser, server: Server, language: str) -> None:
    with new_profile(browser, language) as profile, start_page(profile, server) as page:
        objects = every_object(page, server)
        page.reload()
        open_project(page)
        page.keyboard.press("Control+m")  # Tab moves on in texts, too, as the status bar says
        ui = Ui(page, language)
        found = []
        for item, _panel in open_editors(ui, objects):
            found += [f"{item.shape}: {line}" for line in ways_out(ui, item.id)]
            found += in_both_themes(ui, item.shape, f"[data-panel-id*='{item.id}']")
            found += in_own_language(ui, server, item.shape)
    assert found == [], "\n".join(found)


def leave(ui: Ui, dialogs: Locator) -> list[str]:
    """What is wrong with Tab and Escape in the dialog in front, which is closed then."""
    page, wrong = ui.page, []
    before = dialogs.count()
    page.evaluate(KEEP_FOCUS)
    stays = 0
    for _ in range(STOPS):
        page.keyboard.press("Tab")
        stays += int(page.evaluate(SAME_FOCUS))
    if stays:
        wrong.append(f"Tab stays where it is, {stays} of {STOPS} times")
    page.evaluate("() => window.focusedAtFirst.focus()")
    page.wait_for_timeout(100)
    page.keyboard.press("Escape")
    expect(dialogs).to_have_count(before - 1)
    page.wait_for_timeout(100)
    if before > 1 and ui.area() != "dialog":
        wrong.append(f"Escape leads to '{ui.area()}' and not to the dialog below")
    if before == 1 and not page.evaluate(FOCUS_IS_BACK):
        wrong.append(f"Escape leads to '{ui.area()}' and not to where the keyboard was")
    return wrong


@pytest.mark.slow
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("tour", TOURS, ids=lambda tour: tour.name)
def test_dialogs(browser: Browser, server: Server, tour: Tour, language: str) -> None:
    with new_profile(browser, language) as profile, start_page(profile, server) as page:
        open_project(page)
        page.evaluate(FOLLOW_FOCUS)
        ui = Ui(page, language)
        dialogs = page.locator(DIALOGS)
        found, opened = [], set()
        for key in tour.start(ui, server):
            expect(ui.dialog(key)).to_be_visible()
            expect(dialogs.locator("[aria-busy=true]")).to_have_count(0)
            found += in_both_themes(ui, key, DIALOGS)
            found += in_own_language(ui, server, key)
            found += [f"{key}: {line}" for line in leave(ui, dialogs)]
            opened.add(key)
    assert found == [], "\n".join(found)
    assert opened == tour.opens


def test_no_dialog_is_left_out() -> None:
    """A new dialog belongs into a tour."""
    titles = dialog_titles()
    missing = titles.keys() - {key for tour in TOURS for key in tour.opens}
    assert not missing, "\n".join(f"{titles[key]}: no tour opens '{key}'" for key in sorted(missing))
