"""Expressions of the core IR as LLVM instructions."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Any

from tappet.codegen.emit_calls import CallEmitter
from tappet.codegen.emit_place import COLD
from tappet.codegen.emit_text import constant, llvm_type, memory_type
from tappet.codegen.faults import Fault
from tappet.core import ir

_INTEGER_OPS = {"add": "add", "sub": "sub", "mul": "mul", "and": "and", "or": "or", "xor": "xor"}
_FLOAT_OPS = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv", "rem": "frem"}
_SIGNED_PREDICATES = {"lt": "slt", "le": "sle", "gt": "sgt", "ge": "sge"}
_UNSIGNED_PREDICATES = {"lt": "ult", "le": "ule", "gt": "ugt", "ge": "uge"}
_FLOAT_PREDICATES = {"eq": "oeq", "ne": "une", "lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge"}
_FLOAT_UNARY = {
    "abs": "fabs",
    "sqrt": "sqrt",
    "floor": "floor",
    "ceil": "ceil",
    "trunc": "trunc",
    "round": "round",
}
_LIBM = {"sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "log10", "pow"}


def is_simple(expr: ir.Expr) -> bool:
    """Whether evaluating `expr` early does no harm and costs little: no calls, no checks, no pointers."""
    kind = type(expr)
    if kind is ir.Const or kind is ir.Argument:
        return True
    if kind is ir.Load:
        assert isinstance(expr, ir.Load)
        return not expr.place.subscripts and not isinstance(expr.place.base, ir.Indirect)
    if isinstance(expr, ir.Compare):
        return is_simple(expr.left) and is_simple(expr.right)
    if isinstance(expr, ir.Binary):
        division = expr.op in ("div", "rem") and expr.type.integer
        return not division and is_simple(expr.left) and is_simple(expr.right)
    if isinstance(expr, ir.Unary | ir.Convert | ir.Reinterpret):
        return is_simple(expr.operand)
    if isinstance(expr, ir.ShortCircuit):
        return is_simple(expr.left) and is_simple(expr.right)
    return False


class ExpressionEmitter(CallEmitter):
    """Everything about values."""

    relies_on_proofs = True
    """Whether nobody but the program writes its variables, so that what was proved of them holds."""

    def expr(self, expr: ir.Expr) -> str:
        """Operand text of the value."""
        if isinstance(expr, ir.Const):
            return constant(expr.type, expr.value)
        value = _HANDLERS[type(expr)](self, expr)
        if isinstance(expr, ir.Binary | ir.Compare | ir.Convert | ir.Unary) and _takes_from_pointer(expr):
            self._locate(value)
        return value

    def _locate(self, value: str) -> None:
        """Gives the last instruction, if it makes `value`, its line: what is loaded becomes an operand of it,
        and is then found by its line alone."""
        last = self.out[-1]
        if last.startswith(f"{value} = ") and "!dbg" not in last:
            self.out[-1] = last + self.location

    def _load(self, expr: ir.Load) -> str:
        pointer = self.address(expr.place)
        t = memory_type(expr.type)
        align = f", align {expr.align}" if expr.align else self.place_align(expr.place)
        suffix = self.scopes.text(expr.place)
        if isinstance(expr.place.base, ir.Indirect):
            suffix += self.location
        value = self.value(f"load {t}, ptr {pointer}{align}{suffix}")
        return self.value(f"trunc i8 {value} to i1") if expr.type.bits == 1 else value

    def place_align(self, place: ir.Place) -> str:
        """Alignment suffix where a place may lie anywhere; natural alignment otherwise."""
        if isinstance(place.base, ir.Indirect) and place.base.align == 1:
            return ", align 1"
        return ""

    def _address_of(self, expr: ir.Address) -> str:
        return self.address(expr.place)

    def _argument(self, expr: ir.Argument) -> str:
        return f"%a{expr.number}"

    # -- arithmetic ----------------------------------------------------------------------------------

    def _unary(self, expr: ir.Unary) -> str:
        operand = self.expr(expr.operand)
        t = llvm_type(expr.type)
        op = expr.op
        if expr.type.floating:
            if op == "neg":
                return self.value(f"fneg {t} {operand}")
            name = f"llvm.{_FLOAT_UNARY[op]}.f{expr.type.bits}"
            self.state.intrinsics.add(f"declare {t} @{name}({t})")
            return self.value(f"call {t} @{name}({t} {operand})")
        if op == "neg":
            return self.value(f"sub {t} 0, {operand}")
        if op == "abs":
            self.state.intrinsics.add(f"declare {t} @llvm.abs.{t}({t}, i1)")
            return self.value(f"call {t} @llvm.abs.{t}({t} {operand}, i1 false)")
        ones = "true" if expr.type.bits == 1 else "-1"
        return self.value(f"xor {t} {operand}, {ones}")

    def _binary(self, expr: ir.Binary) -> str:
        op = expr.op
        if op in ("min", "max"):
            return self._extremum(expr)
        if op == "offset":
            pointer, count = self.expr(expr.left), self.expr(expr.right)
            return self.value(f"getelementptr i8, ptr {pointer}, i64 {count}")
        if op in ("shl", "shr", "rol", "ror"):
            return self._shift(expr)
        t = llvm_type(expr.type)
        if expr.type.floating:
            left, right = self.expr(expr.left), self.expr(expr.right)
            return self.value(f"{_FLOAT_OPS[op]} {t} {left}, {right}")
        if op in ("div", "rem"):
            return self.divide(expr)
        left, right = self.expr(expr.left), self.expr(expr.right)
        exact = "nsw " if expr.exact and self.relies_on_proofs else ""
        return self.value(f"{_INTEGER_OPS[op]} {exact}{t} {left}, {right}")

    def _extremum(self, expr: ir.Binary) -> str:
        left, right = self.expr(expr.left), self.expr(expr.right)
        t = llvm_type(expr.type)
        predicate = "lt" if expr.op == "min" else "gt"
        if expr.type.floating:
            test = self.value(f"fcmp {_FLOAT_PREDICATES[predicate]} {t} {right}, {left}")
            return self.value(f"select i1 {test}, {t} {right}, {t} {left}")
        name = f"llvm.{'s' if expr.type.signed else 'u'}{expr.op}.{t}"
        self.state.intrinsics.add(f"declare {t} @{name}({t}, {t})")
        return self.value(f"call {t} @{name}({t} {left}, {t} {right})")

    def divide(self, expr: ir.Binary) -> str:
        """Integer div and rem: zero faults when checked, the smallest number by -1 wraps, never traps."""
        left, right = self.expr(expr.left), self.expr(expr.right)
        t = llvm_type(expr.type)
        sign = "s" if expr.type.signed else "u"
        name = f"{sign}{expr.op}"
        divisor = expr.right
        if isinstance(divisor, ir.Const):
            if divisor.value == 0:
                self.fault_if("true", Fault.DIV_ZERO, [])
                return "0"
            if divisor.value == -1 and expr.type.signed:
                return self.value(f"sub {t} 0, {left}") if expr.op == "div" else "0"
            return self.value(f"{name} {t} {left}, {right}")
        if not expr.type.signed or _cannot_be_minimum(expr.left):
            if expr.checked:
                self.fault_if(self.value(f"icmp eq {t} {right}, 0"), Fault.DIV_ZERO, [])
            return self.value(f"{name} {t} {left}, {right}")
        shifted = self.value(f"add {t} {right}, 1")
        special = self.value(f"icmp ult {t} {shifted}, 2")
        rare, plain, join = self.new_label(), self.new_label(), self.new_label()
        self.branch(special, rare, plain, COLD)
        self.start_block(rare)
        if expr.checked:
            self.fault_if(self.value(f"icmp eq {t} {right}, 0"), Fault.DIV_ZERO, [])
        negated = self.value(f"sub {t} 0, {left}") if expr.op == "div" else "0"
        rare_end = self.block
        self.jump(join)
        self.start_block(plain)
        quotient = self.value(f"{name} {t} {left}, {right}")
        self.start_block(join)
        return self.value(f"phi {t} [{negated}, %{rare_end}], [{quotient}, %{plain}]")

    def _shift(self, expr: ir.Binary) -> str:
        left = self.expr(expr.left)
        t, bits = llvm_type(expr.type), expr.type.bits
        if expr.op in ("rol", "ror"):
            count = self.resize(self.expr(expr.right), ir.U32, ir.UNSIGNED[bits])
            name = f"llvm.fsh{'l' if expr.op == 'rol' else 'r'}.{t}"
            self.state.intrinsics.add(f"declare {t} @{name}({t}, {t}, {t})")
            return self.value(f"call {t} @{name}({t} {left}, {t} {left}, {t} {count})")
        op = "shl" if expr.op == "shl" else ("ashr" if expr.type.signed else "lshr")
        if isinstance(expr.right, ir.Const):
            count_value = int(expr.right.value)
            if count_value < bits:
                return self.value(f"{op} {t} {left}, {count_value}")
            return self.value(f"ashr {t} {left}, {bits - 1}") if op == "ashr" else "0"
        raw = self.expr(expr.right)
        if op == "ashr":
            self.state.intrinsics.add("declare i32 @llvm.umin.i32(i32, i32)")
            raw = self.value(f"call i32 @llvm.umin.i32(i32 {raw}, i32 {bits - 1})")
            return self.value(f"ashr {t} {left}, {self.resize(raw, ir.U32, ir.UNSIGNED[bits])}")
        inside = self.value(f"icmp ult i32 {raw}, {bits}")
        shifted = self.value(f"{op} {t} {left}, {self.resize(raw, ir.U32, ir.UNSIGNED[bits])}")
        return self.value(f"select i1 {inside}, {t} {shifted}, {t} 0")

    def _compare(self, expr: ir.Compare) -> str:
        scalar = expr.left.type
        left, right = self.expr(expr.left), self.expr(expr.right)
        t = llvm_type(scalar)
        if scalar.floating:
            return self.value(f"fcmp {_FLOAT_PREDICATES[expr.op]} {t} {left}, {right}")
        table = _SIGNED_PREDICATES if scalar.signed else _UNSIGNED_PREDICATES
        return self.value(f"icmp {table.get(expr.op, expr.op)} {t} {left}, {right}")

    # -- conversions ---------------------------------------------------------------------------------

    def resize(self, operand: str, source: ir.Scalar, target: ir.Scalar) -> str:
        """Integer to integer."""
        if source.bits == target.bits:
            return operand
        op = "trunc" if target.bits < source.bits else ("sext" if source.signed else "zext")
        return self.value(f"{op} {llvm_type(source)} {operand} to {llvm_type(target)}")

    def _convert(self, expr: ir.Convert) -> str:
        operand = self.expr(expr.operand)
        source, target = expr.operand.type, expr.type
        s, t = llvm_type(source), llvm_type(target)
        if source is target:
            return operand
        if source.floating:
            if target.floating:
                if source.bits == target.bits:
                    return operand
                op = "fpext" if target.bits > source.bits else "fptrunc"
                return self.value(f"{op} {s} {operand} to {t}")
            return self.float_to_integer(operand, source, target, expr.mode)
        if target.floating:
            op = "sitofp" if source.signed else "uitofp"
            return self.value(f"{op} {s} {operand} to {t}")
        if source.pointer:
            return operand if target.pointer else self.value(f"ptrtoint ptr {operand} to {t}")
        if target.pointer:
            wide = self.resize(operand, source, ir.U64) if source.bits != 64 else operand
            return self.value(f"inttoptr i64 {wide} to ptr")
        return self.resize(operand, source, target)

    def float_to_integer(self, operand: str, source: ir.Scalar, target: ir.Scalar, mode: str) -> str:
        """Rounded or cut to a whole number, which is held within the limits of the target (LTYP-26)."""
        s, t = llvm_type(source), llvm_type(target)
        if mode == "round":
            self.state.intrinsics.add(f"declare {s} @llvm.round.f{source.bits}({s})")
            operand = self.value(f"call {s} @llvm.round.f{source.bits}({s} {operand})")
        name = f"llvm.fpto{'s' if target.signed else 'u'}i.sat.{t}.f{source.bits}"
        self.state.intrinsics.add(f"declare {t} @{name}({s})")
        return self.value(f"call {t} @{name}({s} {operand})")

    def _reinterpret(self, expr: ir.Reinterpret) -> str:
        operand = self.expr(expr.operand)
        s, t = llvm_type(expr.operand.type), llvm_type(expr.type)
        return operand if s == t else self.value(f"bitcast {s} {operand} to {t}")

    # -- control -------------------------------------------------------------------------------------

    def _select(self, expr: ir.Select) -> str:
        t = llvm_type(expr.type)
        condition = self.expr(expr.condition)
        if is_simple(expr.then) and is_simple(expr.otherwise):
            then, otherwise = self.expr(expr.then), self.expr(expr.otherwise)
            return self.value(f"select i1 {condition}, {t} {then}, {t} {otherwise}")
        return self.merge(t, condition, expr.then, expr.otherwise)

    def merge(self, t: str, condition: str, then: ir.Expr | str, otherwise: ir.Expr | str) -> str:
        """Evaluate one of two by branching."""
        yes, no, join = self.new_label(), self.new_label(), self.new_label()
        self.branch(condition, yes, no)
        self.start_block(yes)
        first = then if isinstance(then, str) else self.expr(then)
        first_end = self.block
        self.jump(join)
        self.start_block(no)
        second = otherwise if isinstance(otherwise, str) else self.expr(otherwise)
        second_end = self.block
        self.start_block(join)
        return self.value(f"phi {t} [{first}, %{first_end}], [{second}, %{second_end}]")

    def _short_circuit(self, expr: ir.ShortCircuit) -> str:
        left = self.expr(expr.left)
        if is_simple(expr.right):
            right = self.expr(expr.right)
            if expr.op == "and":
                return self.value(f"select i1 {left}, i1 {right}, i1 false")
            return self.value(f"select i1 {left}, i1 true, i1 {right}")
        if expr.op == "and":
            return self.merge("i1", left, expr.right, "false")
        return self.merge("i1", left, "true", expr.right)

    def _sequence(self, expr: ir.Sequence) -> str:
        self.statements(expr.statements)
        return self.expr(expr.value)

    # -- machine operations ---------------------------------------------------------------------------

    def _intrinsic(self, expr: ir.Intrinsic) -> str:
        op = expr.op
        if op in _LIBM:
            t = llvm_type(expr.type)
            name = op + ("f" if expr.type.bits == 32 else "")
            args = [f"{t} {self.expr(a)}" for a in expr.args]
            self.state.intrinsics.add(f"declare {t} @{name}({', '.join([t] * len(args))}) #2")
            return self.value(f"call {t} @{name}({', '.join(args)})")
        handler: str = _MACHINE[op]
        result: str = getattr(self, handler)(expr)
        return result

    def _now_ns(self, expr: ir.Intrinsic) -> str:
        self.state.used.add("tappet_now_ns")
        return self.value(f"call i64 @tappet_now_ns(){self.location}")

    def _setjmp(self, expr: ir.Intrinsic) -> str:
        self.state.intrinsics.add("declare i32 @_setjmp(ptr) #3")
        return self.value(f"call i32 @_setjmp(ptr {self.expr(expr.args[0])}) #3{self.location}")

    def _longjmp(self, expr: ir.Intrinsic) -> str:
        self.state.intrinsics.add("declare void @longjmp(ptr, i32)")
        buffer, value = self.expr(expr.args[0]), self.expr(expr.args[1])
        self.out.append(f"call void @longjmp(ptr {buffer}, i32 {value}){self.location}")
        return ""

    def _frame_address(self, expr: ir.Intrinsic) -> str:
        self.state.intrinsics.add("declare ptr @llvm.frameaddress.p0(i32)")
        pointer = self.value("call ptr @llvm.frameaddress.p0(i32 0)")
        return self.value(f"ptrtoint ptr {pointer} to i64")

    def _load_acquire(self, expr: ir.Intrinsic) -> str:
        t = memory_type(expr.type)
        value = self.value(f"load atomic {t}, ptr {self.expr(expr.args[0])} acquire, align {expr.type.size}")
        return self.value(f"trunc i8 {value} to i1") if expr.type.bits == 1 else value

    def _store_release(self, expr: ir.Intrinsic) -> str:
        pointer, scalar = self.expr(expr.args[0]), expr.args[1].type
        value = self.memory_value(expr.args[1])
        t = memory_type(scalar)
        self.out.append(f"store atomic {t} {value}, ptr {pointer} release, align {scalar.size}")
        return ""

    def _fetch_add(self, expr: ir.Intrinsic) -> str:
        pointer, value = self.expr(expr.args[0]), self.expr(expr.args[1])
        return self.value(f"atomicrmw add ptr {pointer}, {llvm_type(expr.type)} {value} seq_cst")

    def _compare_swap(self, expr: ir.Intrinsic) -> str:
        pointer, old, new = (self.expr(a) for a in expr.args)
        t = llvm_type(expr.args[1].type)
        pair = self.value(f"cmpxchg ptr {pointer}, {t} {old}, {t} {new} seq_cst seq_cst")
        return self.value(f"extractvalue {{ {t}, i1 }} {pair}, 1")

    def _fence(self, expr: ir.Intrinsic) -> str:
        self.out.append("fence seq_cst")
        return ""

    def _compare_strings(self, expr: ir.Intrinsic) -> str:
        name = "strcmp" if expr.op == "strcompare" else "tappet.wstrcmp"
        left, right = self.expr(expr.args[0]), self.expr(expr.args[1])
        self.state.used.add(name)
        return self.value(f"call i32 @{name}(ptr {left}, ptr {right}){self.location}")

    def memory_value(self, expr: ir.Expr) -> str:
        """Operand as it is stored: BOOL as byte 0 or 1."""
        value = self.expr(expr)
        if expr.type.bits != 1:
            return value
        if value in ("true", "false"):
            return "1" if value == "true" else "0"
        return self.value(f"zext i1 {value} to i8")

    @abstractmethod
    def statements(self, body: list[ir.Stmt]) -> None:
        """Emit statements."""


def _takes_from_pointer(expr: ir.Binary | ir.Compare | ir.Convert | ir.Unary) -> bool:
    """Whether an operand is loaded from where a pointer leads, which may be nowhere."""
    operands = (expr.operand,) if isinstance(expr, ir.Convert | ir.Unary) else (expr.left, expr.right)
    return any(isinstance(o, ir.Load) and isinstance(o.place.base, ir.Indirect) for o in operands)


def _cannot_be_minimum(expr: ir.Expr) -> bool:
    """Whether a signed dividend is surely not the smallest number of its type."""
    if isinstance(expr, ir.Convert):
        source = expr.operand.type
        return not source.floating and source.bits < expr.type.bits
    if isinstance(expr, ir.Const):
        return expr.value != -(1 << (expr.type.bits - 1))
    return False


_MACHINE = {
    "now_ns": "_now_ns",
    "setjmp": "_setjmp",
    "longjmp": "_longjmp",
    "frame_address": "_frame_address",
    "load_acquire": "_load_acquire",
    "store_release": "_store_release",
    "fetch_add": "_fetch_add",
    "compare_swap": "_compare_swap",
    "fence": "_fence",
    "strcompare": "_compare_strings",
    "wstrcompare": "_compare_strings",
}

_E = ExpressionEmitter
_HANDLERS: dict[type[ir.Expr], Callable[[ExpressionEmitter, Any], str]] = {
    ir.Load: _E._load,
    ir.Address: _E._address_of,
    ir.Argument: _E._argument,
    ir.FunctionAddress: _E._function_address,
    ir.Unary: _E._unary,
    ir.Binary: _E._binary,
    ir.Compare: _E._compare,
    ir.Convert: _E._convert,
    ir.Reinterpret: _E._reinterpret,
    ir.Select: _E._select,
    ir.ShortCircuit: _E._short_circuit,
    ir.Call: _E._call,
    ir.CallPointer: _E._call_pointer,
    ir.CallVirtual: _E._call_virtual,
    ir.Intrinsic: _E._intrinsic,
    ir.Sequence: _E._sequence,
}
