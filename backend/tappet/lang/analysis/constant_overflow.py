"""Warnings about results of typed constants that are wrapped when they are folded (LOPR-02)."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis.context import Body
from tappet.lang.types import Elementary, Kind

_GROWING = frozenset({"+", "-", "*"})


def of_integers(b: Body, e: ast.Binary, op: str, left: object, right: object, computed: Elementary) -> None:
    """Compares the folded value with the exact one; of bit strings wrapping is meant."""
    if op not in _GROWING or not isinstance(left, int) or not isinstance(right, int):
        return
    exact = left + right if op == "+" else left - right if op == "-" else left * right
    if exact != e.constant and computed.kind is not Kind.BITS:
        larger = "LINT" if computed.size < 8 else "LREAL"
        b.report("W1007", e.span, value=exact, type=computed, wrapped=e.constant, call=f"TO_{larger}(x)")


def of_time(b: Body, e: ast.Binary, exact: object, computed: Elementary) -> None:
    """The same for TIME (ms) and LTIME (ns)."""
    if isinstance(exact, int) and isinstance(e.constant, int) and exact != e.constant:
        unit = "ms" if computed.size == 4 else "ns"
        value, wrapped = f"{exact} {unit}", f"{e.constant} {unit}"
        b.report("W1007", e.span, value=value, type=computed, wrapped=wrapped, call="LTIME#...")
