"""The expressions of watch lists: the evaluator of the runtime and that of the browser fulfil one table."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from expression_values import value_now
from plc_programs import build

from tappet.codegen.expressions.places import ExpressionError
from tappet.runtime.local import LocalRuntime

TABLE = json.loads((Path(__file__).parent / "data" / "watch_expressions.json").read_text(encoding="utf-8"))
"""Worked out by the rules of IEC 61131-3 and IEEE 754; frontend/src/online/computed.test.ts reads it, too."""
VALUES = {"true": True, "false": False, "Infinity": math.inf, "-Infinity": -math.inf, "NaN": math.nan}


@pytest.fixture(scope="module")
def runtime() -> Iterator[LocalRuntime]:
    variables = "".join(f"{name} : {type_} := {value};\n" for name, type_, value in TABLE["declaration"])
    with LocalRuntime(build(f"PROGRAM PLC_PRG\nVAR\n{variables}END_VAR\n;\nEND_PROGRAM\n")) as found:
        found.run(cycles=1)
        yield found


@pytest.mark.parametrize(("text", "kind", "expected"), TABLE["cases"], ids=lambda value: str(value))
def test_an_expression(runtime: LocalRuntime, text: str, kind: str | None, expected: str | None) -> None:
    """WAT-12."""
    try:
        found = value_now(runtime, text)
    except ExpressionError:
        found = None
    if expected is None or found is None:
        assert (found, kind) == (None, None)
        return
    assert type(found) is {"bool": bool, "int": int, "real": float}[str(kind)]
    wanted = VALUES.get(expected, float(expected) if kind == "real" else None)
    wanted = int(expected) if wanted is None else wanted
    assert found == wanted or (math.isnan(wanted) and math.isnan(found))
