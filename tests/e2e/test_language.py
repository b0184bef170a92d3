"""Switching the language: nothing on the screen stays in the one before, and nothing is left untranslated."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from .api import example, write
from .conftest import Server
from .ui import Ui, texts
from .untranslated import still_chinese, still_english, words_of_project
from .workbench import implementation, open_object, open_project

pytestmark = pytest.mark.e2e


def switch(page: Page, before: str, after: str) -> None:
    """By the menu of the user."""
    ui = Ui(page, before)
    page.get_by_role("button", name=ui.name("user.menu")).click()
    page.get_by_role("menuitem", name=ui.name("language.label")).press("ArrowRight")
    page.get_by_role("menuitemcheckbox", name={"en": "English", "zh": "简体中文"}[after]).press("Enter")
    other = Ui(page, after)
    expect(page.get_by_role("menubar", name=other.text("menu.label"))).to_be_visible()


OBJECTS = ("Application", "MainTask", "Tappet Soft PLC", "GVL_IO", "PLC_PRG")
PANELS = ("panel.messages", "forces.title", "panel.tasks", "panel.log", "panel.libraries", "panel.devices")


def show(page: Page, language: str, key: str) -> None:
    title = Ui(page, language).text(key)
    page.locator(".dv-tab").filter(has_text=re.compile(rf"^{re.escape(title)}\s*\d*$")).first.click()
    page.wait_for_timeout(200)


def front(page: Page, name: str) -> None:
    page.locator(".dv-tab").filter(has_text=re.compile(rf"^{re.escape(name)}")).first.click()
    page.wait_for_timeout(300)


def test_nothing_stays_in_the_language_before(page: Page, server: Server) -> None:
    """Open editors, panels, a build with messages: English, Chinese, and English again."""
    write(page, server, example(page, server), "PLC_PRG", "// Mode", "nowhere := 1;")
    words = words_of_project(page, server)
    open_project(page)
    for name in OBJECTS:
        open_object(page, name)
    expect(implementation(page)).to_contain_text("nowhere")
    page.keyboard.press("F11")
    message = page.get_by_role("row").filter(has_text=re.compile(r"E\d{4}")).first
    expect(message).to_be_visible()
    english = message.inner_text()
    switch(page, "en", "zh")
    expect(message).not_to_have_text(english)
    notice = page.get_by_text(texts("zh")["text.languageStays"])
    expect(notice).to_be_visible()
    found = still_english(page, words)
    for key in PANELS:
        show(page, "zh", key)
        found += [f"{key}: {line}" for line in still_english(page, words)]
    for name in OBJECTS:
        front(page, name)
        found += [f"{name}: {line}" for line in still_english(page, words)]
    for menu in page.get_by_role("menubar").get_by_role("menuitem").all():
        menu.click()
        found += [f"menu: {line}" for line in still_english(page, words)]
        page.keyboard.press("Escape")
    assert found == [], "\n".join(dict.fromkeys(found))
    switch(page, "zh", "en")
    expect(notice).to_have_count(0)
    found = still_chinese(page)
    for key in PANELS:
        show(page, "en", key)
        found += [f"{key}: {line}" for line in still_chinese(page)]
    for name in OBJECTS:
        front(page, name)
        found += [f"{name}: {line}" for line in still_chinese(page)]
    assert found == [], "\n".join(dict.fromkeys(found))
