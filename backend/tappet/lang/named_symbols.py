"""The symbols, types and enumeration values that the bodies of a program name, kept between edits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    NamespaceSymbol,
    PouSymbol,
    Storage,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.types import Type
from tappet.lang.walk import all_expressions, expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session


def is_own(source: Source | None) -> bool:
    """Whether a text belongs to the project and not to a library."""
    return source is not None and source.scope is not Scope.LIBRARY


def with_parts(session: Session) -> Iterator[PouSymbol]:
    """Every POU, library or own, with its methods, actions and accessors."""
    for pou in session.analysis.pous:
        yield from pou.with_children()


@dataclass(slots=True)
class Named:
    """What a body names, as far as rules of the whole program use it at each edit."""

    symbols: set[int] = field(default_factory=set)
    """id() of all that it names."""
    values: set[tuple[int, str]] = field(default_factory=set)
    """Values of enumerations: id() of the type, upper-case name."""
    types: list[Type | None] = field(default_factory=list)
    """Types that it names."""
    plain: dict[int, ast.Name] = field(default_factory=dict)
    """The first plain name of what can also be written with a list or a library before it, by id()."""
    qualified: dict[int, ast.Member] = field(default_factory=dict)
    """The first name of each behind a list or a library."""

    def read(self, found: Iterable[ast.Expr]) -> None:
        """Enters names and members among expressions."""
        for e in found:
            if not isinstance(e, (ast.Name, ast.Member)):
                continue
            symbol: Symbol | None = e.symbol
            self.symbols.add(id(symbol))
            if isinstance(symbol, EnumValueSymbol):
                self.values.add((id(symbol.type), symbol.name.upper()))
                self.types.append(symbol.type)
            elif isinstance(symbol, TypeSymbol):
                self.types.append(symbol.type)
            elif isinstance(symbol, (VarSymbol, PouSymbol)):
                if isinstance(e, ast.Name):
                    if _is_shared(symbol) and not e.leading_dot:
                        self.plain.setdefault(id(symbol), e)
                elif _is_list(e.base):
                    self.qualified.setdefault(id(symbol), e)


def named_in(session: Session, pou: PouSymbol) -> Named:
    """What the statements of a body name; kept until the body is analysed again."""
    found: Named | None = session.named.get(id(pou))
    if found is None:
        found = session.named[id(pou)] = Named()
        body = pou.pou.body if pou.pou is not None else []
        found.read(all_expressions(body))
        for s in statements(body):
            if isinstance(s, ast.Case):
                labels = [label for branch in s.branches for label in branch.selectors]
                found.read(expressions(*(e for label in labels for e in (label.low, label.high))))
    return found


def _is_shared(symbol: VarSymbol | PouSymbol) -> bool:
    """Whether a plain name can also be written with a list or a library before it."""
    if isinstance(symbol, VarSymbol):
        return symbol.home is Storage.GLOBAL and symbol.section == "VAR_GLOBAL"
    return symbol.source is not None and symbol.source.scope is Scope.LIBRARY


def _is_list(e: ast.Expr) -> bool:
    return isinstance(e, (ast.Name, ast.Member)) and isinstance(e.symbol, (GvlSymbol, NamespaceSymbol))
