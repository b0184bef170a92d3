"""The start benchmark runs what it says; its numbers are looked at, never asserted."""

from __future__ import annotations

import pytest

from tappet.bench import start
from tappet.bench.large_library import texts


def test_the_library_has_as_many_lines_as_it_says() -> None:
    made = texts(start.BLOCKS, start.LINES)
    assert sum(name.startswith("MX_Move") for name in made) == start.BLOCKS
    lines = sum(text.count("\n") for text in made.values())
    assert abs(lines - start.LINES) < start.LINES // 20


@pytest.mark.slow
def test_every_command_and_first_answer_is_measured() -> None:
    report = start.run(rounds=1, blocks=8, lines=400)
    names = [row.name for row in report.rows]
    assert names[:7] == [
        "version",
        "help",
        "check, cold cache",
        "run, cold cache",
        "check, warm cache",
        "run, warm cache",
        "library show",
    ]
    assert names[7:10] == [
        "first page of the server",
        "first message of the language server, cold cache",
        "first message of the language server, warm cache",
    ]
    assert {row.note for row in report.rows[10:]} == {"library of 8 blocks"}
    assert all(row.ours > 0 and row.baseline for row in report.rows)
