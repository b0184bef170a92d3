"""Names of variables: prefix by type, length, spelling.

Source: coding guidelines of PLCopen, N2 (prefixes), N4 (length), N6 (characters), N7 (reserved words), N10
(names of constants); `lang.coding_settings` holds prefixes and limits.

Passes:
    @static
    VAR bStart : BOOL; nCount : INT; END_VAR
    VAR CONSTANT MAX_COUNT : INT := 10; END_VAR
    bStart := nCount > MAX_COUNT;
Fails:
    @static
    VAR start : BOOL; END_VAR      (* S1004: bStart *)
    start := TRUE;
Fails:
    @static
    VAR
        nCounterOfAllTheBottlesThatWereFilledToday : INT; (* S1005: too long *)
        x : INT;                   (* S1006: too short *)
    END_VAR
    x := nCounterOfAllTheBottlesThatWereFilledToday;
Fails:
    @static
    VAR nCount : INT; END_VAR
    NCOUNT := 1;                   (* S1007: written in another way *)
Fails:
    @static
    VAR CONSTANT maxCount : INT := 10; END_VAR   (* S1008: MAX_COUNT *)
    VAR nCount : INT; END_VAR
    nCount := maxCount;
Fails:
    @static
    VAR ton : INT; END_VAR         (* S1009: the name of a timer *)
    ton := 1;
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.coding_settings import CodingSettings
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Array, Pointer, Reference, String
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1004", "S1005", "S1006", "S1007", "S1008", "S1009")
_STANDARD = frozenset(
    {"TON", "TOF", "TP", "RTO", "CTU", "CTD", "CTUD", "R_TRIG", "F_TRIG", "RS", "SR", "SEMA", "RTC"}
)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports names of variables, and names written in another way than declared."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    for block in pou.pou.blocks:
        constant = "CONSTANT" in block.flags
        for decl in block.variables:
            for code, fields in _faults(decl, constant, b.session.options.static.settings):
                if code in chosen:
                    b.report(code, decl.name_span, name=decl.name, **fields)
    if "S1007" in chosen:
        for e in all_expressions(pou.pou.body):
            if isinstance(e, (ast.Name, ast.Member)) and isinstance(e.symbol, VarSymbol):
                declared = e.symbol.name
                if e.name != declared and e.name.upper() == declared.upper():
                    b.report("S1007", e.span, name=e.name, declared=declared)


def _faults(
    decl: ast.VarDecl, constant: bool, settings: CodingSettings
) -> Iterator[tuple[str, dict[str, object]]]:
    name = decl.name
    if constant:
        if name != name.upper():
            yield "S1008", {"proposal": name.upper()}
    else:
        prefix = _prefix(getattr(decl.symbol, "type", None), settings.prefixes)
        if prefix and not name.startswith(prefix):
            yield "S1004", {"prefix": prefix, "type": getattr(decl.symbol, "type", "")}
    if len(name) > settings.longest_name:
        yield "S1005", {"length": len(name), "limit": settings.longest_name}
    if len(name) < settings.shortest_name and name.lower() not in ("i", "j", "k"):
        yield "S1006", {"limit": settings.shortest_name}
    if name.upper() in _STANDARD:
        yield "S1009", {}


def _prefix(type_: object, prefixes: Mapping[str, str]) -> str:
    if isinstance(type_, Pointer):
        return prefixes.get("POINTER", "")
    if isinstance(type_, Reference):
        return prefixes.get("REFERENCE", "")
    if isinstance(type_, Array):
        return prefixes.get("ARRAY", "")
    if isinstance(type_, String):
        return prefixes.get("STRING", "")
    return prefixes.get(str(type_), "")
