"""IL against a machine with one accumulator: what the rows say one by one is what the compiled body does.

The machine below is the reference (fbd_ld_il.md 5): a typed accumulator of DINT and BOOL values, a stack for
deferred operands, labels. Random programs run on both, several in one build.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field

import pytest
from linked_application import loaded

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
NUMBERS = ("n0", "n1", "n2", "n3")
FLAGS = ("f0", "f1", "f2")
Row = tuple[str, str]
"""Operator and operand; a label is `("label", name)`."""


def wrapped(value: int) -> int:
    """In 32 bit two's complement."""
    return (value + 2**31) % 2**32 - 2**31


def divided(a: int, b: int) -> tuple[int, int]:
    """Quotient towards zero, and remainder."""
    quotient = abs(a) // abs(b)
    quotient = quotient if (a < 0) == (b < 0) else -quotient
    return quotient, a - quotient * b


OPERATIONS = {
    "ADD": lambda a, b: wrapped(a + b),
    "SUB": lambda a, b: wrapped(a - b),
    "MUL": lambda a, b: wrapped(a * b),
    "DIV": lambda a, b: wrapped(divided(a, b)[0]),
    "MOD": lambda a, b: wrapped(divided(a, b)[1]),
    "MAX": max,
    "AND": lambda a, b: a and b,
    "OR": lambda a, b: a or b,
    "XOR": lambda a, b: a != b,
    "ANDN": lambda a, b: a and not b,
    "ORN": lambda a, b: a or not b,
    "XORN": lambda a, b: a != (not b),
    "GT": lambda a, b: a > b,
    "GE": lambda a, b: a >= b,
    "EQ": lambda a, b: a == b,
    "NE": lambda a, b: a != b,
    "LE": lambda a, b: a <= b,
    "LT": lambda a, b: a < b,
}


def machine(rows: list[Row], memory: dict[str, int | bool]) -> None:
    """Carry the rows out one by one."""
    labels = {operand: at for at, (operator, operand) in enumerate(rows) if operator == "label"}
    accumulator: int | bool = 0
    stack: list[tuple[int | bool, str]] = []
    at = 0

    def content(operand: str) -> int | bool:
        if operand in ("TRUE", "FALSE"):
            return operand == "TRUE"
        return memory[operand] if operand in memory else int(operand.removeprefix("DINT#"))

    while at < len(rows):
        operator, operand = rows[at]
        at += 1
        if operator == "LD":
            accumulator = content(operand)
        elif operator == "LDN":
            accumulator = not content(operand)
        elif operator == "ST":
            memory[operand] = accumulator
        elif operator == "STN":
            memory[operand] = not accumulator
        elif operator in ("S", "R"):
            if accumulator:
                memory[operand] = operator == "S"
        elif operator == "NOT":
            accumulator = not accumulator
        elif operator == "ABS":
            accumulator = wrapped(abs(accumulator))
        elif operator.endswith("("):
            stack.append((accumulator, operator[:-1]))
            accumulator = content(operand)
        elif operator == ")":
            before, pending = stack.pop()
            accumulator = OPERATIONS[pending](before, accumulator)
        elif operator in ("RET", "RETC", "RETCN"):
            if operator == "RET" or bool(accumulator) is (operator == "RETC"):
                return
        elif operator in ("JMPC", "JMPCN", "JMP"):
            if operator == "JMP" or bool(accumulator) is (operator == "JMPC"):
                at = labels[operand]
        elif operator != "label":
            accumulator = OPERATIONS[operator](accumulator, content(operand))


