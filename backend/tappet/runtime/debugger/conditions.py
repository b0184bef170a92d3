"""Expressions at a statement: conditions, and what log points write. Names mean what they do in the body."""

from __future__ import annotations

import re
from dataclasses import dataclass

from msgspec import structs

from tappet.codegen import values
from tappet.codegen.debug_code import DebugFunction
from tappet.codegen.expressions.compiler import compile_condition, compile_expression
from tappet.codegen.expressions.places import ApplicationScope, ExpressionError, Place, Scope, member_place
from tappet.codegen.expressions.program import Base, ExpressionProgram, Kind, Op, Step, value_of
from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbol_types import TypeInfo
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.expressions import NativeExpression

MOST_VALUES = 8
"""Expressions of a log point; DEBUG_LOG_ENTRY has room for so many."""
_PARTS = re.compile(r"\{\{|\}\}|\{([^{}]*)\}|\{|\}")


class FrameScope:
    """Names of a body: its locals and parameters, then the members of the own instance or program."""

    def __init__(self, variant: Variant, function: DebugFunction) -> None:
        symbols = variant.application.package.symbols
        self._symbols = structs.replace(symbols, types=variant.code.types)
        self._function = function
        self._types = variant.code.types
        self._root = symbols.roots.get(function.program)

    def find(self, name: str) -> Place | None:
        """A local variable, input or member."""
        for variable in self._function.variables:
            if variable.name.upper() == name.upper():
                info = self._types[variable.type]
                if variable.indirect:
                    address = Step(Op.LOAD, Kind.ULINT, variable.offset, Base.FRAME)
                    return Place(info, steps=(address,), path=variable.name)
                return Place(info, variable.offset, Base.FRAME, path=variable.name)
        own = self.this()
        if own is None or not any(m.name.upper() == name.upper() for m in own.info.members):
            return None
        return member_place(self._symbols, own, name)

    def this(self) -> Place | None:
        """The instance or program whose code runs."""
        if self._root is not None:
            return Place(self._types[self._root.type], self._root.offset, path=self._root.name)
        if self._function.this is None:
            return None
        return Place(self._types[self._function.this], 0, Base.THIS, path="THIS^")


def scope_at(variant: Variant, sites: list[int]) -> Scope:
    """What names mean at a breakpoint."""
    return FrameScope(variant, variant.site(sites[0])[0]) if sites else ApplicationScope()


def condition(variant: Variant, text: str, scope: Scope) -> NativeExpression:
    """A condition as the executive evaluates it. Raises ExpressionError."""
    return _native(variant, compile_condition(text, _symbols(variant), scope))


def value(variant: Variant, text: str, scope: Scope) -> NativeExpression:
    """A value as the executive evaluates it. Raises ExpressionError."""
    return _native(variant, compile_expression(text, _symbols(variant), scope))


def _symbols(variant: Variant) -> SymbolMap:
    return structs.replace(variant.application.package.symbols, types=variant.code.types)


def _native(variant: Variant, program: ExpressionProgram) -> NativeExpression:
    return NativeExpression(variant.executive, program, variant.application.image.size)


def literal(types: list[TypeInfo], program: ExpressionProgram, raw: int) -> str:
    """A result as IEC literal."""
    result = value_of(Kind(program.kind), raw)
    info = next((info for info in types if info.name == program.type_name and info.leaf), None)
    if info is None:
        return str(result).upper() if isinstance(result, bool) else str(result)
    return values.format_literal(types, info, result)


@dataclass(frozen=True, slots=True)
class LogText:
    """The text of a log point: what stands in it, and the expressions between."""

    parts: tuple[str, ...]
    """One more than there are expressions."""
    expressions: tuple[NativeExpression, ...]

    def filled(self, types: list[TypeInfo], valid: int, results: list[int]) -> str:
        """With values; ??? where there is none."""
        text = self.parts[0]
        for number, expression in enumerate(self.expressions):
            shown = literal(types, expression.program, results[number]) if valid >> number & 1 else "???"
            text += shown + self.parts[number + 1]
        return text


def log_text(variant: Variant, text: str, scope: Scope) -> LogText:
    """The text of a log point. Raises ExpressionError."""
    parts, found, at = [""], [], 0
    for match in _PARTS.finditer(text):
        parts[-1] += text[at : match.start()]
        at = match.end()
        if match[0] in ("{{", "}}"):
            parts[-1] += match[0][0]
        elif match[1] is None:
            raise ExpressionError(f"'{text}': a brace is written twice, or stands around an expression")
        else:
            found.append(value(variant, match[1], scope))
            parts.append("")
    parts[-1] += text[at:]
    if len(found) > MOST_VALUES:
        raise ExpressionError(f"a log point writes at most {MOST_VALUES} values, not {len(found)}")
    return LogText(tuple(parts), tuple(found))
