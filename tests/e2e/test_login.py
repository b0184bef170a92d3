"""The questions of a login: what Enter agrees to, and a program with errors."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from .workbench import add_line, answer_to, message_rows, plc_prg, status_bar

pytestmark = pytest.mark.e2e


def test_a_program_with_errors_is_looked_at_without_loading(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iLoaded := nowhere;")
    with answer_to(page, "/login"):
        page.keyboard.press("Alt+F8")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("The application has errors")
    expect(dialog).to_contain_text("'Application' of project 'Bottling line'")
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    expect(editor).to_contain_text("Execute")
    expect(message_rows(page).filter(has_text="nowhere").first).to_be_visible()


def test_enter_does_not_download_over_a_running_machine(page: Page) -> None:
    plc_prg(page)
    page.keyboard.press("Alt+F8")
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    page.get_by_role("menuitem", name="Online", exact=True).click()
    page.get_by_role("menuitem", name=re.compile("^Download")).click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("'Application' of project 'Bottling line'")
    expect(dialog.get_by_role("button", name="Cancel")).to_be_focused()
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(status_bar(page).get_by_text("running")).to_be_visible()
