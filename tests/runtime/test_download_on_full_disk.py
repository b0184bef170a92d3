"""A soft PLC on a full disk: refuses downloads, runs on, and keeps what it had."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

STORY = Path(__file__).with_name("download_story.py")
MOUNT = 'mount -t tmpfs -o size=512k tmpfs "$1" && exec "$2" "$3" "$1"'


def test_a_full_disk_refuses_downloads_and_nothing_else(tmp_path: Path) -> None:
    disk = tmp_path / "disk"
    disk.mkdir()
    private = ["unshare", "-rm", "sh", "-c"]
    try:
        subprocess.run([*private, 'mount -t tmpfs tmpfs "$1"', "sh", disk], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no file systems of one's own here")
    done = subprocess.run(
        [*private, MOUNT, "sh", disk, sys.executable, STORY],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(STORY.parent)},
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {
        "large": "there is no room for the remanent variables",
        "kept": True,
        "full": "there is no room for the boot application",
        "runs": True,
        "code": True,
        "boot": True,
        "stopped": "stop",
        "logged": True,
        "nothing left": [],
        "then": "it was not",
        "live": 0o600,
    }
