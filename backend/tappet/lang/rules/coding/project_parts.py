"""What a project consists of: the bodies of a program and what they name."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import PouSymbol
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session


def is_own(source: Source | None) -> bool:
    """Whether a text belongs to the project and not to a library."""
    return source is not None and source.scope is not Scope.LIBRARY


def with_parts(session: Session) -> Iterator[PouSymbol]:
    """Every POU, library or own, with its methods, actions and accessors."""
    for pou in session.analysis.pous:
        yield from pou.with_children()


def names_in(session: Session, pou: PouSymbol) -> list[ast.Name | ast.Member]:
    """The names and members in the statements of a body; kept, as several rules ask for them at each edit."""
    found = session.named.get(id(pou))
    if found is None or found[0] is not pou.pou:
        body = pou.pou.body if pou.pou is not None else []
        names = [e for e in all_expressions(body) if isinstance(e, (ast.Name, ast.Member))]
        found = session.named[id(pou)] = (pou.pou, names)
    return found[1]
