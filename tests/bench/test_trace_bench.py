"""The benchmark of windows runs and shows each span beside its baseline."""

import pytest

from tappet.bench import trace


def test_every_span_has_its_baseline(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trace, "SAMPLES", 50_000)
    monkeypatch.setattr(trace, "_SPANS", {"whole recording": 50_000, "1,000 samples": 1000})
    monkeypatch.setattr(trace, "ROUNDS", 2)
    report = trace.run()
    assert [row.name for row in report.rows] == ["whole recording", "1,000 samples"]
    assert all(row.baseline is not None and row.unit == "ms" for row in report.rows)
