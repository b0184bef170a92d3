"""Random IL bodies: modifiers, several operands, deferred operands, functions, calls, jumps, loops."""

from __future__ import annotations

from random import Random
from typing import Any

from il_rows import ARITHMETIC, COMPARISONS, Operand, Row
from leaves import Leaves
from typed_tree import BOOL, DINT, INT, INTEGERS, NUMBERS, ULINT, Scalar, Text
from typing_rules import assignable, bit_type, common, comparable, meet

_INSTANCES = ("i0", "i1")


def is_text(type_: Any) -> bool:
    return isinstance(type_, Text)


def is_integer(type_: Any) -> bool:
    return isinstance(type_, Scalar) and type_.integer


class BodyMaker:
    """One body over some variables; the type of the accumulator is known at every row."""

    def __init__(self, r: Random) -> None:
        self.r = r
        self.types: dict[str, Scalar | Text] = {"g": DINT}
        for number in range(6):
            self.types[f"n{number}"] = r.choice(NUMBERS)
        self.types |= {f"f{number}": BOOL for number in range(3)}
        self.types |= {f"s{number}": Text(r.choice((3, 5, 20))) for number in range(3)}
        self.leaves = Leaves(r)
        self.initial = {n: self.leaves.literal_value(t) for n, t in self.types.items() if n != "g"}
        self.rows: list[Row] = []
        self.type: Any = BOOL
        self.constant = False
        """Whether the accumulator is a literal, which is not combined with another one."""
        self.depth = 0
        self.number = 0

    def chance(self, percent: int) -> bool:
        return self.r.randrange(100) < percent

    def add(self, op: str, *operands: Operand, **more: Any) -> None:
        self.rows.append(Row(op, operands, **more))

    # -- operands -----------------------------------------------------------------------------------

    def variables(self, wanted: Any) -> list[Operand]:
        found = [Operand(t, n) for n, t in self.types.items() if wanted(t)]
        outputs = [Operand(DINT, f"{i}.sum") for i in _INSTANCES]
        return found + (outputs if wanted(DINT) else [])

    def operand(self, wanted: Any, moving: bool = False) -> Operand:
        """A variable or a literal."""
        found = self.variables(wanted)
        if found and (moving or self.chance(65)):
            return self.r.choice(found)
        if moving and wanted(Text(20)):
            return Operand(Text(20), "s0")
        if moving:
            return Operand(DINT, "g") if wanted(DINT) else Operand(BOOL, "f0")
        type_ = self.r.choice([t for t in (BOOL, *NUMBERS, Text(20)) if wanted(t)])
        return Operand(type_, value=self.leaves.literal_value(type_))

    # -- rows ---------------------------------------------------------------------------------------

    def load(self) -> None:
        if self.chance(20):
            self.load_text()
            return
        operand = self.operand(lambda t: isinstance(t, Scalar))
        negated = operand.type.kind in ("bool", "bits") and operand.name and self.chance(25)
        self.add("LDN" if negated else "LD", operand, held=operand.type)
        self.type, self.constant = operand.type, not operand.name

    def load_text(self) -> None:
        operand = self.operand(is_text, moving=True)
        self.add("LD", operand, held=operand.type)
        self.type, self.constant = operand.type, False

    def combine_text(self) -> None:
        """A row on a text."""
        choice = self.r.randrange(100)
        long = Text(255)
        text = self.operand(is_text)
        if choice < 15:
            self.add("function", held=INT, result=INT, target="LEN", taken=(long,))
            self.type = INT
        elif choice < 30:
            self.apply(self.r.choice(tuple(COMPARISONS)), is_text)
        elif choice < 60 and self.depth < 2:
            at = len(self.rows)
            self.add("function(", text)
            self.depth += 1
            self.type = text.type
            for _ in range(self.r.randint(0, 2)):
                if is_text(self.type):
                    self.combine_text()
                if self.chance(25):
                    self.store()
            if not is_text(self.type):
                self.load_text()
            self.depth -= 1
            more = {"held": long, "result": long, "target": "CONCAT", "taken": (long, long)}
            self.rows[at] = Row("function(", (text,), **more)
            self.add(")")
            self.type = long
        elif choice < 80:
            self.add("function", text, held=long, result=long, target="CONCAT", taken=(long, long))
            self.type = long
        else:
            name = self.r.choice(("LEFT", "RIGHT"))
            count = self.operand(lambda t: t == INT)
            self.add("function", count, held=long, result=long, target=name, taken=(long, INT))
            self.type = long
        self.constant = False

    def combine(self) -> None:
        """A row or a deferred block on the accumulator."""
        choice = self.r.randrange(100)
        if is_text(self.type):
            self.combine_text()
            return
        if self.type == BOOL:
            if choice < 15:
                self.add("NOT", held=BOOL)
            elif choice < 25:
                self.select()
            else:
                op = self.r.choice(("AND", "OR", "XOR", "ANDN", "ORN", "XORN", "EQ", "NE"))
                self.apply(op, lambda t: t == BOOL)
            return
        if choice < 35:
            self.apply(self.r.choice(tuple(ARITHMETIC)), lambda t: t in NUMBERS)
        elif choice < 50 and self.type.integer:
            words = ("AND", "OR", "XOR", "ANDN", "ORN", "XORN")
            self.apply(self.r.choice(words), is_integer)
        elif choice < 60:
            self.apply(self.r.choice(tuple(COMPARISONS)), lambda t: t in NUMBERS)
        elif choice < 65 and self.type.integer:
            self.add("NOT", held=self.type)
        else:
            self.function()

    def apply(self, op: str, wanted: Any) -> None:
        if op in ("DIV", "MOD"):
            self.divide(op)
            return
        if self.depth < 3 and self.chance(25):
            self.block(op, wanted)
            return
        count = 2 if op in ("ADD", "MUL", "AND", "OR") and self.chance(20) else 1
        for _ in range(count):
            operand = self.operand(wanted, self.constant)
            held, result = self.typed(op, operand.type)
            self.add(op, operand, held=held, result=result, taken=(operand.type,))
            self.type, self.constant = result, False
        last = self.rows[-1]
        if count == 2 and self.rows[-2].held == last.held and self.rows[-2].taken == last.taken:
            first = self.rows.pop(-2)
            self.rows[-1] = Row(op, (*first.operands, *last.operands), last.held, last.result, "", last.taken)

    def typed(self, op: str, other: Scalar) -> tuple[Scalar, Scalar]:
        """The type an operator computes in, and the static type of its result."""
        if op in ARITHMETIC:
            result, held = meet(self.type, other)
            return held, result
        if op in COMPARISONS and is_text(self.type):
            return Text(255), BOOL
        if op in COMPARISONS:
            return (BOOL if self.type == BOOL else comparable(self.type, other)), BOOL
        found = BOOL if self.type == BOOL else bit_type(self.type, other)
        return found, found

    def divide(self, op: str) -> None:
        if op == "MOD" and not self.type.integer:
            op = "DIV"
        type_ = self.r.choice(INTEGERS if self.type.integer else NUMBERS)
        value = self.r.choice((1, 2, 3, 7, 100, type_.high if type_.integer else 0.5))
        if type_.kind == "real":
            value = float(value)
        if type_.kind == "signed" and self.chance(20):
            value = -1
        if self.constant:
            self.add("LD", self.operand(lambda t: t == self.type, True))
            self.type = self.rows[-1].operands[0].type
            op = op if self.type.integer and type_.integer else "DIV"
            if self.type == BOOL:
                return
        result, held = meet(self.type, type_)
        self.add(op, Operand(type_, value=value), held=held, result=result, taken=(type_,))
        self.type, self.constant = result, False

    def block(self, op: str, wanted: Any) -> None:
        """`op( ... )`."""
        outer = self.type
        operand = self.operand(wanted, moving=True)
        at = len(self.rows)
        self.add(op + "(", operand)
        self.type, self.constant = operand.type, False
        self.depth += 1
        for _ in range(self.r.randint(0, 3)):
            self.combine()
            if self.chance(25):
                self.store()
        if not wanted(self.type):
            self.add("LD", operand)
            self.type = operand.type
        self.depth -= 1
        inner, self.type = self.type, outer
        held, result = self.typed(op, inner)
        self.rows[at] = Row(op + "(", (operand,), held, result, "", (inner,))
        self.add(")")
        self.type, self.constant = result, False

    def select(self) -> None:
        """SEL with the accumulator as selector."""
        type_ = self.r.choice([t for n, t in self.types.items() if t in NUMBERS])
        operands = [self.operand(lambda t: t == type_, moving=True) for _ in range(2)]
        self.add("function", *operands, held=type_, result=type_, target="SEL")
        self.type, self.constant = type_, False

    def function(self) -> None:
        choice = self.r.randrange(100)
        if choice < 30 and assignable(self.type, DINT):
            operand = self.operand(lambda t: is_integer(t) and assignable(t, DINT))
            more: dict[str, Any] = {"held": DINT, "result": DINT, "taken": (DINT, DINT)}
            self.add("function", operand, target="F_Twice", **more)
            self.type = DINT
        elif choice < 50:
            target = self.r.choice([t for t in NUMBERS if t != self.type])
            name = f"{self.type.name}_TO_{target.name}"
            self.add("function", held=target, result=target, target=name, taken=(self.type,))
            self.type = target
        elif choice < 75 and self.type.integer:
            name = self.r.choice(("SHL", "SHR", "ROL", "ROR"))
            count = Operand(INT, value=self.r.choice((0, 1, 5, 8, 31, 33)))
            taken = (self.type, ULINT)
            self.add("function", count, held=self.type, result=self.type, target=name, taken=taken)
        elif not self.constant:
            name = self.r.choice(("MIN", "MAX"))
            operand = self.operand(lambda t: t in NUMBERS, moving=True)
            result, carried = meet(self.type, operand.type)[0], common(self.type, operand.type)
            taken = (carried, carried)
            self.add("function", operand, held=carried, result=result, target=name, taken=taken)
            self.type = result
        if self.rows[-1].op == "function":
            self.constant = self.constant and self.rows[-1].target != "F_Twice"

    def store(self) -> None:
        found = [o for o in self.variables(lambda t: assignable(self.type, t)) if "." not in o.name]
        if self.constant or not found:
            return
        op = "ST"
        if not is_text(self.type) and self.type.kind in ("bool", "bits") and self.chance(30):
            op = "STN"
        if self.type == BOOL and self.chance(40):
            op = self.r.choice("SR")
        self.add(op, *self.r.sample(found, min(len(found), self.r.choice((1, 1, 2)))), held=self.type)

    def call(self) -> None:
        """CAL; conditional on a BOOL accumulator."""
        word = "CAL"
        if self.type == BOOL and not self.constant and self.chance(60):
            word = self.r.choice(("CALC", "CALCN"))
        operands = [
            self.operand(lambda t: is_integer(t) and assignable(t, DINT)),
            self.operand(lambda t: t == BOOL),
        ]
        self.add(word, *operands[: self.r.randint(0, 2)], target=self.r.choice(_INSTANCES))

    def network(self, labels: list[str]) -> None:
        self.load()
        for _ in range(self.r.randint(1, 7)):
            self.combine()
            if self.chance(30):
                self.store()
            if self.chance(15):
                self.call()
            if self.type == BOOL and not self.constant and self.chance(15):
                leave = self.r.choice(("C", "CN"))
                if labels and self.chance(70):
                    self.add(f"JMP{leave}", target=self.r.choice(labels))
                else:
                    self.add(f"RET{leave}")
        self.finish()

    def finish(self) -> None:
        """What the accumulator holds is stored somewhere."""
        before = len(self.rows)
        self.store()
        if len(self.rows) == before:
            self.add("LD", Operand(DINT, "g"))
            self.add("ST", Operand(DINT, "g"))

    def loop(self) -> None:
        """A network that is repeated a few times."""
        name, counter = f"again{self.number}", f"c{self.number}"
        self.number += 1
        zero, one, last = (Operand(INT, value=v) for v in (0, 1, self.r.randint(1, 4)))
        place = Operand(INT, counter)
        self.add("LD", zero)
        self.add("ST", place)
        self.add("label", target=name)
        self.network([])
        self.add("LD", place)
        self.add("ADD", one, held=DINT, result=INT)
        self.add("ST", place)
        self.add("LT", last, held=DINT)
        self.add("JMPC", target=name)
        self.types_of_counters[counter] = INT

    def make(self) -> list[Row]:
        self.types_of_counters: dict[str, Scalar | Text] = {}
        names = [f"l{number}" for number in range(self.r.randint(0, 3))]
        self.network(names)
        for at, name in enumerate(names):
            if self.chance(30):
                self.add("JMP", target=self.r.choice(names[at:]))
            self.add("label", target=name)
            self.network(names[at + 1 :])
            if self.chance(40):
                self.loop()
        self.types |= self.types_of_counters
        self.initial |= dict.fromkeys(self.types_of_counters, 0)
        return self.rows


def text(rows: list[Row], maker: BodyMaker, name: str) -> str:
    """The function block with the body."""
    declared = [
        f"{n} : {t.name} := {Operand(t, value=maker.initial[n]).text()};"
        for n, t in maker.types.items()
        if n != "g"
    ]
    instances = f"{', '.join(_INSTANCES)} : FB_Sum;"
    head = [f"FUNCTION_BLOCK {name}", "VAR", *declared, instances, "END_VAR"]
    return "\n".join([*head, *(row.text() for row in rows), "END_FUNCTION_BLOCK"])
