"""What is compiled without being called."""

from __future__ import annotations

from tappet.core.lower import lower
from tappet.lang.analysis import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

TEXTS = (
    "{attribute 'linkalways'}\nFUNCTION_BLOCK Always VAR x : INT; END_VAR x := x + 1; END_FUNCTION_BLOCK",
    "FUNCTION_BLOCK Never VAR x : INT; END_VAR x := x + 1; END_FUNCTION_BLOCK",
    "{attribute 'linkalways'}\nFUNCTION F : INT F := 1; END_FUNCTION",
)


def test_marked_objects_are_compiled_without_a_call() -> None:
    """LPRG-30."""
    analysis = analyse([parse(Source(f"text{n}", text)).unit for n, text in enumerate(TEXTS)])
    assert analysis.ok
    names = set(lower(analysis).module.functions)
    assert {"Always", "F"} <= names
    assert "Never" not in names
