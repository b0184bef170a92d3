"""What an online change would do, variable by variable: before a login, in its dialog, in the panel."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .api import example, stored, write
from .conftest import Server, new_profile, start_page
from .ui import pattern
from .workbench import change_online, choose_menu, log_in, open_object, open_project, status_bar, watch

pytestmark = pytest.mark.e2e

OLD = "VAR_GLOBAL\n"
NEW = "VAR_GLOBAL\n    nBatches : DINT := 12;\n"


def _edited(page: Page, server: Server) -> str:
    """The list of global variables gets a variable; answers the project."""
    project = example(page, server)
    write(page, server, project, "GVL_Line", OLD, NEW)
    return project


def _relation(page: Page) -> Locator:
    """What the status bar says when the project can be changed online."""
    return status_bar(page).get_by_role("button", name=re.compile("online change", re.IGNORECASE))


def test_the_status_bar_tells_before_the_login_and_leads_to_the_variables(page: Page, server: Server) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    expect(status_bar(page).get_by_role("button", name="Unchanged")).to_be_visible()
    project = _edited(page, server)
    try:
        tell = status_bar(page).get_by_role("button", name="Online change possible")
        tell.click()
        table = page.get_by_role("grid", name="Changed variables")
        added = table.get_by_role("row").filter(has_text="GVL_Line.nBatches")
        expect(added).to_contain_text("Initialised")
        expect(added).to_contain_text("New variable")
        expect(table.get_by_role("row").filter(has_text="Moved")).to_have_count(0)
        panel = page.get_by_role("tabpanel", name="Online change")
        panel.get_by_role("button", name=re.compile("^Moved")).click()
        expect(table.get_by_role("row").filter(has_text="GVL_Line.iRecipe")).to_contain_text(
            "keeps its value"
        )
        panel.get_by_label("Filter by name or type").fill("nbatch")
        expect(table.get_by_role("row")).to_have_count(2)
        added.dblclick()
        expect(page.locator(".dv-tab.dv-active-tab").filter(has_text="GVL_Line")).to_be_visible()

        page.keyboard.press("Alt+F8")
        dialog = page.get_by_role("dialog")
        expect(dialog.get_by_role("grid", name="Changed variables")).to_contain_text("GVL_Line.nBatches")
        page.keyboard.press("Enter")
        expect(dialog).to_have_count(0)
        expect(page.get_by_text("changed online").first).to_be_visible()
        expect(page.get_by_text("nothing would change")).to_be_visible()
        assert "nBatches" in stored(page, server, project, "GVL_Line")["data"]["declaration"]
    finally:
        write(page, server, project, "GVL_Line", NEW, OLD)
    expect(
        status_bar(page).get_by_role("button", name=re.compile("online change", re.IGNORECASE))
    ).to_be_visible()
    change_online(page)


def test_the_running_application_is_compared_object_by_object(page: Page, server: Server) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    project = _edited(page, server)
    try:
        _relation(page).click()
        page.get_by_role("button", name=re.compile("^Compare with What Runs")).click()
        dialog = page.get_by_role("dialog")
        dialog.get_by_text("GVL_Line").first.click()
        expect(dialog).to_contain_text("nBatches")
        page.keyboard.press("Escape")
    finally:
        write(page, server, project, "GVL_Line", NEW, OLD)


def test_back_to_the_version_before(page: Page, server: Server) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    project = _edited(page, server)
    try:
        expect(_relation(page)).to_be_visible()
        change_online(page)
        row = watch(page, "GVL_Line.nBatches")
        expect(row).to_contain_text("12")
        choose_menu(page, "Online", "Versions in the controller")
        dialog = page.get_by_role("dialog", name="Versions in the controller")
        versions = dialog.get_by_role("grid", name="Versions in the controller")
        expect(versions.get_by_role("row").filter(has_text="Runs now")).to_have_count(1)
        changes = dialog.get_by_role("grid", name="Changed variables")
        expect(changes.get_by_role("row").filter(has_text="GVL_Line.nBatches")).to_contain_text("Lost")
        if os.environ.get("TAPPET_PICTURES"):
            page.screenshot(path=Path(os.environ["TAPPET_PICTURES"]) / "online-versions.png")
        dialog.get_by_role("button", name="Go back by online change").click()
        expect(dialog).to_have_count(0)
        expect(page.get_by_text("The earlier version is back").first).to_be_visible()
        expect(row).not_to_contain_text("12")
        expect(status_bar(page).get_by_text("running")).to_be_visible()
        assert "nBatches" in stored(page, server, project, "GVL_Line")["data"]["declaration"]
    finally:
        write(page, server, project, "GVL_Line", NEW, OLD)


@pytest.mark.slow
@pytest.mark.parametrize(("theme", "language"), [("dark", "en"), ("light", "zh")])
def test_pictures(browser: Browser, server: Server, theme: str, language: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        open_project(page)
        open_object(page, "PLC_PRG")
        tell = status_bar(page).get_by_role(
            "button", name=re.compile(pattern(language, "relation.short.same"))
        )
        expect(tell).to_be_visible()
        project = _edited(page, server)
        try:
            possible = re.compile(pattern(language, "relation.short.online_change"))
            status_bar(page).get_by_role("button", name=possible).click()
            expect(page.get_by_role("grid").filter(has_text="nBatches")).to_be_visible()
            page.screenshot(path=folder / f"online-changes-{theme}-{language}.png")
            page.keyboard.press("Alt+F8")
            expect(page.get_by_role("dialog")).to_contain_text("nBatches")
            page.screenshot(path=folder / f"online-dialog-{theme}-{language}.png")
        finally:
            write(page, server, project, "GVL_Line", NEW, OLD)
