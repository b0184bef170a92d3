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
    round_away,
    saturate,
    wrap,
)
from builtin_functions import FUNCTIONS
from typed_tree import Array, Block, Enum, Scalar, Struct, Subrange, Text, Type, Variable, base_of


class _Exit(Exception):  # noqa: N818
    pass


class _Continue(Exception):  # noqa: N818
    pass


class _Return(Exception):  # noqa: N818
    pass


BLOCK = ""
"""Where an instance tells what it is an instance of."""


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
        return {**fresh(type_.members), BLOCK: type_}
    if isinstance(type_, tree.Pointer | tree.Interface):
        return None
    return {"bool": False, "real": 0.0}.get(type_.kind, 0)


def fresh(variables: list[Variable]) -> dict[str, Any]:
    """A set of variables with their initial values."""
    return {v.name: default(v.type) if v.initial is None else initial(v.type, v.initial) for v in variables}


def initial(type_: Type, given: Any) -> Any:
    """An initial value; what an array or structure leaves open has its default."""
    if isinstance(type_, Struct):
        return {n: initial(t, given[n]) if n in given else default(t) for n, t in type_.members}
    if not isinstance(type_, Array):
        return given
    found = default(type_)
    rest = type_.bounds[1:]
    width = rest[0][1] - rest[0][0] + 1 if rest else 1
    for number, value in enumerate(given):
        row = found[number // width] if rest else found
        row[number % width if rest else number] = initial(type_.element, value)
    return found


def copied(value: Any) -> Any:
    """Arrays and structures are assigned by value."""
    if isinstance(value, list):
        return [copied(v) for v in value]
    if isinstance(value, dict):
        return {k: copied(v) for k, v in value.items()}
    return value


def overwrite(place: Any, value: Any) -> None:
    """Puts the parts of an array or structure where they belong: pointers lead to them."""
    for key in range(len(place)) if isinstance(place, list) else list(place):
        if isinstance(place[key], list | dict):
            overwrite(place[key], value[key])
        else:
            place[key] = value[key]


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
        elif isinstance(inner, list | dict):
            overwrite(inner, copied(value))
        elif self.bit is None:
            self.holder[self.key] = stored(value, type_)
        else:
            base = base_of(type_)
            cleared = inner & ~(1 << self.bit)
            self.holder[self.key] = wrap(cleared | int(bool(value)) << self.bit, base)


@dataclass(frozen=True)
class Address:
    """Value of a pointer, a reference or an interface."""

    slot: Slot


@dataclass
class Frame:
    """Variables a body sees: its own first, then those of the instance."""

    scopes: list[dict[str, Any]]
    this: dict[str, Any] | None = None
    """The instance whose code runs."""

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
    globals: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        self.variables = fresh(self.program.variables)
        self.globals = fresh(self.program.globals)

    def cycle(self) -> None:
        """One call of the program; raises Fault."""
        self._body(self.program.body, self._frame(self.variables))

    def _frame(self, own: dict[str, Any], this: dict[str, Any] | None = None) -> Frame:
        return Frame([own, *([this] if this is not None else []), self.globals], this)

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
        if s.op != ":=":
            if not value:
                return
            value = s.op == "S="
        if isinstance(s.target, tree.Get):
            self._set(s.target, value, f)
            return
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
        assert s.target is not None
        result = self._result(s, f)
        self.place(s.target, f).write(result, s.target.type)

    def _result(self, s: tree.CallFunction, f: Frame) -> Any:
        self.steps -= 1
        if self.steps < 0:
            raise TooLong
        this = f.this if s.via else self._instance(s.instance, f)
        function = s.function
        if this is not None and s.via != "SUPER":
            function = this[BLOCK].all_methods[function.name]
        own = fresh(function.locals)
        for variable, value in zip(function.inputs, s.inputs, strict=True):
            own[variable.name] = stored(self.value(value, f), variable.type)
        for variable, target in zip(function.in_outs, s.in_outs, strict=True):
            own[variable.name] = self.place(target, f)
        own[function.name] = default(function.result)
        own |= fresh(function.outputs)
        self._body(function.body, self._frame(own, this))
        for name, target in s.outputs:
            self.place(target, f).write(copied(own[name]), target.type)
        return own[function.name]

    def _instance(self, e: Any, f: Frame) -> Any:
        """The instance a call is for, None for functions."""
        if e is None:
            return None
        found = self.place(e, f).read()
        if isinstance(e.type, tree.Interface):
            if found is None:
                raise Fault("null interface")
            found = found.slot.read()
        return found

    def _accessor(self, e: tree.Get, f: Frame, role: str) -> tuple[tree.Function, Any]:
        """Get or Set, and the instance it runs on."""
        this = f.this if e.base is None else self._instance(e.base, f)
        found = e.fixed or this[BLOCK].all_properties[e.name]
        return getattr(found, role), this

    def _get(self, e: tree.Get, f: Frame) -> Any:
        getter, this = self._accessor(e, f, "getter")
        own = {**fresh(getter.locals), getter.name: default(getter.result)}
        self._body(getter.body, self._frame(own, this))
        return own[getter.name]

    def _set(self, e: tree.Get, value: Any, f: Frame) -> None:
        setter, this = self._accessor(e, f, "setter")
        own = {**fresh(setter.locals), setter.name: stored(value, setter.inputs[0].type)}
        self._body(setter.body, self._frame(own, this))

    def _callbase(self, s: tree.CallBase, f: Frame) -> None:
        assert f.this is not None
        self._body(s.block.body, self._frame(f.this, f.this))

    def _bind(self, s: tree.Bind, f: Frame) -> None:
        slot = self.place(s.place, f)
        while isinstance(slot.holder[slot.key], Slot):
            slot = slot.holder[slot.key]
        target = f.slot(s.target.name)
        target.holder[target.key] = Address(slot)

    def _callblock(self, s: tree.CallBlock, f: Frame) -> None:
        instance = self.place(s.instance, f).read()
        block = s.instance.type
        assert isinstance(block, Block)
        types = {v.name: v.type for v in block.all_inputs}
        for name, value in s.inputs:  # one by one: a fault leaves those before it
            Slot(instance, name).write(self.value(value, f), types[name])
        self._body(block.body, self._frame(instance, instance))
        for name, target in s.outputs:
            self.place(target, f).write(copied(instance[name]), target.type)

    # -- places -------------------------------------------------------------------------------------

    def place(self, e: Any, f: Frame) -> Slot:
        if isinstance(e, tree.Name):
            return f.slot(e.name)
        if isinstance(e, tree.Member):
            return Slot(self.place(e.base, f).read(), e.name)
        if isinstance(e, tree.Get):
            return Slot([copied(self._get(e, f))], 0)
        if isinstance(e, tree.Deref):
            address = self.place(e.base, f).read()
            if address is None:
                raise Fault("null pointer")
            return address.slot
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
        if isinstance(e, tree.Get):
            return self._get(e, f)
        if isinstance(e, tree.Applied):
            return self._result(e.call, f)
        if isinstance(e, tree.Chained):
            value = stored(self.value(e.value, f), e.target.type)
            place = self.place(e.target, f)
            place.write(value, e.target.type)
            return value
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
        return FUNCTIONS[name](args, e)
