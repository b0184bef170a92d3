"""A chart as data: what the text, or a drawing, says."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from tappet.lang import ast
from tappet.lang.source import Span

QUALIFIERS: Final = ("N", "R", "S", "L", "D", "P", "P0", "P1", "SD", "DS", "SL")
"""Action qualifiers (LSFC-30..LSFC-38); P0 and P1 execute once, behind and at the beginning."""
TIMED: Final = frozenset({"L", "D", "SD", "DS", "SL"})
"""Qualifiers that need a time (LSFC-39)."""
ROLES: Final = ("STEP", "ENTRY", "EXIT")
"""Actions of the step itself (LSFC-04, LSFC-11)."""


@dataclass(slots=True)
class Association:
    """An action or BOOL variable at a step, with its qualifier."""

    action: str
    action_span: Span
    qualifier: str
    time: ast.Expr | None
    span: Span


@dataclass(slots=True)
class Step:
    """A step."""

    name: str
    name_span: Span
    span: Span
    initial: bool
    associations: list[Association] = field(default_factory=list)
    roles: dict[str, tuple[str, Span]] = field(default_factory=dict)
    """Step, entry and exit action by role."""
    minimum: ast.Expr | None = None
    maximum: ast.Expr | None = None


@dataclass(slots=True)
class Transition:
    """From steps that must all be active to steps that become active together."""

    sources: list[tuple[str, Span]]
    targets: list[tuple[str, Span]]
    condition: ast.Expr
    span: Span
    priority: int | None = None
    rows: list[ast.Stmt] = field(default_factory=list)
    """Of a condition in IL what its rows compute before it."""


@dataclass(slots=True, kw_only=True)
class Chart(ast.Graph):
    """Steps and transitions in the order of the text, which is left to right."""

    language: str = "SFC"
    steps: list[Step] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)

    def in_order(self) -> list[Transition]:
        """Transitions as they are evaluated: by priority, those without one from left to right (LSFC-17)."""
        last = 1 << 31
        return sorted(self.transitions, key=lambda t: last if t.priority is None else t.priority)
