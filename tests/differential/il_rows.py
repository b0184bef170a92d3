"""IL bodies as rows, and the machine with one accumulator that carries them out (fbd_ld_il.md 5).

The accumulator has the type of the last result; narrow integers are computed in DINT as in ST, and cut where
they are stored, handed over, or where an operator depends on a width.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import typed_tree as tree
from arithmetic import arithmetic, bitwise, compare, convert, wrap
from builtin_functions import FUNCTIONS
from typed_tree import BOOL, Scalar, Text
from write_st import literal

ARITHMETIC = {"ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "MOD": "MOD"}
COMPARISONS = {"GT": ">", "GE": ">=", "EQ": "=", "NE": "<>", "LE": "<=", "LT": "<"}


def fitted(value: Any, type_: Scalar | Text) -> Any:
    """A value as something of a type holds it."""
    return value[: type_.length] if isinstance(type_, Text) else convert(value, type_)


@dataclass(frozen=True)
class Operand:
    """A variable, or a literal of a type."""

    type: Scalar | Text
    name: str = ""
    value: Any = None

    def text(self) -> str:
        return self.name or literal(self.type, self.value)


@dataclass(frozen=True)
class Row:
    """One instruction. `held`: the type it computes in; `result`: the type the accumulator has then."""

    op: str
    operands: tuple[Operand, ...] = ()
    held: Any = BOOL
    result: Any = BOOL
    target: str = ""
    """A label, a function, an instance."""
    taken: tuple[Any, ...] = ()
    """Types a function takes its operands in, that of the accumulator first."""

    def text(self) -> str:
        operands = ", ".join(o.text() for o in self.operands)
        if self.op == "label":
            return f"{self.target}:"
        if self.op.startswith("function"):
            return f"    {self.target}{self.op[8:]} {operands}"
        if self.op.startswith("CAL"):
            given = [f"{name} := {o.text()}" for name, o in zip(("a", "b"), self.operands, strict=False)]
            return f"    {self.op} {self.target}({', '.join(given)})"
        return f"    {self.op} {operands or self.target}"


@dataclass
class Counter:
    """The function block that is called: FB_Sum adds its inputs up."""

    a: int = 0
    b: bool = False
    sum: int = 0

    def call(self) -> None:
        self.sum = wrap(self.sum + self.a if self.b else self.sum - 1, tree.DINT)


@dataclass
class Machine:
    """Variables, accumulator, and what waits for a closing parenthesis."""

    types: dict[str, Scalar | Text]
    memory: dict[str, Any]
    instances: dict[str, Counter] = field(default_factory=dict)
    value: Any = 0
    stack: list[tuple[Any, Row]] = field(default_factory=list)
    steps: int = 5000

    def content(self, o: Operand) -> Any:
        instance, _, member = o.name.partition(".")
        if member:
            return getattr(self.instances[instance], member)
        return self.memory[o.name] if o.name else o.value

    def store(self, name: str, value: Any) -> None:
        self.memory[name] = fitted(value, self.types[name])

    def run(self, rows: list[Row]) -> None:
        """The body once."""
        labels = {row.target: at for at, row in enumerate(rows) if row.op == "label"}
        at = 0
        while at < len(rows):
            row = rows[at]
            at += 1
            self.steps -= 1
            assert self.steps, "endless"
            word = row.op.removesuffix("CN").removesuffix("C") if row.op[:3] in ("JMP", "RET", "CAL") else ""
            if word:
                if row.op != word and bool(self.value) is not (row.op == word + "C"):
                    continue
                if word == "RET":
                    return
                if word == "JMP":
                    at = labels[row.target]
                else:
                    self._call(row)
            elif row.op == ")":
                before, pending = self.stack.pop()
                if pending.op == "function(":
                    self.value = FUNCTIONS[pending.target]([before, self.value], None)
                else:
                    self.value = self._combined(pending, before, self.value)
            elif row.op.endswith("("):
                self.stack.append((self.value, row))
                self.value = self.content(row.operands[0])
            elif row.op != "label":
                self._row(row)

    def _call(self, row: Row) -> None:
        instance = self.instances[row.target]
        for name, o in zip(("a", "b"), row.operands, strict=False):
            setattr(instance, name, convert(self.content(o), tree.DINT if name == "a" else BOOL))
        instance.call()

    def _row(self, row: Row) -> None:
        op = row.op
        if op in ("LD", "LDN"):
            value = self.content(row.operands[0])
            self.value = self._negated(value, row.held) if op == "LDN" else value
        elif op in ("ST", "STN"):
            value = self._negated(self.value, row.held) if op == "STN" else self.value
            for o in row.operands:
                self.store(o.name, value)
        elif op in ("S", "R"):
            for o in row.operands:
                if self.value:
                    self.store(o.name, op == "S")
        elif op == "NOT":
            self.value = self._negated(self.value, row.held)
        elif op == "function":
            self._function(row)
        else:
            for o in row.operands:
                self.value = self._combined(row, self.value, self.content(o))

    def _negated(self, value: Any, held: Scalar) -> Any:
        return not value if held == BOOL else wrap(~convert(value, held), held)

    def _combined(self, row: Row, left: Any, right: Any) -> Any:
        op = row.op.removesuffix("(")
        held = row.held
        if op in ARITHMETIC:
            return arithmetic(ARITHMETIC[op], convert(left, held), convert(right, held), held)
        if op in COMPARISONS and isinstance(held, Text):
            return compare(COMPARISONS[op], left, right)
        if op in COMPARISONS:
            return compare(COMPARISONS[op], convert(left, held), convert(right, held))
        if op.endswith("N"):
            right = self._negated(right, row.taken[0])
        return bitwise(op.removesuffix("N"), convert(left, held), convert(right, held), held)

    def _function(self, row: Row) -> None:
        values = [self.value, *(self.content(o) for o in row.operands)]
        if row.target == "SEL":
            self.value = fitted(values[2 if values[0] else 1], row.held)
            return
        args = [fitted(v, t) for v, t in zip(values, row.taken, strict=True)]
        if row.target == "F_Twice":
            self.store("g", self.memory["g"] + args[1])
            self.value = wrap(args[0] * 2 + args[1], tree.DINT)
            return
        name = "convert" if "_TO_" in row.target else row.target
        node = tree.Builtin(row.result, row.held, False, name, [], list(row.taken))
        self.value = FUNCTIONS[name](args, node)


COMMON = """FUNCTION_BLOCK FB_Sum
VAR_INPUT a : DINT; b : BOOL; END_VAR
VAR_OUTPUT sum : DINT; END_VAR
IF b THEN sum := sum + a; ELSE sum := sum - 1; END_IF
END_FUNCTION_BLOCK
FUNCTION F_Twice : DINT
VAR_INPUT x, y : DINT; END_VAR
g := g + y;
F_Twice := x * 2 + y;
END_FUNCTION
VAR_GLOBAL g : DINT; END_VAR
"""
"""What the bodies call; `g` is changed behind the back of the accumulator."""
