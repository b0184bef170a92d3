"""Formula channels of exports: the table that binds the editor, too; random ones against Python and numpy."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tappet.project.trace import TraceChannel, TraceRecord
from tappet.traces.formula import Formula, FormulaError, channel_key
from tappet.traces.formula_channels import FormulasError, WithFormulas, check_formulas
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch, BatchSamples

sys.path.insert(0, str(Path(__file__).parent))
import formula_trees

CASES = json.loads((Path(__file__).parent / "data" / "formula_cases.json").read_text(encoding="utf-8"))
"""Worked out by IEC 61131-3 and IEEE 754; the test of the editor's formula.ts reads them, too."""


def _value(text: str, **channels: float) -> float:
    formula = Formula(text)
    found = formula.values([np.array([channels[key.lower()]]) for key in formula.channels])
    return float(found[0])


def _same(found: float, expected: float) -> bool:
    if math.isnan(expected) or math.isinf(expected) or expected == 0:
        return repr(found) == repr(expected)
    return math.isclose(found, expected, rel_tol=1e-15)


@pytest.mark.parametrize(("text", "expected"), CASES["values"])
def test_values(text: str, expected: str) -> None:
    found = _value(text)
    assert _same(found, float(expected)), found


@pytest.mark.parametrize(("text", "fault", "at", "word"), CASES["faults"])
def test_what_is_wrong_is_told(text: str, fault: str, at: int, word: str) -> None:
    with pytest.raises(FormulaError) as error:
        Formula(text)
    assert (error.value.fault, error.value.at, error.value.word) == (fault, at, word)
    assert fault in ("empty", "arguments") or f"at {at + 1}" in str(error.value)


@pytest.mark.parametrize(("text", "names"), CASES["channels"])
def test_channels(text: str, names: list[str]) -> None:
    formula = Formula(text)
    assert formula.channels == [channel_key(name) for name in names]
    assert ["".join(word.split()) for word, _ in formula.spelt] == names
    assert all(text[at:].startswith(word) for word, at in formula.spelt)


def test_the_table_of_random_formulas_is_that_of_the_reference() -> None:
    """Stale: `python tests/traces/formula_trees.py`."""
    assert formula_trees.FILE.read_text(encoding="utf-8") == formula_trees.written()


class _Choices:
    """Choices of hypothesis."""

    def __init__(self, data: st.DataObject) -> None:
        self._data = data

    def randrange(self, stop: int) -> int:
        return int(self._data.draw(st.integers(0, stop - 1)))


@given(st.data())
def test_a_random_formula_is_that_of_python(data: st.DataObject) -> None:
    """Bit by bit, as all machines have what IEEE 754 rounds correctly."""
    expected = formula_trees.tree(_Choices(data), 4)
    assume(expected.exact)
    found = _value(expected.text, **formula_trees.CHANNELS)
    assert formula_trees.same(found, expected), (expected.text, found, expected.value)


@given(st.sampled_from(formula_trees.ONE), st.floats())
def test_a_function_is_that_of_python(
    function: tuple[str, Callable[[float], float], bool], value: float
) -> None:
    name, of, _ = function
    assume(not math.isnan(value))
    assert _same(_value(f"{name}(x)", x=value), of(value))


@given(st.floats(allow_nan=False), st.floats(allow_nan=False), st.sampled_from(["x ** y", "EXPT(x, y)"]))
def test_a_power_is_that_of_python(x: float, y: float, text: str) -> None:
    assert _same(_value(text, x=x, y=y), formula_trees.power(x, y))


