"""The project settings: pages of the project, its applications and their libraries, saved as one change."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import choose_menu, objects_stored, open_project

pytestmark = pytest.mark.e2e


def _settings(page: Page) -> Locator:
    choose_menu(page, "Project", "Project Settings")
    dialog = page.get_by_role("dialog", name="Project Settings")
    expect(dialog.get_by_role("tab", name="Memory and source")).to_be_visible()
    return dialog


def test_settings_of_several_pages_are_saved_together(page: Page) -> None:
    open_project(page)
    dialog = _settings(page)
    dialog.get_by_label("Description").fill("Line 7, hall B")
    dialog.get_by_role("tab", name="Memory and source").click()
    limit = dialog.get_by_label("Limit", exact=True)
    limit.fill("2000000")
    save = dialog.get_by_role("button", name="Save")
    expect(save).to_have_attribute("aria-disabled", "true")
    limit.fill("256")
    dialog.get_by_role("tab", name="Coding rules").click()
    dialog.get_by_label("Severity of S1211").click()
    page.get_by_role("option", name="Error", exact=True).click()
    dialog.get_by_role("tab", name="Library parameters").click()
    expect(dialog.get_by_text("No library parameters")).to_be_visible()
    with objects_stored(page) as saved:
        save.click()
    expect(dialog).to_have_count(0)
    (application,) = saved.value.json()
    assert application["data"]["heap"]["limit_kib"] == 256
    assert application["data"]["static_analysis"]["rules"]["S1211"] == "error"

    dialog = _settings(page)
    expect(dialog.get_by_label("Description")).to_have_value("Line 7, hall B")
    dialog.get_by_role("tab", name="Memory and source").click()
    expect(dialog.get_by_label("Limit", exact=True)).to_have_value("256")


def test_single_compiler_warnings_are_switched_off(page: Page) -> None:
    open_project(page)
    dialog = _settings(page)
    dialog.get_by_role("tab", name="Compiler warnings").click()
    dialog.get_by_label("Search warnings").fill("W1122")
    box = dialog.get_by_role("checkbox", name="W1122")
    expect(dialog.get_by_role("checkbox")).to_have_count(1)
    expect(box).to_be_checked()
    box.click()
    with objects_stored(page) as saved:
        dialog.get_by_role("button", name="Save").click()
    expect(dialog).to_have_count(0)
    (application,) = saved.value.json()
    assert application["data"]["disabled_warnings"] == ["W1122"]
    dialog = _settings(page)
    dialog.get_by_role("tab", name="Compiler warnings").click()
    dialog.get_by_label("Search warnings").fill("W1122")
    expect(dialog.get_by_role("checkbox", name="W1122")).not_to_be_checked()