@dataclass
class Writer:
    """Writes one random program; the type of the accumulator is known at every row."""

    random: random.Random
    rows: list[Row] = field(default_factory=list)
    depth: int = 0

    def add(self, operator: str, operand: str = "") -> None:
        self.rows.append((operator, operand))

    def number(self) -> str:
        if self.random.random() < 0.4:
            return f"DINT#{self.random.choice([0, 1, 2, 3, 7, 100, 12345, 2**31 - 1])}"
        return self.random.choice(NUMBERS)

    def divisor(self) -> str:
        return f"DINT#{self.random.choice([1, 2, 3, 10, 1000])}"

    def flag(self) -> str:
        return self.random.choice([*FLAGS, "TRUE", "FALSE"])

    def combine(self, kind: str) -> str:
        """A row or a deferred block on an accumulator of a kind; returns the kind it has then."""
        deferred = self.depth < 3 and self.random.random() < 0.3
        if kind == "number":
            if self.random.random() < 0.15:
                self.add("ABS")
                return kind
            operator = self.random.choice(
                ["ADD", "SUB", "MUL", "DIV", "MOD", "MAX", "GT", "GE", "EQ", "NE", "LE", "LT"]
            )
            result = "number" if operator in ("ADD", "SUB", "MUL", "DIV", "MOD", "MAX") else "flag"
            if operator in ("DIV", "MOD"):
                self.add(operator, self.divisor())
            elif deferred:
                self.block(operator, "number")
            else:
                self.add(operator, self.number())
            return result
        if self.random.random() < 0.2:
            self.add("NOT")
            return kind
        operator = self.random.choice(["AND", "OR", "XOR", "ANDN", "ORN", "XORN", "EQ", "NE"])
        if deferred:
            self.block(operator, "flag")
        else:
            self.add(operator, self.flag())
        return "flag"

    def block(self, operator: str, kind: str) -> None:
        """`operator( ... )` whose operand is of a kind."""
        self.depth += 1
        self.add(operator + "(", self.number() if kind == "number" else self.flag())
        now = kind
        for _ in range(self.random.randint(0, 3)):
            now = self.combine(now)
            if self.random.random() < 0.2:
                self.add("ST", self.random.choice(NUMBERS if now == "number" else FLAGS))
        if now != kind:  # a comparison has made a BOOL of a number
            self.add("LD", self.number())
        self.add(")")
        self.depth -= 1

    def network(self, labels: list[str]) -> None:
        """From a load to the rows that use the value."""
        kind = self.random.choice(["number", "flag"])
        self.add("LD" if kind == "number" or self.random.random() < 0.6 else "LDN",
                 self.number() if kind == "number" else self.flag())  # fmt: skip
        for _ in range(self.random.randint(0, 6)):
            kind = self.combine(kind)
            self.use(kind, labels)
        self.add("ST", self.random.choice(NUMBERS if kind == "number" else FLAGS))

    def use(self, kind: str, labels: list[str]) -> None:
        chance = self.random.random()
        if kind == "number":
            if chance < 0.3:
                self.add("ST", self.random.choice(NUMBERS))
        elif chance < 0.3:
            self.add(self.random.choice(["ST", "STN", "S", "R"]), self.random.choice(FLAGS))
        elif chance < 0.45 and labels:
            self.add(self.random.choice(["JMPC", "JMPCN"]), self.random.choice(labels))
        elif chance < 0.5:
            self.add(self.random.choice(["RETC", "RETCN"]))

    def program(self) -> list[Row]:
        """Networks with jumps to later labels only, so that every program ends."""
        names = [f"l{number}" for number in range(self.random.randint(0, 4))]
        self.network(names)
        for at, name in enumerate(names):
            if self.random.random() < 0.3:
                self.add("JMP", self.random.choice(names[at:]))
            self.add("label", name)
            self.network(names[at + 1 :])
        return self.rows


def text_of(rows: list[Row], memory: dict[str, int | bool], name: str) -> str:
    declared = [f"{v} : {'DINT' if v in NUMBERS else 'BOOL'} := {str(c).upper()};" for v, c in memory.items()]
    lines = [
        f"{operand}:" if operator == "label" else f"  {operator} {operand}" for operator, operand in rows
    ]
    return "\n".join([f"FUNCTION_BLOCK {name}", "VAR", *declared, "END_VAR", *lines, "END_FUNCTION_BLOCK"])


@pytest.mark.parametrize("seed", range(6))
def test_compiled_rows_do_what_the_machine_does(seed: int) -> None:
    """IL-20..IL-51, LST-50..LST-54."""
    chance = random.Random(seed)
    wanted: dict[str, int | bool] = {}
    texts = []
    count = 25
    for number in range(count):
        rows = Writer(chance).program()
        memory: dict[str, int | bool] = {n: chance.choice([0, 1, -1, 5, -77, 2**31 - 1]) for n in NUMBERS}
        memory |= {f: chance.random() < 0.5 for f in FLAGS}
        texts.append(text_of(rows, memory, f"FB{number}"))
        machine(rows, memory)
        wanted |= {f"b{number}.{name}": value for name, value in memory.items()}
    instances = "".join(f"b{number} : FB{number}; " for number in range(count))
    calls = "\n".join(f"CAL b{number}()" for number in range(count))
    main = f"PROGRAM PLC_PRG\nVAR {instances}END_VAR\n{calls}\nEND_PROGRAM"
    sources = [Source(f"text{number}", text) for number, text in enumerate([main, *texts])]
    result = build_application(sources, session=SESSION, options=BuildOptions(level=1))
    errors = [str(d) for d in result.diagnostics if d.severity == "error"]
    assert errors == []
    assert result.package is not None
    with loaded(result.package) as application:
        application.cycle()
        found = {path: application.literal(f"PLC_PRG.{path}") for path in wanted}
    expected = {path: str(value).upper() for path, value in wanted.items()}
    wrong = {path: (found[path], value) for path, value in expected.items() if found[path] != value}
    assert not wrong, (wrong, texts[int(next(iter(wrong)).partition(".")[0][1:])])
