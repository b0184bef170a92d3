"""A recording of ten million samples is panned and zoomed. Figures with `pytest -s`.

Beside them stands what the same browser makes of a plain uPlot of the same size with fixed data, in a page of
its own: the machine and its (software) rendering are in both.
"""

from __future__ import annotations

import http.client
import json
import os
import zipfile
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from playwright.sync_api import Browser, CDPSession, FloatRect, Page, expect

from . import optimising_browser
from .api import example
from .conftest import ROOT, Server
from .frame_times import Frames, frames_of
from .test_trace_editor import TracePage, opened, record

pytestmark = [pytest.mark.e2e, pytest.mark.slow]
browser, profile = optimising_browser.browser, optimising_browser.profile

SAMPLES = int(os.environ.get("TAPPET_TRACE_SAMPLES", "10_000_000"))
CHANNELS = ("sine", "beat", "noise", "steps")
BLOCK = 1 << 18
TITLE = "Ten million"
MOVES = 240
UPLOT = ROOT / "frontend/node_modules/uplot/dist/uPlot.iife.min.js"
PLAIN = """
([width, height, points]) => {
  document.body.innerHTML = '<div id="plot"></div>';
  document.body.style.margin = 0;
  const x = Float64Array.from({ length: points }, (_, k) => k);
  const wave = (n) => x.map((k) => (k % 2 ? 1 : -1) * (0.3 + 0.2 * n * Math.abs(Math.sin(k / (40 * n)))));
  const ink = ['#1f77b4', '#ff7f0e', '#2ca02c', '#d62728'];
  const series = [{}, ...ink.map((stroke) => ({ stroke, width: 1.4, points: { show: false } }))];
  const scales = { x: { time: false, auto: false }, y: { auto: false } };
  const options = { width, height, series, scales, legend: { show: false }, cursor: { show: false } };
  const plot = new uPlot(options, [x, wave(1), wave(2), wave(3), wave(4)], document.querySelector('#plot'));
  let step = 0;
  const show = () => {
    step = (step + 3) % 50;
    plot.batch(() => {
      plot.setScale('x', { min: step, max: points - 50 + step });
      plot.setScale('y', { min: -1.2, max: 1.2 });
    });
  };
  show();
  addEventListener('wheel', (event) => {
    event.preventDefault();
    show();
  }, { passive: false });
}
"""


