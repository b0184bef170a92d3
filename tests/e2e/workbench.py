"""What a person does in the workbench, for the browser tests."""

from __future__ import annotations

import re
import time
from contextlib import AbstractContextManager
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server


def open_project(page: Page, name: str = "Bottling line") -> None:
    page.locator("main > section").get_by_text(
        name
    ).first.dblclick()  # beside them are examples of such names
    expect(tree_item(page, "Application")).to_be_visible()


def tree_item(page: Page, name: str) -> Locator:
    return page.get_by_role("treeitem").filter(has_text=re.compile(rf"^\s*{re.escape(name)}(?!\w)")).first


def open_object(page: Page, name: str) -> None:
    tree_item(page, name).dblclick()
    expect(page.locator(".dv-tab").filter(has_text=name).first).to_be_visible()


def open_new_object(page: Page, server: Server, project: str, kind: str, name: str) -> tuple[str, str]:
    """An object of the application of a new project, opened; the path of the project and its id."""
    made = fetch(page, server, "POST", "/projects", data={"name": project})
    path = f"/projects/{made['id']}"
    objects = fetch(page, server, "GET", f"{path}/objects")
    application = next(item for item in objects if item["kind"] == "application")
    data = {"kind": kind, "name": name, "parent_id": application["id"]}
    item = fetch(page, server, "POST", f"{path}/objects", data=data)
    page.reload()
    open_project(page, project)
    open_object(page, name)
    return path, str(item["id"])


def objects_stored(page: Page) -> AbstractContextManager[Any]:
    """Until objects of the project are stored, with the answer; settings of the user are put as well."""
    return page.expect_response(
        lambda answer: (
            answer.request.method == "PUT" and "/projects/" in answer.url and "/objects" in answer.url
        )
    )


def implementation(page: Page) -> Locator:
    """The lower pane of the text editor in front."""
    return page.locator(".monaco-editor:visible").last


def plc_prg(page: Page) -> Locator:
    """The implementation of PLC_PRG, ready to be typed into."""
    open_project(page)
    open_object(page, "PLC_PRG")
    editor = implementation(page)
    expect(editor).to_contain_text("xSafe")
    return editor


def text_of(editor: Locator) -> str:
    return (editor.locator(".view-lines").inner_text()).replace("\xa0", " ")


def add_line(page: Page, editor: Locator, text: str) -> None:
    """A new line behind the first one."""
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type(text)
    page.keyboard.press("Escape")
    expect(editor).to_contain_text(text.replace(" ", "\xa0"))


def delete_line(page: Page, editor: Locator, number: int) -> None:
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    for _ in range(number - 1):
        page.keyboard.press("ArrowDown")
    page.keyboard.press("Home")
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Delete")


def status_bar(page: Page) -> Locator:
    return page.locator("footer[role=status]")


def log_in(page: Page, expected: str = "running") -> None:
    """Alt+F8; loads what has changed, by online change where that is possible."""
    page.keyboard.press("Alt+F8")
    dialog = page.get_by_role("dialog")
    online = status_bar(page).get_by_text(expected)
    expect(dialog.or_(online).first).to_be_visible()
    if dialog.count():
        loading = dialog.get_by_role("radio", name=re.compile("^Login with (online change|download)"))
        if loading.count():
            loading.first.click()
        dialog.locator("button[type=submit]").click()
        expect(dialog).to_have_count(0)
    expect(online).to_be_visible()


def change_online(page: Page) -> None:
    """Alt+F8 while logged in: the dialog proposes the online change; agrees to it."""
    page.keyboard.press("Alt+F8")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("radio", name=re.compile("online change"))).to_be_checked()
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(page.get_by_text("changed online").first).to_be_visible()
    expect(status_bar(page).get_by_text("running")).to_be_visible()


def message_rows(page: Page) -> Locator:
    return page.get_by_role("row").filter(has_text=re.compile(r"[EW]\d{4}"))


def open_panel(page: Page, title: str) -> Locator:
    """A tool panel that has a tab, brought to the front."""
    page.locator(".dv-tab").filter(has_text=re.compile(rf"^{re.escape(title)}\s*\d*$")).click()
    return page.get_by_role("tabpanel", name=title)


def choose_menu(page: Page, menu: str, *entries: str) -> None:
    # Where the text lacks it, the letter of Alt+letter stands behind it: 编译(B).
    page.get_by_role("menuitem", name=re.compile(f"^{re.escape(menu)}(\\([A-Z]\\))?$")).click()
    for entry in entries:
        page.get_by_role("menuitem", name=re.compile(f"^{re.escape(entry)}", re.IGNORECASE)).last.click()


def show_panel(page: Page, title: str) -> None:
    """The entry of the View menu that shows a tool panel."""
    page.get_by_role("menuitem", name=re.compile(r"^(View|视图)")).first.click()
    page.get_by_role("menuitemcheckbox", name=re.compile(f"^{re.escape(title)}")).first.click()


def answer_to(page: Page, path: str) -> AbstractContextManager[Any]:
    """What the server answers to the next request whose path ends so."""
    return page.expect_response(lambda answer: urlsplit(answer.url).path.endswith(path))


def watch(page: Page, expression: str) -> Locator:
    """The row of a variable in the first watch list; typed into the empty line when it is not there."""
    table = open_panel(page, "Watch 1").get_by_role("treegrid")
    expect(table).to_be_visible()
    row = table.get_by_role("row").filter(has_text=expression)
    if row.count() == 0:
        table.get_by_role("row").last.get_by_role("gridcell").first.dblclick()
        page.keyboard.type(expression)
        page.keyboard.press("Escape" if page.get_by_role("listbox").count() else "Shift")
        page.keyboard.press("Enter")
    expect(row).to_be_visible()
    return row


def prepare(row: Locator, text: str | None = None) -> None:
    """Double click on the prepared value once the row has a value: a BOOL changes, else `text` is typed."""
    expect(row.get_by_role("gridcell").nth(2)).not_to_have_text("")
    row.get_by_role("gridcell").nth(3).dblclick()
    if text is not None:
        row.page.keyboard.type(text)
        row.page.keyboard.press("Enter")


def watch_value(row: Locator, *, at_least: int) -> str:
    """The number in the value column, once it is that large."""
    cell = row.get_by_role("gridcell").nth(2)
    deadline = time.monotonic() + 30.0
    while time.monotonic() < deadline:
        text = (cell.text_content() or "").strip()
        if text.isdigit() and int(text) >= at_least:
            return text
        cell.page.wait_for_timeout(100)
    raise AssertionError(f"{row.text_content()!r} does not reach {at_least}")
