"""Runs the `.st` files of `behaviour`: a program, and in comments what must come out of the libraries.

// CYCLES: 12                 calls of Main (default 1), 10 ms of virtual time apart
// EXPECT: Main.x = 7         value after the last one, as IEC literal
// NEAR: Main.y = 0.3333333   value after the last one, equal to 6 digits
"""

import math
import re
from pathlib import Path

import pytest
from tests.libraries.st_program import run

FILES = sorted((Path(__file__).parent / "behaviour").glob("*.st"))
_DIRECTIVE = re.compile(r"^\s*//\s*(CYCLES|EXPECT|NEAR):\s*(.+?)\s*$", re.MULTILINE)


@pytest.mark.parametrize("path", FILES, ids=[file.stem for file in FILES])
def test_file(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    cycles, exact, near = 1, {}, {}
    for kind, value in _DIRECTIVE.findall(text):
        expression, _, expected = (part.strip() for part in value.partition("="))
        if kind == "CYCLES":
            cycles = int(value)
        elif kind == "EXPECT":
            exact[expression] = expected
        else:
            near[expression] = [float(number) for number in expected.strip("[]").split(",")]
    assert exact or near, "the file expects nothing"
    with run(text, cycles) as program:
        assert {expression: program.literal(expression) for expression in exact} == exact
        for expression, wanted in near.items():
            got = program.numbers(expression)
            assert len(got) == len(wanted)
            assert all(
                math.isclose(g, w, rel_tol=1e-6, abs_tol=1e-6) for g, w in zip(got, wanted, strict=True)
            ), (
                expression,
                got,
            )
