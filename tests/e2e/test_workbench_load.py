"""What the workbench costs the browser: live values, editors, the first page. Figures with `pytest -s`.

Shares are processor time of the page's main thread by wall time, as Chromium counts it (`TaskDuration` of its
thread's own clock, so that what else runs on the machine does not count).
"""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from playwright.sync_api import (
    APIRequestContext,
    Browser,
    Locator,
    Page,
    WebSocket,
    expect,
)

from . import optimising_browser
from .conftest import Server
from .frame_times import frames_of
from .main_thread import FRAMES, PAINTED, SECONDS, Load, PlainTable, compare_scrolling
from .workbench import implementation, log_in, open_object, open_panel, open_project

pytestmark = [pytest.mark.e2e, pytest.mark.slow]
browser, profile = optimising_browser.browser, optimising_browser.profile

PROJECT = "Thousand values"
VARIABLES = 1000
ROW_PX = 26
WATCH_LIST = "[aria-label='Watch 1'][role=treegrid]"
NUMBER = re.compile(r"\d+")
OPENED = """
async ([name, shown]) => {
  const rows = [...document.querySelectorAll('[role=treeitem]')];
  const row = rows.find((each) => each.textContent.trim().startsWith(name));
  const began = performance.now();
  row.dispatchEvent(new MouseEvent('dblclick', { bubbles: true, cancelable: true }));
  while (performance.now() - began < 20000) {
    const group = document.querySelector('.dv-groupview.dv-active-group');
    const tab = group?.querySelector('.dv-active-tab');
    const busy = [...document.querySelectorAll('[aria-busy]')].some((each) => each.checkVisibility());
    const content = [...(group?.querySelectorAll(shown) ?? [])].find((each) => each.checkVisibility());
    if (tab?.textContent.includes(name) && !busy && content !== undefined && content.textContent !== '')
      return performance.now() - began;
    await new Promise(requestAnimationFrame);
  }
  return null;
}
"""
LATENCY = """
() => {
  window.latencies = [];
  document.addEventListener('keydown', (event) => requestAnimationFrame(() =>
    setTimeout(() => window.latencies.push(performance.now() - event.timeStamp))), true);
}
"""
"""From a key to the picture that has its text."""
TEXT = ".view-line span span"
EDITORS = [
    ("PLC_PRG", TEXT),
    ("GVL_IO", TEXT),
    ("GVL_Line", TEXT),
    ("GVL_Plant", TEXT),
    ("Library Manager", ".dv-content-container [role=treegrid], .dv-content-container [role=grid]"),
    ("MainTask", ".dv-content-container label"),
    ("Tappet Soft PLC", ".dv-content-container label"),
    ("PersistentVars", TEXT),
]


SCREEN_4K = 3840 * 2160

BIG_LINES = 5000
"""Lines of the body of the large text."""
ADDED = {"SmallIl": "IL", "LargeSt": "ST", "AnotherSt": "ST"}
"""Programs beside those of the example, with their languages."""


class Subscriptions:
    """What the page asks the online socket for."""

    def __init__(self, page: Page) -> None:
        self._asked: dict[int, list[str]] = {}
        page.on("websocket", self._opened)

    def _opened(self, socket: WebSocket) -> None:
        if "/online" in socket.url:
            socket.on("framesent", self._sent)

    def _sent(self, frame: str | bytes) -> None:
        if isinstance(frame, bytes):
            return
        message = json.loads(frame)
        if message.get("op") == "subscribe":
            self._asked[message["id"]] = message["expressions"]
        elif message.get("op") == "unsubscribe":
            self._asked.pop(message["id"], None)

    def expressions(self) -> list[str]:
        """All that is asked for at present."""
        return [expression for asked in self._asked.values() for expression in asked]


def make_project(request: APIRequestContext, server: Server) -> str:
    """A running application whose variables change in every cycle; the id of its project."""
    api = f"{server.address}/api/v1"
    headers = {"X-Tappet-Client": "1", "Origin": server.address}

    def send(method: str, path: str, body: object) -> Any:
        answer = request.fetch(api + path, method=method, headers=headers, data=body)
        assert answer.ok, f"{method} {path}: {answer.status} {answer.text()}"
        return answer.json() if answer.text() else None

    project = send("POST", "/projects", {"name": PROJECT})["id"]
    path = f"/projects/{project}"
    objects = request.get(f"{api}{path}/objects").json()
    found = {each["kind"]: each for each in objects}
    application, program = found["application"], found["pou"]
    types = ("DINT", "LREAL", "BOOL", "TIME")
    names = [f"v{number:04d}" for number in range(VARIABLES)]
    declared = "\n".join(f"  {name} : {types[number % 4]};" for number, name in enumerate(names))
    send(
        "POST",
        f"{path}/objects",
        {
            "parent_id": application["id"],
            "kind": "gvl",
            "name": "GVL_Values",
            "data": {"declaration": f"VAR_GLOBAL\n{declared}\nEND_VAR"},
        },
    )
    step = {"DINT": "{0} := {0} + 1;", "LREAL": "{0} := {0} + 0.25;", "BOOL": "{0} := NOT {0};"}
    step["TIME"] = "{0} := {0} + T#20ms;"
    # A BOOL that changes in each cycle of 20 ms is the same in every fifth; the counter decides instead.
    step["BOOL"] = "{0} := (v0000 / 5) MOD 2 = 0;"
    lines = [step[types[number % 4]].format(name) for number, name in enumerate(names)]
    detail = request.get(f"{api}{path}/objects/{program['id']}").json()
    data = detail["data"] | {"implementation": "\n".join(lines)}
    send("PUT", f"{path}/objects/{program['id']}", {"base_revision": detail["revision"], "data": data})
    send("PUT", f"/me/settings/watch.{project}", {"1": names})
    send(
        "POST",
        f"{path}/applications/{application['id']}/download",
        {"runtime_id": "local", "mode": "download", "start": True},
    )
    return str(project)


