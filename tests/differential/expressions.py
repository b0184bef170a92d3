"""Random well-typed expressions. `r` is a random.Random, or that of hypothesis, which then shrinks."""

from __future__ import annotations

from typing import Any

import typed_tree as tree
from leaves import Leaves, single
from typed_tree import (
    BOOL,
    DATE,
    DINT,
    DT,
    INT,
    INTEGERS,
    LDATE,
    LDT,
    LINT,
    LTIME,
    LTOD,
    NUMBERS,
    REAL,
    REALS,
    TIME,
    TOD,
    ULINT,
    Binary,
    Bit,
    Builtin,
    Clock,
    Enum,
    Expr,
    IsNull,
    Literal,
    Name,
    Pointer,
    Scalar,
    Text,
    Type,
    Unary,
    base_of,
)
from typing_rules import bit_type, common, comparable, meet

COMPARISONS = ("=", "<>", "<", ">", "<=", ">=")
CLOCKS = (TIME, LTIME, DATE, DT, TOD, LDATE, LDT, LTOD)
CONVERTED_CLOCKS = {
    TIME: (LTIME,),
    LTIME: (TIME,),
    DATE: (DT, LDATE, LDT),
    TOD: (DT, LTOD, LDT),
    DT: (LDT, DATE),
    LDATE: (DATE, LDT, DT),
    LTOD: (TOD, LDT, DT),
    LDT: (DT, LDATE),
}
MEETINGS: dict[Scalar, list[tuple[Scalar, Scalar]]] = {t: [] for t in NUMBERS}
COMMONS: dict[Scalar, list[tuple[Scalar, Scalar]]] = {t: [] for t in NUMBERS}
BITS: dict[Scalar, list[tuple[Scalar, Scalar]]] = {t: [] for t in INTEGERS}
for _left in NUMBERS:
    for _right in NUMBERS:
        MEETINGS[meet(_left, _right)[0]].append((_left, _right))
        COMMONS[meet(_left, _right)[0]].append((_left, _right))
        if _left.integer and _right.integer:
            BITS[bit_type(_left, _right)].append((_left, _right))


