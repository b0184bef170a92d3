"""A short run of every fuzz target with fixed seeds; long ones: `python -m tests.fuzz NAME --seconds 300`."""

from __future__ import annotations

from random import Random

import pytest
from door_targets import DOORS
from targets import TARGETS

FEW = 60
MANY = {
    "compiler": 1200,
    "checker": 2400,
    "il": 2400,
    "editor": 600,
    "messages": 600,
    "archive": 2000,
    "gcode": 1_000_000,
}
MANY |= dict.fromkeys(DOORS, 600)


def fuzz(name: str, start: int, count: int) -> None:
    target = TARGETS[name]
    corpus = target.seeds()
    assert corpus
    for number in range(start, start + count):
        data = target.mutate(Random(number), corpus)
        try:
            target.run(data)
        except Exception as error:
            raise AssertionError(f"{name} {number}: {error!r}\n{data.decode('utf-8', 'replace')}") from error
    target.finish()


@pytest.mark.parametrize("name", TARGETS)
def test_nothing_escapes(name: str) -> None:
    fuzz(name, 0, min(FEW, MANY.get(name, 4000) // 20))


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_nothing_escapes_for_long(name: str) -> None:
    fuzz(name, 100_000, MANY.get(name, 4000))
