"""Editing, building, downloading and commissioning the example machine in a real browser."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from .conftest import Server
from .workbench import (
    add_line,
    delete_line,
    implementation,
    log_in,
    message_rows,
    open_object,
    open_project,
    plc_prg,
    status_bar,
    text_of,
)

pytestmark = pytest.mark.e2e


def test_a_build_error_is_listed_leads_to_its_place_and_is_mended(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "GVL_Line.iRecipe := 'three';")
    page.keyboard.press("F11")
    row = message_rows(page).filter(has_text="STRING")
    expect(row).to_contain_text("E0301")
    expect(row).to_contain_text("Line 2")
    page.keyboard.press("Control+Home")
    row.dblclick()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()
    delete_line(page, editor, 2)
    page.keyboard.press("F11")
    expect(message_rows(page)).to_have_count(0)
    expect(page.get_by_text(re.compile(r"built in [\d.]+ s"))).to_be_visible()


def test_an_edit_of_one_line_runs_after_an_online_change(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "GVL_Line.stRecipe.lrBelt := 123.0;")
    log_in(page)
    expect(editor).to_contain_text("123")


def test_two_users_on_one_object_lose_nothing(page: Page, browser_two: Page) -> None:
    for one in (page, browser_two):
        open_project(one)
        open_object(one, "PLC_PRG")
        expect(implementation(one)).to_contain_text("xSafe")
    first, second = implementation(page), implementation(browser_two)
    add_line(page, first, "// written by the first")
    page.keyboard.press("Control+S")
    expect(second).to_contain_text("written by the first".replace(" ", "\xa0"))
    assert "written by the first" in text_of(first)


@pytest.fixture
def browser_two(browser: Browser, server: Server) -> Iterator[Page]:
    other = browser.new_context()
    opened = other.new_page()
    opened.goto(server.fresh_link())
    yield opened
    other.close()


PICTURE = """() => new Promise((done, fail) => {
    setTimeout(() => fail(new Error('no frame was drawn')), 20000);
    requestAnimationFrame(() => {
        const [scene] = [...document.querySelectorAll('canvas')].sort((a, b) => b.width - a.width);
        const small = Object.assign(document.createElement('canvas'), {width: 320, height: 200});
        small.getContext('2d').drawImage(scene, 0, 0, 320, 200);
        done(small.toDataURL());
    });
})"""
"""The scene as it is drawn in this moment, small."""


def wait_for_pictures(page: Page, *, moving: bool) -> None:
    """Pictures a second apart differ while bottles move, and are the same when they stand."""
    view = page.locator("[data-testid=scene-view]").element_handle().content_frame()
    assert view is not None
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        before = view.evaluate(PICTURE)
        page.wait_for_timeout(1000)
        if (view.evaluate(PICTURE) != before) is moving:
            return
    raise AssertionError("nothing moves" if moving else "something still moves")


def test_the_3d_view_shows_the_plant_behind_the_login(page: Page, browser: Browser, server: Server) -> None:
    page.set_viewport_size({"width": 1000, "height": 640})
    open_project(page)
    open_object(page, "Plant3D")
    frame = page.frame_locator("[data-testid=scene-view]")
    expect(frame.locator("canvas").first).to_be_visible(timeout=30_000)
    wait_for_pictures(page, moving=True)
    log_in(page)
    page.keyboard.press("Shift+F8")
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
    wait_for_pictures(page, moving=False)
    page.keyboard.press("F5")
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    path = page.locator("[data-testid=scene-view]").get_attribute("src")
    stranger = browser.new_context()
    answer = stranger.request.get(f"{server.address}{path}")
    stranger.close()
    assert answer.status == 401
