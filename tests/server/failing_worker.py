"""An analysis worker that fails at texts which say so: `HANG`, `SPIN`, `MEMORY`, `CRASH`."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Mapping

from tappet.lang.services.documents import Program
from tappet.server.analysis import worker
from tappet.server.lsp.project_programs import ProjectPrograms

compose = ProjectPrograms.__call__


def failing(self: ProjectPrograms, unsaved: Mapping[str, str]) -> list[Program]:
    words = " ".join(unsaved.values())
    if "HANG" in words:
        time.sleep(1000)
    if "SPIN" in words:
        re.match(r"(a+)+$", "a" * 60 + "b")  # lets no other Python code run
    if "MEMORY" in words:
        held = [bytearray(1 << 26) for _ in range(1 << 10)]
        del held
    if "CRASH" in words:
        os._exit(3)
    return compose(self, unsaved)


ProjectPrograms.__call__ = failing  # type: ignore[method-assign]
worker.main()
