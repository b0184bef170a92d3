"""File > Print: the project and the object in the editor, as PDF and HTML."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect
from pypdf import PdfReader

from .workbench import choose_menu, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e


def test_the_project_and_the_object_in_the_editor_are_printed(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")

    def print_(scope: str, format_: str) -> bytes:
        choose_menu(page, "File", "Print")
        dialog = page.get_by_role("dialog", name="Print")
        for label, option in (("What", scope), ("Format", format_)):
            dialog.get_by_label(label, exact=True).click()
            page.get_by_role("option", name=option).click()
        dialog.get_by_label("Text at the foot").fill("Plant <4>")
        with page.expect_download() as download:
            dialog.get_by_role("button", name="Save").click()
        expect(dialog).to_have_count(0)
        assert download.value.suggested_filename.endswith(format_.lower())
        return Path(download.value.path()).read_bytes()

    pages = PdfReader(io.BytesIO(print_("The whole project", "PDF"))).pages
    text = "".join(one.extract_text() for one in pages)
    assert "Contents" in text
    assert "Plant <4>" in text
    assert "GVL_IO" in text
    html = print_("The object in the editor: PLC_PRG", "HTML").decode()
    assert "PLC_PRG" in html
    assert r"Plant \3c 4\3e " in html  # a string of the style
    # PLC_PRG with its three actions
    assert ('id="s3"' in html, 'id="s4"' in html) == (True, False)


def test_single_objects_are_printed(page: Page) -> None:
    open_project(page)
    tree_item(page, "PLC_PRG").click()
    choose_menu(page, "File", "Print")
    dialog = page.get_by_role("dialog", name="Print")
    for label, option in (("What", "Single objects"), ("Format", "HTML")):
        dialog.get_by_label(label, exact=True).click()
        page.get_by_role("option", name=option).click()

    def node(name: str) -> Locator:
        return dialog.get_by_role("treeitem").filter(has_text=name).first

    expect(node("PLC_PRG")).to_have_attribute("aria-checked", "true")  # as it was selected
    dialog.get_by_label("Search objects").fill("GVL_IO")
    dialog.get_by_role("button", name="None").click()
    expect(dialog.get_by_role("button", name="Save")).to_be_disabled()
    node("GVL_IO").locator("[data-state]").click()
    dialog.get_by_label("Search objects").fill("PLC_PRG")
    node("PLC_PRG").locator("[data-state]").click()
    dialog.get_by_label("Search objects").fill("")
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save").click()
    expect(dialog).to_have_count(0)
    assert download.value.suggested_filename == "Bottling line.html"
    html = Path(download.value.path()).read_text()
    assert "GVL_IO" in html
    assert "PLC_PRG" in html
    assert "Library Manager" not in html
