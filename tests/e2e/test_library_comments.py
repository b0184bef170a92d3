"""Comments of SM3_Basic are in the language of the workbench, also when that changes while they are shown."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from .test_language import show, switch
from .ui import Ui
from .workbench import open_project

pytestmark = pytest.mark.e2e


def test_comments_of_blocks_follow_the_language(page: Page) -> None:
    open_project(page)
    show(page, "en", "panel.libraries")
    page.get_by_label(Ui(page, "en").text("libraries.search")).fill("MC_MoveAbsolute")
    page.get_by_role("treeitem", name="MC_MoveAbsolute").dblclick()
    described = page.get_by_role("article")
    expect(described).to_contain_text("Moves the axis to a position.")
    expect(described).to_contain_text("Target [u]")
    switch(page, "en", "zh")
    expect(described).to_contain_text("使轴运动到一个位置。")
    expect(described).to_contain_text("目标位置 [u]")
    expect(described).not_to_contain_text("Target")
    switch(page, "zh", "en")
    expect(described).to_contain_text("Moves the axis to a position.")
