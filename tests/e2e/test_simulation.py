"""A device set to simulation, and single cycles of a stopped machine."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .conftest import Server
from .workbench import answer_to, choose_menu, log_in, open_project, status_bar, tree_item, watch, watch_value

pytestmark = pytest.mark.e2e


def test_a_simulated_device_needs_no_hardware(page: Page, server: Server) -> None:
    """LST-88: the path leads to a controller that is not there; with Simulation the application runs beside
    the server, and all online functions are those of the real one."""
    headers = {"X-Tappet-Client": "1", "Origin": server.address}
    runtimes = f"{server.address}/api/v1/runtimes"
    absent = {"name": "Absent", "url": "ws://127.0.0.1:9/", "token": "none"}
    answer = page.request.post(runtimes, headers=headers, data=absent)
    assert answer.ok, answer.text()
    try:
        open_project(page)
        tree_item(page, "Tappet Soft PLC").dblclick()
        absent_choice = page.get_by_role("radio", name="Absent")
        absent_choice.click()
        expect(absent_choice).to_be_checked()
        page.get_by_label("Simulation").check()
        expect(page.get_by_role("radio", name="Local")).to_be_checked()
        page.keyboard.press("Control+s")
        log_in(page)
        expect(status_bar(page).get_by_text("simulation")).to_be_visible()
        watch_value(watch(page, "GVL_Line.udiFilled"), at_least=1)
    finally:
        page.request.delete(f"{runtimes}/{answer.json()['id']}", headers=headers)


def test_single_cycles_of_a_stopped_machine(page: Page, server: Server) -> None:
    """LST-84 from the menu: each order is one cycle of each task."""

    def cycles() -> list[int]:
        tasks = page.request.get(f"{server.address}/api/v1/runtimes/local/tasks").json()
        return [task["iec_cycles"] for task in tasks]

    open_project(page)
    log_in(page)
    page.keyboard.press("Shift+F8")
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
    before = cycles()
    for ordered in (1, 2):
        with answer_to(page, "/single-cycle"):
            choose_menu(page, "Debug", "Single Cycle")
        assert cycles() == [count + ordered for count in before]
    expect(status_bar(page).get_by_text("stopped")).to_be_visible()
