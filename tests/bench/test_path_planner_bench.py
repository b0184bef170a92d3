"""What `tappet bench path-planner` measures moves as it says; how fast it is is looked at, never asserted."""

import pytest

from tappet.bench import path_planner


def test_every_path_is_gone_and_stands_beside_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(path_planner, "CALLS", 10)
    monkeypatch.setattr(path_planner, "ROUNDS", 2)
    report = path_planner.run()
    assert len(report.rows) == 5
    assert all(row.baseline == path_planner.BAR_NS for row in report.rows[:4])
    assert all(row.ours > 0 for row in report.rows[:4])
