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
from bytes_in_memory import Unsettled, size_and_alignment
from reference_values import (
    BLOCK,
    BOUNDS,
    Address,
    Continue,
    Exit,
    Frame,
    Return,
    Slot,
    TooLong,
    copied,
    default,
    fresh,
    initial,
    line,
    stored,
)
from typed_tree import Array, Block, OpenArray, Text, Variable, base_of


@dataclass
class Machine:
    """Runs one program."""

    program: tree.Program
    steps: int = 20_000
    variables: dict[str, Any] = field(init=False)
    globals: dict[str, Any] = field(init=False)
    kept: dict[int, tuple[Any, dict[str, Any]]] = field(default_factory=dict)
    """VAR_STAT by what declares it, VAR_INST by instance, each with its owner."""

    def __post_init__(self) -> None:
        self.globals = fresh(self.program.globals)
        self.variables = fresh(self.program.variables)
        self._construct(self.program.variables, self.variables)

    def _construct(self, variables: list[Variable], holder: dict[str, Any]) -> None:
        """FB_Init of the blocks among some variables, then what their declarations say (LDEC-100)."""
        for v in variables:
            if isinstance(v.type, Block):
                self._initialise(v.type, holder[v.name], v.arguments)
                if v.initial is not None:
                    types = {m.name: m.type for m in v.type.members}
                    holder[v.name] |= {n: initial(types[n], x) for n, x in v.initial.items()}

    def _initialise(self, block: Block, instance: dict[str, Any], given: tuple[Any, ...] | None) -> None:
        self._construct(block.members, instance)
        made = block.maker
        if made is not None and given is not None:
            own = {v.name: stored(x, v.type) for v, x in zip(made.inputs, given, strict=True)}
            self._body(made.body, self._frame(own, instance))

    def cycle(self) -> None:
        """One call of the program; raises Fault."""
        self._body(self.program.body, self._frame(self.variables))

    def _frame(self, own: dict[str, Any], this: dict[str, Any] | None = None) -> Frame:
        inside: list[dict[str, Any]] = []
        if this is not None:
            inside = [this, *(self._static(b, b.statics) for b in line(this[BLOCK]) if b.statics)]
        return Frame([own, *inside, self.globals], this)

    def _static(self, owner: Any, variables: list[Variable]) -> dict[str, Any]:
        """Variables that live as long as their owner: a function, a block, an instance."""
        found = self.kept.setdefault(id(owner), (owner, {}))[1]
        for v in variables:
            if v.name not in found:
                found |= fresh([v])
        return found

    def _body(self, body: list[Any], frame: Frame) -> None:
        with contextlib.suppress(Return):
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
        except Continue:
            pass
        except Exit:
            return False
        return True

    def _for(self, s: tree.For, f: Frame) -> None:
        type_ = base_of(s.counter.type)
        counter = self.place(s.counter, f)
        counter.write(self.value(s.start, f), s.counter.type)
        while True:
            number = counter.read()
            stop = convert(self.value(s.stop, f), type_)  # every pass looks at it again
            if number > stop if self._step(s, f) >= 0 else number < stop:
                return
            if not self._pass(s.body, f):
                return
            number = counter.read()
            counter.write(wrap(number + self._step(s, f), type_), s.counter.type)

    def _step(self, s: tree.For, f: Frame) -> int:
        """With its own sign, also where the counter has none."""
        return s.step if isinstance(s.step, int) else self.value(s.step, f)  # type: ignore[no-any-return]

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
        raise {"EXIT": Exit, "CONTINUE": Continue, "RETURN": Return}[s.word]

    def _try(self, s: tree.Try, f: Frame) -> None:
        unsettled = False
        try:
            self._run(s.body, f)
        except Fault as fault:
            if s.handler is None:
                raise
            if s.code is not None:
                f.slot(s.code.name).write(fault.number, tree.DWORD)
            self._run(s.handler, f)
        except (TooLong, Unsettled):
            unsettled = True
            raise
        finally:
            if s.final is not None and not unsettled:
                self._run(s.final, f)

    def _new(self, s: tree.New, f: Frame) -> None:
        assert isinstance(s.pointer.type, tree.Pointer)
        made = s.pointer.type.target
        holder = {"": default(made)}
        if isinstance(made, Block):
            self._initialise(made, holder[""], s.arguments)
        pointer = f.slot(s.pointer.name)
        pointer.holder[pointer.key] = Address(Slot(holder, ""))
        self._run(s.body, f)
        pointer.holder[pointer.key] = None

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
            if isinstance(variable.type, OpenArray):
                own[BOUNDS + variable.name] = self._bounds(target, f)
        own[function.name] = default(function.result)
        own |= fresh(function.outputs)
        frame = self._frame(own, this)
        if function.statics:
            frame.scopes.insert(1, self._static(function, function.statics))
        if function.kept:
            frame.scopes.insert(1, self._static(this, function.kept))
        self._body(function.body, frame)
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

    def _attempt(self, s: tree.Attempt, f: Frame) -> None:
        assert isinstance(s.target.type, tree.Pointer)
        wanted = s.target.type.target
        assert isinstance(wanted, Block)
        slot = self.place(s.source, f)
        while isinstance(slot.holder[slot.key], Slot):
            slot = slot.holder[slot.key]
        address = Address(slot) if isinstance(s.source.type, Block) else slot.read()
        fits = address is not None and address.slot.read()[BLOCK].is_a(wanted)
        target = f.slot(s.target.name)
        target.holder[target.key] = address if fits else None
        self._run(s.body if fits else s.otherwise, f)

    def _callblock(self, s: tree.CallBlock, f: Frame) -> None:
        instance = self.place(s.instance, f).read()
        block = s.instance.type
        assert isinstance(block, Block)
        types = {v.name: v.type for v in block.all_inputs}
        enabled = s.enable is None or self.value(s.enable, f)
        if s.success is not None:
            self.place(s.success, f).write(enabled, tree.BOOL)
        if not enabled:
            return
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
        for index, (low, high) in zip(indices, self._bounds(e.base, f), strict=True):
            if self.program.checks and not isinstance(e.base.type, OpenArray):
                index = min(max(wrap(index, tree.DINT), low), high)
            if not low <= index <= high:
                raise Fault("array index")
            slot = Slot(slot.read(), index - low)
        return slot

    def _bounds(self, e: Any, f: Frame) -> tuple[tuple[int, int], ...]:
        """Of an array; an open one has those of its argument."""
        if isinstance(e.type, OpenArray):
            return f.slot(BOUNDS + e.name).read()  # type: ignore[no-any-return]
        assert isinstance(e.type, Array)
        return e.type.bounds

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
        if isinstance(e, tree.Bound):
            return self._bounds(e.array, f)[e.dimension][e.upper]
        if isinstance(e, tree.IsNull):
            return (self.place(e.pointer, f).read() is None) is e.equal
        if isinstance(e, tree.SizeOf):
            return size_and_alignment(e.of)[0]
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
        if self.program.checks and right == 0 and e.op in ("/", "MOD") and not e.constant:
            right = convert(1, e.computed)
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
            if self.program.checks and e.op == "/":
                right = right or 1
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
