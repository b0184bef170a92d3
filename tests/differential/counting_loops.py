"""Random FOR loops: up and down, counters of every integer type, bounds and steps that move."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typed_tree as tree
from typed_tree import BOOL, INTEGERS, Expr, Scalar, Subrange, base_of

if TYPE_CHECKING:
    from statements import Body, Statements

_STEPS = (1, 1, 1, 2, -1, -1, -2, -3)


def counting_loop(made: Statements, b: Body, depth: int) -> tree.For:
    """A loop that mostly ends after a few passes; the reference gives up on others."""
    counter = _counter(made, b)
    type_ = base_of(counter.type)
    assert isinstance(type_, Scalar)
    step = made.r.choice(_STEPS)
    first, last = made.r.choice([0, 1, -2 if type_.low < 0 else 2]), made.r.randint(0, 5)
    if step < 0:
        first, last = last, max(first, -1 if type_.low < 0 else 1)
    if made.chance(12):  # close to the end of the type, where a counter wraps
        near = type_.high - 6 if step > 0 else type_.low + 1
        first, last = near + first % 3, near + last % 6
        first, last = (first, last) if step > 0 else (last, first)
    start, stop = (_bound(made, b, type_, number) for number in (first, last))
    amount = _step(made, b, type_, step) if made.chance(30) else step
    b.loops += 1
    body = made.statements(b, made.r.randint(1, 3), depth - 1)
    b.loops -= 1
    return tree.For(counter, start, stop, amount, body)


def _counter(made: Statements, b: Body) -> Expr:
    """Mostly a variable that nothing else writes, sometimes any place."""
    if made.chance(15):
        places = b.maker.places(_counts, writable=True)
        if places:
            return b.maker.filled(made.r.choice(places), 1)
    return made.loop_variable(b, "k", made.r.choice(INTEGERS))


def _counts(type_: tree.Type) -> bool:
    return isinstance(type_, Scalar | Subrange) and base_of(type_).integer


def _bound(made: Statements, b: Body, type_: Scalar, number: int) -> Expr:
    """A literal, or something that moves in a small range and may look at the counter."""
    literal = b.maker.literal(type_, number)
    if made.chance(70):
        return literal
    lowest, highest = max(number - 2, type_.low), min(number + 2, type_.high)
    args = [b.maker.literal(type_, lowest), b.maker.moving(type_, 1), b.maker.literal(type_, highest)]
    return tree.Builtin(type_, type_, False, "LIMIT", args, [type_] * 3)


def _step(made: Statements, b: Body, counter: Scalar, step: int) -> Expr:
    """A step of a type of its own: it keeps its sign where the counter has none."""
    own = made.r.choice(
        [t for t in INTEGERS if t.bits <= counter.bits and (t.low < 0 or (step > 0 and counter.low >= 0))]
    )
    other = step if made.chance(60) or own.low == 0 else -step
    args = [b.maker.moving(BOOL, 1), b.maker.literal(own, step), b.maker.literal(own, other)]
    return tree.Builtin(own, own, False, "SEL", args, [BOOL, own, own])
