"""Every language case of the specification is built and run; what this depth lacks is listed by feature.

The expected failures are strict: a case that begins to pass has to leave the list.
"""

from __future__ import annotations

from collections import Counter
from typing import Any

import pytest
from tests.spec.language_cases import build, load_cases, matches, run

CASES = load_cases()
MISSING: dict[str, tuple[str, ...]] = {
    "declaration shorthand (an editor function)": tuple(f"EDIT-{n:02}" for n in range(1, 10)),
    "WSTRING functions of the standard library": ("TYPE-21",),
    "symbol configuration": ("PRAG-37",),
    "display mode of the monitor": ("PRAG-40",),
}
"""Feature that is not there yet, and the cases that need it."""
_FEATURE = {case: feature for feature, cases in MISSING.items() for case in cases}


def _parameter(case: dict[str, Any]) -> Any:
    feature = _FEATURE.get(case["id"])
    marks = [pytest.mark.xfail(strict=True, reason=feature)] if feature else []
    return pytest.param(case, id=case["id"], marks=marks)


@pytest.mark.parametrize("case", [_parameter(c) for c in CASES])
def test_case(case: dict[str, Any]) -> None:
    if case.get("language", "IL") != "IL":
        pytest.fail(f"language {case['language']}")
    expect = case["expect"]
    outcome = run(case)
    if "error" in expect:
        if case.get("error_kind") in ("watchdog", "runtime_exception"):
            assert outcome.errors == []
            assert outcome.fault is not None
            assert (outcome.fault == "watchdog") is (case["error_kind"] == "watchdog")
        else:
            assert outcome.errors, f"expected an error: {expect['error']}"
        return
    assert outcome.errors == []
    assert outcome.fault is None
    if "warning" in expect:
        assert outcome.warnings, f"expected a warning: {expect['warning']}"
    unknown = {"display", "symbols", "line"} & expect.keys()
    assert not unknown, f"checked elsewhere: {unknown}"
    result = build(case)
    package = result.package
    assert package is not None
    texts = [d.message for d in result.diagnostics]
    for message in case.get("messages", []):
        assert any(message["text"] in text for text in texts), message
    if "completion" in expect:
        wanted = expect["completion"]
        names = {c.name for c in package.symbols.children("PLC_PRG." + wanted["prefix"].rstrip("."))}
        assert set(wanted["contains"]) <= names
        assert not set(wanted["excludes"]) & names
        return
    wrong = {}
    for path, want in case.get("expect_after_task", expect).items():
        if path == "warning":
            continue
        got = outcome.values[path]
        if not matches(case, package, path, got, want):
            wrong[path] = (got, want)
    assert wrong == {}


def test_every_listed_case_exists() -> None:
    assert set(_FEATURE) <= {c["id"] for c in CASES}


def test_count_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    counts = Counter(_FEATURE.values())
    with capsys.disabled():
        print(f"\nlanguage cases: {len(CASES) - len(_FEATURE)} of {len(CASES)} run; {dict(counts)} to come")
    assert len(CASES) == 417
