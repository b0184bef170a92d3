"""SM3_CNC: SMC_NCDecoder on words that no parser makes: an error or finite objects, never a fault."""

from __future__ import annotations

import math

from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_decoder import decoder, outcome, write_words

from tappet.cnc.commands import COMMANDS
from tappet.cnc.letters import LETTERS
from tappet.cnc.word_list import CodeWord

VALUES = st.one_of(
    st.integers(-5, 120).map(float),
    st.floats(-100, 100),
    st.floats(width=64),
    st.sampled_from([0.0, -0.0, 1e-300, 1e9, 2147483647.0]),
)
WORDS = st.one_of(
    st.tuples(st.just(LETTERS["G"]), st.sampled_from(sorted(COMMANDS)).map(float)),
    st.tuples(st.sampled_from([0, 0, *(ord(letter) for letter in "XYZIJKRTPEFDHLOM")]), VALUES),
    st.tuples(st.integers(0, 255), VALUES),
).map(lambda word: CodeWord(*word))


@settings(max_examples=150, deadline=None)
@given(st.lists(WORDS, max_size=60))
def test_any_words(words: list[CodeWord]) -> None:
    """cnc 13: what has no sense is an error; what comes out has finite numbers and can be driven."""
    with decoder("") as program:
        write_words(program, words)
        decoded = outcome(program, cycles=40)
    for geo in decoded.objects:
        assert all(math.isfinite(value) for value in geo.values.values())
        if geo.kind != "MCOMMAND":
            assert geo["dAccel"] > 0
            assert geo["dDecel"] > 0
