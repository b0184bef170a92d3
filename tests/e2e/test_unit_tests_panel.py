"""Unit tests in the workbench: results tree, places of failures, filter, and what failed once more."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .conftest import Server, new_profile, start_page
from .workbench import choose_menu, implementation, open_project

pytestmark = pytest.mark.e2e

ADD_SUITE = """async () => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const project = (await (await fetch('/api/v1/projects')).json())[0].id;
    const objects = await (await fetch(`/api/v1/projects/${project}/objects`)).json();
    const add = async (parent_id, kind, name, declaration, implementation) => {
        const answer = await fetch(`/api/v1/projects/${project}/objects`, {method: 'POST', headers,
            body: JSON.stringify({parent_id, kind, name, data: {declaration, implementation}})});
        return (await answer.json()).id;
    };
    const suite = await add(objects.find((o) => o.kind === 'application').id, 'pou', 'FB_Sum_Test',
        'FUNCTION_BLOCK FB_Sum_Test EXTENDS TcUnit.FB_TestSuite', 'Good();\\nBad();\\nWorse();');
    const bodies = {
        Good: "TEST('Good');\\nAssertEquals_INT(2, 1 + 1, 'sum');\\nTEST_FINISHED();",
        Bad: "TEST('Bad');\\n\\nAssertEquals_INT(3, 1 + 1, 'sum');\\nTEST_FINISHED();",
        Worse: "TEST('Worse');\\nzero := 1 / zero;\\nTEST_FINISHED();",
    };
    for (const [name, body] of Object.entries(bodies))
        await add(suite, 'method', name, `METHOD PRIVATE ${name}\\nVAR\\n    zero : INT;\\nEND_VAR`, body);
}"""


def results(page: Page) -> Locator:
    return page.get_by_role("tree", name="Unit Tests")


def row(page: Page, text: str | re.Pattern[str]) -> Locator:
    return results(page).get_by_role("treeitem").filter(has_text=text)


def suite(page: Page, counts: str) -> Locator:
    return row(page, re.compile(rf"FB_Sum_Test\s*{counts}"))


@pytest.fixture
def tested(page: Page) -> Page:
    """The example with a suite of three tests that have run."""
    page.evaluate(ADD_SUITE)
    page.reload()
    open_project(page)
    choose_menu(page, "Build", "Run Tests")
    expect(suite(page, "1 of 3")).to_be_visible()
    return page


def test_the_tree_says_what_came_of_each_test(tested: Page) -> None:
    expect(row(tested, "Good").get_by_label("Passed", exact=True)).to_be_visible()
    expect(row(tested, "Bad").first.get_by_label("Failed", exact=True)).to_be_visible()
    expect(row(tested, "sum: expected 3, but was 2")).to_contain_text("FB_Sum_Test.Bad, line 3")
    expect(row(tested, "division by zero")).to_contain_text("FB_Sum_Test.Worse, line 2")
    panel = tested.get_by_role("tabpanel", name="Unit Tests")
    for count in ("1 passed", "1 failed", "1 with an error", "0 not run"):
        expect(panel.get_by_text(count, exact=True)).to_be_visible()


def test_a_double_click_on_a_failure_leads_to_its_line(tested: Page) -> None:
    row(tested, "sum: expected 3").dblclick()
    expect(tested.locator(".dv-tab").filter(has_text="Bad")).to_be_visible()
    expect(implementation(tested)).to_contain_text("AssertEquals_INT(3")
    expect(tested.locator("footer[role=status]")).to_contain_text(re.compile(r"\b3\b"))


def test_what_is_good_can_be_hidden_and_suites_closed(tested: Page) -> None:
    tested.get_by_label("Only what is not good").check()
    expect(row(tested, "Good")).to_have_count(0)
    expect(row(tested, "division by zero")).to_be_visible()
    suite(tested, "1 of 3").dblclick()
    expect(results(tested).get_by_role("treeitem")).to_have_count(1)


def test_the_filter_runs_only_what_it_names(tested: Page) -> None:
    tested.get_by_label("Only tests with this text").fill("sum_test.good")
    tested.get_by_role("button", name="Run Tests", exact=True).click()
    expect(tested.get_by_text("2 not run", exact=True)).to_be_visible()
    expect(tested.get_by_text("1 passed", exact=True)).to_be_visible()
    expect(tested.get_by_text("0 failed", exact=True)).to_be_visible()


def test_what_failed_runs_again_and_the_others_keep_their_results(tested: Page) -> None:
    row(tested, "sum: expected 3").dblclick()
    editor = implementation(tested)
    expect(editor).to_contain_text("AssertEquals_INT(3")
    editor.locator(".view-line").first.click()
    tested.keyboard.press("Control+a")
    tested.keyboard.type("TEST('Bad');\nAssertEquals_INT(2, 1 + 1, 'sum');\nTEST_FINISHED();")
    tested.keyboard.press("Escape")
    expect(editor).to_contain_text("AssertEquals_INT(2")
    tested.get_by_role("button", name="Run Failed Tests Again").click()
    expect(suite(tested, "2 of 3")).to_be_visible()
    expect(row(tested, "sum: expected 3")).to_have_count(0)
    expect(row(tested, "division by zero")).to_be_visible()
    expect(tested.get_by_text("0 not run", exact=True)).to_be_visible()


def test_results_outlast_the_page_and_say_when_they_are_outdated(tested: Page) -> None:
    tested.reload()
    expect(suite(tested, "1 of 3")).to_be_visible()
    expect(row(tested, "sum: expected 3, but was 2")).to_be_visible()
    outdated = tested.get_by_text("The program has changed since")
    expect(tested.get_by_text("project revision")).to_be_visible()
    expect(outdated).to_have_count(0)
    row(tested, "sum: expected 3").dblclick()
    editor = implementation(tested)
    expect(editor).to_contain_text("AssertEquals_INT(3")
    editor.locator(".view-line").first.click()
    tested.keyboard.press("Control+End")
    tested.keyboard.type(" // later")
    tested.keyboard.press("Control+s")
    expect(outdated).to_be_visible()
    tested.get_by_role("button", name="Run Tests", exact=True).click()
    expect(outdated).to_have_count(0)
    expect(suite(tested, "1 of 3")).to_be_visible()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("theme", "language"), [("dark", "en"), ("light", "en"), ("dark", "zh"), ("light", "zh")]
)
def test_pictures(browser: Browser, server: Server, theme: str, language: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        page.evaluate(ADD_SUITE)
        open_project(page)
        menu, entry, title = (
            ("Build", "Run Tests", "Unit Tests") if language == "en" else ("编译", "运行测试", "单元测试")
        )
        choose_menu(page, menu, entry)
        tree = page.get_by_role("tree", name=title)
        expect(tree.get_by_role("treeitem")).to_have_count(6)
        page.screenshot(path=folder / f"unit-tests-{theme}-{language}.png")
