"""Statements and whole functions of the core IR as LLVM text."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from tappet.codegen.emit_expression import ExpressionEmitter, is_simple
from tappet.codegen.emit_place import COLD, WRITTEN, ModuleState
from tappet.codegen.emit_text import constant, function_symbol, llvm_type, memory_type
from tappet.core import ir
from tappet.core.internal_error import function_at, working_on

_ATTRIBUTES = {"": "#0", "cold": "#4", "never": "#5", "always": "#6", "twice": "#7"}
_KEPT = 'call void asm sideeffect "", "r,~{{memory}}"(ptr {})'
"""Locals of a function that faults come back to stay in memory: a register would have its old value."""


class FunctionEmitter(ExpressionEmitter):
    """Emits one function."""

    handlers: ClassVar[dict[type[ir.Stmt], Callable[[Any, Any], None]]] = {}
    """What emits each kind of statement."""

    def __init__(self, state: ModuleState, function: ir.Function) -> None:
        super().__init__(state, function)
        self.loops: list[tuple[str, str]] = []
        """(continue label, break label) of the open loops."""

    def text(self, linkage: str) -> list[str]:
        """All lines of the definition."""
        with working_on("code generation", lambda: function_at(self.function, self.line)):
            return self._text(linkage)

    def _text(self, linkage: str) -> list[str]:
        function = self.function
        if function.result_local is not None:
            self.local(function.result_local)
        self.statements(function.body)
        if not self.terminated:
            self._return_(ir.Return())
        self.write_cold()
        result = llvm_type(function.result)
        parameters = ", ".join(
            f"{llvm_type(p.type)}{parameter_attributes(p)} %a{i}" for i, p in enumerate(function.parameters)
        )
        head = (
            f"define {linkage}{result} {function_symbol(function)}({parameters}) {self.attributes()} "
            f"!dbg !{self.subprogram} {{"
        )
        if function.returns_twice:
            self.prologue += [_KEPT.format(name) for name in self.locals.values() if name.startswith("%l")]
        if self.calls and function.self_type and self.state.module.catches_faults:
            self.prologue.append(WRITTEN)
        return [head, "entry:", *self.prologue, "br label %start", "start:", *self.out, "}"]

    def attributes(self) -> str:
        """Attribute groups of the function."""
        return attributes(self.function)

    def statements(self, body: list[ir.Stmt]) -> None:
        """Emit statements in order; what cannot be reached is left out."""
        for statement in body:
            if self.terminated and type(statement) is not ir.Label:
                continue
            self.handlers[type(statement)](self, statement)

    def _line(self, s: ir.Line) -> None:
        self.location = self.location_of(s.line)

    # -- memory --------------------------------------------------------------------------------------

    def _store(self, s: ir.Store) -> None:
        value = self.memory_value(s.value)
        pointer = self.address(s.place)
        align = f", align {s.align}" if s.align else self.place_align(s.place)
        t = memory_type(s.value.type)
        self.out.append(f"store {t} {value}, ptr {pointer}{align}{self.scopes.text(s.place)}{self.location}")

    def _copy(self, s: ir.Copy) -> None:
        if s.size <= 0:
            return
        source, target = self.address(s.source), self.address(s.target)
        name = "memmove" if s.overlap else "memcpy"
        self.state.intrinsics.add(f"declare void @llvm.{name}.p0.p0.i64(ptr, ptr, i64, i1)")
        self.out.append(
            f"call void @llvm.{name}.p0.p0.i64(ptr align {s.align} {target}, ptr align {s.align} {source}, "
            f"i64 {s.size}, i1 false){self.location}"
        )

    def _fill(self, s: ir.Fill) -> None:
        if s.size <= 0:
            return
        self.state.intrinsics.add("declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)")
        self.out.append(
            f"call void @llvm.memset.p0.i64(ptr align {s.align} {self.address(s.target)}, i8 {s.value}, "
            f"i64 {s.size}, i1 false){self.location}"
        )

    def _copy_bytes(self, s: ir.CopyBytes) -> None:
        target, source, count = self.expr(s.target), self.expr(s.source), self.expr(s.count)
        self.state.intrinsics.add("declare void @llvm.memmove.p0.p0.i64(ptr, ptr, i64, i1)")
        args = f"ptr {target}, ptr {source}, i64 {count}, i1 false"
        self.out.append(f"call void @llvm.memmove.p0.p0.i64({args}){self.location}")

    def _fill_bytes(self, s: ir.FillBytes) -> None:
        target, value, count = self.expr(s.target), self.expr(s.value), self.expr(s.count)
        self.state.intrinsics.add("declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)")
        self.out.append(
            f"call void @llvm.memset.p0.i64(ptr {target}, i8 {value}, i64 {count}, i1 false){self.location}"
        )

    def _evaluate(self, s: ir.Evaluate) -> None:
        self.expr(s.value)

    def _fault(self, s: ir.FaultIf) -> None:
        condition = self.expr(s.condition)
        self.fault_if(condition, s.code, [self.expr(a) for a in s.args])

    def _check_index(self, s: ir.CheckIndex) -> None:
        if s.subscript.checked:
            self.element_number(s.subscript)

    # -- branches ------------------------------------------------------------------------------------

    def condition(self, expr: ir.Expr, yes: str, no: str) -> None:
        """Branch on an expression; short-circuit operators become control flow where that saves work."""
        if isinstance(expr, ir.Unary) and expr.op == "not":
            self.condition(expr.operand, no, yes)
            return
        if isinstance(expr, ir.ShortCircuit) and not is_simple(expr.right):
            middle = self.new_label()
            if expr.op == "and":
                self.condition(expr.left, middle, no)
            else:
                self.condition(expr.left, yes, middle)
            self.start_block(middle)
            self.condition(expr.right, yes, no)
            return
        self.branch(self.expr(expr), yes, no)

    def _if_(self, s: ir.If) -> None:
        then, join = self.new_label(), self.new_label()
        otherwise = self.new_label() if s.otherwise else join
        self.condition(s.condition, then, otherwise)
        self.start_block(then)
        self.statements(s.then)
        self.jump(join)
        if s.otherwise:
            self.start_block(otherwise)
            self.statements(s.otherwise)
            self.jump(join)
        self.start_block(join)

    def switch(self, s: ir.Switch) -> None:
        """Small ranges become switch cases, large ones a search in front of it."""
        scalar = s.selector.type
        t = llvm_type(scalar)
        selector = self.expr(s.selector)
        join = self.new_label()
        default = self.new_label() if s.default else join
        labels = [self.new_label() for _ in s.cases]
        table: list[str] = []
        large: list[tuple[int, int, str]] = []
        seen: set[int] = set()
        for case, label in zip(s.cases, labels, strict=True):
            for low, high in case.ranges:
                if high - low < 64:
                    fresh = [v for v in range(low, high + 1) if v not in seen]
                    seen.update(fresh)
                    table += [f"{t} {constant(scalar, v)}, label %{label}" for v in fresh]
                else:
                    large.append((low, high, label))
        if large:
            small = self.new_label()
            self._search(scalar, selector, sorted(large), small)
            self.start_block(small)
        self.out.append(f"switch {t} {selector}, label %{default} [{' '.join(table)}]{self.location}")
        self.terminated = True
        for case, label in zip(s.cases, labels, strict=True):
            self.start_block(label)
            self.statements(case.body)
            self.jump(join)
        if s.default:
            self.start_block(default)
            self.statements(s.default)
            self.jump(join)
        self.start_block(join)

    def _search(
        self, scalar: ir.Scalar, selector: str, ranges: list[tuple[int, int, str]], otherwise: str
    ) -> None:
        """Go to the label of the range that holds the selector: halving, as a chain costs LLVM its square."""
        t = llvm_type(scalar)
        if len(ranges) > 1:
            middle = len(ranges) // 2
            order = "slt" if scalar.signed else "ult"
            below, above = self.new_label(), self.new_label()
            bound = constant(scalar, ranges[middle][0])
            self.branch(self.value(f"icmp {order} {t} {selector}, {bound}"), below, above)
            self.start_block(below)
            self._search(scalar, selector, ranges[:middle], otherwise)
            self.start_block(above)
            self._search(scalar, selector, ranges[middle:], otherwise)
            return
        low, high, label = ranges[0]
        shifted = self.value(f"sub {t} {selector}, {constant(scalar, low)}") if low else selector
        inside = self.value(f"icmp ule {t} {shifted}, {constant(scalar, high - low)}")
        self.branch(inside, label, otherwise)

    # -- loops ---------------------------------------------------------------------------------------

    def _for_(self, s: ir.For) -> None:
        self._store(ir.Store(s.counter, s.start))
        if s.fixed and isinstance(s.step, int) and s.step:
            self.counted(s, s.step)
        else:
            self.stepped(s)

    def _read_counter(self, s: ir.For) -> str:
        suffix = self.scopes.text(s.counter)
        return self.value(f"load {memory_type(s.type)}, ptr {self.address(s.counter)}{suffix}")

    def _write_counter(self, s: ir.For, value: str) -> None:
        suffix = self.scopes.text(s.counter)
        self.out.append(f"store {memory_type(s.type)} {value}, ptr {self.address(s.counter)}{suffix}")

    def counted(self, s: ir.For, step: int) -> None:
        """A counter that only the loop changes: the increment of the hot path provably does not overflow.

        When the next value would pass `stop` the loop ends; only there the step may wrap, and a wrapped
        counter that is inside the limits again continues as the language says (LST-29).
        """
        t = llvm_type(s.type)
        head, body, latch = self.new_label(), self.new_label(), self.new_label()
        hot, last, done = self.new_label(), self.new_label(), self.new_label()
        order = "le" if step > 0 else "ge"
        signed = "s" if s.type.signed else "u"
        self.start_block(head)
        counter, stop = self._read_counter(s), self.expr(s.stop)
        self.branch(self.value(f"icmp {signed}{order} {t} {counter}, {stop}"), body, done)
        self.start_block(body)
        self._loop_body(s.body, latch, done)
        self.start_block(latch)
        self.location = self.location_of(s.line)
        counter, stop = self._read_counter(s), self.expr(s.stop)
        if abs(step) == 1:
            more = self.value(f"icmp {signed}{'lt' if step > 0 else 'gt'} {t} {counter}, {stop}")
        else:
            more = self.has_room(s, step, counter, stop)
        self.branch(more, hot, last)
        self.start_block(hot)
        flags = "nsw" if s.type.signed else ("nuw" if step > 0 else "")
        self._write_counter(s, self.value(f"add {flags} {t} {counter}, {constant(s.type, step)}"))
        self.jump(body)
        self.start_block(last)
        passed = self.value(f"add {t} {counter}, {constant(s.type, step)}")
        self._write_counter(s, passed)
        if _cannot_wrap(s, step):
            self.jump(done)
        else:
            again = self.value(f"icmp {signed}{order} {t} {passed}, {stop}")
            self.branch(again, head, done, COLD)
        self.start_block(done)

    def has_room(self, s: ir.For, step: int, counter: str, stop: str) -> str:
        """Whether counter + step still is inside `stop`, without overflow."""
        t = llvm_type(s.type)
        if s.type.bits < 64:
            extend = "sext" if s.type.signed else "zext"
            wide = self.value(f"{extend} {t} {counter} to i64")
            limit = self.value(f"{extend} {t} {stop} to i64")
            ahead = self.value(f"add nsw i64 {wide}, {step}")
            return self.value(f"icmp {'sle' if step > 0 else 'sge'} i64 {ahead}, {limit}")
        low, high = (counter, stop) if step > 0 else (stop, counter)
        ordered = self.value(f"icmp {'s' if s.type.signed else 'u'}le {t} {low}, {high}")
        distance = self.value(f"sub {t} {high}, {low}")
        enough = self.value(f"icmp uge {t} {distance}, {abs(step)}")
        return self.value(f"and i1 {ordered}, {enough}")

    def stepped(self, s: ir.For) -> None:
        """The general form: check, body, add the step with wrap-around."""
        t = llvm_type(s.type)
        head, body, latch, done = (self.new_label() for _ in range(4))
        signed = "s" if s.type.signed else "u"
        self.start_block(head)
        counter, stop = self._read_counter(s), self.expr(s.stop)
        if isinstance(s.step, int):
            test = self.value(f"icmp {signed}{'le' if s.step >= 0 else 'ge'} {t} {counter}, {stop}")
        else:
            step = self.expr(s.step)
            test = up = self.value(f"icmp {signed}le {t} {counter}, {stop}")
            if s.step.type.signed:
                down = self.value(f"icmp {signed}ge {t} {counter}, {stop}")
                rising = self.value(f"icmp sge {t} {step}, 0")
                test = self.value(f"select i1 {rising}, i1 {up}, i1 {down}")
        self.branch(test, body, done)
        self.start_block(body)
        self._loop_body(s.body, latch, done)
        self.start_block(latch)
        self.location = self.location_of(s.line)
        counter = self._read_counter(s)
        amount = constant(s.type, s.step) if isinstance(s.step, int) else self.expr(s.step)
        self._write_counter(s, self.value(f"add {t} {counter}, {amount}"))
        self.jump(head)
        self.start_block(done)

    def _loop_body(self, body: list[ir.Stmt], continue_label: str, break_label: str) -> None:
        self.loops.append((continue_label, break_label))
        self.statements(body)
        self.loops.pop()
        self.jump(continue_label)

    def _while_(self, s: ir.While) -> None:
        head, body, done = self.new_label(), self.new_label(), self.new_label()
        self.start_block(head)
        if s.line:
            self.location = self.location_of(s.line)
        self.condition(s.condition, body, done)
        self.start_block(body)
        self._loop_body(s.body, head, done)
        self.start_block(done)

    def _repeat(self, s: ir.Repeat) -> None:
        body, check, done = self.new_label(), self.new_label(), self.new_label()
        self.start_block(body)
        self._loop_body(s.body, check, done)
        self.start_block(check)
        self.location = self.location_of(s.until.line)
        self.condition(s.condition, done, body)
        self.start_block(done)

    def _promote(self, s: ir.Promoted) -> None:
        self.load_promoted(s)
        self.promoted.append(s)
        self.statements([s.loop])
        self.promoted.pop()
        if not self.terminated:
            self.store_promoted(s)

    # -- jumps ---------------------------------------------------------------------------------------

    def _break_(self, s: ir.Break) -> None:
        self.jump(self.loops[-1][1])

    def _continue_(self, s: ir.Continue) -> None:
        self.jump(self.loops[-1][0])

    def _return_(self, s: ir.Return) -> None:
        for promoted in reversed(self.promoted):
            self.store_promoted(promoted)
        function = self.function
        if function.result is ir.VOID:
            self.out.append(f"ret void{self.location}")
        else:
            assert function.result_local is not None
            value = self.expr(ir.Load(function.result, ir.Place(function.result_local)))
            self.out.append(f"ret {llvm_type(function.result)} {value}{self.location}")
        self.terminated = True

    def _label(self, s: ir.Label) -> None:
        self.start_block(f"j.{s.name}")

    def _goto(self, s: ir.Goto) -> None:
        self.jump(f"j.{s.name}")


def _cannot_wrap(s: ir.For, step: int) -> bool:
    """Whether a counter that has just passed a constant `stop` is still inside its type."""
    if not isinstance(s.stop, ir.Const):
        return False
    bits, stop = s.type.bits, int(s.stop.value)
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if s.type.signed else (0, (1 << bits) - 1)
    return low <= stop + step <= high


def parameter_attributes(parameter: ir.Parameter) -> str:
    """LLVM attributes of a parameter."""
    if not parameter.type.pointer:
        return " noundef"
    text = " noundef"
    if parameter.alone:
        text += " noalias"
    if not parameter.writable:
        text += " readonly"
    if parameter.align > 1:
        text += f" align {parameter.align}"
    return text


_MANY_LABELS = 400
"""A body with more labels is not optimised: the time for jumps back and forth grows with their square."""


def attributes(function: ir.Function) -> str:
    """Attribute groups of a function."""
    if function.labels > _MANY_LABELS:
        return f"{_ATTRIBUTES['twice' if function.returns_twice else 'never']} #8"
    if function.returns_twice:
        return _ATTRIBUTES["twice"]
    if function.cold:
        return _ATTRIBUTES["cold"]
    return _ATTRIBUTES[function.inline]


_F = FunctionEmitter
FunctionEmitter.handlers = {
    ir.Line: _F._line,
    ir.Store: _F._store,
    ir.Copy: _F._copy,
    ir.Fill: _F._fill,
    ir.CopyBytes: _F._copy_bytes,
    ir.FillBytes: _F._fill_bytes,
    ir.Evaluate: _F._evaluate,
    ir.FaultIf: _F._fault,
    ir.CheckIndex: _F._check_index,
    ir.If: _F._if_,
    ir.Switch: _F.switch,
    ir.For: _F._for_,
    ir.While: _F._while_,
    ir.Repeat: _F._repeat,
    ir.Promoted: _F._promote,
    ir.Break: _F._break_,
    ir.Continue: _F._continue_,
    ir.Return: _F._return_,
    ir.Label: _F._label,
    ir.Goto: _F._goto,
}