@given(st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_an_angle_is_that_of_python(y: float, x: float) -> None:
    assert _same(_value("ATAN2(y, x)", x=x, y=y), math.atan2(y, x))


@given(st.text(alphabet="aA1_.^[]()+-*/<>=,&# ?eE0TRUMODabsN速ß\t", max_size=30))
def test_any_text_is_read_or_refused_with_its_place(text: str) -> None:
    try:
        Formula(text)
        fault = None
    except FormulaError as error:
        fault = error
    assert fault is None or text[fault.at :].startswith(fault.word)


reals = st.floats(-1e6, 1e6)


@given(st.lists(st.tuples(reals, reals), min_size=1, max_size=50), st.sets(st.integers(0, 49)))
def test_each_sample_is_that_of_python(pairs: list[tuple[float, float]], missing: set[int]) -> None:
    x, y = (np.array(column) for column in zip(*pairs, strict=True))
    x[[k for k in missing if k < len(x)]] = np.nan
    found = Formula("LIMIT(-10, x, 10) * 2 - ABS(y) + SEL(x > y, 1, 3)").values([x, y])
    for k, (a, b) in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
        if math.isnan(a):
            assert math.isnan(found[k])
        else:
            assert found[k] == min(max(a, -10), 10) * 2 - abs(b) + (3 if a > b else 1)


def _formulas(*texts: tuple[int, str, str]) -> list[tuple[int, TraceChannel]]:
    return [(number, TraceChannel(name=name, formula=text)) for number, name, text in texts]


def _samples() -> BatchSamples:
    cycle = np.arange(1000)
    channels = [ChannelInfo(0, "PLC_PRG.s", "LREAL", "f8"), ChannelInfo(2, "PLC_PRG.n", "INT", "i2")]
    values = [np.sin(cycle / 50), cycle.astype("i2")]
    return BatchSamples(channels, Batch(cycle, cycle, np.zeros(1000, "u1"), values))


def test_samples_have_the_formulas_as_channels() -> None:
    cycle = np.arange(1000)
    values = np.sin(cycle / 50)
    found = WithFormulas(_samples(), ["s", "n"], _formulas((1, "f", "s * 2 + n"), (5, "five", "2 + 3")))
    assert [(c.index, c.name, c.type) for c in found.channels[2:]] == [
        (1, "f", "LREAL"),
        (5, "five", "LREAL"),
    ]
    assert found.native(2, 100, 900).tolist() == (values * 2 + cycle)[100:900].tolist()
    assert found.native(1, 5, 7).tolist() == [5, 6]
    assert found.native(3, 3, 7).tolist() == [5.0] * 4
    low, high = found.extremes(2, 0, 1000, 100)
    blocks = (values * 2 + cycle).reshape(10, 100)
    assert low.tolist() == blocks.min(1).tolist()
    assert high.tolist() == blocks.max(1).tolist()


def test_of_two_channels_with_one_name_the_first_is_meant() -> None:
    """As in the editor."""
    found = WithFormulas(_samples(), ["n", "N"], _formulas((3, "f", "n")))
    assert found.native(2, 10, 12).tolist() == np.sin(np.arange(10, 12) / 50).tolist()


def test_all_formulas_without_values_are_told() -> None:
    texts = _formulas((1, "f", "s * 2"), (3, "bad", "s +"), (4, "lost", "s + gone . x"), (6, "over", "f * 2"))
    with pytest.raises(FormulasError) as error:
        WithFormulas(_samples(), ["s", "n"], texts)
    assert [(one.channel, one.name, one.message) for one in error.value.problems] == [
        (3, "bad", "something is missing at the end (at 4)"),
        (4, "lost", "no recorded variable is called 'gone . x' (at 5); there are: s, n"),
        (6, "over", "no recorded variable is called 'f' (at 1); there are: s, n"),
    ]


def test_the_settings_of_a_record_tell_it_before_anything_is_recorded() -> None:
    good = [TraceChannel(variable="PLC_PRG.x", name="x"), TraceChannel(formula="X + 1", name="f")]
    check_formulas(TraceRecord(channels=tuple(good)))
    with pytest.raises(FormulasError, match="no recorded variable is called 'y'"):
        check_formulas(TraceRecord(channels=(*good, TraceChannel(formula="y + 1"))))
