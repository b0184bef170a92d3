"""Watching, writing, forcing and resetting the running machine, through the controls a person uses."""

from __future__ import annotations

import os
import re
import signal
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .conftest import Server
from .workbench import (
    add_line,
    choose_menu,
    delete_line,
    implementation,
    log_in,
    open_object,
    open_panel,
    open_project,
    plc_prg,
    prepare,
    status_bar,
    watch,
    watch_value,
)

pytestmark = pytest.mark.e2e

EMERGENCY_STOP = "GVL_IO.xEmergencyStop"


def test_an_input_is_forced_from_the_watch_list_and_released(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    editor = implementation(page)
    expect(editor).to_contain_text("Execute")
    row = watch(page, EMERGENCY_STOP)
    expect(row).to_contain_text("FALSE")
    prepare(row)
    expect(row).to_contain_text("<TRUE>")
    page.keyboard.press("F7")
    expect(row.get_by_label("forced")).to_be_visible()
    expect(row).not_to_contain_text("<TRUE>")
    expect(editor).to_contain_text("Aborted")
    expect(editor.locator("[class*=forced]").first).to_be_visible()

    forces = open_panel(page, "Forces")
    forced = forces.get_by_role("row").filter(has_text=EMERGENCY_STOP)
    expect(forced).to_contain_text("TRUE")
    page.keyboard.press("Alt+F7")
    expect(forced).to_have_count(0)
    expect(editor).to_contain_text("Aborted")
    expect(editor.locator("[class*=forced]")).to_have_count(0)

    reset = watch(page, "GVL_IO.xResetButton")
    prepare(reset)
    page.keyboard.press("F7")
    expect(editor).to_contain_text("Stopped")
    page.keyboard.press("Alt+F7")


def test_a_value_clicked_in_the_editor_is_written(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    row = watch(page, "GVL_IO.diCaps")
    expect(row).to_contain_text("DINT")
    prepare(row, "twelve")
    expect(page.get_by_text(re.compile("DINT.*whole number|whole number.*DINT", re.I)).first).to_be_visible()
    page.keyboard.press("Control+A")
    page.keyboard.type("1234")
    page.keyboard.press("Enter")
    expect(row).to_contain_text("<1234>")
    page.keyboard.press("Control+F7")
    expect(row).not_to_contain_text("<1234>")
    expect(row).to_contain_text(re.compile(r"12[0-3]\d"))


def test_resets_keep_what_they_promise(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    total = watch(page, "PersistentVars.udiOperatingTime")
    recipe = watch(page, "GVL_Line.iRecipe")
    prepare(recipe, "2")
    page.keyboard.press("Control+F7")
    expect(recipe.get_by_role("gridcell").nth(2)).to_have_text("2")
    running = int(watch_value(total, at_least=1))

    choose_menu(page, "Online", "Reset warm")
    page.get_by_role("dialog").get_by_role("button", name="Reset warm").click()
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
    expect(recipe.get_by_role("gridcell").nth(2)).to_have_text("1")
    page.wait_for_timeout(1_000)  # a row may lag behind by some frames, and nothing says that it does not
    kept = int(watch_value(total, at_least=running))

    choose_menu(page, "Online", "Reset cold")
    page.get_by_role("dialog").get_by_role("button", name="Reset cold").click()
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
    assert int(watch_value(total, at_least=kept)) == kept
    page.keyboard.press("F5")
    expect(status_bar(page).get_by_text("running")).to_be_visible()


def test_logging_out_leaves_the_machine_running(page: Page) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    row = watch(page, "PersistentVars.udiOperatingTime")
    before = int(watch_value(row, at_least=1))
    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()
    page.wait_for_timeout(2500)
    log_in(page)
    assert int(watch_value(row, at_least=before + 2)) >= before + 2


def test_an_exception_names_its_place_and_a_reset_ends_it(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iLoaded := 7 / LEN('');")
    log_in(page, expected="exception")
    report = open_panel(page, "Call Stack")
    expect(report).to_contain_text("Division by zero")
    expect(report).to_contain_text("PLC_PRG, line 2, task MainTask")
    editor.locator(".view-line").last.click()
    report.get_by_role("button", name="Go to place").click()
    expect(page.get_by_text("Ln 2, Col")).to_be_visible()

    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()
    delete_line(page, editor, 2)
    log_in(page, expected="exception")
    report.get_by_role("button", name="Reset warm").click()
    page.get_by_role("dialog").get_by_role("button", name="Reset warm").click()
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
    page.keyboard.press("F5")
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    expect(editor).to_contain_text("Execute")


def test_a_killed_runtime_is_noticed_and_comes_back_with_its_values(page: Page, server: Server) -> None:
    open_project(page)
    open_object(page, "PLC_PRG")
    log_in(page)
    row = watch(page, "PersistentVars.udiOperatingTime")
    before = int(watch_value(row, at_least=2))
    (victim,) = [
        int(path.name)
        for path in Path("/proc").glob("[0-9]*")
        if f"{server.data}/data/runtime".encode() in _command_line(path)
    ]
    os.kill(victim, signal.SIGKILL)
    expect(page.get_by_text(re.compile("lost", re.IGNORECASE)).first).to_be_visible()
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    assert int(watch_value(row, at_least=before - 1)) >= before - 1


def _command_line(process: Path) -> bytes:
    try:
        return (process / "cmdline").read_bytes()
    except OSError:
        return b""


def test_a_page_loaded_anew_is_online_as_before(page: Page) -> None:
    open_project(page)
    log_in(page)
    page.reload()
    expect(status_bar(page).get_by_text("running")).to_be_visible()
    watch_value(watch(page, "GVL_Line.udiFilled"), at_least=1)
    page.keyboard.press("Control+F8")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()
    page.reload()
    open_object(page, "PLC_PRG")
    expect(status_bar(page).get_by_text("Offline")).to_be_visible()
