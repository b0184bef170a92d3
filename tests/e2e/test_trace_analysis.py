"""What is computed of recordings and compared between them, against the formulas that made the samples."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tappet.traces.formats import write_trace
from tappet.traces.recording import ChannelInfo, RecordInfo
from tappet.traces.samples import Batch, BatchSamples

from .api import example, fetch
from .conftest import Server, new_profile, start_page
from .test_trace_editor import RATE, TracePage, opened, record

pytestmark = pytest.mark.e2e

COUNT = 4000
SECONDS = np.arange(COUNT) / 1000
BEGUN = 1_700_000_000_000_000_000
TURN = 2 * np.pi * 5
LATER_S = 0.05
HIGHER = 0.25
RED = "#ff0000"
SETTINGS = {
    "records": [
        {
            "name": "Record1",
            "channels": [
                {
                    "variable": "PLC_PRG.a",
                    "name": "a",
                    "maximum_warning": {"on": True, "limit": 2, "color": RED},
                },
                {"variable": "PLC_PRG.b", "name": "b"},
                {"variable": "PLC_PRG.pulse", "name": "pulse"},
                {"formula": "a + 2 * pulse", "name": "f"},
            ],
        }
    ]
}
REDS = """([key]) => {
    const canvas = document.querySelector(`figure[data-diagram="${key}"] canvas`);
    const { width, height } = canvas;
    const data = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    const rows = [];
    for (let k = 0; k < data.length; k += 4)
        if (data[k] > 230 && data[k + 1] < 60 && data[k + 2] < 60 && data[k + 3] > 60)
            rows.push(Math.floor(k / 4 / width) / height);
    return rows.length === 0 ? null : [rows[0], rows[rows.length - 1]];
}"""


def _a(later: float = 0.0, higher: float = 0.0) -> Any:
    return 1 + higher + 2 * np.sin(TURN * (SECONDS - later))


def _columns(later: float = 0.0, higher: float = 0.0) -> list[Any]:
    """A sine, the cosine beside it, and a pulse in the middle."""
    cosine = 1 + 2 * np.cos(TURN * (SECONDS - later))
    return [_a(later, higher), cosine, np.exp(-(((SECONDS - later - 2) / 0.1) ** 2))]


def _stored(page: Page, server: Server, folder: Path, title: str, columns: list[Any]) -> str:
    """A trace file of these samples, loaded as Load Trace does it; its id."""
    channels = [
        ChannelInfo(n, f"PLC_PRG.{name}", "LREAL", "f8") for n, name in enumerate(("a", "b", "pulse"))
    ]
    cycle = np.arange(COUNT)
    samples = BatchSamples(channels, Batch(cycle, BEGUN + cycle * 1_000_000, np.zeros(COUNT, "u1"), columns))
    file = folder / f"{title}.trace"
    write_trace(
        file,
        "Trace",
        "Application",
        SETTINGS,
        [(RecordInfo("Record1", "Main", 1_000_000, 1, channels), samples)],
    )
    project = example(page, server).rpartition("/")[2]
    path = f"/recordings?title={title}&project_id={project}"
    headers = {"Content-Type": "application/octet-stream", "X-Tappet-Client": "1", "Origin": server.address}
    answer = page.request.post(f"{server.address}/api/v1{path}", data=file.read_bytes(), headers=headers)
    assert answer.ok, answer.text()
    return str(answer.json()["id"])


@pytest.fixture
def runs(page: Page, server: Server, tmp_path: Path) -> Iterator[TracePage]:
    """Two recordings, the second a twentieth of a second later and a little higher; the first is shown."""
    trace = opened(page, server, record("PLC_PRG.iLoaded"))
    ids = [
        _stored(page, server, tmp_path, "First", _columns()),
        _stored(page, server, tmp_path, "Second", _columns(LATER_S, HIGHER)),
    ]
    trace.panel("Recordings").get_by_role("button", name="First", exact=True).click()
    expect(trace.editor.get_by_text("Recording: First")).to_be_visible()
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    yield trace
    for one in ids:
        fetch(page, server, "DELETE", f"/recordings/{one}")


def _picture(page: Page, server: Server, name: str) -> None:
    folder = Path(os.environ.get("TAPPET_PICTURES", server.data))
    folder.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=folder / f"trace-{name}.png")


def _numbers(cells: Locator) -> list[float]:
    return [float(text.replace(",", "").replace("−", "-")) for text in cells.all_inner_texts()]


def test_statistics_are_those_of_all_samples(runs: TracePage, server: Server) -> None:
    table = runs.panel("Statistics").get_by_role("table")
    rows = table.get_by_role("row")
    expect(rows.nth(4).get_by_role("cell").nth(1)).to_have_text(re.compile(r"\d"))
    expected = [*_columns(), _a() + 2 * _columns()[2]]
    for number, values in enumerate(expected):
        found = _numbers(rows.nth(number + 1).get_by_role("cell"))
        rms = float(np.sqrt((values**2).mean()))
        wanted = [COUNT, values.min(), values.max(), np.ptp(values), values.mean(), rms, values.std()]
        assert found == pytest.approx(wanted, abs=2e-4, rel=2e-4), f"row {number}"
    _picture(runs.page, server, "statistics")


def test_the_spectrum_finds_the_sine(runs: TracePage, server: Server) -> None:
    panel = runs.panel("Spectrum")
    expect(panel).to_contain_text(re.compile(r"Peak (2|1\.99\d*) at 5 Hz"))
    expect(panel.get_by_role("img", name="Spectrum").locator("path")).to_have_count(1)
    panel.get_by_text("dB").click()
    expect(panel.get_by_role("img")).to_contain_text("dB")
    _picture(runs.page, server, "spectrum")


def test_one_variable_over_another_is_a_circle(runs: TracePage, server: Server) -> None:
    panel = runs.panel("XY Plot")
    path = panel.get_by_role("img").locator("path")
    expect(path).to_have_attribute("d", re.compile(r"\d"))
    # Sine over cosine with one centre: every point is as far from it, in the scales of both axes.
    found = path.evaluate(
        """(path) => {
            const length = path.getTotalLength();
            return Array.from({ length: 400 }, (_, k) => {
                const at = path.getPointAtLength((k / 400) * length);
                return [at.x, at.y];
            });
        }"""
    )
    points = np.array(found)
    low, high = points.min(0), points.max(0)
    unit = (points - (low + high) / 2) / ((high - low) / 2)
    assert np.hypot(unit[:, 0], unit[:, 1]) == pytest.approx(np.ones(len(unit)), abs=0.02)
    _picture(runs.page, server, "xy")


def test_runs_are_compared_and_moved_in_time(runs: TracePage, server: Server) -> None:
    rows = runs.panel("Recordings")
    rows.get_by_role("button", name="Draw Second over what is shown").click()
    panel = runs.panel("Compare")
    expect(panel).to_contain_text("Greatest")
    expect(panel.get_by_role("img", name="Difference").locator("path")).to_have_count(1)
    _picture(runs.page, server, "compare")
    panel.get_by_role("combobox", name="Variable").click()
    runs.page.get_by_role("option", name="pulse").click()
    expect(panel).to_contain_text(re.compile(r"Greatest 0\.4\d"))
    panel.get_by_role("button", name="Align").click()
    expect(panel.get_by_label("Time shift")).to_have_value("T#-50ms")
    expect(panel).to_contain_text(re.compile(r"Greatest (0(\.0\d*)?|\d\.?\d*e-\d+),"))
    panel.get_by_role("combobox", name="Variable").click()
    runs.page.get_by_role("option", name="a", exact=True).click()
    expect(panel).to_contain_text(f"Greatest {HIGHER}, RMS {HIGHER}")
    shift = panel.get_by_label("Time shift")
    shift.fill("half a second")
    expect(shift).to_have_attribute("aria-invalid", "true")
    shift.fill("T#0s")
    shift.press("Enter")
    expect(panel).not_to_contain_text(f"Greatest {HIGHER},")
    _picture(runs.page, server, "compare-shifted")


def test_what_is_computed_of_a_curve(runs: TracePage, server: Server) -> None:
    """Derivative, integral and formula at a cursor, which stands in the middle of what is seen."""
    runs.tool("Cursor").click()
    runs.tree.get_by_role("treeitem").nth(1).click()
    runs.choose("Derivative")
    runs.choose("Integral")
    expect(runs.diagrams).to_have_count(3)
    at = (COUNT - 1) / 2 / 1000

    def value(diagram: int, curve: int = 0) -> float:
        shown = runs.diagrams.nth(diagram).locator("figcaption output").nth(curve)
        expect(shown).to_have_text(re.compile(r"\d"))
        return _numbers(shown)[0]

    assert value(1) == pytest.approx(2 * TURN * np.cos(TURN * at), abs=0.5)
    assert value(2) == pytest.approx(at + 2 / TURN * (1 - np.cos(TURN * at)), abs=0.01)
    assert value(0, 3) == pytest.approx(1 + 2 * np.sin(TURN * at) + 2, abs=0.05)
    _picture(runs.page, server, "computed")


def test_values_beyond_a_limit_are_in_its_colour(runs: TracePage) -> None:
    """TRC-43 to TRC-46, trace EX-06: here the part of the sine above 2, in a picture of -1 to 5."""
    runs.tool("Multi-Channel").click()
    expect(runs.diagrams).to_have_count(4)
    runs.drawn(runs.diagrams.first, 0.1, 0.9)
    first, last = runs.page.evaluate(REDS, [runs.diagrams.first.get_attribute("data-diagram")])
    assert 0 < last - first < 0.3, "a quarter of the sine is above the limit"
    assert last < 0.5
    other = runs.page.evaluate(REDS, [runs.diagrams.nth(1).get_attribute("data-diagram")])
    assert other is None


def test_exported_files_hold_the_samples(runs: TracePage, tmp_path: Path) -> None:
    expected = _columns()

    def exported(choice: str) -> Path:
        runs.choose("Export")
        dialog = runs.page.get_by_role("dialog")
        dialog.get_by_role("combobox").click()
        runs.page.get_by_role("option", name=choice).click()
        with runs.page.expect_download() as saving:
            dialog.get_by_role("button", name="Export").click()
        expect(dialog).to_have_count(0)
        file = tmp_path / saving.value.suggested_filename
        saving.value.save_as(file)
        return file

    with exported("CSV").open(newline="") as text:
        rows = list(csv.reader(text))
    assert rows[0] == ["time_ns", "cycle", "PLC_PRG.a", "PLC_PRG.b", "PLC_PRG.pulse", "f"]
    assert [int(row[0]) for row in rows[1:]] == [BEGUN + n * 1_000_000 for n in range(COUNT)]
    computed = expected[0] + 2 * expected[2]
    for number, values in enumerate([*expected, computed]):
        assert [float(row[2 + number]) for row in rows[1:]] == values.tolist()
    table = pq.read_table(exported("Parquet"))
    assert table["time"].cast("int64").to_pylist() == [BEGUN + n * 1_000_000 for n in range(COUNT)]
    for name, values in zip(("a", "b", "pulse"), expected, strict=True):
        assert table[f"PLC_PRG.{name}"].to_pylist() == values.tolist()
    assert table["f"].to_pylist() == computed.tolist()


def test_a_long_term_recording_is_begun_with_its_limits_and_ended(page: Page, server: Server) -> None:
    trace = opened(page, server, record(RATE, buffer=100))
    trace.download()
    trace.tool("Long-Term Recording").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Title").fill("Night shift")
    dialog.get_by_label("Keep the last").fill("1 hour")
    begin = dialog.get_by_role("button", name="Begin")
    expect(begin).to_have_attribute("aria-disabled", "true")
    _picture(page, server, "long-term")
    dialog.get_by_label("Keep the last").fill("T#1h")
    dialog.get_by_label("Keep at most").fill("64")
    begin.click()
    state = trace.editor.get_by_role("status", name="State")
    expect(state).to_contain_text("Long-term recording: Night shift")
    row = trace.panel("Recordings").get_by_role("row").filter(has_text="Night shift")
    expect(row).to_contain_text("the last T#1h · at most 64 MiB")
    expect(row.get_by_role("cell").nth(3)).to_have_text(re.compile(r"^[1-9]"))
    trace.tool("Long-Term Recording").click()
    expect(state).not_to_contain_text("Long-term recording")
    _picture(page, server, "recordings")
    row.get_by_role("button", name="Night shift", exact=True).click()
    trace.drawn(trace.diagrams.first, 0.1, 0.9)
    (found,) = fetch(page, server, "GET", "/recordings?trace=Trace")["recordings"]
    assert (found["state"], found["lost"], found["keep_seconds"]) == ("complete", 0, 3600)
    raw = page.request.get(f"{server.address}/api/v1/recordings/{found['id']}/export?format=csv").text()
    cycles = [int(line.split(",")[1]) for line in raw.splitlines()[1:]]
    assert np.diff(cycles).tolist() == [1] * (len(cycles) - 1), "each cycle is there"
    fetch(page, server, "DELETE", f"/recordings/{found['id']}")


@pytest.mark.slow
@pytest.mark.parametrize(("theme", "language"), [("dark", "zh"), ("dark", "en"), ("light", "zh")])
def test_pictures_of_all_panels(
    browser: Browser, server: Server, tmp_path: Path, theme: str, language: str
) -> None:
    with new_profile(browser, language, theme) as profile, start_page(profile, server) as page:
        opened(page, server, record("PLC_PRG.iLoaded"))
        for title, columns in (("First", _columns()), ("Second", _columns(LATER_S, HIGHER))):
            _stored(page, server, tmp_path, title, columns)
        editor = page.locator(".dv-active-group [data-panel-id]:visible").last
        tabs = editor.get_by_role("tablist").get_by_role("tab")
        tabs.last.click()
        editor.get_by_role("button", name="First", exact=True).click()
        editor.get_by_role("row").filter(has_text="Second").locator("button").nth(1).click()
        for number in range(tabs.count()):
            tabs.nth(number).click()
            expect(tabs.nth(number)).to_have_attribute("aria-selected", "true")
            page.wait_for_load_state("networkidle")
            _picture(page, server, f"panel{number}-{theme}-{language}")
        for one in fetch(page, server, "GET", "/recordings")["recordings"]:
            fetch(page, server, "DELETE", f"/recordings/{one['id']}")
