"""Every message has samples, of what is reported and of what is right, and they do what they claim."""

from __future__ import annotations

import pytest
from sample_stage import diagnose

from tappet.lang.diagnostics import TABLE
from tappet.lang.rules import all_rules
from tappet.lang.sample_texts import Sample, read_samples, samples, text_of_rule

SAMPLES = [
    pytest.param(code, sample, id=f"{code}-{'passes' if sample.passes else 'fails'}-{number}")
    for code, entries in samples().items()
    for number, sample in enumerate(entries)
]


@pytest.mark.parametrize(("code", "sample"), SAMPLES)
def test_sample(code: str, sample: Sample) -> None:
    found = {d.code for d in diagnose(sample.text)}
    if sample.passes:
        assert code not in found
        assert not {c for c in found if c[0] == "E"}, "what is shown as right must be right"
    else:
        assert code in found


WITHOUT_SAMPLE = {"E0905", "E0130", "E0131", "E0132"}
"""What no program should bring about: tests/codegen/test_internal_errors.py does; and messages about drawn
bodies, which are no text: tests/server/test_plugged_in_language.py has those."""


@pytest.mark.parametrize("code", sorted(TABLE.keys() - WITHOUT_SAMPLE))
def test_every_code_has_a_sample_that_passes_and_one_that_fails(code: str) -> None:
    assert {sample.passes for sample in samples().get(code, ())} == {True, False}


def test_every_sample_is_of_a_code_of_the_table() -> None:
    assert set(samples()) <= set(TABLE)


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.__name__.rpartition(".")[2])
def test_every_module_among_the_rules_is_a_rule(rule: object) -> None:
    assert getattr(rule, "CODES", ()), "an analysis that rules share belongs in lang/dataflow"


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.__name__.rpartition(".")[2])
def test_every_rule_explains_itself(rule: object) -> None:
    text = text_of_rule(rule)
    assert "Source:" in text.explanation
    assert {sample.passes for sample in text.samples} == {True, False}
    claimed = {code for sample in text.samples for code in sample.codes}
    assert claimed <= set(rule.CODES)


def test_samples_of_a_text_file() -> None:
    found = read_samples("=== E0001\na\n--- accepted\nb\n\n=== E0002\nc\n")
    assert [(s.codes, s.passes, s.text) for s in found] == [
        (("E0001",), False, "a\n"),
        (("E0001",), True, "b\n"),
        (("E0002",), False, "c\n"),
    ]
