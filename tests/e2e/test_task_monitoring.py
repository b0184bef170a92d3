"""The monitoring page of the task configuration: times, load and histograms while a controller runs."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from .workbench import log_in, open_object, open_project

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
    chosen.locator("rect").nth(3).hover(force=True)
    expect(chosen.get_by_role("status")).to_contain_text("up to here")
    task = rows.nth(2)
    task.click()
    name = task.get_by_role("gridcell").first.inner_text()
    expect(page.get_by_role("figure", name=f"Jitter of {name}")).to_be_visible()
