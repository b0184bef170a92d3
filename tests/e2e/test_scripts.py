"""Scripts: what they may do, what they write, how they are stopped; the examples of docs/scripts.md."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .workbench import choose_menu, open_object, open_panel, open_project

pytestmark = pytest.mark.e2e

EXAMPLES = re.findall(
    r"```js\n(.*?)```", (Path(__file__).parents[2] / "docs/scripts.md").read_text("utf-8"), re.S
)
ADD = """async ([name, text]) => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const [project] = await (await fetch('/api/v1/projects')).json();
    const path = `/api/v1/projects/${project.id}/objects`;
    const made = await fetch(path, {method: 'POST', headers, body: JSON.stringify({
        parent_id: null, kind: 'script', name, data: {text}})});
    return {project: project.id, status: made.status, object: (await made.json()).id};
}"""
COPY = """async ([project, object]) => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const path = `/api/v1/projects/${project}/objects/${object}/copy`;
    const made = await fetch(path, {method: 'POST', headers, body: JSON.stringify({parent_id: null})});
    return (await made.json()).name;
}"""


def _add(page: Page, name: str, text: str) -> dict[str, Any]:
    added: dict[str, Any] = page.evaluate(ADD, [name, text])
    assert added["status"] == 201
    return added


def _start(page: Page, name: str) -> Locator:
    choose_menu(page, "Tools", "Scripts", f"Run {name}")
    return page.get_by_role("tabpanel", name="Scripts")


def _run(page: Page, name: str, text: str, state: str = "done") -> Locator:
    """The panel of a script that has just been added and has run."""
    _add(page, name, text)
    panel = _start(page, name)
    expect(panel.get_by_role("status")).to_have_text(state)
    return panel


def test_the_examples_of_the_documentation_run(page: Page) -> None:
    open_project(page)
    look, make = EXAMPLES
    panel = _run(page, "Comments", look)
    expect(panel.get_by_role("log")).to_contain_text("function blocks without a comment")
    panel = _run(page, "Recipe", make)
    expect(panel.get_by_role("log")).to_contain_text("GVL_Recipe has 3 variables")
    expect(page.get_by_role("treeitem").filter(has_text="GVL_Recipe")).to_be_visible()


REACHES = """
const ways = {
  fetch: () => fetch('/api/v1/projects'),
  prototype: () => Object.getPrototypeOf(Object.getPrototypeOf(globalThis)).fetch.call(self, '/api'),
  request: () => new XMLHttpRequest(),
  socket: () => new WebSocket(`ws://${location.host}/api/v1/events`),
  worker: () => new Worker('data:,'),
  database: () => indexedDB.open('x'),
  module: () => import('/assets/x.js'),
  json: () => import('/api/v1/projects', {with: {type: 'json'}}),
  data: () => import('data:text/javascript,export default 1'),
  elsewhere: () => tappet.get('/../../views'),
  users: () => tappet.get('/users'),
  tokens: () => tappet.post('/auth/tokens', {name: 'mine'}),
  trust: () => tappet.put('/me/settings/scripts.trusted', []),
  page: () => document.cookie,
  evaluated: () => new Function('return 1')(),
};
for (const [name, way] of Object.entries(ways)) {
  let reached = true;
  try { await way(); } catch { reached = false; }
  tappet.log(name, reached ? 'REACHED' : 'refused');
}
tappet.log('projects', (await tappet.get('/projects')).length);
"""


def test_a_script_reaches_the_api_alone(page: Page) -> None:
    open_project(page)
    panel = _run(page, "Curious", REACHES)
    log = panel.get_by_role("log")
    expect(log).to_contain_text(re.compile(r"projects \d"))
    text = log.inner_text()
    assert "REACHED" not in text
    assert text.count("refused") == REACHES.count("() =>")


def test_the_worker_has_a_policy_without_connections(page: Page) -> None:
    """So the browser refuses also what is not taken away from the scope of a script."""
    open_project(page)
    _add(page, "First", "tappet.log('there')")
    with page.expect_worker(lambda worker: "scriptWorker-" in worker.url) as started:
        _start(page, "First")
    policy = page.request.get(started.value.url).headers["content-security-policy"]
    assert policy == "default-src 'none'; script-src blob:"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("const a = 1;\nconst b = ;\n", r"Line 2: SyntaxError"),
        ("tappet.log('x');\n\nnull.x;\n", r"Line 3: TypeError"),
        ("const n = 1;\nawait tappet.get('/projects/none');\n", r"Line 2: RequestError: 404"),
        (
            "\nPromise.reject(new Error('alone'));\nawait tappet.sleep(200);\nthrow new Error('end')",
            "Line 2: Error: alone",
        ),
    ],
)
def test_an_error_names_its_line(page: Page, text: str, message: str) -> None:
    open_project(page)
    panel = _run(page, "Faulty", text, "failed")
    place = panel.get_by_role("button", name=re.compile(message)).first
    expect(place).to_be_visible()
    place.click()
    expect(page.locator(".dv-tab").filter(has_text="Faulty")).to_be_visible()
    line = re.search(r"Line (\d)", message)
    assert line is not None
    expect(page.locator("footer[role=status]")).to_contain_text(f"Ln {line[1]}")


def test_an_endless_script_is_stopped(page: Page) -> None:
    open_project(page)
    _add(page, "Endless", "for (;;) tappet.log('again');")
    panel = _start(page, "Endless")
    expect(panel.get_by_role("status")).to_have_text("running…")
    panel.get_by_role("button", name="Stop Script").click()
    expect(panel.get_by_role("status")).to_have_text("stopped")


def test_a_foreign_text_is_shown_before_its_first_run(page: Page) -> None:
    open_project(page)
    added = _add(page, "Own", "tappet.log('mine')")
    copied = page.evaluate(COPY, [added["project"], added["object"]])
    panel = _start(page, copied)
    dialog = page.get_by_role("dialog", name=f"Run {copied}?")
    expect(dialog).to_contain_text("tappet.log('mine')")
    expect(dialog.get_by_role("button", name="Cancel")).to_be_focused()
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(page.get_by_role("tabpanel", name="Scripts")).to_have_count(0)
    _start(page, copied)
    dialog.get_by_role("button", name="Run", exact=True).click()
    expect(panel.get_by_role("status")).to_have_text("done")
    panel.get_by_role("button", name="Clear").click()
    _start(page, copied)
    expect(panel.get_by_role("log")).to_contain_text("mine")


def test_a_script_is_typed_and_run_in_its_editor(page: Page) -> None:
    open_project(page)
    _add(page, "Typed", "")
    page.locator(".dv-tab").filter(has_text="POUs").click()
    page.get_by_role("treeitem").filter(has_text="Typed").dblclick()
    editor = page.locator(".monaco-editor:visible").last
    editor.locator(".view-line").first.click()
    page.keyboard.type("tappet.log(tappet.user.role, 6 * 7);")
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page.get_by_role("tabpanel", name="Scripts").get_by_role("log")).to_contain_text("admin 42")


def test_a_script_is_searched(page: Page) -> None:
    open_project(page)
    _add(page, "Long", "const one = 1;\nconst two = 2;\n")
    open_panel(page, "POUs")
    open_object(page, "Long")
    text = page.locator(".monaco-editor:visible").last
    text.locator(".view-line").nth(1).click()
    page.keyboard.press("Control+f")
    find = page.get_by_role("textbox", name="Find").last
    expect(find).to_be_focused()
    page.keyboard.type("one")
    expect(page.get_by_text(re.compile(r"^[1?] of 1$"))).to_be_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Control+End")
    page.keyboard.press("Control+h")
    expect(page.get_by_role("textbox", name="Replace").last).to_be_visible()
