"""What a page costs the browser: the main thread, the frames a second, and a plain table to compare with."""

from __future__ import annotations

import time

from playwright.sync_api import CDPSession, Page

from .conftest import VIEWPORT

SECONDS = 5.0
FRAMES = """
async ([selector, px]) => {
  const target = selector === null ? null : document.querySelector(selector);
  if (target !== null) target.scrollTop = 0;
  let frames = 0;
  const began = performance.now();
  while (performance.now() - began < %d) {
    if (target !== null) target.scrollTop += px;
    await new Promise(requestAnimationFrame);
    frames += 1;
  }
  return (frames * 1000) / (performance.now() - began);
}
"""

WHEEL = """
async () => {
  const editors = [...document.querySelectorAll('.monaco-editor .editor-scrollable')];
  const editor = editors.filter((each) => each.checkVisibility()).at(-1);
  const began = performance.now();
  let frames = 0;
  while (performance.now() - began < %d) {
    editor.dispatchEvent(new WheelEvent('wheel', { deltaY: 40, bubbles: true, cancelable: true }));
    await new Promise(requestAnimationFrame);
    frames += 1;
  }
  return (frames * 1000) / (performance.now() - began);
}
"""
PLAIN_TABLE = """
([count, pitch, height]) => {
  const rows = Array.from({ length: count }, (_, row) =>
    `<p style="top:${row * pitch}px"><b>v${row}</b><i>DINT</i><u>${row * 37}</u><b></b><b></b></p>`);
  document.body.innerHTML = `<style>
    div { position: relative; overflow: auto; width: 1100px; font: 13px sans-serif; }
    p { position: absolute; display: flex; width: 100%; height: 25px; margin: 0; }
    p { border-bottom: 1px solid #ddd; }
    p > * { width: 200px; overflow: hidden; font: inherit; text-decoration: none; line-height: 25px; }
    </style><div id="table" style="height:${height}px">${rows.join('')}</div>`;
}
"""
"""Rows that nothing changes and no script draws: what the browser itself can do."""
CHANGING = """
() => {
  const values = [...document.querySelectorAll('u')];
  let turn = 0;
  setInterval(() => {
    turn += 1;
    values.forEach((value, row) => { value.firstChild.data = String(row * 37 + turn); });
  }, 100);
}
"""
"""The texts of that table change ten times a second."""
PAINTED = """
async (ms) => {
  const prototype = CanvasRenderingContext2D.prototype;
  const { fillText } = prototype;
  let texts = 0;
  prototype.fillText = function (...text) {
    texts += 1;
    return fillText.apply(this, text);
  };
  const began = performance.now();
  await new Promise((done) => setTimeout(done, ms));
  prototype.fillText = fillText;
  return (texts * 1000) / (performance.now() - began);
}
"""
"""Values painted a second."""


class Load:
    """Measures the page's main thread."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._session: CDPSession = page.context.new_cdp_session(page)
        self._session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def busy(self, name: str, *, scrolled: str | None = None, px: int = 40) -> float:
        """Prints the share of the main thread, and the frames a second, while `scrolled` is scrolled.

        Gives the frames a second.
        """
        before, began = self._counters(), time.monotonic()
        script = WHEEL if scrolled == "text" else FRAMES
        rate = self._page.evaluate(script % int(SECONDS * 1000), [scrolled, px])
        after = self._counters()
        wall = time.monotonic() - began
        parts = ("TaskDuration", "ScriptDuration", "RecalcStyleDuration", "LayoutDuration")
        task, scripts, style, layout = (100.0 * (after[part] - before[part]) / wall for part in parts)
        print(
            f"\n{name}: main thread {task:.0f} %"
            f" (script {scripts:.0f}, style {style:.0f}, layout {layout:.0f}), {rate:.0f} frames/s",
            end="",
        )
        return float(rate)

    def _counters(self) -> dict[str, float]:
        answer = self._session.send("Performance.getMetrics")
        return {metric["name"]: metric["value"] for metric in answer["metrics"]}


class PlainTable:
    """A table without a workbench, in a page of its own: what the same browser makes of it."""

    def __init__(self, page: Page, count: int, pitch: int, height: float) -> None:
        self._beside = page
        self.page = page.context.new_page()
        self._rows = (count, pitch)
        self.resize(height)
        self._load = Load(self.page)

    def resize(self, height: float) -> None:
        """As high as the page beside it, the table in it `height` px."""
        self.page.set_viewport_size(self._beside.viewport_size or VIEWPORT)
        self.page.evaluate(PLAIN_TABLE, [*self._rows, height])

    def busy(self, name: str, *, scrolled: bool = False, changing: bool = False) -> float:
        self.page.bring_to_front()
        if changing:
            self.page.evaluate(CHANGING)
        rate = self._load.busy(f"  {name}", scrolled="#table" if scrolled else None)
        self._beside.bring_to_front()
        return rate


def compare_scrolling(load: Load, plain: PlainTable, name: str, selector: str) -> None:
    """Scrolls by turns, as what else the machine does comes and goes."""
    pairs = [
        (load.busy(name, scrolled=selector), plain.busy("a plain table, scrolled", scrolled=True))
        for _ in range(3)
    ]
    ratios = sorted(ours / theirs for ours, theirs in pairs)
    print(f"\n  {name}: {ratios[1]:.2f} of the frames of a plain table", end="")
