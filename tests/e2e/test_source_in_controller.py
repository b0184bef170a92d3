"""The source of the project in the controller: asked for at a download, stored by a command, read back."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .workbench import choose_menu, log_in, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e


def test_the_source_is_stored_when_the_user_agrees_and_comes_back_as_a_project(page: Page) -> None:
    open_project(page)
    open_object(page, "Application")
    page.get_by_label("Store it in the controller").click()
    page.get_by_role("option", name="Ask at each download").click()
    page.keyboard.press("Control+s")
    log_in(page)
    choose_menu(page, "Online", "Download")
    dialog = page.get_by_role("dialog")
    dialog.locator("button[type=submit]").click()
    question = page.get_by_role("dialog", name="Store the source in the controller?")
    question.get_by_role("button", name="Store source").click()
    expect(question).to_have_count(0)
    expect(page.get_by_text("'Application' downloaded").first).to_be_visible()
    choose_menu(page, "Online", "Source Download")
    page.get_by_role("dialog").get_by_role("button", name="Store source").click()
    expect(page.get_by_text("The source of 'Bottling line' is in the controller")).to_be_visible()
    choose_menu(page, "File", "Source Upload")
    upload = page.get_by_role("dialog", name="Source Upload")
    expect(upload.get_by_text("the application in the controller was built from it")).to_be_visible()
    upload.get_by_label("Name of the project").fill("From the controller")
    upload.get_by_role("button", name="Make project").click()
    expect(upload).to_have_count(0)
    expect(tree_item(page, "Application")).to_be_visible()
    choose_menu(page, "Project", "Project information")
    expect(page.get_by_role("dialog").get_by_label("Name", exact=True)).to_have_value("From the controller")
