"""The task configuration: system events and groups, and the measured times while a controller runs."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, Request, expect

from .api import change, example, stored
from .conftest import Server
from .workbench import log_in, objects_stored, open_object, open_project

pytestmark = pytest.mark.e2e


def test_load_and_histograms_of_the_tasks_are_drawn(page: Page) -> None:
    """TASK-60: while logged in the task configuration opens with the measured times of its tasks."""
    open_project(page)
    log_in(page)
    open_object(page, "Task Configuration")
    rows = page.get_by_role("grid", name="Tasks").get_by_role("row")
    expect(rows.filter(has_text="MainTask")).to_contain_text("Valid")
    load = page.get_by_role("figure", name="Load")
    expect(load.get_by_role("listitem").filter(has_text="MainTask")).to_contain_text(re.compile(r"\d %"))
    expect(load.get_by_role("listitem").filter(has_text="Processor").first).to_contain_text(
        re.compile(r"\d %")
    )
    chosen = page.get_by_role("figure", name=re.compile("^Execution time of "))
    expect(chosen.locator("rect").first).to_be_visible()
    chosen.locator("rect:not([height='0'])").last.hover(force=True)
    expect(chosen.get_by_role("status")).to_contain_text("up to here")
    task = rows.nth(2)
    task.click()
    name = task.get_by_role("gridcell").first.inner_text()
    expect(page.get_by_role("figure", name=f"Jitter of {name}")).to_be_visible()


def test_a_function_is_coupled_to_an_event_and_its_calls_are_counted(page: Page, server: Server) -> None:
    """TASK-05: add, download, and the counter of calls."""
    open_project(page)
    project = example(page, server)
    before = stored(page, server, project, "Task Configuration")["data"]
    open_object(page, "Task Configuration")
    page.get_by_role("tab", name="System Events").click()
    page.get_by_role("button", name="Add event handler").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("combobox", name="Event")).to_have_text("StartDone")
    with objects_stored(page):
        dialog.get_by_role("button", name="Add").click()
    function = page.get_by_role("textbox", name="Function to call at StartDone")
    expect(function).to_have_value("OnStartDone")
    expect(page.get_by_role("treeitem").filter(has_text="OnStartDone")).to_be_visible()
    try:
        log_in(page)
        page.get_by_role("tab", name="System Events").click()
        row = page.get_by_role("row").filter(has_text="StartDone")
        expect(row.get_by_role("cell").nth(4)).to_have_text(re.compile("^[0-9]+$"))
    finally:
        page.keyboard.press("Control+F8")
        change(page, server, project, "Task Configuration", **before)


def test_times_are_asked_for_as_often_as_values(page: Page) -> None:
    """TASK-58: the times of the tasks are asked for several times between two questions for the load."""
    open_project(page)
    log_in(page)
    asked: list[str] = []

    def note(request: Request) -> None:
        if (name := request.url.rpartition("/")[2].partition("?")[0]) in ("tasks", "load"):
            asked.append(name)

    page.on("request", note)
    open_object(page, "Task Configuration")
    expect(page.get_by_role("grid", name="Tasks").get_by_role("row").nth(1)).to_be_visible()
    while " tasks tasks tasks tasks " not in f" {' '.join(asked)} " and asked.count("load") < 30:
        page.wait_for_event("request")
    page.remove_listener("request", note)
    assert asked.count("load") < 30


def test_the_event_of_a_task_is_chosen_from_the_global_variables(page: Page) -> None:
    """TASK-18: F2 lists the variables. TASK-06, TASK-07: no tab of parameters, which no device describes."""
    open_project(page)
    open_object(page, "AlarmTask")
    page.get_by_role("combobox", name="Type").last.click()
    page.get_by_role("option", name="Event", exact=True).click()
    field = page.get_by_label("Event", exact=True)
    field.click()
    page.keyboard.press("F2")
    assistant = page.get_by_role("dialog")
    expect(assistant).to_be_visible()
    page.keyboard.type("xStartButton")
    assistant.get_by_text("xStartButton").first.dblclick()
    if assistant.count():
        page.keyboard.press("Enter")
    expect(field).to_have_value(re.compile("xStartButton"))
    page.get_by_role("button", name="Choose a variable").click()
    expect(page.get_by_role("dialog")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("tab", name=re.compile("Parameter"))).to_have_count(0)
