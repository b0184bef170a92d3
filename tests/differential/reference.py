"""The reference: walks the tree of a program, one Python object per variable."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from typing import Any

import typed_tree as tree
from arithmetic import (
    Fault,
    arithmetic,
    bitwise,
    compare,
    convert,
    divide,
    real,
    round_away,
    saturate,
    shift,
    square_root,
    wrap,
)
from typed_tree import Array, Block, Enum, Scalar, Struct, Subrange, Text, Type, Variable, base_of


class _Exit(Exception):  # noqa: N818
    pass


class _Continue(Exception):  # noqa: N818
    pass


class _Return(Exception):  # noqa: N818
    pass


class TooLong(Exception):  # noqa: N818
    """The program takes too many steps to be worth comparing."""


def default(type_: Type) -> Any:
    """Value of a variable without initial value."""
    if isinstance(type_, Text):
        return ""
    if isinstance(type_, Enum):
        return type_.members[0][1]
    if isinstance(type_, Subrange):
        return 0  # also where 0 is outside the limits
    if isinstance(type_, Array):
        low, high = type_.bounds[0]
        rest = Array(type_.element, type_.bounds[1:]) if len(type_.bounds) > 1 else type_.element
        return [default(rest) for _ in range(high - low + 1)]
    if isinstance(type_, Struct):
        return {name: default(t) for name, t in type_.members}
    if isinstance(type_, Block):
        return fresh(type_.members)
    return {"bool": False, "real": 0.0}.get(type_.kind, 0)


def fresh(variables: list[Variable]) -> dict[str, Any]:
    """A set of variables with their initial values."""
    return {v.name: default(v.type) if v.initial is None else v.initial for v in variables}


def copied(value: Any) -> Any:
    """Arrays and structures are assigned by value."""
    if isinstance(value, list):
        return [copied(v) for v in value]
    if isinstance(value, dict):
        return {k: copied(v) for k, v in value.items()}
    return value


def stored(value: Any, type_: Type) -> Any:
    """A value as a variable of a type holds it."""
    base = base_of(type_)
    if isinstance(base, Scalar):
        return convert(value, base)
    if isinstance(base, Text):
        return value[: base.length]
    return copied(value)


@dataclass
class Slot:
    """Where a value lies."""

    holder: Any
    key: Any
    bit: int | None = None

    def read(self) -> Any:
        value = self.holder[self.key]
        if isinstance(value, Slot):
            return value.read()
        return value if self.bit is None else bool(value >> self.bit & 1)

    def write(self, value: Any, type_: Type) -> None:
        inner = self.holder[self.key]
        if isinstance(inner, Slot):
            inner.write(value, type_)
        elif self.bit is None:
            self.holder[self.key] = stored(value, type_)
        else:
            base = base_of(type_)
            cleared = inner & ~(1 << self.bit)
            self.holder[self.key] = wrap(cleared | int(bool(value)) << self.bit, base)


@dataclass
class Frame:
    """Variables a body sees: its own first, then those of the instance."""

    scopes: list[dict[str, Any]]

    def slot(self, name: str) -> Slot:
        for scope in self.scopes:
            if name in scope:
                return Slot(scope, name)
        raise KeyError(name)


@dataclass
class Machine:
    """Runs one program."""

    program: tree.Program
    steps: int = 20_000
    variables: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        self.variables = fresh(self.program.variables)

    def cycle(self) -> None:
        """One call of the program; raises Fault."""
        self._body(self.program.body, Frame([self.variables]))

    def _body(self, body: list[Any], frame: Frame) -> None:
        with contextlib.suppress(_Return):
            self._run(body, frame)

    # -- statements ---------------------------------------------------------------------------------

    def _run(self, body: list[Any], frame: Frame) -> None:
        for statement in body:
            self.steps -= 1
            if self.steps < 0:
                raise TooLong
            getattr(self, "_" + type(statement).__name__.lower())(statement, frame)

    def _assign(self, s: tree.Assign, f: Frame) -> None:
        value = copied(self.value(s.value, f))
        type_ = s.target.base.type if isinstance(s.target, tree.Bit) else s.target.type
        self.place(s.target, f).write(value, type_)

    def _if(self, s: tree.If, f: Frame) -> None:
        for condition, body in s.branches:
            if self.value(condition, f):
                return self._run(body, f)
        return self._run(s.otherwise, f)

    def _case(self, s: tree.Case, f: Frame) -> None:
        selector = self.value(s.selector, f)
        for ranges, body in s.branches:
            if any(low <= selector <= high for low, high in ranges):
                return self._run(body, f)
        return self._run(s.otherwise, f)

    def _pass(self, body: list[Any], f: Frame) -> bool:
        """One pass of a loop; False after EXIT."""
        self.steps -= 1
        if self.steps < 0:
            raise TooLong
        try:
            self._run(body, f)
        except _Continue:
            pass
        except _Exit:
            return False
        return True

    def _for(self, s: tree.For, f: Frame) -> None:
        type_ = base_of(s.counter.type)
        counter = f.slot(s.counter.name)
        counter.write(self.value(s.start, f), type_)
        while True:
            stop = convert(self.value(s.stop, f), type_)  # every pass looks at it again
            if counter.read() > stop if s.step > 0 else counter.read() < stop:
                return
            if not self._pass(s.body, f):
                return
            counter.write(wrap(counter.read() + s.step, type_), type_)

    def _while(self, s: tree.While, f: Frame) -> None:
        guard = f.slot(s.guard.name)
        guard.write(0, tree.DINT)
        while s.until or (self.value(s.condition, f) and guard.read() < s.limit):
            guard.write(guard.read() + 1, tree.DINT)
            if not self._pass(s.body, f):
                return
            if s.until and (self.value(s.condition, f) or guard.read() >= s.limit):
                return

    def _jump(self, s: tree.Jump, f: Frame) -> None:
        raise {"EXIT": _Exit, "CONTINUE": _Continue, "RETURN": _Return}[s.word]

    def _callfunction(self, s: tree.CallFunction, f: Frame) -> None:
        own = fresh(s.function.locals)
        scopes = [own]
        if s.instance is not None:
            scopes.append(self.place(s.instance, f).read())
        for variable, value in zip(s.function.inputs, s.inputs, strict=True):
            own[variable.name] = stored(self.value(value, f), variable.type)
        for variable, target in zip(s.function.in_outs, s.in_outs, strict=True):
            own[variable.name] = self.place(target, f)
        own[s.function.name] = default(s.function.result)
        self._body(s.function.body, Frame(scopes))
        self.place(s.target, f).write(own[s.function.name], s.target.type)

    def _callblock(self, s: tree.CallBlock, f: Frame) -> None:
        instance = self.place(s.instance, f).read()
        block = s.instance.type
        assert isinstance(block, Block)
        types = {v.name: v.type for v in block.inputs}
        for name, value in s.inputs:  # one by one: a fault leaves those before it
            instance[name] = stored(self.value(value, f), types[name])
        self._body(block.body, Frame([instance]))

    # -- places -------------------------------------------------------------------------------------

    def place(self, e: Any, f: Frame) -> Slot:
        if isinstance(e, tree.Name):
            return f.slot(e.name)
        if isinstance(e, tree.Member):
            return Slot(self.place(e.base, f).read(), e.name)
        if isinstance(e, tree.Bit):
            slot = self.place(e.base, f)
            while isinstance(slot.holder[slot.key], Slot):
                slot = slot.holder[slot.key]
            return Slot(slot.holder, slot.key, e.bit)
        assert isinstance(e, tree.Index)
        indices = [self.value(i, f) for i in e.indices]
        slot = self.place(e.base, f)
        assert isinstance(e.base.type, Array)
        for index, (low, high) in zip(indices, e.base.type.bounds, strict=True):
            if not low <= index <= high:
                raise Fault("array index")
            slot = Slot(slot.read(), index - low)
        return slot

    # -- expressions --------------------------------------------------------------------------------

    def value(self, e: Any, f: Frame) -> Any:
        if isinstance(e, tree.Literal):
            return e.value
        if isinstance(e, tree.Unary):
            value = convert(self.value(e.operand, f), e.held)
            if e.op == "NOT":
                return not value if e.held == tree.BOOL else wrap(~value, e.held)
            return -value if e.held.kind == "real" else wrap(-value, e.held)
        if isinstance(e, tree.Binary):
            return self._binary(e, f)
        if isinstance(e, tree.Clock):
            return self._clock(e, f)
        if isinstance(e, tree.Builtin):
            return self._builtin(e, f)
        return self.place(e, f).read()

    def _binary(self, e: tree.Binary, f: Frame) -> Any:
        left = self.value(e.left, f)
        if e.op == "AND_THEN":
            return left and self.value(e.right, f)
        if e.op == "OR_ELSE":
            return left or self.value(e.right, f)
        right = self.value(e.right, f)
        if isinstance(e.computed, Text):
            return compare(e.op, left, right)
        left, right = convert(left, e.computed), convert(right, e.computed)
        if e.type == tree.BOOL and e.op in ("=", "<>", "<", ">", "<=", ">="):
            return compare(e.op, left, right)
        if e.op in ("AND", "OR", "XOR"):
            return bitwise(e.op, left, right, e.computed)
        return arithmetic(e.op, left, right, e.computed)

    def _clock(self, e: tree.Clock, f: Frame) -> Any:
        left, right = self.value(e.left, f), self.value(e.right, f)
        result = base_of(e.type)
        left_unit, right_unit = base_of(e.left.type).unit_ns, base_of(e.right.type).unit_ns
        if e.op in ("*", "/"):
            if not left_unit:
                left, right = right, left
            if isinstance(right, float):
                product = arithmetic(e.op, float(left), right, tree.LREAL)
                return wrap(saturate(round_away(product), tree.LINT), result)
            return wrap(left * right if e.op == "*" else divide(left, right), result)
        if left_unit == right_unit:
            number = left + right if e.op == "+" else left - right
            return wrap(number * left_unit // result.unit_ns, result)
        scaled = right * right_unit // left_unit
        return wrap(left + scaled if e.op == "+" else left - scaled, result)

    def _builtin(self, e: tree.Builtin, f: Frame) -> Any:
        def handed(number: int) -> Any:
            taken = e.taken[number]
            value = self.value(e.args[number], f)
            return value[: taken.length] if isinstance(taken, Text) else convert(value, taken)

        name = e.name
        if name == "SEL":
            return handed(2 if handed(0) else 1)
        if name == "MUX":
            number, count = self.value(e.args[0], f), len(e.args) - 1
            return handed(1 + number if 0 <= number < count else count)
        args = [handed(i) for i in range(len(e.args))]
        return _FUNCTIONS[name](args, e)


def _larger(a: Any, b: Any) -> Any:
    return b if b > a else a


def _smaller(a: Any, b: Any) -> Any:
    return b if b < a else a


def _converted(args: list[Any], e: tree.Builtin) -> Any:
    target = base_of(e.type)
    source = e.taken[0]
    value = args[0]
    if source.unit_ns and target.unit_ns and source != target:
        day = 86_400_000_000_000 // source.unit_ns
        if source in (tree.DT, tree.LDT) and target == tree.TOD:
            value %= day
        elif source in (tree.DT, tree.LDT) and target == tree.DATE:
            value -= value % day
        return wrap(value * source.unit_ns // target.unit_ns, target)
    return convert(value, target)


def _absolute(args: list[Any], e: tree.Builtin) -> Any:
    held = e.held
    return abs(args[0]) if held.kind == "real" else wrap(abs(args[0]), held)


def _find(args: list[Any], e: tree.Builtin) -> int:
    return args[0].find(args[1]) + 1 if args[1] else 0


_FUNCTIONS: dict[str, Any] = {
    "MAX": lambda a, e: _larger(a[0], a[1]),
    "MIN": lambda a, e: _smaller(a[0], a[1]),
    "LIMIT": lambda a, e: _smaller(_larger(a[1], a[0]), a[2]),
    "convert": _converted,
    "ABS": _absolute,
    "SQRT": lambda a, e: square_root(a[0], e.held),
    "TRUNC": lambda a, e: saturate(a[0], tree.DINT),
    "LEN": lambda a, e: len(a[0]),
    "CONCAT": lambda a, e: (a[0] + a[1])[:255],
    "LEFT": lambda a, e: a[0][: max(a[1], 0)],
    "RIGHT": lambda a, e: a[0][-a[1] :] if a[1] > 0 else "",
    "text": lambda a, e: str(a[0]),
}
for _name in ("SHL", "SHR", "ROL", "ROR"):
    _FUNCTIONS[_name] = lambda a, e, name=_name: shift(name, a[0], a[1], e.held)
_FUNCTIONS["real"] = lambda a, e: real(a[0], e.held)
