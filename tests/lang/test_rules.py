"""The samples in the docstring of each rule do what they claim."""

from __future__ import annotations

import inspect
import re
from types import ModuleType

import pytest

from tappet.lang.analysis import analyse
from tappet.lang.diagnostic_pages import Sample, rule_text
from tappet.lang.parser import parse
from tappet.lang.rules import RULES
from tappet.lang.source import Source

SAMPLES = [
    pytest.param(rule, sample, id=f"{rule.__name__.rpartition('.')[2]}-{number}")
    for rule in RULES
    for number, sample in enumerate(rule_text(inspect.getdoc(rule) or "").samples)
]


def _whole(text: str) -> str:
    """Samples are objects, or types followed by the declarations and statements of a program."""
    if "END_FUNCTION" in text:
        return text
    types, found, rest = text.rpartition("END_TYPE\n")
    return f"{types}{found}PROGRAM Sample\n{rest}END_PROGRAM\n"


def _codes(sample: Sample) -> set[str]:
    result = parse(Source("sample", _whole(sample.text)))
    assert not result.diagnostics, [str(d) for d in result.diagnostics]
    return {d.code for d in analyse([result.unit]).diagnostics}


@pytest.mark.parametrize(("rule", "sample"), SAMPLES)
def test_sample(rule: ModuleType, sample: Sample) -> None:
    found = _codes(sample)
    if sample.passes:
        assert not found & set(rule.CODES)
    else:
        claimed = set(re.findall(r"[EW]\d{4}", sample.text))
        assert claimed
        assert claimed <= found
        assert claimed <= set(rule.CODES)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__.rpartition(".")[2])
def test_every_rule_explains_itself(rule: ModuleType) -> None:
    text = rule_text(inspect.getdoc(rule) or "")
    assert "Source:" in text.explanation
    assert {sample.passes for sample in text.samples} == {True, False}
    assert rule.CODES
