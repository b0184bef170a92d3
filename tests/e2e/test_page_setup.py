"""File > Page Setup: paper, logo, head and foot of prints as a setting of the project."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Locator, Page, expect
from pypdf import PdfReader

from .workbench import choose_menu, open_project, tree_item

pytestmark = pytest.mark.e2e

MM = 72 / 25.4


def _logo(form: str = "PNG") -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (120, 40), "#0a58ca").save(file, form)
    return file.getvalue()


def _choose(page: Page, box: Locator, option: str) -> None:
    box.click()
    page.get_by_role("option", name=option, exact=True).click()


def _printed(page: Page) -> PdfReader:
    choose_menu(page, "File", "Print")
    dialog = page.get_by_role("dialog", name="Print")
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save").click()
    expect(dialog).to_have_count(0)
    return PdfReader(io.BytesIO(Path(download.value.path()).read_bytes()))


def test_the_page_setup_of_a_project_is_printed(page: Page) -> None:
    open_project(page)
    choose_menu(page, "File", "Page Setup")
    form = page.locator(".dv-active-group")
    inner = form.locator("svg[data-page=inner]")
    expect(inner).to_be_visible()
    expect(inner).to_contain_text("Bottling line")
    expect(form.locator("svg[data-page=title]")).to_be_visible()

    _choose(page, form.get_by_label("Paper", exact=True), "A5")
    _choose(page, form.get_by_label("Orientation"), "Landscape")
    expect(inner).to_have_attribute("viewBox", "0 0 210 148")
    form.get_by_label("Title page", exact=True).click()
    expect(form.locator("svg[data-page=title]")).to_have_count(0)
    form.get_by_label("Company").fill("Works <7>")
    head = form.locator("section").filter(has_text="Head of the pages")
    head.get_by_label("Centre").fill("{company} / {nothing}")
    expect(head.get_by_role("alert")).to_contain_text("'{nothing}' is no placeholder")
    head.get_by_label("Centre").fill("{company} {{7}")
    expect(head.get_by_role("alert")).to_have_count(0)
    expect(inner).to_contain_text("Works <7> {7}")
    margin = form.get_by_label("Left margin (mm)")
    margin.fill("2")
    expect(form.get_by_text("5 to 100 mm")).to_be_visible()
    margin.fill("30")
    expect(form.get_by_text("5 to 100 mm")).to_have_count(0)

    picture = form.locator("input[type=file]")
    picture.set_input_files({"name": "logo.gif", "mimeType": "image/gif", "buffer": _logo("GIF")})
    expect(form.get_by_text("neither PNG nor JPEG")).to_be_visible()
    picture.set_input_files({"name": "logo.png", "mimeType": "image/png", "buffer": _logo()})
    expect(form.get_by_role("img", name="Logo")).to_be_visible()
    _choose(page, form.get_by_label("At the head of the pages"), "At the right")
    expect(inner.locator("image")).to_have_count(1)
    page.keyboard.press("Control+s")
    expect(page.locator(".dv-active-tab [class*=dirty]")).to_have_count(0)

    page.reload()
    expect(tree_item(page, "Page Setup")).to_be_visible()
    expect(inner).to_have_attribute("viewBox", "0 0 210 148")
    expect(inner).to_contain_text("Works <7> {7}")
    reader = _printed(page)
    box = reader.pages[1].mediabox
    assert (float(box.width), float(box.height)) == pytest.approx((210 * MM, 148 * MM), abs=0.5)
    assert all("Works <7> {7}" in one.extract_text() for one in reader.pages)
    assert len(reader.pages[1].images) == 1


def test_the_print_dialog_begins_with_the_page_setup_and_leads_to_it(page: Page) -> None:
    open_project(page)
    choose_menu(page, "File", "Print")
    dialog = page.get_by_role("dialog", name="Print")
    expect(dialog.get_by_label("Table of contents")).to_be_checked()
    dialog.get_by_role("button", name="Page Setup").click()
    expect(dialog).to_have_count(0)
    form = page.locator(".dv-active-group")
    form.get_by_label("Table of contents").click()
    _choose(page, form.get_by_label("Paper", exact=True), "US Legal")
    page.keyboard.press("Control+s")
    choose_menu(page, "File", "Print")
    expect(dialog.get_by_label("Table of contents")).not_to_be_checked()
    expect(dialog.get_by_label("Paper", exact=True)).to_have_text("US Legal")
