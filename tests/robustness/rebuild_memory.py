"""Edits and rebuilds one application in this process, as the compiler process of the server does.

`python rebuild_memory.py COUNT` prints resident memory in KiB after a tenth of the builds, and at the end.
"""

from __future__ import annotations

import gc
import sys
import tempfile
from pathlib import Path

from tappet.bench.build import order
from tappet.lang.source import Source
from tappet.server.builds.worker import Compiler

_BLOCK = """FUNCTION_BLOCK FB_Unit{n}
VAR_INPUT x : LREAL; END_VAR
VAR_OUTPUT y : LREAL; END_VAR
VAR t : TON; a : ARRAY [0..9] OF LREAL; i : INT; {extra} END_VAR
FOR i := 0 TO 9 DO a[i] := a[i] + x * {factor}.5; END_FOR
t(IN := x > 3.0, PT := T#1s);
y := SEL(t.Q, a[3], a[4]);
END_FUNCTION_BLOCK
"""


def blocks(turn: int) -> list[Source]:
    """Thirty blocks; each turn changes a body, every tenth a declaration, every seventh makes an error."""
    found = []
    for n in range(30):
        edited = n == turn % 30
        extra = f"v{turn} : DINT;" if edited and turn % 10 == 0 else ""
        text = _BLOCK.format(n=n, extra=extra, factor=turn if edited else n)
        if edited and turn % 7 == 3:
            text = text.replace("a[3]", "unknown")
        found.append(Source(f"FB_Unit{n}", text, name=f"FB_Unit{n}"))
    instances = " ".join(f"u{n} : FB_Unit{n};" for n in range(30))
    calls = "\n".join(f"u{n}(x := u{(n + 1) % 30}.y + 1.0);" for n in range(30))
    main = f"PROGRAM Main\nVAR {instances} END_VAR\n{calls}\nEND_PROGRAM\n"
    return [*found, Source("Main", main, name="Main")]


def resident_kib() -> int:
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1])
    raise OSError("no VmRSS in /proc/self/status")


def main(count: int) -> None:
    compiler = Compiler()
    gc.disable()
    previous: bytes | None = None
    with tempfile.TemporaryDirectory() as cache:
        for turn in range(count):
            outcome = compiler.outcome(order(blocks(turn), previous, cache))
            assert "crash" not in outcome, outcome
            previous = outcome["package"] or previous
            compiler.tidy()
            if turn == count // 10:
                print(resident_kib(), flush=True)
    print(resident_kib(), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
