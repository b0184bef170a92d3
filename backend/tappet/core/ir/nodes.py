"""Bases of expressions and statements: each of the two may be part of the other, and of places."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.core.ir.types import Scalar


@dataclass(eq=False, slots=True)
class Expr:
    """Base of the expressions; `type` is the type of the value."""

    type: Scalar


@dataclass(eq=False, slots=True)
class Stmt:
    """Base of the statements."""
