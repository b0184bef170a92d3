"""Heads and explanations of the operators in functional form (spec language_operators.md)."""

from __future__ import annotations

import csv
from importlib.resources import files
from typing import Final


def _read() -> dict[str, tuple[str, str]]:
    text = files("tappet.lang.services").joinpath("operators.csv").read_text(encoding="utf-8")
    return {row["name"]: (row["head"], row["explanation"]) for row in csv.DictReader(text.splitlines())}


OPERATOR_HEADS: Final[dict[str, tuple[str, str]]] = _read()
"""Upper-case name to head and explanation, from `operators.csv`."""

CONVERTIBLE: Final = (
    "BOOL", "BYTE", "WORD", "DWORD", "LWORD", "SINT", "USINT", "INT", "UINT", "DINT", "UDINT", "LINT",
    "ULINT", "REAL", "LREAL", "TIME", "LTIME", "DATE", "TOD", "DT", "STRING", "WSTRING",
)  # fmt: skip
"""Types between which `<T1>_TO_<T2>` and `TO_<T2>` convert."""


def head_of(name: str) -> tuple[str, str] | None:
    """Head and explanation of an operator or conversion; None if it is none."""
    key = name.upper()
    known = OPERATOR_HEADS.get(key)
    if known is not None:
        return known
    before, mark, target = key.rpartition("TO_")
    if not mark or target not in CONVERTIBLE:
        return None
    if before in ("", "ANY_"):
        return f"{key}(IN : ANY) : {target}", f"Converts to {target}."
    source = before.removesuffix("_")
    if before.endswith("_") and source in CONVERTIBLE:
        return f"{key}(IN : {source}) : {target}", f"Converts {source} to {target}."
    return None
