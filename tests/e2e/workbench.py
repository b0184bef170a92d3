"""What a person does in the workbench, for the browser tests."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, expect


def open_project(page: Page, name: str = "Bottling line") -> None:
    page.get_by_text(name).first.dblclick()
    expect(tree_item(page, "Application")).to_be_visible()


def tree_item(page: Page, name: str) -> Locator:
    return page.get_by_role("treeitem").filter(has_text=re.compile(rf"^\s*{re.escape(name)}\b")).first


def open_object(page: Page, name: str) -> None:
    tree_item(page, name).dblclick()
    expect(page.locator(".dv-tab").filter(has_text=name).first).to_be_visible()


def implementation(page: Page) -> Locator:
    """The lower pane of the text editor in front."""
    return page.locator(".monaco-editor:visible").last


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


def login(page: Page) -> None:
    """Alt+F8; agrees to what the dialog proposes first, if the runtime holds something else."""
    page.keyboard.press("Alt+F8")
    dialog = page.get_by_role("dialog")
    online = status_bar(page).get_by_text("running")
    expect(dialog.or_(online).first).to_be_visible()
    if dialog.count():
        page.keyboard.press("Enter")
        expect(dialog).to_have_count(0)
    expect(online).to_be_visible()


def message_rows(page: Page) -> Locator:
    return page.get_by_role("row").filter(has_text=re.compile(r"[EW]\d{4}"))