class Maker(Leaves):
    """Expressions over the variables of one scope."""

    # -- compound -----------------------------------------------------------------------------------

    def expr(self, type_: Type, depth: int) -> Expr:
        """An expression whose static type counts as `type_`."""
        if depth <= 0 or self.chance(12):
            return self.leaf(type_)
        if self.call is not None and self.chance(5):
            called = self.call(type_, depth - 1)
            if called is not None:
                return called
        if isinstance(type_, Text):
            return self._text(type_, depth)
        if isinstance(type_, Enum):
            return self.selection(type_, depth) if self.chance(30) else self.leaf(type_, depth)
        base = base_of(type_)
        if base == BOOL:
            return self._boolean(depth)
        if base.kind in ("time", "date"):
            return self._clock(base, depth)
        return self._number(base, depth)

    def _number(self, type_: Scalar, depth: int) -> Expr:
        choice = self.r.randrange(100)
        if choice < 45:
            return self._arithmetic(type_, depth)
        if choice < 52:
            return self.selection(type_, depth)
        if choice < 62:
            return self._extreme(type_, depth)
        if choice < 75:
            source = self.r.choice(NUMBERS) if self.chance(85) else self.r.choice((BOOL, TIME, LTIME))
            return self.converted(self.expr(source, depth - 1), type_)
        if choice < 80:
            operand = self.expr(type_, depth - 1)
            return Builtin(type_, type_, operand.constant, "ABS", [operand], [type_])
        if choice < 84:
            return self.negative(self.expr(type_, depth - 1))
        if not type_.integer:
            operand = self.expr(type_, depth - 1)
            return Builtin(type_, type_, operand.constant, "SQRT", [operand], [type_])
        if choice < 92:
            return self._bits(type_, depth)
        if choice < 94 and type_ == DINT:
            operand = self.moving(self.r.choice(REALS), depth - 1)
            return Builtin(DINT, DINT, False, "TRUNC", [operand], [base_of(operand.type)])
        if choice < 95 and self.texts and type_ == INT:
            long = Text(255, self.chance(30))
            if self.chance(50):
                return Builtin(INT, INT, False, wide_name("LEN", long), [self.moving_text(long, 0)], [long])
            args = [self.moving_text(long, depth - 1), self.expr(Text(20, long.wide), depth - 1)]
            return Builtin(INT, INT, False, wide_name("FIND", long), args, [long, long])
        return self._shift(type_, depth)

    def _arithmetic(self, type_: Scalar, depth: int) -> Expr:
        pair = (type_, type_) if self.chance(60) else self.r.choice(MEETINGS[type_])
        op = self.r.choice(("+", "-", "*", "/", "MOD") if type_.integer else ("+", "-", "*", "/"))
        left = self.expr(pair[0], depth - 1)
        right = (
            self._divisor(pair[1], depth)
            if op in ("/", "MOD") and type_.integer
            else self.expr(pair[1], depth - 1)
        )
        if not left.constant and base_of(left.type) == pair[1] and self.chance(20):
            right = self._untyped(pair[1], nonzero=op in ("/", "MOD"))
        computed = meet(base_of(left.type), base_of(right.type))
        return Binary(
            computed[0], computed[1], left.constant and right.constant, op, left, right, computed[1]
        )

    def _untyped(self, type_: Scalar, nonzero: bool = False) -> Literal:
        """A literal without prefix, which takes the type of the other side."""
        if type_.kind == "real":
            value: Any = self.r.choice([0.0, 1.0, 0.5, 2.25, 1000.0, 0.1])
            value = single(value) if type_ == REAL else value
        else:
            value = self.r.choice(
                [1, 2, 3, 10, 100, type_.high] if nonzero else [0, 1, 2, 3, 10, 100, type_.high]
            )
        return Literal(type_, type_, True, value, untyped=True)

    def _divisor(self, type_: Scalar, depth: int) -> Expr:
        if self.chance(50):
            low = type_.low if type_.low < 0 else 1
            return self.literal(type_, self.r.choice([1, 2, 3, 7, type_.high, low, -1 if low < 0 else 5]))
        divisor = self.moving(type_, depth - 1)
        if divisor.constant:
            return self.literal(type_, 3)
        if self.chance(8) or base_of(divisor.type) != type_:
            return divisor
        return Builtin(type_, type_, False, "MAX", [divisor, self.literal(type_, 1)], [type_, type_])

    def negative(self, operand: Expr) -> Expr:
        base = base_of(operand.type)
        computed = DINT if base.integer and base.bits < 32 else base
        if base in (tree.UDINT, tree.DWORD):
            computed = LINT
        return Unary(base, computed, operand.constant, "-", operand)

    def _bits(self, type_: Scalar, depth: int) -> Expr:
        if self.chance(25):
            operand = self.expr(type_, depth - 1)
            return Unary(type_, type_, operand.constant, "NOT", operand)
        pair = (type_, type_) if self.chance(60) else self.r.choice(BITS[type_])
        left, right = (self.expr(t, depth - 1) for t in pair)
        constant = left.constant and right.constant
        return Binary(type_, type_, constant, self.r.choice(("AND", "OR", "XOR")), left, right, type_)

    def _shift(self, type_: Scalar, depth: int) -> Expr:
        name = self.r.choice(("SHL", "SHR", "ROL", "ROR"))
        operand = self.expr(type_, depth - 1)
        count_type = self.r.choice((tree.USINT, INT, DINT, tree.BYTE, LINT, ULINT))
        count: Expr = self.literal(
            count_type, self.r.choice([0, 1, 3, 7, 8, 15, 16, 31, 32, 33, 63, 64, 65, 100])
        )
        if self.chance(40):
            count = self.moving(count_type, depth - 1)
            if base_of(count.type).kind == "signed" and self.chance(70):
                limits = (self.literal(count_type, 0), self.literal(count_type, 70))
                count = Builtin(
                    count_type, count_type, False, "LIMIT", [limits[0], count, limits[1]], [count_type] * 3
                )
        return Builtin(
            type_, type_, operand.constant and count.constant, name, [operand, count], [type_, ULINT]
        )

    def _extreme(self, type_: Scalar, depth: int) -> Expr:
        name = self.r.choice(("MIN", "MAX", "LIMIT"))
        if name == "LIMIT" or self.chance(50) or not COMMONS[type_]:
            count = 3 if name == "LIMIT" else 2
            args, carried = [self.expr(type_, depth - 1) for _ in range(count)], type_
        else:
            pair = self.r.choice(COMMONS[type_])
            args, carried = [self.moving(t, depth - 1) for t in pair], common(*pair)
        return Builtin(type_, carried, all(a.constant for a in args), name, args, [carried] * len(args))

    def selection(self, type_: Type, depth: int) -> Expr:
        held = base_of(type_)
        if self.chance(50):
            lead, count = self.expr(BOOL, depth - 1), 2
        else:
            lead, count = self.moving(self.r.choice(INTEGERS), depth - 1), self.r.randint(2, 4)
        args = [self.expr(type_, depth - 1) for _ in range(count)]
        constant = lead.constant and all(a.constant for a in args)
        name = "SEL" if base_of(lead.type) == BOOL else "MUX"
        return Builtin(type_, held, constant, name, [lead, *args], [base_of(lead.type), *[held] * count])

    def _boolean(self, depth: int) -> Expr:
        choice = self.r.randrange(100)
        if choice < 45:
            return self.comparison(depth)
        if choice < 60:
            left, right = self.expr(BOOL, depth - 1), self.expr(BOOL, depth - 1)
            return Binary(
                BOOL,
                BOOL,
                left.constant and right.constant,
                self.r.choice(("AND", "OR", "XOR")),
                left,
                right,
                BOOL,
            )
        if choice < 75:
            left, right = self.moving(BOOL, depth - 1), self.moving(BOOL, depth - 1)
            return Binary(BOOL, BOOL, False, self.r.choice(("AND_THEN", "OR_ELSE")), left, right, BOOL)
        if choice < 82:
            operand = self.expr(BOOL, depth - 1)
            return Unary(BOOL, BOOL, operand.constant, "NOT", operand)
        if choice < 88:
            return self.converted(self.moving(self.r.choice((*NUMBERS, TIME)), depth - 1), BOOL)
        if choice < 94:
            found = self.bit_place(depth)
            if found is not None:
                return found
        return self.selection(BOOL, depth)

    def bit_place(self, depth: int, writable: bool = False) -> Bit | None:
        """One bit of an integer variable."""
        found = self.places(lambda t: isinstance(t, Scalar) and t.integer, writable)
        if not found:
            return None
        place = self.filled(self.r.choice(found), depth)
        names = {bit: name for name, bit in self.bits}
        bit = self.r.choice(tuple(names)) if names and self.chance(30) else 64
        if bit >= base_of(place.type).bits:
            bit = self.r.randrange(base_of(place.type).bits)
        return Bit(BOOL, BOOL, False, place, bit, names.get(bit, "") if self.chance(60) else "")

    def comparison(self, depth: int) -> Expr:
        op = self.r.choice(COMPARISONS)
        choice = self.r.randrange(100)
        pointers = [v for v in self.variables if isinstance(v.type, Pointer) and not v.type.reference]
        if pointers and self.chance(10):
            pointer = self.r.choice(pointers)
            name = Name(pointer.type, None, False, pointer.name)
            return IsNull(BOOL, BOOL, False, name, self.chance(50))
        if choice < 10 and self.texts:
            long = Text(255, self.chance(30))
            left, right = self.moving_text(long, depth - 1), self.moving_text(long, depth - 1)
            constant = left.constant and right.constant
            return Binary(BOOL, BOOL, constant, op, left, right, long)  # type: ignore[arg-type]
        if choice < 20:
            clock = self.r.choice(CLOCKS)
            left, right = self.moving(clock, depth - 1), self.expr(clock, depth - 1)
            return Binary(BOOL, BOOL, left.constant and right.constant, op, left, right, clock)
        first = self.r.choice(NUMBERS)
        left = self.moving(first, depth - 1)
        if self.chance(25) and base_of(left.type) == first and first.integer:
            right: Expr = self._untyped(first)
        else:
            right = self.expr(first if self.chance(60) else self.r.choice(NUMBERS), depth - 1)
        computed = comparable(base_of(left.type), base_of(right.type))
        return Binary(BOOL, BOOL, left.constant and right.constant, op, left, right, computed)

    def _clock(self, type_: Scalar, depth: int) -> Expr:
        choice = self.r.randrange(100)
        if choice < 15:
            return self.selection(type_, depth)
        if choice < 25 and type_ in CONVERTED_CLOCKS:
            source = self.r.choice(CONVERTED_CLOCKS[type_])
            return self.converted(self.moving(source, depth - 1), type_)
        if type_ in (TIME, LTIME):
            return self._duration(type_, depth)
        if type_ in (DATE, LDATE):
            return self.leaf(type_, depth)
        span = LTIME if self.chance(80 if type_.bits == 64 else 20) else TIME
        left, right = self.moving(type_, depth - 1), self.moving(span, depth - 1)
        return self.clock(type_, self.r.choice("+-"), left, right)

    def clock(self, type_: Scalar, op: str, left: Expr, right: Expr) -> Clock:
        return Clock(type_, type_, left.constant and right.constant, op, left, right)

    def _duration(self, type_: Scalar, depth: int) -> Expr:
        choice = self.r.randrange(100)
        left = self.moving(type_, depth - 1)
        if choice < 50:
            right = self.expr(type_, depth - 1)
            constant = left.constant and right.constant
            return Binary(type_, type_, constant, self.r.choice("+-"), left, right, type_)
        if choice < 70:
            number = self.moving(self.r.choice(INTEGERS[:7] + REALS), depth - 1)
            return self.clock(type_, "*", left, number)
        if choice < 85:
            divisor: Expr = self._divisor(self.r.choice(INTEGERS), depth)
            if divisor.constant and not isinstance(divisor, Literal):
                divisor = self.literal(INT, 7)
            return self.clock(type_, "/", left, divisor)
        date = self.r.choice((LDT, LTOD, LDATE) if type_ == LTIME else (DT, TOD, DATE))
        return self.clock(type_, "-", self.moving(date, depth - 1), self.moving(date, depth - 1))

    def moving_text(self, type_: Text, depth: int) -> Expr:
        found = self.places(lambda t: isinstance(t, Text) and t.wide == type_.wide)
        return self.filled(self.r.choice(found), depth) if found else self.literal(Text(20, type_.wide))

    def position(self, depth: int) -> Expr:
        """A position or a length: small, sometimes anything."""
        if self.chance(75):
            return self.literal(INT, self.r.choice([-2, -1, 0, 0, 1, 1, 2, 3, 4, 6, 9, 32767]))
        return self.expr(INT, depth - 1)

    def _text(self, type_: Text, depth: int) -> Expr:
        choice = self.r.randrange(100)
        long = Text(255, type_.wide)
        if choice < 30:
            literal = self.literal(Text(20, type_.wide))
            return self.moving_text(type_, depth - 1) if self.chance(70) else literal
        if choice < 85:
            name = self.r.choice(tuple(TEXT_FUNCTIONS))
            args = [
                self.expr(type_, depth - 1) if kind == "T" else self.position(depth)
                for kind in TEXT_FUNCTIONS[name]
            ]
            taken = [long if kind == "T" else INT for kind in TEXT_FUNCTIONS[name]]
            return Builtin(long, long, False, wide_name(name, long), args, taken)
        short = Text(80, type_.wide)
        if type_.wide and self.chance(40):
            narrow = self.moving_text(Text(20), depth - 1)
            return Builtin(short, short, False, "text", [narrow], [Text(80)])
        source = self.r.choice(INTEGERS)
        return Builtin(short, short, False, "text", [self.moving(source, depth - 1)], [source])


TEXT_FUNCTIONS = {
    "CONCAT": "TT",
    "LEFT": "TI",
    "RIGHT": "TI",
    "MID": "TII",
    "INSERT": "TTI",
    "DELETE": "TII",
    "REPLACE": "TTII",
}
"""Arguments that are a text (T) or an integer (I)."""


def wide_name(name: str, text: Text) -> str:
    """The function of the same meaning for WSTRING has a W before its name."""
    return f"W{name}" if text.wide else name