@pytest.fixture
def subscriptions(page: Page, server: Server) -> Subscriptions:
    """The page logged in to the application of many values."""
    make_project(page.request, server)
    seen = Subscriptions(page)
    page.goto(server.address)
    open_project(page, PROJECT)
    log_in(page)
    return seen


def test_a_thousand_values_on_screen(page: Page, subscriptions: Subscriptions) -> None:
    """A table in a window of usual height, still and scrolled, then in one as high as its 1,000 rows."""
    load = Load(page)
    load.busy("logged in, no values shown")
    page.set_viewport_size({"width": 1440, "height": 1200})
    open_object(page, "GVL_Values")
    table = page.get_by_role("treegrid").filter(has_text="v0000").first
    cell = table.get_by_role("row").filter(has_text="v0000").get_by_role("gridcell").nth(2)
    expect(cell).to_have_text(NUMBER)
    first = cell.text_content()
    load.busy("table, 1,000 rows in a window of 1,200 px")
    assert cell.text_content() != first
    assert 0 < len(subscriptions.expressions()) < 200
    plain = PlainTable(page, VARIABLES, ROW_PX, table.evaluate("table => table.clientHeight"))
    compare_scrolling(load, plain, "table, scrolled", "[role=treegrid]")
    page.set_viewport_size({"width": 1440, "height": int(VARIABLES * ROW_PX * 1.6)})
    expect(table.get_by_role("row")).to_have_count(VARIABLES + 1)
    load.busy("table, 1,000 values on screen")
    painted = page.evaluate(PAINTED, SECONDS * 1000)
    print(f"\n  each value is painted {painted / VARIABLES:.1f} times a second", end="")
    assert painted > VARIABLES
    plain.resize(VARIABLES * ROW_PX)
    plain.busy("a plain table, 1,000 texts changed at 10 Hz", changing=True)
    plain.page.close()


def test_a_thousand_values_on_the_pixels_of_one_screen(page: Page, subscriptions: Subscriptions) -> None:
    """The 1,000 rows again, so small that they have the pixels of a 4K screen."""
    size = {"width": 1440, "height": int(VARIABLES * ROW_PX * 1.6)}
    metrics = {"deviceScaleFactor": (SCREEN_4K / (size["width"] * size["height"])) ** 0.5, "mobile": False}
    open_object(page, "GVL_Values")
    session = page.context.new_cdp_session(page)
    session.send("Emulation.setDeviceMetricsOverride", {**size, **metrics})
    table = page.get_by_role("treegrid").filter(has_text="v0000").first
    expect(table.get_by_role("row")).to_have_count(VARIABLES + 1)
    page.wait_for_timeout(3000)
    Load(page).busy("table, 1,000 values on the pixels of a 4K screen")
    painted = page.evaluate(PAINTED, SECONDS * 1000)
    print(f"\n  each value is painted {painted / VARIABLES:.1f} times a second", end="")
    assert painted > VARIABLES
    session.send("Emulation.clearDeviceMetricsOverride")


def test_a_thousand_values_in_a_watch_list(
    page: Page, browser: Browser, subscriptions: Subscriptions
) -> None:
    """What no row on screen shows is neither in the page nor asked for once its type is known, wherever one
    scrolls."""
    open_panel(page, "Watch 1")
    table = page.get_by_role("treegrid", name="Watch 1")

    def value_of(name: str) -> Locator:
        return table.get_by_role("row").filter(has_text=name).get_by_role("gridcell").nth(2)

    def is_lean(shown: str, hidden: str) -> None:
        """One value changes, another is not asked for, and neither are most of the others."""
        expect(value_of(shown)).to_have_text(NUMBER)
        before = value_of(shown).text_content() or ""
        expect(value_of(shown)).not_to_have_text(before)
        page.wait_for_timeout(3000)
        asked = subscriptions.expressions()
        rows = table.get_by_role("row").count()
        print(f"\n  at {shown}: {rows} rows in the page, {len(asked)} expressions asked for", end="")
        assert shown in asked
        assert hidden not in asked
        assert len(asked) < 200
        assert rows < 100

    is_lean("v0000", "v0900")
    load = Load(page)
    load.busy("watch list of 1,000 rows, some on screen")
    with frames_of(browser, page) as still:
        page.wait_for_timeout(SECONDS * 1000)
    with frames_of(browser, page) as scrolled:
        page.evaluate(FRAMES % int(SECONDS * 1000), [WATCH_LIST, 40])
    print(f"\n  values change: {still.text()}\n  and the list is scrolled: {scrolled.text()}", end="")
    plain = PlainTable(page, VARIABLES, ROW_PX, table.evaluate("table => table.clientHeight"))
    compare_scrolling(load, plain, "watch list, scrolled", WATCH_LIST)
    plain.page.close()
    table.get_by_role("row").nth(1).get_by_role("gridcell").nth(1).click()
    page.keyboard.press("Control+End")
    is_lean("v0996", "v0000")
    painted = page.evaluate(PAINTED, SECONDS * 1000)
    print(f"\n  {painted:.0f} values are painted a second", end="")
    assert painted < VARIABLES
    page.keyboard.press("Control+Home")
    is_lean("v0000", "v0900")


