"""Every language case of the specification is built and run."""

from __future__ import annotations

from typing import Any

import pytest
from tests.spec.language_cases import build, load_cases, matches, resolve, run

from tappet.codegen.display import display_text
from tappet.codegen.symbol_export import exported
from tappet.lang.services.shorthand import expand

CASES = load_cases()


@pytest.mark.parametrize("case", CASES, ids=[c["id"] for c in CASES])
def test_case(case: dict[str, Any]) -> None:
    expect = case["expect"]
    if case.get("language") == "declaration-shortcut":
        line = expand(case["code"])
        assert line is not None
        assert "".join(line.split()) == "".join(expect["line"].split())
        return
    result = build(case)
    outcome = run(case, result)
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
    package = result.package
    assert package is not None
    if "symbols" in expect:
        assert exported(package.symbols) == expect["symbols"]
        return
    if "display" in expect:
        shown = {
            path: display_text(package.symbols, resolve(package, path), outcome.values[path])
            for path in expect["display"]
        }
        assert shown == expect["display"]
        return
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


def test_no_case_is_left_out() -> None:
    assert len(CASES) == len({c["id"] for c in CASES}) == 417
