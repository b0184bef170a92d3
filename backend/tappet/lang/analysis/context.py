"""What the passes share: the session of one analysis, and the view of one text (`Body`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any, NamedTuple, TypeVar

from tappet.lang import ast
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.analysis.scope import Fits, Levels, QualifiedSymbol, suggestion
from tappet.lang.attributes import attribute
from tappet.lang.diagnostics import Diagnostic, Related, report
from tappet.lang.source import Source, Span
from tappet.lang.symbols import PouSymbol, Symbol
from tappet.lang.types import Type

SUGGESTION_LIMIT = 200
"""Closest matches are searched for so many unknown names of one analysis: the search is slow."""


class DirectWrite(NamedTuple):
    """A write to a variable or operand at an address: bits from `first` up to `last`, not included."""

    area: str
    first: int
    last: int
    name: str
    uri: str
    span: Span


@dataclass(slots=True)
class Record:
    """What one part of the program has reported, named, written and called; sets hold id() of symbols.
    `operands`, `outputs`: see `Session`."""

    messages: list[Diagnostic] = field(default_factory=list)
    coding: list[Diagnostic] = field(default_factory=list)
    """What the coding rules report."""
    used: set[int] = field(default_factory=set)
    written: set[int] = field(default_factory=set)
    called: set[int] = field(default_factory=set)
    operands: set[tuple[str, int]] = field(default_factory=set)
    outputs: set[DirectWrite] = field(default_factory=set)
    aggregates: bool = False
    """Whether statements hold `(a := 1)`: it names members without a variable they are in."""
    incomplete: bool = False
    """Whether a variable is declared at an incomplete address `%I*`."""


Key = tuple[type, str, str]
"""Class, owner and upper-case name of what a text declares."""
Made = TypeVar("Made")


@cache
def _content_of(kind: type) -> tuple[str, ...]:
    return tuple(f.name for f in fields(kind))


@dataclass(slots=True)
class Session:
    """State of one analysis."""

    options: AnalysisOptions
    analysis: Analysis
    levels: Levels = field(default_factory=Levels)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    resolve: Callable[[Symbol], None] = lambda symbol: None
    """Gives a variable its type, and its value when it is constant; set by the declarations pass."""
    type_of: Callable[[Body, ast.TypeRef, str], Type | None] = lambda body, ref, name: None
    """The type that a body writes; set by the declarations pass."""
    complete: Callable[[Type], object] = lambda type_: None
    """Makes sure that size and members of a type are known; set by the declarations pass."""
    used: set[int] = field(default_factory=set)
    """id() of every variable that some code names."""
    written: set[int] = field(default_factory=set)
    """id() of every variable that some code assigns, passes as VAR_IN_OUT or takes the address of."""
    calls: dict[int, list[tuple[PouSymbol, str, Span]]] = field(default_factory=dict)
    """Calls to a POU by id() of the caller, with their place."""
    called: set[int] = field(default_factory=set)
    """id() of every POU that is called, instantiated or whose address is taken."""
    operands: set[tuple[str, int]] = field(default_factory=set)
    """Area and last byte + 1 of every address that some code names."""
    outputs: set[DirectWrite] = field(default_factory=set)
    """Places of the areas Q and M that some code writes."""
    suggestions: int = 0
    named: dict[int, Any] = field(default_factory=dict)
    """What coding rules have read in a body as it is resolved now, by id() of the symbol."""
    aggregates: bool = False
    """Whether an aggregate `(a := 1)` has been met."""
    declared: dict[str, Record] = field(default_factory=dict)
    """What the declarations of each text have named, by its uri."""
    values_of_project: bool = False
    """Whether a value for a parameter of a library names what the project declares."""
    named_outside: frozenset[str] = frozenset()
    """Where libraries are analysed for an application: names that its objects have, upper case."""
    extended_outside: frozenset[str] = frozenset()
    """The same: names of blocks that it extends."""
    accounted: str | None = None
    """Text whose declarations name what is named now."""
    made: dict[str, dict[Key, Any]] = field(default_factory=dict)
    """Symbols and types of what each text declares, by its uri."""
    before: dict[str, dict[Key, Any]] = field(default_factory=dict)
    """The same, from before an edit, of the texts that are being declared again."""

    def stand_for(self, made: Made, uri: str, owner: str = "") -> Made:
        """`made`; or what denoted the same before an edit, with the content of `made`, as others refer to
        it."""
        key = (made.__class__, owner, made.name.upper())  # type: ignore[attr-defined]
        earlier = self.before.get(uri)
        old = earlier.pop(key, None) if earlier else None
        if old is not None:
            for name in _content_of(old.__class__):
                setattr(old, name, getattr(made, name))
            made = old
        known = self.made.get(uri)
        if known is None:
            known = self.made[uri] = {}
        known.setdefault(key, made)
        return made

    def record_of(self, uri: str) -> Record:
        """What the declarations of a text have named and reported."""
        record = self.declared.get(uri)
        if record is None:
            record = self.declared[uri] = Record()
        return record

    def account(self, uri: str) -> tuple[Any, ...] | None:
        """What is named from now on is named by the declarations of a text; give the result to `resume`."""
        if uri == self.accounted:
            return None
        before = (self.accounted, self.used, self.written, self.called, self.operands, self.outputs)
        self.accounted = uri
        self.count_in(self.record_of(uri))
        return before

    def resume(self, before: tuple[Any, ...] | None) -> None:
        """Ends what `account` has begun."""
        if before is not None:
            self.accounted, self.used, self.written, self.called, self.operands, self.outputs = before

    def count_in(self, record: Record) -> None:
        """What is named from now on goes to `record`."""
        self.used, self.written, self.called = record.used, record.written, record.called
        self.operands, self.outputs = record.operands, record.outputs

    def report(
        self, code: str, uri: str, span: Span, related: Iterable[Related] = (), /, **fields: object
    ) -> None:
        """Adds a message."""
        self.diagnostics.append(report(code, uri, span, related, **fields))

    def report_qualified(self, uri: str, span: Span, symbol: QualifiedSymbol) -> None:
        """Adds the message about a name that stands without what belongs in front of it."""
        code = "E0220" if symbol.library else "E0207"
        self.report(code, uri, span, name=symbol.name, choice=symbol.choice, library=symbol.library)


class Body:
    """One text as the passes see it: what its names mean and where its messages go."""

    __slots__ = (
        "assigned",
        "called",
        "callee",
        "held",
        "jumps",
        "labels",
        "locals",
        "loop_variables",
        "loop_writes",
        "loops",
        "names",
        "pou",
        "session",
        "source",
        "unreadable",
        "uri",
        "values",
    )  # fmt: skip

    def __init__(
        self, session: Session, source: Source, pou: PouSymbol | None, visible: dict[str, Symbol]
    ) -> None:
        self.session = session
        self.source = source
        self.uri = source.uri
        self.pou = pou
        self.locals = visible
        self.names = session.levels.seen_by(source)
        self.values = session.levels.values_seen_by(source)
        """Of the names of types: what they mean where a value stands."""
        self.begin()

    def begin(self) -> None:
        """Forget what was found in the statements: they are resolved, for the first time or again."""
        self.loops = 0
        self.labels: dict[str, Span] = {}
        self.jumps: list[ast.Jump] = []
        self.loop_variables: list[Symbol] = []
        self.called: list[tuple[PouSymbol, str, Span]] = []
        self.callee: ast.Expr | None = None
        """What the call being resolved calls."""
        self.assigned: ast.Expr | None = None
        """The value of the assignment being resolved: `__NEW` is legal only there."""
        self.loop_writes: list[tuple[Symbol, Span]] = []
        self.unreadable: list[ast.Name | ast.Member] = []
        """Properties without Get that are not assigned, as far as is known."""
        self.held: dict[int, ast.Expr] = {}
        """What the accumulator of IL holds, by the number of its place."""

    def report(self, code: str, span: Span, related: Iterable[Related] = (), /, **fields: object) -> None:
        """Adds a message at a place of this text."""
        self.session.diagnostics.append(report(code, self.uri, span, related, **fields))

    def warn_obsolete(self, span: Span, attributes: Iterable[ast.Pragma]) -> None:
        """Reports the use of what has the attribute 'obsolete' (LPRG-39)."""
        text = attribute(attributes, "obsolete")
        if text is not None:
            self.report("W1203", span, text=text or "This is obsolete")

    def lookup(self, name: str) -> Symbol | None:
        """What a plain name means here, where a value stands."""
        key = name.upper()
        return self.locals.get(key) or self.values.get(key) or self.names.get(key)

    def suggest(self, name: str, *tables: Iterable[tuple[str, Symbol]], fits: Fits | None = None) -> str:
        """Advice with the nearest name of the tables, by default of all that is visible here; what `fits`
        goes before the rest."""
        if self.session.suggestions >= SUGGESTION_LIMIT:
            return ""
        self.session.suggestions += 1
        return suggestion(name, *(tables or (self.locals.items(), self.names.items())), fits=fits)

    @property
    def block(self) -> PouSymbol | None:
        """The function block or program this text belongs to."""
        pou = self.pou
        return pou.owner or pou if pou is not None else None
