"""Every elementary type into every other one: the compiler and the reference agree."""

from __future__ import annotations

from random import Random

import compared
import pytest
import typed_tree as tree
import write_st
from expressions import CLOCKS, CONVERTED_CLOCKS
from leaves import Leaves
from typed_tree import BOOL, NUMBERS, Assign, Builtin, Name, Program, Scalar, Variable

VALUES = 6
"""Values of each type: its limits, small ones, and what is around them."""


def targets(source: Scalar) -> list[Scalar]:
    """Times convert into those of their kind, and into numbers; numbers into all times but days."""
    if source.unit_ns:
        others = [c for c in CLOCKS if source in CONVERTED_CLOCKS[c]]
    else:
        others = [c for c in CLOCKS if c not in (tree.DATE, tree.LDATE)]
    return [t for t in (BOOL, *NUMBERS, *others) if t != source]


def program(source: Scalar, seed: int) -> Program:
    leaves = Leaves(Random(seed))
    given = [Variable(f"v{n}", source, leaves.literal_value(source)) for n in range(VALUES)]
    variables, body = list(given), []
    for target in targets(source):
        for variable in given:
            result = Variable(f"{target.name.lower()}_{variable.name}", target)
            variables.append(result)
            value = Name(source, source, False, variable.name)
            converted = Builtin(target, target, False, "convert", [value], [source])
            body.append(Assign(Name(target, target, False, result.name), converted))
    return Program([], [], [], variables, body, 1)


@pytest.mark.parametrize("level", [0, 2])
@pytest.mark.parametrize("source", [BOOL, *NUMBERS, *CLOCKS], ids=lambda t: t.name)
def test_every_pair(source: tree.Scalar, level: int) -> None:
    for seed in range(3):
        p = program(source, seed)
        assert compared.differences(p, level) == [], write_st.program(p)
