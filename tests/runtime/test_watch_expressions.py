"""The expressions of watch lists: the evaluator of the runtime and of the browser fulfil the same tables."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from expression_values import value_now
from hypothesis import assume, given
from hypothesis import strategies as st
from plc_programs import build

from tappet.codegen.expressions.compiler import compile_expression
from tappet.codegen.expressions.places import ExpressionError, kind_of
from tappet.lang.types import ELEMENTARY
from tappet.runtime.local import LocalRuntime

sys.path.insert(0, str(Path(__file__).parent))
import watch_trees
from iec_numbers import REALS, ImpossibleError

TABLE = json.loads((Path(__file__).parent / "data" / "watch_expressions.json").read_text(encoding="utf-8"))
"""Worked out by the rules of IEC 61131-3, LOPR-01..LOPR-03 and IEEE 754; the tests of the browser's
online/computed read it, too."""
MESSAGES = {
    "impossible": "is not possible with", "large": "is larger than any integer type",
    "literal": r"too large for type|is not a valid number|is no literal of type|invalid \w+ literal",
    "modulo": "MOD needs integers", "noNumber": "is no single number", "not": "NOT needs BOOL or a bit",
    "number": "needs a number, not", "operator": "is not possible here", "order": "BOOL is compared with =",
    "outside": "is outside", "text": "texts are not compared here",
    "timeDivisor": "is divided by an unsigned integer here", "divided": "has no value",
}  # fmt: skip
"""What the runtime says for each message of the browser."""


def _loaded(declaration: list[list[str]], types: str = "") -> LocalRuntime:
    variables = "".join(f"{name} : {type_} := {value};\n" for name, type_, value in declaration)
    found = LocalRuntime(build(f"{types}\nPROGRAM PLC_PRG\nVAR\n{variables}END_VAR\n;\nEND_PROGRAM\n"))
    found.run(cycles=1)
    return found


@pytest.fixture(scope="module")
def runtime() -> Iterator[LocalRuntime]:
    with _loaded(TABLE["declaration"], TABLE["types"]) as found:
        yield found


@pytest.fixture(scope="module")
def of_trees() -> Iterator[LocalRuntime]:
    with _loaded([list(row) for row in watch_trees.DECLARATION]) as found:
        yield found


def _check(runtime: LocalRuntime, text: str, held: str, expected: str | None) -> None:
    application = runtime.plc.application
    assert application is not None
    program = compile_expression(text, application.package.symbols)
    assert program.kind == kind_of(ELEMENTARY[held])
    found = value_now(runtime, text)
    if held in REALS and expected is not None:
        wanted = float(expected)
        assert isinstance(found, float)
        assert math.isnan(wanted) if math.isnan(found) else repr(found) == repr(wanted)
    else:
        assert watch_trees.shown(found, held) == expected


@pytest.mark.parametrize(("text", "held", "expected"), TABLE["cases"])
def test_an_expression(runtime: LocalRuntime, text: str, held: str, expected: str | None) -> None:
    """WAT-12."""
    _check(runtime, text, held, expected)


@pytest.mark.parametrize(("text", "message"), TABLE["refused"])
def test_what_is_refused(runtime: LocalRuntime, text: str, message: str) -> None:
    with pytest.raises(ExpressionError, match=MESSAGES[message]):
        value_now(runtime, text)


def test_all_messages_are_in_the_table() -> None:
    assert {message for _, message in TABLE["refused"]} == set(MESSAGES)


def test_the_table_of_random_expressions_is_that_of_the_reference() -> None:
    """Stale: `python tests/runtime/watch_trees.py`."""
    assert watch_trees.FILE.read_text(encoding="utf-8") == watch_trees.written()


def test_the_random_expressions_of_the_table(of_trees: LocalRuntime) -> None:
    for text, held, expected in watch_trees.rows():
        assert text is not None
        assert held is not None
        _check(of_trees, text, held, expected)


class _Choices:
    """Choices of hypothesis."""

    def __init__(self, data: st.DataObject) -> None:
        self._data = data

    def randrange(self, stop: int) -> int:
        return int(self._data.draw(st.integers(0, stop - 1)))


@given(st.data())
def test_a_random_expression_is_that_of_numpy(of_trees: LocalRuntime, data: st.DataObject) -> None:
    try:
        one = watch_trees.tree(_Choices(data), 3)
    except ImpossibleError:
        assume(False)
        return
    _check(of_trees, one.text, one.held, watch_trees.shown(one.value, one.held))
