"""The accumulator of one network while its rows are read (spec fbd_ld_il.md 5).

The value of the accumulator is kept as the expression that the rows have built so far, so that types,
conversions and constants follow the same rules as in ST. It is computed at once, into a place of its own
(`ast.Hold`), where a statement comes between the value and its next use.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang.languages.il.operators import Instruction
from tappet.lang.source import Span

_ROWS_AT_ONCE = 200
"""Rows that become one expression at most; trees have a limited depth."""


@dataclass(slots=True)
class Level:
    """The accumulator at one depth of parentheses."""

    value: ast.Expr | None = None
    used: bool = True
    """Whether what the accumulator holds has been stored, tested or passed on."""
    start: Span | None = None
    """Row that began to build the value."""
    began: int = 0
    """Number of that row."""
    pending: Instruction | None = None
    """The operation that waits for `)`; None at the outermost level, and for functions."""
    function: ast.Expr | None = None
    """The function that waits for `)`."""
    opener: Span | None = None
    """The operator before the `(`."""
    before: list[ast.Expr] = field(default_factory=list)
    """Operands that stand before the deferred one."""
    rows: int = 0
    """Rows since the value was computed."""


class Network:
    """Statements of a body, and the accumulator that ties its rows together."""

    def __init__(self) -> None:
        self.out: list[ast.Stmt] = []
        self.levels = [Level()]
        self.slots = 0
        self.number = 1
        """Number of the network; a label begins a new one (IL-09)."""
        self.row = 0
        """Number of the row inside the network."""
        self.label: tuple[str, Span] | None = None
        """A label that waits for the statement it stands before."""

    @property
    def level(self) -> Level:
        """The innermost level."""
        return self.levels[-1]

    def emit(self, statement: ast.Stmt) -> None:
        """Append a statement; the label read before it becomes one of its own."""
        self.flush_label()
        self.out.append(statement)

    def flush_label(self) -> None:
        """Put a waiting label on a statement of its own."""
        if self.label is not None:
            name, span = self.label
            self.label = None
            self.out.append(ast.Empty(span=span, label=name))

    def set(self, value: ast.Expr, start: Span) -> None:
        """Load the accumulator; the value of before is dropped."""
        level = self.level
        level.value, level.used, level.start, level.began = value, False, start, self.row

    def combine(self, value: ast.Expr, row: Span) -> None:
        """The accumulator has become a part of `value` in a row."""
        level = self.level
        if isinstance(level.value, ast.Held):
            level.start = row  # what stands before has been computed by a statement of its own
        level.value = value
        level.used = False
        level.rows += 1
        if level.rows >= _ROWS_AT_ONCE:
            level.rows = 0
            self.settle(True)

    def settle(self, current: bool) -> None:
        """Compute what a following statement must not change: the outer levels, and the innermost one too."""
        levels = self.levels if current else self.levels[:-1]
        for level in levels:
            if level.value is not None and not isinstance(level.value, ast.Held):
                self.hold(level)

    def hold(self, level: Level) -> None:
        """Compute the value of a level into a place of its own."""
        value = level.value
        assert value is not None
        self.slots += 1
        span = value.span if level.start is None else level.start.to(value.span)
        self.emit(ast.Hold(span=span, slot=self.slots, value=value))
        level.value = ast.Held(span=value.span, slot=self.slots)

    def use(self, again: bool, at: Span) -> ast.Expr:
        """The accumulator as operand of the instruction at `at`; `again`: a later row may need it, too."""
        self.settle(again)
        level = self.level
        value = level.value
        assert value is not None
        level.used = True
        if not again:
            level.value = None
            return value
        assert isinstance(value, ast.Held)
        return ast.Held(span=at, slot=value.slot)

    def drop(self) -> ast.Expr | None:
        """Give the accumulator up; returns the value when nothing has used it."""
        level = self.level
        value = level.value
        level.value = None
        if value is None or level.used:
            return None
        level.used = True
        span = value.span if level.start is None else level.start.to(value.span)
        if isinstance(value, ast.Call):
            self.settle(False)
            self.emit(ast.CallStmt(span=span, call=value))
            return None
        self.settle(False)
        self.slots += 1
        self.emit(ast.Hold(span=span, slot=self.slots, value=value))
        return value
