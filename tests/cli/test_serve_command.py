"""`tappet serve`: what its options set."""

from __future__ import annotations

from datetime import timedelta
from typing import Any

import pytest

from tappet.cli import main
from tappet.server import serve


@pytest.mark.parametrize(
    ("arguments", "gib", "keep"),
    [
        ([], 20, None),
        (["--recordings-gib", "3", "--recordings-days", "90"], 3, timedelta(days=90)),
    ],
)
def test_limits_of_recordings(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str], gib: int, keep: timedelta | None
) -> None:
    given: list[Any] = []
    monkeypatch.setattr(serve, "serve", lambda options: given.append(options.settings) or 0)
    assert main(["serve", *arguments]) == 0
    assert [(one.recordings_gib, one.recordings_keep) for one in given] == [(gib, keep)]


@pytest.mark.parametrize("arguments", [["--recordings-days", "0"], ["--recordings-gib", "none"]])
def test_limits_that_are_none(capsys: pytest.CaptureFixture[str], arguments: list[str]) -> None:
    assert main(["serve", *arguments]) == 2
    assert arguments[0] in capsys.readouterr().err
