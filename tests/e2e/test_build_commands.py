"""Rebuild, generate code, clean, boot application."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tappet.codegen.package import CodePackage

from .workbench import answer_to, choose_menu, log_in, open_project

pytestmark = pytest.mark.e2e


def test_code_is_generated_and_saved_as_boot_application(page: Page) -> None:
    open_project(page)
    with answer_to(page, "/rebuild") as rebuilt:
        choose_menu(page, "Build", "Rebuild")
    assert rebuilt.value.json()["ok"]
    choose_menu(page, "Build", "Generate Code")
    expect(page.get_by_text("Code of Application is ready")).to_be_visible()
    with page.expect_download() as saved:
        choose_menu(page, "Online", "Create Boot Application")
    assert saved.value.suggested_filename == "boot.tappet"
    package = CodePackage.from_bytes(saved.value.path().read_bytes())
    assert package.code_id == rebuilt.value.json()["code_id"]


def test_clean_asks_and_makes_the_next_login_a_download(page: Page) -> None:
    open_project(page)
    choose_menu(page, "Build", "Clean…")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("an online change is not possible any more")
    with answer_to(page, "/clean"):
        dialog.get_by_role("button", name="Clean").click()
    expect(page.get_by_text("Application is cleaned")).to_be_visible()
    page.keyboard.press("Alt+F8")
    expect(dialog.get_by_role("radio", name="Login with download")).to_be_visible()
    page.keyboard.press("Escape")


def test_the_application_of_the_controller_becomes_its_boot_application(page: Page) -> None:
    open_project(page)
    log_in(page)
    with answer_to(page, "/boot-application") as answer:
        choose_menu(page, "Online", "Create Boot Application")
    assert answer.value.status == 200
    expect(page.get_by_text("Application is the boot application")).to_be_visible()
