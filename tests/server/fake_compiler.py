"""A compiler process that does what its first source says: sleep, wait to be cancelled, die, fail, answer.

`sleep PATH` and `patient PATH` make the file when they have begun.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

from tappet.server.builds.worker import BuildCancelled
from tappet.server.frames import CANCEL, pack_frame, read_frame


def obey(number: int, frame: object) -> None:
    raise BuildCancelled


def begun(text: str) -> None:
    Path(text.split()[1]).touch()


builds = 0
while (order := read_frame(sys.stdin.buffer)) is not None:
    builds += 1
    text = order["sources"][0]["text"] if order["sources"] else ""
    if "die" in text:
        os._exit(3)
    if "sleep" in text:
        begun(text)
        time.sleep(600)
    if "patient" in text:
        signal.signal(CANCEL, obey)
        try:
            begun(text)
            time.sleep(600)
        except BuildCancelled:
            sys.stdout.buffer.write(pack_frame({"cancelled": True}))
            sys.stdout.buffer.flush()
            continue
    answer = {"package": b"package", "code_id": str(builds), "data_id": "d", "code_size": 1, "data_size": 2}
    answer |= {
        "change_base": None,
        "change_reasons": [],
        "change_report": {},
        "diagnostics": [],
        "timings": {},
        "seconds": 0.1,
    }
    if "fail" in text:
        answer = {"crash": "KeyError: 'x'"}
    sys.stdout.buffer.write(pack_frame(answer))
    sys.stdout.buffer.flush()
