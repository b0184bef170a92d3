"""Variables at addresses do not share memory by accident.

Two variables at the very same address with the same type are taken as two names for one signal.

Source: spec LDEC-51, LDEC-57, language_declarations.md section 4.1.

Passes:
    VAR a AT %MW0 : INT; b AT %MW1 : INT; END_VAR
    a := b;
Fails:
    VAR a AT %MD0 : DINT; b AT %MW1 : INT; END_VAR   (* W1301: they share %MB2 *)
    a := b;
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.source import Scope
from tappet.lang.symbols import Storage, VarSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1301",)


def check_program(session: Session) -> None:
    """Reports partly overlapping variables of the areas Q and M."""
    placed: dict[str, list[tuple[int, int, VarSymbol]]] = {"Q": [], "M": []}
    for variable in _direct_variables(session):
        if variable.area in placed and variable.type is not None:
            start = 8 * variable.offset + (variable.bit or 0)
            length = 1 if variable.bit is not None else 8 * variable.type.size
            placed[variable.area].append((start, start + length, variable))
    for area, entries in placed.items():
        entries.sort(key=lambda entry: (entry[0], -entry[1]))
        reach: tuple[int, int, VarSymbol] | None = None
        for entry in entries:
            if reach is not None and entry[0] < reach[1]:
                same = entry[:2] == reach[:2] and entry[2].type == reach[2].type
                if not same:
                    _report(session, entry[2], reach[2], f"%{area}B{entry[0] // 8}")
            if reach is None or entry[1] > reach[1]:
                reach = entry


def _direct_variables(session: Session) -> list[VarSymbol]:
    tables: list[dict[str, VarSymbol]] = [gvl.members for gvl in session.analysis.gvls]
    tables += [pou.locals for pou in session.analysis.pous]
    found = {id(v): v for table in tables for v in table.values() if v.home is Storage.DIRECT}
    return [v for v in found.values() if v.source is not None and v.source.scope is not Scope.LIBRARY]


def _report(session: Session, one: VarSymbol, other: VarSymbol, address: str) -> None:
    assert one.source is not None
    if one.span is not None:
        session.report("W1301", one.source.uri, one.span, name=one.name, other=other.name, address=address)
