"""No kill at any moment loses or tears remanent variables: `retain_kills.py` says how."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

FEW, MANY = 40, int(os.environ.get("TAPPET_RETAIN_KILLS", "5000"))


@pytest.mark.parametrize("kills", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
def test_killed_at_any_moment(tmp_path: Path, kills: int) -> None:
    script = Path(__file__).with_name("retain_kills.py")
    ended = subprocess.run(
        [sys.executable, str(script), str(tmp_path), str(kills), str(kills)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr[-3000:]
    told = json.loads(ended.stdout)
    print(told)
    assert told["wrong"] == []
    assert told["kills"] == kills
    if kills >= 1000:
        often = {name for name, number in told["done"].items() if number > kills / 20}
        assert often >= {"boot", "run", "save", "download", "online change", "warm", "cold"}, told
        assert told["starts that were looked at"] > kills / 2, told
