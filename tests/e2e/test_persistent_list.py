"""The list of persistent variables in the browser: Add All Instance Paths."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from .api import example, fetch, write
from .conftest import Server
from .workbench import choose_menu, log_in, open_object, open_project

pytestmark = pytest.mark.e2e

DECLARATION = "PROGRAM PLC_PRG\nVAR PERSISTENT\n    nHours : UDINT;\nEND_VAR"


def test_all_instance_paths_are_added(page: Page, server: Server) -> None:
    """PERS-07."""
    project = fetch(page, server, "POST", "/projects", data={"name": "Hours"})
    path = f"/projects/{project['id']}/objects"
    objects = fetch(page, server, "GET", path)
    application = next(item for item in objects if item["kind"] == "application")
    program = next(item for item in objects if item["kind"] == "pou")
    data = {"declaration": DECLARATION, "implementation": "nHours := nHours + 1;"}
    body = {"base_revision": program["revision"], "data": data}
    fetch(page, server, "PUT", f"{path}/{program['id']}", data=body)
    body = {"kind": "persistent", "name": "Kept", "parent_id": application["id"]}
    fetch(page, server, "POST", path, data=body)
    page.reload()
    open_project(page, "Hours")
    open_object(page, "Kept")
    panel = page.locator(".dv-active-group [data-panel-id]:visible").last
    expect(panel).to_contain_text("VAR_GLOBAL")
    choose_menu(page, "Edit", "Add All Instance Paths")
    expect(page.get_by_text("Instance paths added to Kept")).to_be_visible()
    expect(panel).to_contain_text("PLC_PRG.nHours")
    choose_menu(page, "Edit", "Add All Instance Paths")
    expect(page.get_by_text("Nothing to add to Kept")).to_be_visible()


def test_the_login_tells_what_a_download_cannot_keep(page: Page, server: Server) -> None:
    """PERS-05: the renamed variable is named; all others can be initialised, too."""
    open_project(page)
    project = example(page, server)
    write(page, server, project, "PersistentVars", "END_VAR", "    udiSpare : UDINT;\nEND_VAR")
    log_in(page)
    page.keyboard.press("Control+F8")
    write(page, server, project, "PersistentVars", "udiSpare", "udiOther")
    page.keyboard.press("Alt+F8")
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("radio", name=re.compile("^Login with download")).click()
    group = dialog.get_by_role("group", name="Persistent variables")
    expect(group.get_by_role("listitem")).to_have_text(["PersistentVars.udiSpare · renamed or removed"])
    expect(group.get_by_text("A persistent variable cannot keep its value:")).to_be_visible()
    group.get_by_role("checkbox").click()
    dialog.locator("button[type=submit]").click()
    expect(dialog).to_have_count(0)
    expect(page.get_by_text(re.compile("downloaded")).first).to_be_visible()
    acts = fetch(page, server, "GET", "/audit")
    assert "reset-origin" in [row["action"] for row in acts[:6]]
