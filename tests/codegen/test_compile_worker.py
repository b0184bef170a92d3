"""The process that compiles one module."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict

from unread_answers import ends_quietly

from tappet.codegen.compile_options import OptimiseOptions

MODULE = b"define i32 @f() {\n  ret i32 1\n}\n"


def test_a_worker_whose_builder_was_killed_ends_quietly() -> None:
    head = json.dumps(asdict(OptimiseOptions())).encode() + b"\n" + len(MODULE).to_bytes(8, "little")
    ends_quietly([sys.executable, "-m", "tappet.codegen.compile_worker"], head + MODULE)
