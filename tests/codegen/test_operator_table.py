"""Every operator, conversion and statement over every type has code, or a message: nothing in between."""

from __future__ import annotations

from random import Random

import pytest
from operator_table import Table, actions, expressions, refused, sinks

from tappet import libraries
from tappet.codegen.build import BuildOptions, LibraryReference, build_application

LIBRARIES = ("Standard", "Standard64")
PARTS = 25
"""Builds of the whole table."""
QUICK = 2500
"""Lines of the build of the fast suite."""


def build(whole: list[str], values: int) -> int:
    """Builds what is accepted of some lines, of which the first `values` are expressions; how many."""
    texts = [source for name in LIBRARIES for source in libraries.load(name).sources]
    lines = [line + ";" for line in whole[:values]] + whole[values:]
    wrong, types = refused(lines, texts)
    known = sinks()
    kept = []
    for number, line in enumerate(lines):
        target = known.get(types.get(number, "")) if number < values else None
        if number not in wrong:
            kept.append(f"{target} := {line}" if target else line)
    wrong, _ = refused(kept, texts)  # a constant may not fit the variable of its type
    table = Table([line for number, line in enumerate(kept) if number not in wrong])
    options = BuildOptions(level=0, libraries=tuple(LibraryReference(name) for name in LIBRARIES))
    result = build_application(table.sources(), (), options)
    found = []
    for d in result.diagnostics:
        if d.severity == "error":
            number = table.place(d.uri, d.span.line)
            found.append(f"{d.code} {d.message}: {d.uri if number is None else table.lines[number]}")
    assert found == []
    return len(table.lines)


def test_a_part_of_the_table() -> None:
    r = Random(8)
    chosen = r.sample(list(expressions()), QUICK)
    assert build(chosen + r.sample(list(actions()), QUICK // 4), QUICK) > QUICK // 5


@pytest.mark.slow
@pytest.mark.parametrize("part", range(PARTS))
def test_the_whole_table(part: int) -> None:
    values = list(expressions())[part::PARTS]
    build(values + list(actions())[part::PARTS], len(values))