def _trace_file(path: Path, samples: int) -> None:
    """A trace file of four channels at 1 kHz."""
    infos = [
        {"index": n, "name": f"PLC_PRG.{name}", "type": "REAL", "number": "f4"}
        for n, name in enumerate(CHANNELS)
    ]
    one = {
        "name": "Record1",
        "task": "MainTask",
        "interval_ns": 1_000_000,
        "every": 1,
        "channels": infos,
        "trigger_ns": None,
    }
    settings = {"records": [record(*(f"PLC_PRG.{name}" for name in CHANNELS))]}
    head = {"format": "tappet-trace", "version": 1, "name": "Trace", "application": "Application"}
    head |= {"settings": settings, "records": [one], "samples": [samples]}
    number = np.random.default_rng(1)
    begun = 1_700_000_000_000_000_000
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr("trace.json", json.dumps(head))

        def column(name: str, dtype: str, values: object) -> None:
            with archive.open(f"0/{name}.npy", "w", force_zip64=True) as file:
                shape = {"descr": np.dtype(dtype).str, "fortran_order": False, "shape": (samples,)}
                np.lib.format.write_array_header_1_0(file, shape)
                for start in range(0, samples, BLOCK):
                    at = np.arange(start, min(samples, start + BLOCK))
                    file.write(values(at).astype(dtype).tobytes())  # type: ignore[operator]

        column("cycle", "<i8", lambda at: at)
        column("time", "<i8", lambda at: begun + at * 1_000_000)
        column("gap", "u1", lambda at: at * 0)
        column("0", "<f4", lambda at: np.sin(at / 40) + 0.3 * np.sin(at / 1e6))
        column("1", "<f4", lambda at: np.sin(at / 9) * np.sin(at / 3e5))
        column("2", "<f4", lambda at: 0.4 * number.standard_normal(len(at)))
        column("3", "<f4", lambda at: (at // 70_000 % 5) - 2.0)


def _uploaded(page: Page, server: Server, project: str, file: Path) -> None:
    """As Load Trace does it; a body of this size is sent in pieces."""
    host = urlsplit(server.address)
    connection = http.client.HTTPConnection(str(host.hostname), host.port, timeout=600)
    cookies = "; ".join(f"{one['name']}={one['value']}" for one in page.context.cookies(server.address))
    headers = {"X-Tappet-Client": "1", "Origin": server.address, "Cookie": cookies}
    headers |= {"Content-Type": "application/octet-stream", "Content-Length": str(file.stat().st_size)}
    path = f"/api/v1/recordings?title={TITLE.replace(' ', '%20')}&project_id={project.rpartition('/')[2]}"
    with file.open("rb") as body:
        connection.request("POST", path, body, headers)
        answer = connection.getresponse()
        assert answer.status == 201, answer.read()
    connection.close()


@pytest.fixture
def large(page: Page, server: Server, tmp_path: Path) -> TracePage:
    """The editor with the recording."""
    trace = opened(page, server, record("PLC_PRG.iLoaded"))
    file = tmp_path / "large.trace"
    _trace_file(file, SAMPLES)
    _uploaded(page, server, example(page, server), file)
    file.unlink()
    trace.panel("Recordings").get_by_role("button", name=TITLE, exact=True).click()
    expect(trace.editor.get_by_text(f"Recording: {TITLE}")).to_be_visible()
    trace.editor.get_by_role("tab", name="Recordings", exact=True).click()  # the diagram has all the room
    expect(trace.editor.get_by_role("tabpanel")).to_have_count(0)
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    return trace


class Hand:
    """Wheel and pointer, an event a frame."""

    def __init__(self, page: Page, box: FloatRect) -> None:
        self._session: CDPSession = page.context.new_cdp_session(page)
        self._box = box

    def _send(self, kind: str, part: float, **more: object) -> None:
        place = {
            "x": self._box["x"] + part * self._box["width"],
            "y": self._box["y"] + self._box["height"] / 2,
        }
        self._session.send("Input.dispatchMouseEvent", {"type": kind, **place, **more})
        frame = {"expression": "new Promise(requestAnimationFrame)", "awaitPromise": True}
        self._session.send("Runtime.evaluate", frame)

    def zoom(self, moves: int) -> None:
        """In by a factor of a million, and out again."""
        for k in range(moves):
            self._send("mouseWheel", 0.55, deltaX=0, deltaY=(-60 if k < moves / 2 else 60) * 110 / moves)

    def pan(self, moves: int) -> None:
        """To and fro around the middle."""
        self._send("mousePressed", 0.5, button="left", clickCount=1)
        for k in range(moves):
            part = 0.5 + 0.3 * (abs((k / 60 + 1) % 4 - 2) - 1)
            self._send("mouseMoved", part, button="left", buttons=1)
        self._send("mouseMoved", 0.5, button="left", buttons=1)
        self._send("mouseReleased", 0.5, button="left", clickCount=1)

    def whole(self) -> None:
        """What there is, then about a third of it."""
        self._send("mousePressed", 0.5, button="left", clickCount=2)
        self._send("mouseReleased", 0.5, button="left", clickCount=2)
        for _ in range(8):
            self._send("mouseWheel", 0.5, deltaX=0, deltaY=-60)


def _measured(
    browser: Browser, page: Page, box: FloatRect, name: str, acts: tuple[str, ...] = ("zoom", "pan")
) -> dict[str, Frames]:
    hand = Hand(page, box)
    found = {}
    for act in acts:
        work = {"zoom": hand.zoom, "pan": hand.pan}[act]
        hand.whole()
        work(60)
        with frames_of(browser, page) as frames:
            work(MOVES)
        found[act] = frames
        step = sum(frames.work) / MOVES
        print(f"\n{name}, {act}: {frames.text()}; {step:.1f} ms a step of the hand", end="")
    return found


def _memory(page: Page) -> float:
    """MiB of scripts and of their arrays, which lie outside of the heap."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    found = session.send("Runtime.getHeapUsage")
    session.detach()
    return float(found["usedSize"] + found.get("backingStorageSize", 0)) / 2**20


def test_ten_million_samples_pan_and_zoom(large: TracePage, browser: Browser, server: Server) -> None:
    page = large.page
    box = large.diagrams.first.locator("canvas").bounding_box()
    assert box is not None
    memory = [_memory(page)]
    ours = _measured(browser, page, box, f"{SAMPLES:,} samples")
    memory.append(_memory(page))
    plain = page.context.new_page()
    plain.set_viewport_size(page.viewport_size or {"width": 1440, "height": 900})
    plain.add_script_tag(path=UPLOT)
    plain.evaluate(PLAIN, [round(box["width"]), round(box["height"]), 2 * round(box["width"])])
    around: FloatRect = {"x": 0, "y": 0, "width": box["width"], "height": box["height"]}
    theirs = _measured(browser, plain, around, "plain uPlot", ("zoom",))
    plain.close()
    print(f"\nmemory of the page: {memory[0]:.0f} MiB, {memory[1]:.0f} MiB after all that", end="")
    whole = SAMPLES * len(CHANNELS) * 8 / 2**20
    print(f"; the samples as the browser would hold them: {whole:.0f} MiB")
    page.screenshot(path=Path(os.environ.get("TAPPET_PICTURES", server.data)) / "large-trace.png")
    for frames in (*ours.values(), *theirs.values()):
        assert len(frames.work) >= MOVES, "each step has a frame"
