"""Makes the instrumented variant from what a build has generated, without lowering anything again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.compile_pool import Compilation
from tappet.codegen.debug_code import DebugCode, DebugFunction, FrameVariable, StatementSite
from tappet.codegen.emit_function import FunctionEmitter
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.codegen.emit_place import ModuleState
from tappet.codegen.generate import Generated
from tappet.codegen.instrumented import FrameLayout, InstrumentedEmitter, StatementHead
from tappet.codegen.object_cache import ObjectCache
from tappet.codegen.symbols_build import TypeTable
from tappet.core import ir
from tappet.core.program import Program, path_of
from tappet.lang import ast
from tappet.lang.source import NOWHERE, Scope
from tappet.lang.symbols import PouSymbol, VarSymbol
from tappet.lang.walk import bodies, expressions, own_expressions, statements

MOST_NAMES = 8
"""Variables of a statement whose values flow control keeps; FLOW_RESULT has room for so many."""
LARGE = 6_000
"""Applications of more weight are compiled without optimisation: somebody waits, and LLVM would take three
times as long as for the normal code."""


def instrument(generated: Generated, cache: ObjectCache | None = None) -> DebugCode:
    """The instrumented variant of an application that was just generated."""
    program = generated.lowered.program
    assert program is not None
    work = _Instrumentation(program, _copied(generated.laid.table))
    module, parts = generated.lowered.module, generated.parts
    parallel = len(parts) > 2
    level = 0 if sum(function.weight for function in module.functions.values()) > LARGE else 1
    compilation = Compilation(cache or ObjectCache(None), OptimiseOptions(level=level), parallel)
    options = EmitOptions(triple=generated.package.triple)
    for part in parts:
        copies = [name for name in part.copies if not work.is_instrumented(name)]
        compilation.add(
            emit_module(module, part.names, options, len(parts) == 1, copies, emitter=work.emitter)
        )
    objects, functions = compilation.objects(), work.functions()
    return DebugCode(generated.package.code_id, objects, functions, list(work.table.types))


def _copied(table: TypeTable) -> TypeTable:
    """A type table that gets the types of local variables; that of the package stays as it is."""
    copy = TypeTable(table.areas, table.statics)
    copy.types, copy.numbers = list(table.types), dict(table.numbers)
    copy.described, copy.lists = dict(table.described), dict(table.lists)
    return copy


@dataclass(slots=True)
class _Instrumentation:
    """Which functions have hooks, and what came of them."""

    program: Program
    table: TypeTable
    emitted: list[tuple[ir.Function, InstrumentedEmitter, tuple[FrameVariable, ...]]] = field(
        default_factory=list
    )

    def is_instrumented(self, name: str) -> bool:
        """Bodies of the application are; libraries run as they are."""
        pou = self.program.bodies.get(name)
        return pou is not None and pou.source is not None and pou.source.scope is not Scope.LIBRARY

    def emitter(self, state: ModuleState, function: ir.Function) -> FunctionEmitter:
        """What emits a function."""
        if not self.is_instrumented(function.name):
            return FunctionEmitter(state, function)
        layout = FrameLayout()
        variables = tuple(self._variables(function, layout))
        heads = _heads(self.program.bodies[function.name])
        emitter = InstrumentedEmitter(state, function, layout, heads)
        self.emitted.append((function, emitter, variables))
        return emitter

    def functions(self) -> list[DebugFunction]:
        """All that have a place to halt, in the order in which they were emitted."""
        return [self._function(function, emitter, found) for function, emitter, found in self.emitted]

    def _function(
        self, function: ir.Function, emitter: InstrumentedEmitter, variables: tuple[FrameVariable, ...]
    ) -> DebugFunction:
        pou = self.program.bodies[function.name]
        owner = pou.owner if pou.owner is not None else pou
        block = owner.instance if function.self_type else None
        sites: tuple[StatementSite, ...] = tuple(emitter.sites)
        return DebugFunction(
            function.name,
            function.uri,
            sites,
            variables,
            self.table.number(block) if block is not None else None,
            path_of(owner).upper() if owner.kind == "PROGRAM" else "",
            emitter.fixed_order(),
        )

    def _variables(self, function: ir.Function, layout: FrameLayout) -> list[FrameVariable]:
        places = self.program.places.get(function.name, {})
        found = []
        for variable in _declared(self.program.bodies[function.name]):
            place = places.get(id(variable))
            if place is None or variable.type is None or place.subscripts or place.offset:
                continue
            base, number = place.base, self.table.number(variable.type)
            if isinstance(base, ir.Local) and base in function.aliases:
                at = layout.pointer(function.aliases[base])
                found.append(FrameVariable(variable.name, number, at, variable.section, True, False))
            elif isinstance(base, ir.Local):
                writable = not variable.is_constant
                at = layout.place(base)
                found.append(FrameVariable(variable.name, number, at, variable.section, False, writable))
            elif isinstance(base, ir.Indirect) and isinstance(base.pointer, ir.Argument):
                at = layout.pointer(base.pointer.number)
                found.append(FrameVariable(variable.name, number, at, variable.section, True))
        return found


def _declared(pou: PouSymbol) -> list[VarSymbol]:
    """Parameters, the result and what a body declares itself, in order."""
    found = list(pou.parameters)
    if pou.result is not None:
        found.append(pou.result)
    assert pou.pou is not None
    for block in pou.pou.blocks:
        found += [d.symbol for d in block.variables if isinstance(d.symbol, VarSymbol)]
    return list({id(v): v for v in found}.values())


def _heads(pou: PouSymbol) -> dict[tuple[int, int], StatementHead]:
    """Of each statement and each condition of an ELSIF or UNTIL, by its place: the variables that it names,
    as its text does; some may have no single value."""
    assert pou.pou is not None
    assert pou.source is not None
    lines = pou.source.text.split("\n")
    found: dict[tuple[int, int], StatementHead] = {}
    for statement in statements(pou.pou.body):
        place = statement.span.line + 1, statement.span.column
        if place in found:
            continue  # what one place stands for, as the jump of a JMPC
        own, further = list(own_expressions(statement)), []
        if isinstance(statement, ast.If):
            (first, _), *later = statement.branches
            own, further = list(expressions(first)), [condition for condition, _ in later]
        elif isinstance(statement, ast.RepeatUntil):
            own, further = [], [statement.condition]
        begin = min([statement.span.line, *(e.span.line for e in own if e.span != NOWHERE)])
        found[place] = StatementHead((begin + 1, _head_line(statement)), _names(own, lines))
        for condition in further:
            span = condition.span
            head = span.line + 1, span.end_line + 1
            found[span.line + 1, span.column] = StatementHead(head, _names(expressions(condition), lines))
    return found


def _names(among: Iterable[ast.Expr], lines: Sequence[str]) -> tuple[str, ...]:
    """The variables among expressions, as the text writes them; outer expressions come before their parts."""
    named: dict[str, str] = {}
    parts: set[int] = set()
    for e in among:
        if isinstance(e, ast.Index | ast.Member | ast.Deref):
            parts.add(id(e.base))
        if id(e) in parts or e.is_constant or not isinstance(e, _NAMED):
            continue
        span = e.span
        if span.line == span.end_line and 0 <= span.line < len(lines):
            text = lines[span.line][span.column : span.end_column].strip()
            if text:
                named.setdefault(text.upper(), text)
    return tuple(named.values())[:MOST_NAMES]


def _head_line(statement: ast.Stmt) -> int:
    """The last line, from 1, of what is executed before the statements inside one."""
    match statement:
        case ast.If():
            last = statement.branches[0][0].span.end_line
        case ast.Case():
            last = statement.selector.span.end_line
        case ast.For():
            last = (statement.step or statement.stop).span.end_line
        case ast.While():
            last = statement.condition.span.end_line
        case _ if bodies(statement):
            last = statement.span.line
        case _:
            last = statement.span.end_line
    return max(last, statement.span.line) + 1


_NAMED = (ast.Name, ast.Member, ast.Index, ast.Deref)
