"""Formula channels of exports, against Python and numpy; the syntax as in the test of the editor."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.traces.formula import Formula, FormulaError, WithFormulas
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Batch, BatchSamples


def _value(text: str, **channels: float) -> float:
    formula = Formula(text)
    found = formula.values([np.array([channels[key.lower()]]) for key in formula.channels])
    return float(found[0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("-2 ** 2", 4),
        ("2 ** 3 ** 2", 64),
        ("2 ** -1", 0.5),
        ("10 - 4 - 3", 3),
        ("7 MOD 4 * 2", 6),
        ("-7 MOD 4", -3),
        ("TRUE OR FALSE AND FALSE", 1),
        ("NOT FALSE AND FALSE", 0),
        ("1 < 2 = (3 > 2)", 1),
        ("TRUE XOR TRUE OR TRUE", 1),
        ("16#FF + 2#101 + 1_000 + 1.5e1", 255 + 5 + 1000 + 15),
        ("LIMIT(0, 99, 10) + min(1, 2, -3) + Max(4, 5)", 12),
        ("SEL(FALSE, 1, 2)", 1),
        ("ATAN2(1, 2) + LOG(1000) + PI", math.atan2(1, 2) + 3 + math.pi),
    ],
)
def test_precedence_and_functions(text: str, expected: float) -> None:
    assert _value(text) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "empty"),
        ("1 +", "the end cannot stand at 4"),
        ("1 + * 2", "'\\*' cannot stand at 5"),
        ("(a", "the end"),
        ("a b", "'b' cannot stand at 3"),
        ("a ? b", "'\\?'"),
        ("1 + FOO(2)", "no function 'FOO'"),
        ("ABS(1, 2)", "'ABS' takes 1 to 1"),
        ("(" * 200 + "1" + ")" * 200, "too deeply"),
    ],
)
def test_what_is_wrong_is_told(text: str, says: str) -> None:
    with pytest.raises(FormulaError, match=says):
        Formula(text)


def test_a_long_sum_needs_no_deep_stack() -> None:
    assert _value("+".join("1" * 5000)) == 5000


def test_channels_are_paths_elements_and_pointers_in_any_case() -> None:
    formula = Formula("PLC_PRG.a - plc_prg.A + gvl.arr[2].x * p^.y + q^ + arr[i[1], 2]")
    assert formula.channels == ["PLC_PRG.A", "GVL.ARR[2].X", "P^.Y", "Q^", "ARR[I[1],2]"]


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


def test_samples_have_the_formulas_as_channels() -> None:
    cycle = np.arange(1000)
    values = np.sin(cycle / 50)
    channels = [ChannelInfo(0, "PLC_PRG.s", "LREAL", "f8"), ChannelInfo(2, "PLC_PRG.n", "INT", "i2")]
    samples = BatchSamples(channels, Batch(cycle, cycle, np.zeros(1000, "u1"), [values, cycle.astype("i2")]))
    formulas = [(1, "f", "s * 2 + n"), (3, "bad", "s +"), (4, "lost", "gone * 2"), (5, "five", "2 + 3")]
    found = WithFormulas(samples, ["s", "n"], formulas)
    assert [(c.index, c.name, c.type) for c in found.channels[2:]] == [
        (1, "f", "LREAL"),
        (3, "bad", "LREAL"),
        (4, "lost", "LREAL"),
        (5, "five", "LREAL"),
    ]
    assert found.native(2, 100, 900).tolist() == (values * 2 + cycle)[100:900].tolist()
    assert found.native(1, 5, 7).tolist() == [5, 6]
    assert np.isnan(found.native(3, 0, 10)).all()
    assert np.isnan(found.native(4, 0, 10)).all()
    assert found.native(5, 3, 7).tolist() == [5.0] * 4
    low, high = found.extremes(2, 0, 1000, 100)
    blocks = (values * 2 + cycle).reshape(10, 100)
    assert low.tolist() == blocks.min(1).tolist()
    assert high.tolist() == blocks.max(1).tolist()
