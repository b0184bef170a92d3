"""What each frame of a page costs: the distance of frames, and the main thread's time in each of them.

The distances are those of animation frames. The work comes from Chromium's own trace: tasks of the main
thread with their processor time,
without what else runs on the machine, put into the frame that ends behind them.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from statistics import median
from typing import Any

from playwright.sync_api import Browser, Page

CATEGORIES = ["toplevel", "devtools.timeline", "disabled-by-default-devtools.timeline"]
PARTS = {
    "script": ("FunctionCall", "EvaluateScript", "RunMicrotasks", "FireAnimationFrame", "TimerFire"),
    "style and layout": ("UpdateLayoutTree", "Layout", "PrePaint"),
    "paint": ("Paint", "Layerize", "Commit"),
}
COLLECT = """
() => {
  window.frameTimes = [];
  const next = (at) => {
    window.frameTimes.push(at);
    window.nextFrame = requestAnimationFrame(next);
  };
  window.nextFrame = requestAnimationFrame(next);
}
"""
COLLECTED = "() => { cancelAnimationFrame(window.nextFrame); return window.frameTimes; }"


@dataclass
class Frames:
    """What was measured."""

    distances: list[float] = field(default_factory=list)
    """Milliseconds from a frame to the next one."""
    work: list[float] = field(default_factory=list)
    """Milliseconds of processor time of the main thread, a frame."""
    parts: dict[str, float] = field(default_factory=dict)
    """The same by kind of work: the mean of all frames."""
    threads: dict[str, float] = field(default_factory=dict)
    """Milliseconds a frame that each thread of the browser has worked."""

    def text(self) -> str:
        distance, work = _middle(self.distances), _middle(self.work)
        parts = ", ".join(f"{name} {ms:.1f}" for name, ms in self.parts.items())
        return f"{distance} ms from frame to frame, main thread {work} ms ({parts}), {len(self.work)} frames"


def _middle(values: list[float]) -> str:
    rising = sorted(values)
    return f"{median(rising):.1f} (95 %: {rising[int(0.95 * (len(rising) - 1))]:.1f})"


@contextmanager
def frames_of(browser: Browser, page: Page) -> Iterator[Frames]:
    """Measures until the block ends; what was measured is there then."""
    found = Frames()
    session = browser.new_browser_cdp_session()
    events: list[dict[str, Any]] = []
    complete: list[bool] = []
    session.on("Tracing.dataCollected", lambda message: events.extend(message["value"]))
    session.on("Tracing.tracingComplete", lambda _: complete.append(True))
    config = {"includedCategories": CATEGORIES, "excludedCategories": ["*"]}
    session.send("Tracing.start", {"transferMode": "ReportEvents", "traceConfig": config})
    page.evaluate(COLLECT)
    yield found
    times = page.evaluate(COLLECTED)
    session.send("Tracing.end")
    while not complete:
        page.wait_for_timeout(20)
    session.detach()
    found.distances += [after - before for before, after in pairwise(times)]
    _read(events, found)


def _read(events: list[dict[str, Any]], found: Frames) -> None:
    names = {
        (each["pid"], each["tid"]): each["args"]["name"]
        for each in events
        if each["ph"] == "M" and each["name"] == "thread_name"
    }
    frames = [each for each in events if each["name"] == "FireAnimationFrame"]
    main, _ = Counter((each["pid"], each["tid"]) for each in frames).most_common(1)[0]
    tasks = _outermost(events, lambda each: "RunTask" in each["name"])
    own = sorted((each for each in tasks if (each["pid"], each["tid"]) == main), key=lambda one: one["ts"])
    # The task that calls animation frames, however many there are, goes on to paint: a frame ends with it.
    begins = [each["ts"] for each in own]
    drawing = {bisect_right(begins, each["ts"]) - 1 for each in frames if (each["pid"], each["tid"]) == main}
    ends = [own[number]["ts"] + own[number]["dur"] for number in sorted(drawing)]
    count = max(1, len(ends) - 1)
    threads: dict[str, float] = defaultdict(float)
    for each in tasks:
        if ends[0] <= each["ts"] < ends[-1]:
            thread = (each["pid"], each["tid"])
            name = "main" if thread == main else names.get(thread, "?")
            threads[name] += _ms(each) / count
    found.threads = dict(sorted(threads.items(), key=lambda one: -one[1]))
    work = [0.0] * (len(ends) - 1)
    for each in own:
        at = bisect_right(ends, each["ts"]) - 1
        if 0 <= at < len(work):
            work[at] += _ms(each)
    found.work += work
    for part, kinds in PARTS.items():
        of_main = [
            each
            for each in _outermost(events, lambda one, kinds=kinds: one["name"] in kinds)  # type: ignore[misc]
            if (each["pid"], each["tid"]) == main and ends[0] <= each["ts"] < ends[-1]
        ]
        found.parts[part] = sum(map(_ms, of_main)) / count


def _ms(event: dict[str, Any]) -> float:
    return float(event.get("tdur", event["dur"])) / 1000


def _outermost(
    events: list[dict[str, Any]], wanted: Callable[[dict[str, Any]], bool]
) -> list[dict[str, Any]]:
    """Complete events of a kind that lie in no other one of their kind."""
    found = []
    ends: dict[tuple[int, int], float] = defaultdict(float)
    for each in sorted(
        (one for one in events if one["ph"] == "X" and wanted(one)), key=lambda one: (one["ts"], -one["dur"])
    ):
        thread = (each["pid"], each["tid"])
        if each["ts"] >= ends[thread]:
            ends[thread] = each["ts"] + each["dur"]
            found.append(each)
    return found
