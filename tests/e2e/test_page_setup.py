"""File > Page Setup: paper, logo, head and foot of prints as a setting of the project."""

from __future__ import annotations

import base64
import io
import re
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect
from pypdf import PdfReader

from .api import example, fetch
from .conftest import Server
from .workbench import choose_menu, log_in, open_project, tree_item

pytestmark = pytest.mark.e2e

MM = 72 / 25.4


DROP = """(target, text) => {
    const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], 'logo.jpg', {type: 'image/jpeg'}));
    target.dispatchEvent(new DragEvent('drop', {dataTransfer, bubbles: true, cancelable: true}));
}"""


def _logo(form: str = "PNG", size: tuple[int, int] = (120, 40)) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", size, "#0a58ca").save(file, form)
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
    picture.set_input_files({"name": "logo.png", "mimeType": "image/png", "buffer": _logo()[:60]})
    expect(form.get_by_text("it is damaged")).to_be_visible()
    picture.set_input_files({"name": "logo.png", "mimeType": "image/png", "buffer": _logo(size=(4001, 1))})
    expect(form.get_by_text("4001 x 1")).to_be_visible()
    picture.set_input_files({"name": "logo.png", "mimeType": "image/png", "buffer": _logo()})
    logo = form.get_by_role("img", name="Logo")
    expect(logo).to_be_visible()
    expect(form.get_by_text("4001 x 1")).to_have_count(0)
    form.get_by_role("button", name="Remove").click()
    expect(logo).to_have_count(0)
    form.locator("[data-drop=logo]").evaluate(DROP, base64.b64encode(_logo("JPEG")).decode())
    expect(logo).to_have_attribute("src", re.compile("^data:image/jpeg"))
    _choose(page, form.get_by_label("At the head of the pages"), "At the right")
    expect(inner.locator("[data-edge=header] img")).to_have_count(1)
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
    assert f"Page 2 of {len(reader.pages)}" in reader.pages[1].extract_text()


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


def test_who_cannot_change_the_project_sees_what_holds_without_a_page_setup(page: Page) -> None:
    open_project(page)
    log_in(page)
    choose_menu(page, "File", "Page Setup")
    dialog = page.get_by_role("dialog", name="Page Setup")
    expect(dialog).to_contain_text("The project has no page setup of its own")
    expect(dialog).to_contain_text("Log out to change the project.")
    expect(dialog.get_by_label("Top margin (mm)")).to_be_disabled()
    expect(dialog.get_by_label("Paper", exact=True)).to_be_disabled()
    expect(dialog.get_by_label("Centre").first).to_be_disabled()
    expect(dialog.locator("svg[data-page=inner]")).to_contain_text("Bottling line")
    expect(dialog.locator("svg[data-page=inner]")).to_contain_text("Page 2 of 7")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    expect(tree_item(page, "Page Setup")).to_have_count(0)


def test_chromium_prints_the_html_by_the_page_setup(page: Page, server: Server, browser: Browser) -> None:
    open_project(page)
    path = example(page, server)
    setup = {
        "paper": "a5",
        "orientation": "landscape",
        "header": {"left": "<b> {project}", "right": "{object}|{{x}"},
        "footer": {"centre": "{page} of {pages}"},
        "logo": base64.b64encode(_logo()).decode(),
        "logo_in_header": "left",
    }
    order = {"parent_id": None, "kind": "page_setup", "name": None, "data": setup}
    fetch(page, server, "POST", f"{path}/objects", data=order)
    html = fetch(page, server, "GET", f"{path}/documentation?format=html").decode()
    with browser.new_context(java_script_enabled=False) as context:
        sheet = context.new_page()
        sheet.set_content(html)
        printed = PdfReader(io.BytesIO(sheet.pdf(prefer_css_page_size=True))).pages
    assert {(round(one.mediabox.width), round(one.mediabox.height)) for one in printed} == {(595, 420)}
    texts = [one.extract_text() for one in printed]
    assert "<b>" not in texts[0]
    for number, text in enumerate(texts[1:], 2):
        assert "<b> Bottling line" in text
        assert "|{x}" in text  # without the object, which it knows no strings for
        assert f"{number} of {len(texts)}" in text
    assert all(len(one.images) == 1 for one in printed)
