"""Random CNC programs as trees: their text, and what they do. Spec VAR-05 to VAR-08.

The trees are computed and played by Python; the library sees the text alone. Brackets stand where the
priorities of the specification need them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from hypothesis import strategies as st

PRIORITIES = {"MOD": 14, "*": 13, "/": 13, "+": 12, "-": 12, "AND": 6, "XOR": 5, "OR": 4} | dict.fromkeys(
    ("=", "<>", "<", ">", "<=", ">="), 10
)
PREFIX = 15
OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "MOD": math.fmod,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "=": lambda a, b: a == b,
    "<>": lambda a, b: a != b,
    "<": lambda a, b: a < b,
    ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b,
    ">=": lambda a, b: a >= b,
    "AND": lambda a, b: a and b,
    "XOR": lambda a, b: a != b,
    "OR": lambda a, b: a or b,
}
FUNCTIONS: dict[str, Callable[[float], float]] = {
    "sin": math.sin, "cos": math.cos, "atan": math.atan, "abs": abs, "trunc": math.trunc, "exp": math.exp,
    "ln": math.log, "log": math.log10, "sqrt": math.sqrt, "asin": math.asin, "acos": math.acos,
}  # fmt: skip
PAIRS: dict[str, Callable[[float, float], float]] = {"min": min, "max": max, "expt": math.pow}
Scope = dict[str, Any]


class NoNumberError(Exception):
    """The value is none, or too near to where rounding decides."""


@dataclass(frozen=True)
class Tree:
    """An expression: a value, a variable, or an operation with its operands."""

    name: str
    operands: tuple[Tree, ...] = ()
    value: Any = None

    def text(self, least: int = 0) -> str:
        if not self.operands:
            return self.name
        if self.name in PRIORITIES:
            own = PRIORITIES[self.name]
            left, right = self.operands
            text = f"{left.text(own)} {self.name} {right.text(own + 1)}"
            return f"{{{text}}}" if own < least else text
        if self.name in ("negative", "NOT"):
            return ("-" if self.name == "negative" else "NOT ") + self.operands[0].text(PREFIX)
        return f"{self.name}{{{', '.join(operand.text() for operand in self.operands)}}}"

    def compute(self, scope: Scope) -> Any:
        if not self.operands:
            return scope[self.name.upper()] if self.name.startswith("#") else self.value
        given = [operand.compute(scope) for operand in self.operands]
        try:
            result = self._apply(*given)
        except (ValueError, OverflowError, ZeroDivisionError) as error:
            raise NoNumberError from error
        if isinstance(result, float | int) and not isinstance(result, bool):
            if not math.isfinite(result) or abs(result) > 1e12:
                raise NoNumberError
            return float(result)
        return result

    def _apply(self, *given: Any) -> Any:
        if self.name in PRIORITIES:
            first, last = given
            compares = isinstance(first, float) and PRIORITIES[self.name] == PRIORITIES["="]
            if compares and 0 < abs(first - last) < 1e-9 * (1 + abs(first)):
                raise NoNumberError
            if self.name == "MOD" and abs(first / last - round(first / last)) < 1e-6 * (
                1 + abs(first / last)
            ):
                raise NoNumberError
            return OPERATIONS[self.name](first, last)
        if self.name == "negative":
            return -given[0]
        if self.name == "NOT":
            return not given[0]
        if self.name == "concat":
            return (given[0] + given[1])[:80]
        if self.name == "trunc" and abs(given[0] - round(given[0])) < 1e-6:
            raise NoNumberError
        return (FUNCTIONS.get(self.name) or PAIRS[self.name])(*given)


def numbers(variables: tuple[str, ...]) -> st.SearchStrategy[Tree]:
    """Expressions of type LREAL."""
    leaves = st.one_of(
        st.integers(0, 20).map(lambda n: Tree(str(n), value=float(n))),
        st.floats(0, 100).map(lambda x: round(x, 3)).map(lambda x: Tree(f"{x:.3f}", value=x)),
        st.just(Tree("PI", value=math.pi)),
        *[st.just(Tree(name)) for name in variables],
    )
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            *[
                st.tuples(st.sampled_from(["MOD", "*", "/", "+", "-"]), st.tuples(inner, inner)).map(
                    lambda pair: Tree(*pair)
                )
            ]
            * 4,  # more often than functions: priorities are between them
            st.tuples(st.sampled_from(["negative", *FUNCTIONS]), st.tuples(inner)).map(
                lambda pair: Tree(*pair)
            ),
            st.tuples(st.sampled_from([*PAIRS]), st.tuples(inner, inner)).map(lambda pair: Tree(*pair)),
        ),
        max_leaves=10,
    )


def conditions(variables: tuple[str, ...]) -> st.SearchStrategy[Tree]:
    """Expressions of type BOOL."""
    texts = st.recursive(
        st.sampled_from("abc").map(lambda c: Tree(f"'{c}'", value=c)),
        lambda inner: st.tuples(st.just("concat"), st.tuples(inner, inner)).map(lambda pair: Tree(*pair)),
        max_leaves=3,
    )
    comparisons = st.one_of(
        st.tuples(
            st.sampled_from(["=", "<>", "<", ">", "<=", ">="]),
            st.tuples(numbers(variables), numbers(variables)),
        ).map(lambda pair: Tree(*pair)),
        st.tuples(st.sampled_from(["=", "<>"]), st.tuples(texts, texts)).map(lambda pair: Tree(*pair)),
        st.booleans().map(lambda flag: Tree(str(flag).upper(), value=flag)),
    )
    return st.recursive(
        comparisons,
        lambda inner: st.one_of(
            st.tuples(st.sampled_from(["AND", "XOR", "OR", "=", "<>"]), st.tuples(inner, inner)).map(
                lambda pair: Tree(*pair)
            ),
            st.tuples(st.just("NOT"), st.tuples(inner)).map(lambda pair: Tree(*pair)),
        ),
        max_leaves=4,
    )


@dataclass
class Machine:
    """Where the path is, and its ends so far."""

    position: list[float] = field(default_factory=lambda: [0.0, 0.0])
    relative: bool = False
    ends: list[tuple[float, float]] = field(default_factory=list)

    def move(self, x: float, y: float) -> None:
        base = self.position if self.relative else (0.0, 0.0)
        if max(abs(x), abs(y)) > 1e8:
            raise NoNumberError
        self.position = [base[0] + x, base[1] + y]
        self.ends.append((self.position[0], self.position[1]))


@dataclass
class Step:
    """A statement: how it is written, and what it does."""

    kind: str
    trees: tuple[Tree, ...] = ()
    name: str = ""
    count: int = 0
    body: tuple[Step, ...] = ()


@dataclass
class Subprogram:
    parameters: tuple[str, ...]
    body: tuple[Step, ...]
    restores: bool


VARIABLES = ("#a", "#b")


def steps(variables: tuple[str, ...], callable_count: int) -> st.SearchStrategy[tuple[Step, ...]]:
    """Bodies of programs that may call so many subprograms, each with two numbers."""
    number = numbers(variables)
    simple = st.one_of(
        st.tuples(number, number).map(lambda trees: Step("move", trees)),
        st.sampled_from([90, 91]).map(lambda mode: Step("mode", count=mode)),
        st.tuples(st.sampled_from(variables), number).map(lambda p: Step("set", (p[1],), p[0])),
        st.tuples(st.sampled_from(variables), number).map(lambda p: Step("add", (p[1],), p[0])),
        *(
            [
                st.tuples(st.integers(0, callable_count - 1), number, number).map(
                    lambda p: Step("call", (p[1], p[2]), count=p[0])
                )
            ]
            if callable_count
            else []
        ),
    )
    some = st.lists(simple, min_size=1, max_size=3).map(tuple)
    block = st.one_of(
        simple,
        st.tuples(st.integers(1, 3), some).map(lambda p: Step("loop", count=p[0], body=p[1])),
        st.tuples(conditions(variables), some).map(lambda p: Step("if", (p[0],), body=p[1])),
    )
    return st.lists(block, min_size=1, max_size=5).map(tuple)


class Writer:
    """The text of a body, with block numbers and counters of its own."""

    def __init__(self) -> None:
        self.number = 0
        self.counters = 0

    def lines(self, body: tuple[Step, ...]) -> Iterator[str]:
        for step in body:
            yield from self._step(step)

    def _next(self) -> int:
        self.number += 10
        return self.number

    def _step(self, step: Step) -> Iterator[str]:
        if step.kind == "move":
            x, y = step.trees
            yield f"G1 X {x.text()} Y {y.text()}"
        elif step.kind == "mode":
            yield f"G{step.count}"
        elif step.kind in ("set", "add"):
            yield f"{'G36' if step.kind == 'set' else 'G37'} O{step.name} D {step.trees[0].text()}"
        elif step.kind == "call":
            yield f"N{self._next()} Sub{'ABC'[step.count]}{{{', '.join(tree.text() for tree in step.trees)}}}"
        elif step.kind == "if":
            behind = self._next()
            yield f"G20 L{behind} K NOT {{{step.trees[0].text()}}}"
            yield from self.lines(step.body)
            yield f"N{behind}"
        else:
            self.counters += 1
            counter, start = f"#count{self.counters}", self._next()
            yield f"G36 O{counter} D{step.count}"
            yield f"N{start}"
            yield from self.lines(step.body)
            yield f"G37 O{counter} D-1"
            yield f"G20 L{start} K{counter} > 0"

    def program(self, body: tuple[Step, ...], locals_: tuple[str, ...]) -> str:
        written = list(self.lines(body))
        names = [*locals_, *(f"#count{n + 1}" for n in range(self.counters))]
        return "\n".join([*(f"LET {name} : LREAL" for name in names), *written])


class Player:
    """Plays a program with its subprograms."""

    def __init__(self, subprograms: list[Subprogram]) -> None:
        self.subprograms = subprograms
        self.machine = Machine()

    def play(self, body: tuple[Step, ...], scope: Scope) -> None:
        for step in body:
            values = [tree.compute(scope) for tree in step.trees]
            if any(isinstance(value, float) and abs(value) > 1e8 for value in values):
                raise NoNumberError
            if step.kind == "move":
                self.machine.move(*values)
            elif step.kind == "mode":
                self.machine.relative = step.count == 91
            elif step.kind == "set":
                scope[step.name.upper()] = values[0]
            elif step.kind == "add":
                scope[step.name.upper()] += values[0]
            elif step.kind == "if":
                if values[0]:
                    self.play(step.body, scope)
            elif step.kind == "loop":
                for _ in range(step.count):
                    self.play(step.body, scope)
            else:
                called = self.subprograms[step.count]
                before = self.machine.relative
                self.play(called.body, {"#P": values[0], "#Q": values[1]})
                if called.restores:
                    self.machine.relative = before


@st.composite
def programs(draw: st.DrawFn) -> tuple[tuple[Step, ...], list[Subprogram]]:
    """A main program and up to three subprograms; each calls those behind it."""
    count = draw(st.integers(0, 3))
    subprograms: list[Subprogram] = []
    for place in range(count):
        body = draw(steps(("#p", "#q"), 0))
        calls = draw(st.booleans()) and place > 0
        if calls:
            called = draw(st.integers(0, place - 1))
            body = (*body, Step("call", (Tree("#q"), Tree("#p")), count=called))
        subprograms.append(Subprogram(("#p", "#q"), body, draw(st.booleans())))
    return draw(steps(VARIABLES, count)), subprograms


def files(main: tuple[Step, ...], subprograms: list[Subprogram]) -> dict[str, str]:
    """The texts of the files."""
    texts = {"main.cnc": Writer().program(main, VARIABLES)}
    for place, one in enumerate(subprograms):
        name = f"Sub{'ABC'[place]}"
        parameters = ", ".join(f"{parameter} : LREAL" for parameter in one.parameters)
        head = f"SUBPROGRAM {name}{{{parameters}}}{' RESTORE_MODES' if one.restores else ''}\n"
        texts[f"{name.lower()}.cnc"] = head + Writer().program(one.body, ()) + "\nEND_SUBPROGRAM\n"
    return texts
