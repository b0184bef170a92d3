"""CASE over an enumeration names every value or has an ELSE.

A value that is added to the enumeration later is then found by the compiler, not on the machine.

Source: IEC 61131-3 7.3.3.3.3; spec LST-26.

Passes:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; x : INT; END_VAR
    CASE eMode OF
        Off: x := 0;
        On: x := 1;
    END_CASE
Passes:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; x : INT; END_VAR
    CASE eMode OF
        Off: x := 0;
    ELSE
        x := 1;
    END_CASE
Fails:
    TYPE E_Mode : (Off, On); END_TYPE
    VAR eMode : E_Mode; x : INT; END_VAR
    CASE eMode OF                  (* W1104: On is not handled *)
        Off: x := 0;
    END_CASE
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Enum

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1104",)
NODES = (ast.Case,)
_SHOWN = 4


def check_statement(b: Body, s: ast.Case) -> None:
    """Reports the values of the enumeration that no label names."""
    enum = s.selector.type
    if s.otherwise is not None or not isinstance(enum, Enum):
        return
    ranges: list[tuple[int, int]] = []
    for branch in s.branches:
        for selector in branch.selectors:
            low = selector.low.constant
            high = low if selector.high is None else selector.high.constant
            if not isinstance(low, int) or not isinstance(high, int):
                return
            ranges.append((low, high))
    missing = [n for n, v in enum.values.items() if not any(low <= v <= high for low, high in ranges)]
    if missing:
        names = ", ".join(f"'{n}'" for n in missing[:_SHOWN]) + (" ..." if len(missing) > _SHOWN else "")
        b.report("W1104", s.selector.span, names=names, type=enum)
