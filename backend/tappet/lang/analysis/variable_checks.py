"""What rules say about the variables of a POU by what the code of the whole program names.

An edit changes that for few variables. So the messages of a POU stay until its own text is another one, what
it depends on is declared again, or one of its variables becomes or is no longer named or written somewhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from tappet.lang.analysis.context import Session
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.rules import VARIABLE_RULES
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol


class _Checked(NamedTuple):
    """One POU with its methods."""

    variables: frozenset[int]
    """id() of what it declares."""
    messages: list[Diagnostic]


class VariableChecks:
    """The messages of one program, from one analysis to the next."""

    def __init__(self) -> None:
        self._checked: dict[int, _Checked] = {}
        """By id() of the POU."""
        self._used: frozenset[int] = frozenset()
        self._written: frozenset[int] = frozenset()

    def forget(self, pous: Iterable[PouSymbol]) -> None:
        """These POUs, methods, actions or accessors, or what they depend on, are declared in another way."""
        for pou in pous:
            self._checked.pop(id(pou.owner or pou), None)

    def report(self, session: Session) -> None:
        """Adds the messages about all POUs but those of libraries."""
        changed = (session.used ^ self._used) | (session.written ^ self._written)
        self._used, self._written = frozenset(session.used), frozenset(session.written)
        for pou in session.analysis.pous:
            if pou.pou is None or pou.source is None or pou.source.scope is Scope.LIBRARY:
                continue
            known = self._checked.get(id(pou))
            if known is None or not known.variables.isdisjoint(changed):
                known = self._checked[id(pou)] = _check(session, pou)
            session.diagnostics += known.messages


def _check(session: Session, pou: PouSymbol) -> _Checked:
    found: list[Diagnostic] = []
    others, session.diagnostics = session.diagnostics, found
    for check in VARIABLE_RULES:
        check(session, pou)
    session.diagnostics = others
    blocks = [block for part in (pou, *pou.methods.values()) if part.pou for block in part.pou.blocks]
    variables = {id(decl.symbol) for block in blocks for decl in block.variables}
    return _Checked(frozenset(variables.union(map(id, pou.parameters))), found)
