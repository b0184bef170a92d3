"""From the text of an expression to the stack program that the executive evaluates.

Operand types meet as in compiled code (`lang.analysis.conversion`): integers narrower than 32 bit are
computed in DINT, literals without a type adapt to the other operand. Names are those of a scope, such as the
locals where a program is halted, then those of the symbol map.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce

from tappet.codegen.expressions.operators import (
    Operand,
    combine,
    compare,
    comparison_operators,
    constant,
    converted,
    logic,
    negated,
    numeric_function,
    short_circuit,
)
from tappet.codegen.expressions.places import (
    ApplicationScope,
    ExpressionError,
    Place,
    Scope,
    element_place,
    elementary_of,
    kind_of,
    member_place,
    place_at,
    static_place,
)
from tappet.codegen.expressions.program import (
    MOST_STEPS,
    ExpressionProgram,
    ProgramError,
    Step,
    check_program,
)
from tappet.codegen.symbol_map import SymbolError, SymbolMap
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.parser import parse_expression

MAX_TEXT = 1000
_FUNCTIONS = {"ABS": 1, "SQRT": 1, "MIN": 2, "MAX": 2, "LIMIT": 3}


def compile_expression(text: str, symbols: SymbolMap, scope: Scope | None = None) -> ExpressionProgram:
    """The program of an expression; ExpressionError says what is wrong with it."""
    operand = _Compiler(symbols, scope or ApplicationScope()).expression(_parsed(text))
    return _program(operand)


def compile_condition(text: str, symbols: SymbolMap, scope: Scope | None = None) -> ExpressionProgram:
    """The program of a condition: BOOL, or a number that is not 0."""
    operand = _Compiler(symbols, scope or ApplicationScope()).expression(_parsed(text))
    if operand.type is not t.BOOL:
        operand = compare("<>", operand, constant(0))
    return _program(operand)


def compile_crossing(
    value: str, level: str, upwards: bool, symbols: SymbolMap, scope: Scope | None = None
) -> ExpressionProgram:
    """Whether a value has reached a level from below (`upwards`) or from above; of a BOOL without level,
    whether it is TRUE or FALSE. An edge is where this becomes TRUE."""
    compiler = _Compiler(symbols, scope or ApplicationScope())
    operand = compiler.expression(_parsed(value))
    if not level.strip():
        if operand.type is not t.BOOL:
            raise ExpressionError(f"'{value.strip()}' ({operand.type_name}) needs a level")
        return _program(operand if upwards else negated(operand))
    if operand.type is t.BOOL:
        raise ExpressionError(f"'{value.strip()}' is BOOL, which has no level; leave it empty")
    expected = compiler.expected(_parsed(level), operand)
    return _program(compare(">=" if upwards else "<=", operand, expected))


def place_of(text: str, symbols: SymbolMap) -> Place | None:
    """The variable that an expression is, where it is one with a fixed place; ExpressionError for a text that
    is no expression."""
    compiler = _Compiler(symbols, ApplicationScope())
    tree = _parsed(text)
    if not isinstance(tree, ast.Name | ast.Member | ast.Index):
        return None
    path = compiler.path(tree)
    return static_place(symbols, path) if path is not None else None


def _parsed(text: str) -> ast.Expr:
    if len(text) > MAX_TEXT:
        raise ExpressionError(f"an expression has at most {MAX_TEXT} characters")
    if not text.strip():
        raise ExpressionError("an expression is missing")
    tree, found = parse_expression(text.strip())
    for diagnostic in found:
        if diagnostic.severity == "error":
            raise ExpressionError(f"{diagnostic.message} {diagnostic.advice}".strip())
    return tree


def _program(operand: Operand) -> ExpressionProgram:
    if len(operand.steps) > MOST_STEPS:
        raise ExpressionError(f"the expression is too long: {len(operand.steps)} of {MOST_STEPS} steps")
    program = ExpressionProgram(operand.steps, kind_of(operand.held), operand.type_name)
    try:
        check_program(program, 1 << 62)
    except ProgramError as error:
        raise ExpressionError(f"the expression is too deep: {error}") from error
    return program


@dataclass(frozen=True, slots=True)
class _Compiler:
    symbols: SymbolMap
    scope: Scope

    def expression(self, tree: ast.Expr) -> Operand:
        """Steps that push the value of `tree`."""
        if isinstance(tree, ast.Literal):
            return self._literal(tree)
        if isinstance(tree, ast.Unary):
            operand = self.expression(tree.operand)
            return operand if tree.op == "+" else negated(operand, sign=tree.op == "-")
        if isinstance(tree, ast.Binary):
            return self._binary(tree)
        if isinstance(tree, ast.Call):
            return self._call(tree)
        if isinstance(tree, ast.Name | ast.Member):
            value = self._enumerator(tree)
            if value is not None:
                return value
        return self._loaded(self.place(tree))

    def expected(self, tree: ast.Expr, other: Operand) -> Operand:
        """The same, where a lone name can be a value of the enumeration on the other side."""
        if isinstance(tree, ast.Name) and other.info is not None and other.info.kind == "enum":
            for name, number in other.info.values:
                if name.upper() == tree.name.upper():
                    return replace(constant(number, other.type), info=other.info)
        return self.expression(tree)

    def _loaded(self, place: Place) -> Operand:
        if place.info.kind == "reference" and place.bit is None:
            place = place.target(self.symbols.types)
        type_ = t.BOOL if place.bit is not None else elementary_of(place.info, place.path)
        return Operand(place.load(), type_, info=place.info)

    def _literal(self, tree: ast.Literal) -> Operand:
        if tree.kind in ("string", "wstring") or tree.value is None:
            raise ExpressionError(f"{tree.text} is no number; texts are not compared here")
        assert isinstance(tree.value, bool | int | float)
        if tree.kind == "bool":
            return constant(int(tree.value), t.BOOL)
        if tree.kind not in ("int", "real"):
            return constant(tree.value, t.ELEMENTARY[tree.kind.upper()])
        if tree.prefix:
            type_ = t.ELEMENTARY.get(tree.prefix)
            if type_ is None:
                raise ExpressionError(f"{tree.text}: the type {tree.prefix} is not known here")
            return constant(tree.value, type_)
        return constant(tree.value)

    def _binary(self, tree: ast.Binary) -> Operand:
        left = self.expression(tree.left) if not self._lone_name(tree.left) else None
        right = self.expected(tree.right, left) if left is not None else self.expression(tree.right)
        if left is None:
            left = self.expected(tree.left, right)
        op = tree.op
        if op in comparison_operators:
            return compare(op, left, right)
        if op in ("AND", "OR", "XOR"):
            return logic(op, left, right)
        if op in ("AND_THEN", "OR_ELSE"):
            return short_circuit(op, left, right)
        return combine(op, left, right)

    def _lone_name(self, tree: ast.Expr) -> bool:
        """A name that is no variable: perhaps a value of the enumeration on the right."""
        if not isinstance(tree, ast.Name) or tree.leading_dot:
            return False
        return self.scope.find(tree.name) is None and static_place(self.symbols, tree.name) is None

    def _call(self, tree: ast.Call) -> Operand:
        if not isinstance(tree.callee, ast.Name) or tree.callee.name.upper() not in _FUNCTIONS:
            raise ExpressionError(f"only {', '.join(_FUNCTIONS)} can be called here")
        name = tree.callee.name.upper()
        given = [argument.value for argument in tree.args if argument.value is not None]
        more = name in ("MIN", "MAX") and len(given) > _FUNCTIONS[name]
        if (len(given) != _FUNCTIONS[name] and not more) or any(argument.output for argument in tree.args):
            raise ExpressionError(f"'{name}' takes {_FUNCTIONS[name]} values, not {len(tree.args)}")
        values = [self.expression(value) for value in given]
        if name == "LIMIT":  # IEC 61131-3, table 36: MIN(MAX(IN, MN), MX)
            least, value, most = values
            return numeric_function("MIN", [numeric_function("MAX", [value, least]), most])
        if more:
            return reduce(lambda one, other: numeric_function(name, [one, other]), values)
        return numeric_function(name, values)

    # -- variables ---------------------------------------------------------------------------------------

    def path(self, tree: ast.Expr) -> str | None:
        """The path of an access with no computed part; None where there is one."""
        if isinstance(tree, ast.Name):
            return f".{tree.name}" if tree.leading_dot else tree.name
        if isinstance(tree, ast.Member):
            base = self.path(tree.base)
            return None if base is None else f"{base}.{tree.name}"
        if isinstance(tree, ast.Index):
            base = self.path(tree.base)
            numbers = [_number(index) for index in tree.indices]
            if base is None or None in numbers:
                return None
            return f"{base}[{', '.join(map(str, numbers))}]"
        return None

    def place(self, tree: ast.Expr) -> Place:
        """Where a variable lies; ExpressionError names the part that is wrong."""
        if isinstance(tree, ast.Name):
            return self._named(tree)
        if isinstance(tree, ast.This):
            this = self.scope.this()
            if this is None:
                raise ExpressionError("THIS means nothing here; write the path of the instance")
            return this
        if isinstance(tree, ast.Deref):
            if isinstance(tree.base, ast.This):
                return self.place(tree.base)
            return self.place(tree.base).target(self.symbols.types)
        if not isinstance(tree, ast.Member | ast.Index):
            raise ExpressionError("only variables, literals, operators and functions are possible here")
        if not self._begins_in_scope(tree):
            path = self.path(tree)
            found = static_place(self.symbols, path) if path is not None else None
            if found is not None:
                return found
        if isinstance(tree, ast.Member):
            try:
                base = self.place(tree.base)
            except ExpressionError as error:
                raise self._unknown(tree, error) from error
            return member_place(self.symbols, base, tree.name)
        return element_place(self.symbols, self.place(tree.base), [self._index(i) for i in tree.indices])

    def _begins_in_scope(self, tree: ast.Expr) -> bool:
        while isinstance(tree, ast.Member | ast.Index):
            tree = tree.base
        return not isinstance(tree, ast.Name) or (
            not tree.leading_dot and self.scope.find(tree.name) is not None
        )

    def _named(self, tree: ast.Name) -> Place:
        found = None if tree.leading_dot else self.scope.find(tree.name)
        if found is not None:
            return found
        try:
            ref = self.symbols.resolve(tree.name)
        except SymbolError as error:
            raise ExpressionError(str(error)) from error
        return place_at(ref)

    def _unknown(self, tree: ast.Member, error: ExpressionError) -> ExpressionError:
        """What the symbol map says of a path is nearer to the fault than what is known of its first name."""
        path = self.path(tree)
        if path is None:
            return error
        try:
            self.symbols.resolve(path)
        except SymbolError as found:
            return ExpressionError(str(found))
        return error

    def _index(self, tree: ast.Expr) -> tuple[Step, ...] | int:
        number = _number(tree)
        if number is not None:
            return number
        index = self.expression(tree)
        if not index.type.is_integer:
            raise ExpressionError(f"an index is an integer, not {index.type_name}")
        return converted(index, t.LINT).steps

    def _enumerator(self, tree: ast.Name | ast.Member) -> Operand | None:
        """`Type.Value`, or a value that only one enumeration has; None for a variable."""
        path = self.path(tree)
        if path is None or self._begins_in_scope(tree) or static_place(self.symbols, path) is not None:
            return None
        owner, _, name = path.rpartition(".")
        found = {}
        for info in self.symbols.types:
            if info.kind != "enum" or (owner and not _is_named(info.name, owner)):
                continue
            for value, number in info.values:
                if value.upper() == name.upper():
                    found[number, info.name] = info
        if not owner and len(found) > 1:
            names = ", ".join(sorted(f"{type_name}.{name}" for _, type_name in found))
            raise ExpressionError(f"'{name}' is a value of several enumerations; write one of {names}")
        for (number, _), info in found.items():
            return replace(constant(number, elementary_of(info, path)), info=info)
        return None


def _number(tree: ast.Expr) -> int | None:
    """The integer that a literal, or a negative one, is."""
    if isinstance(tree, ast.Unary) and tree.op == "-":
        number = _number(tree.operand)
        return None if number is None else -number
    if isinstance(tree, ast.Literal) and tree.kind == "int" and isinstance(tree.value, int):
        return tree.value
    return None


def _is_named(type_name: str, written: str) -> bool:
    """Whether a type is written so: with its namespace or without."""
    full, short = type_name.upper(), written.upper().lstrip(".")
    return full == short or full.endswith(f".{short}") or short.endswith(f".{full}")
