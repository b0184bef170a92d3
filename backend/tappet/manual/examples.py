"""The examples of the manual: programs with what is to come out, in comments in front of them.

    // Moves an axis there.
    // CYCLES: 500
    // EXPECT 3: Move.Busy = TRUE
    // EXPECT: Move.Done = TRUE
    // CHART: Move.Execute, Move.Busy, Axis.fSetPosition
    PROGRAM MC_MoveAbsolute_Example

`EXPECT n` holds at the end of cycle n, `EXPECT` at the end of the last one; numbers within 1e-6.
Without `CHART` the BOOL pins of the instance of the block are drawn, and the set values of axes that move.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

CYCLE_MS = 4
AXES = {
    "Axis": "linear",
    "Master": "rotary",
    "Slave": "rotary",
}
"""The axes that examples may use, as `FRAME` declares them."""
_HEADER = re.compile(r"// (CYCLES|EXPECT|CHART)(?: (\d+))?: (.+)")


@dataclass(frozen=True, slots=True)
class Expectation:
    """What an expression is at the end of a cycle."""

    cycle: int
    expression: str
    value: str


@dataclass(frozen=True, slots=True)
class Example:
    """A program for a block."""

    name: str
    """Of the block."""
    comment: str
    program: str
    """Text from the word PROGRAM on."""
    cycles: int
    expectations: tuple[Expectation, ...]
    chart: tuple[str, ...] = field(default=())
    """What is drawn; empty: what the pins of the block offer."""
    charted: bool = True

    @property
    def pou(self) -> str:
        """Name of the program."""
        found = re.match(r"PROGRAM\s+(\w+)", self.program)
        assert found is not None, self.name
        return found.group(1)

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that the program uses."""
        code = re.sub(r"//[^\n]*|\(\*.*?\*\)", "", self.program, flags=re.DOTALL)
        return tuple(name for name in AXES if re.search(rf"(?::=\s*|\(|\s){name}\b(?!\s*:=)", code))

    @property
    def instance(self) -> str | None:
        """Name of the instance of the block."""
        found = re.search(rf"^\s*(\w+)\s*:\s*{self.name}\b", self.program, re.MULTILINE)
        return found and found.group(1)


def read_examples(folder: Path) -> dict[str, Example]:
    """The examples of a folder by block; raises ValueError for one without an expectation."""
    return {path.stem: _example(path) for path in sorted(folder.glob("*.st"))}


def _example(path: Path) -> Example:
    comment: list[str] = []
    cycles = 0
    chart: tuple[str, ...] = ()
    charted = True
    expected: list[tuple[str, str]] = []
    lines = path.read_text(encoding="utf-8").splitlines()
    first = 0
    for first, line in enumerate(lines):  # noqa: B007 - the line of PROGRAM
        found = _HEADER.fullmatch(line.rstrip())
        if found is None and line.startswith("PROGRAM"):
            break
        if found is None:
            comment.append(line.removeprefix("//").strip())
        elif found[1] == "CYCLES":
            cycles = int(found[3])
        elif found[1] == "EXPECT":
            expected.append((found[2] or "", found[3]))
        else:
            charted = found[3] != "none"
            chart = tuple(part.strip() for part in found[3].split(",")) if charted else ()
    if not cycles or not expected:
        raise ValueError(f"{path.name} needs lines `// CYCLES: n` and `// EXPECT: expression = value`")
    expectations = []
    for at, text in expected:
        expression, _, value = text.partition(" = ")
        expectations.append(Expectation(int(at) if at else cycles, expression.strip(), value.strip()))
    program = "\n".join(lines[first:]).rstrip()
    return Example(
        path.stem, "\n".join(comment).strip(), program, cycles, tuple(expectations), chart, charted
    )
