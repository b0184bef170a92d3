"""Every integer type with every other one: operators whose result has a type of its own (LOPR-02, LOPR-03).

What is computed is shifted then, where the width of the static type shows, and stored uncut beside it.
"""

from __future__ import annotations

import compared
import pytest
import typed_tree as tree
import write_st
from typed_tree import (
    INT,
    INTEGERS,
    LINT,
    ULINT,
    Assign,
    Binary,
    Builtin,
    Expr,
    Literal,
    Name,
    Program,
    Scalar,
    Variable,
)
from typing_rules import assignable, bit_type, common, meet


def results(left: Expr, right: Expr) -> list[Expr]:
    """Both operands under each operator."""
    assert isinstance(left.type, Scalar)
    assert isinstance(right.type, Scalar)
    pair = [left, right]
    result, computed = meet(left.type, right.type)
    held = common(left.type, right.type)
    bits = bit_type(left.type, right.type)
    found: list[Expr] = [Builtin(result, held, False, name, pair, [held] * 2) for name in ("MIN", "MAX")]
    found += [Binary(result, computed, False, op, left, right, computed) for op in ("+", "-", "*")]
    found += [Binary(bits, bits, False, op, left, right, bits) for op in ("AND", "XOR")]
    return found


def program(left: Scalar, names: tuple[str, str]) -> Program:
    variables = [
        Variable(f"a{n}", left, value) for n, value in enumerate((left.low, left.high, left.high // 3))
    ]
    body = []
    for right in INTEGERS:
        second = Variable(f"b_{right.name}", right, right.low or right.high - 1)
        variables.append(second)
        for first in list(variables[:3]):
            for value in results(*(Name(v.type, v.type, False, v.name) for v in (first, second))):
                assert isinstance(value.type, Scalar)
                one = Literal(INT, INT, True, 1)
                shown = [value]
                shown += [
                    Builtin(value.type, value.type, False, n, [value, one], [value.type, ULINT])
                    for n in names
                ]
                for e in shown:
                    target = LINT if assignable(e.type, LINT) else e.type
                    assert isinstance(target, Scalar)
                    stored = Variable(f"r{len(variables)}", target)
                    variables.append(stored)
                    body.append(Assign(Name(target, target, False, stored.name), e))
    return Program([], [], [], variables, body, 1)


@pytest.mark.parametrize("left", INTEGERS, ids=lambda t: t.name)
def test_pairs(left: tree.Scalar) -> None:
    number = INTEGERS.index(left)
    p = program(left, (("ROL", "SHR"), ("ROR", "SHL"))[number % 2])
    assert compared.differences(p, 2 * (number // 2 % 2)) == [], write_st.program(p)