def test_a_text_with_many_values(page: Page, subscriptions: Subscriptions) -> None:
    """Values behind the variables of a text, in a window of 3,200 px, and scrolled in one of 1,200 px."""
    load = Load(page)
    page.set_viewport_size({"width": 1440, "height": 3200})
    open_object(page, "PLC_PRG")
    pills = implementation(page).locator("[class*=pill]")
    expect(pills.nth(20)).to_be_visible()
    load.busy(f"text, {pills.count()} values on screen")
    page.set_viewport_size({"width": 1440, "height": 1200})
    page.wait_for_timeout(1000)
    load.busy("text in a window of 1,200 px")
    load.busy("text, scrolled", scrolled="text")
    assert pills.count() > 0


def add_programs(request: APIRequestContext, server: Server) -> None:
    """Programs in other languages and sizes, in the example."""
    api = f"{server.address}/api/v1"
    headers = {"X-Tappet-Client": "1", "Origin": server.address}
    project = next(each for each in request.get(f"{api}/projects").json() if each["name"] == "Bottling line")
    objects = f"{api}/projects/{project['id']}/objects"
    application = next(each for each in request.get(objects).json() if each["kind"] == "application")
    for name, language in ADDED.items():
        lines = (
            ["LD 1", "ST n"] if language == "IL" else ["n := n + 1;"] * (BIG_LINES if "Large" in name else 5)
        )
        data = {
            "declaration": f"PROGRAM {name}\nVAR\n  n : INT;\nEND_VAR",
            "implementation": "\n".join(lines),
            "language": language,
        }
        order = {"parent_id": application["id"], "kind": "pou", "name": name, "data": data}
        answer = request.post(objects, headers=headers, data=order)
        assert answer.ok, answer.text()


def test_opening_editors(page: Page, server: Server) -> None:
    """From the double click until the editor shows its content: the first one, and each further one."""
    add_programs(page.request, server)
    open_project(page)
    table = ".dv-content-container [role=treegrid], .dv-content-container [role=grid]"
    added = [(name, table if language == "IL" else TEXT) for name, language in ADDED.items()]
    page.wait_for_timeout(3000)
    for name, shown in EDITORS + added:
        taken = page.evaluate(OPENED, [name, shown])
        assert taken is not None, f"{name} was not shown"
        print(f"\n{name} opened: {taken:.0f} ms", end="")
        page.wait_for_timeout(1500)


def test_a_3d_view_beside_the_workbench(page: Page, server: Server) -> None:
    """Frames of the workbench, and the time from a key to its text, without and with a scene that moves."""
    load = Load(page)
    open_project(page)
    page.evaluate(LATENCY)
    for name in ("no 3D view", "3D view open"):
        load.busy(name)
        page.keyboard.press("Control+p")
        page.wait_for_timeout(500)
        page.evaluate("() => { window.latencies = []; }")
        for key in "plc_prg_line":
            page.keyboard.press(key)
            page.wait_for_timeout(150)
        page.keyboard.press("Escape")
        page.wait_for_timeout(500)
        taken = sorted(page.evaluate("() => window.latencies"))
        print(f"\n  key to text: median {taken[len(taken) // 2]:.0f} ms, longest {taken[-1]:.0f} ms", end="")
        if name == "no 3D view":
            open_object(page, "Plant3D")
            expect(page.frame_locator("[data-testid=scene-view]").locator("canvas").first).to_be_visible()
            page.wait_for_timeout(15_000)


def test_the_first_page(browser: Browser, server: Server) -> None:
    """Bytes as they come over the wire until the login page stands, and the start page."""
    for name, address in (("login page", server.address), ("start page", server.fresh_link())):
        profile = browser.new_context()
        page = profile.new_page()
        session = profile.new_cdp_session(page)
        session.send("Network.enable")
        sizes: list[float] = []
        session.on(
            "Network.loadingFinished", lambda event, sizes=sizes: sizes.append(event["encodedDataLength"])
        )
        page.goto(address)
        expect(page.get_by_role("button").first).to_be_visible()
        page.wait_for_timeout(3000)
        print(f"\n{name}: {sum(sizes) / 1000:.0f} kB in {len(sizes)} answers", end="")
        assert sizes
        profile.close()
