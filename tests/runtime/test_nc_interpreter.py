"""SMC_ReadNCFile2 and SMC_NCInterpreter: expressions, local variables, subprograms, functions of the application."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from nc_interpreter import Interpreter


@pytest.fixture
def program(tmp_path: Path) -> Iterator[Interpreter]:
    with Interpreter.running(tmp_path) as running:
        yield running


def test_example_of_subprograms(program: Interpreter) -> None:
    """Spec EX-31: a line, two half circles that come back; 10 and 125.6637 long."""
    found = program.run(
        {
            "main.cnc": "N0 G1 X10 F50\nN10 ARCS{20}",
            "arcs.cnc": "SUBPROGRAM ARCS{#R : LREAL}\nN0 G91\nN10 G2 X#R*2 Y0 R#R\nN20 G2 X-#R*2 Y0 R#R\n"
            "END_SUBPROGRAM\n",
        }
    )
    assert found.done
    assert found.kinds == [1, 2, 2]
    assert found.xs == pytest.approx([10, 50, 10])
    assert sum(found.lengths) == pytest.approx(10 + 125.66370614359172)
