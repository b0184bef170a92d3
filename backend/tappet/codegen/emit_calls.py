"""Calls of the core IR as LLVM instructions: direct, through an address, and through method tables.

A virtual call takes two loads, as in C with a table of function pointers: the type number in the instance,
and the entry of the method's table for that number. Where few bodies can be meant, they are called directly
behind a comparison of the number, so that small ones are inlined; the table stays for any other number.
"""

from __future__ import annotations

from tappet.codegen.emit_place import PlaceEmitter
from tappet.codegen.emit_text import PREFIX, llvm_type, symbol
from tappet.core import ir

FEW = 4
"""Bodies that a virtual call compares for; the comparisons for more cost as much as the table."""
FEW_NUMBERS = 16
"""Type numbers that these bodies may belong to."""
TABLE = "tappet.dispatch."
"""Prefix of the table of a slot: code addresses by type number."""


def direct_targets(method: ir.VirtualMethod) -> list[str]:
    """The bodies that calls of a virtual method name; none where they go through its table."""
    names = list(dict.fromkeys(method.targets.values()))
    return names if len(names) <= FEW and len(method.targets) <= FEW_NUMBERS else []


class CallEmitter(PlaceEmitter):
    """Everything about calls."""

    def function_name(self, name: str) -> str:
        """Global name of a function or import."""
        self.state.called.add(name)
        function = self.state.module.functions.get(name)
        if function is None or function.exported:
            return symbol(name)
        return symbol(PREFIX + name)

    def _function_address(self, expr: ir.FunctionAddress) -> str:
        return self.function_name(expr.name)

    def _arguments(self, args: list[ir.Expr]) -> list[str]:
        return [f"{llvm_type(a.type)} {self.expr(a)}" for a in args]

    def _call(self, expr: ir.Call) -> str:
        args = self._arguments(expr.args)
        barriers = self._before_call(expr.function)
        if self.state.module.catches_faults and self._goes_through_pointer(expr):
            # a fault in the middle of the body would find what it assigns before left out
            self.write_back()
            self.value(f"load volatile i8, {args[0]}{self.location}")
        value = self._invoke(expr.type, self.function_name(expr.function), args)
        return self._after_call(barriers, value)

    def _goes_through_pointer(self, expr: ir.Call) -> bool:
        """Whether the instance of a call is given by a pointer, which may lead nowhere."""
        callee = self.state.module.functions.get(expr.function)
        if callee is None or not callee.self_type:
            return False
        own = expr.args[0]
        if isinstance(own, ir.Address):
            return isinstance(own.place.base, ir.Indirect) and not own.place.base.own
        return isinstance(own, ir.Load)

    def _call_pointer(self, expr: ir.CallPointer) -> str:
        pointer = self.expr(expr.pointer)
        args = self._arguments(expr.args)
        barriers = self._before_call("")
        return self._after_call(barriers, self._invoke(expr.type, pointer, args))

    def _before_call(self, name: str) -> list[ir.Promoted]:
        """Writes promoted variables; those that the callee reaches are to be read again behind it.

        A fault in a callee that cannot reach them must find them in memory, too (decision 2).
        """
        for promoted in self.promoted:
            self.store_promoted(promoted)
        return [p for p in self.promoted if name not in p.free]

    def _after_call(self, barriers: list[ir.Promoted], value: str) -> str:
        for promoted in barriers:
            self.load_promoted(promoted)
        return value

    def _invoke(self, result: ir.Scalar, callee: str, args: list[str]) -> str:
        self.calls = True
        text = f"call {llvm_type(result)} {callee}({', '.join(args)}){self.location}"
        if result is not ir.VOID:
            return self.value(text)
        self.out.append(text)
        return ""

    # -- virtual calls -------------------------------------------------------------------------------

    def _call_virtual(self, expr: ir.CallVirtual) -> str:
        args = self._arguments(expr.args)
        instance = args[0].removeprefix("ptr ")
        method = expr.method
        barriers = self._before_call(method.key)
        self.write_back()
        names = direct_targets(method)
        if len(names) == 1:
            # no instance of any other block exists; the load is there to fault where there is none at all
            self.value(f"load volatile i32, ptr {instance}{self.location}")
            value = self._invoke(expr.type, self.function_name(names[0]), args)
        elif names:
            value = self._select_body(expr, names, instance, args)
        else:
            if not method.targets:
                # the table is known to be empty, so nothing else would look at the instance
                self.value(f"load volatile i32, ptr {instance}{self.location}")
            number = self._type_number(instance)
            value = self._invoke(expr.type, self._entry(method, number), args)
        return self._after_call(barriers, value)

    def _type_number(self, instance: str) -> str:
        """The type number of an instance.

        Not marked as `!invariant.group`, though it stays while the instance exists: the GVN of LLVM 22 then
        looks through all uses of the address, and dies over those in other functions when inlining has made
        the address a constant.
        """
        return self.value(f"load i32, ptr {instance}{self.location}")

    def _entry(self, method: ir.VirtualMethod, number: str) -> str:
        """Code address of the body for a type number."""
        table = f"{TABLE}{method.slot}"
        self.state.used.add(table)
        wide = self.value(f"zext i32 {number} to i64")
        entry = self.value(f"getelementptr inbounds ptr, ptr {symbol(table)}, i64 {wide}")
        return self.value(f"load ptr, ptr {entry}, !invariant.load !1")

    def _select_body(self, expr: ir.CallVirtual, names: list[str], instance: str, args: list[str]) -> str:
        """Direct calls of a few bodies behind a comparison of the type number."""
        number = self._type_number(instance)
        labels = {name: self.new_label() for name in names}
        other, join = self.new_label(), self.new_label()
        cases = [f"i32 {n}, label %{labels[name]}" for n, name in expr.method.targets.items()]
        weights = ", ".join(["i32 1", *["i32 1048575"] * len(cases)])
        rarely = self.state.metadata.add(f'!{{!"branch_weights", {weights}}}')
        self.out.append(
            f"switch i32 {number}, label %{other} [{' '.join(cases)}], !prof !{rarely}{self.location}"
        )
        self.terminated = True
        results = []
        for name, label in [*labels.items(), ("", other)]:
            self.start_block(label)
            callee = self.function_name(name) if name else self._entry(expr.method, number)
            results.append(f"[{self._invoke(expr.type, callee, args)}, %{label}]")
            self.jump(join)
        self.start_block(join)
        return "" if expr.type is ir.VOID else self.value(f"phi {llvm_type(expr.type)} {', '.join(results)}")
