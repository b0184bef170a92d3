"""Function blocks with generic constants: a block of its own for every list of values (`FB<20>`).

`expand` runs before the analysis: it computes the values that types name, copies the trees of the block with
the values as constants, and lets the types name the copies. Values are made of integers and named constants.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import MISSING, dataclass, field, fields, replace
from typing import Any

from tappet.lang import ast
from tappet.lang.analysis.conversion import RANGES
from tappet.lang.ast.fields import resolved_fields

LIMIT = 30
"""Blocks whose values come from the values of others: one that names itself with another value never ends."""
_DEPTH = 50
"""Constants from constants."""
_OPERATIONS: dict[str, Callable[[int, int], int]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1),
    "MOD": lambda a, b: abs(a) % abs(b) * (1 if a >= 0 else -1),
}

Constants = dict[str, ast.Expr]
"""Values of named constants by upper-case name."""


def generic_constants(pou: ast.Pou) -> list[ast.VarDecl]:
    """The generic constants of a block, in order."""
    return [decl for block in pou.blocks if block.generic for decl in block.variables]


def expand(units: Sequence[ast.Unit]) -> Sequence[ast.Unit]:
    """The units and those of the blocks that generic ones become; `units` itself where there are none."""
    blocks: dict[str, list[_Generic]] = {}
    for unit in units:
        for declaration in unit.declarations:
            if isinstance(declaration, ast.Pou) and generic_constants(declaration):
                blocks.setdefault(declaration.name.upper(), []).append(_Generic(unit, declaration))
    if not blocks:
        return units
    return _Expansion(units, blocks).run()


@dataclass(slots=True)
class _Generic:
    """A block with generic constants, and its methods that have a text of their own."""

    unit: ast.Unit
    pou: ast.Pou
    made: set[str] = field(default_factory=set)


class _Expansion:
    """Makes the blocks of one program."""

    def __init__(self, units: Sequence[ast.Unit], blocks: dict[str, list[_Generic]]) -> None:
        self.units = units
        self.blocks = blocks
        self.new: list[ast.Unit] = []
        self.depths: dict[int, int] = {}
        """Of each new unit by its id(): how many values came from values of another."""
        self.globals: Constants = {}
        for unit in units:
            for declaration in unit.declarations:
                if isinstance(declaration, ast.GlobalList):
                    for name, initial in _constants(declaration.blocks).items():
                        self.globals.setdefault(name, initial)
                        self.globals.setdefault(f"{declaration.name.upper()}.{name}", initial)

    def run(self) -> Sequence[ast.Unit]:
        todo = list(self.units)
        while todo:
            unit = todo.pop(0)
            for declaration in unit.declarations:
                before = len(self.new)
                self._declaration(unit, declaration)
                todo += self.new[before:]
        return [*self.units, *self.new]

    def _declaration(self, unit: ast.Unit, declaration: ast.Declaration) -> None:
        owner = unit.source.owner
        outside: Constants = {}
        for text in [*self.units, *self.new] if owner is not None else ():
            if text.source.scope is unit.source.scope and text.source.library == unit.source.library:
                for other in text.declarations:
                    if isinstance(other, ast.Pou) and other.name.upper() == (owner or "").upper():
                        outside |= _constants(other.blocks)
        self._part(unit, declaration, outside)

    def _part(self, unit: ast.Unit, part: ast.Declaration | ast.Accessor, outside: Constants) -> None:
        known = outside
        if isinstance(part, (ast.Pou, ast.Accessor, ast.GlobalList)):
            known = outside | _constants(part.blocks)
        if isinstance(part, ast.Pou) and part.extends_type is not None:
            self._named(unit, part.extends_type, known)
            part.extends = part.extends_type.name
        for ref in _types_of(part):
            for named in _named_types(ref):
                self._named(unit, named, known)
        for inner in _inner_parts(part):
            self._part(unit, inner, known)

    def _named(self, unit: ast.Unit, ref: ast.NamedType, known: Constants) -> None:
        if not ref.values:
            return
        ref.name = ref.generic
        path, _, name = ref.generic.rpartition(".")
        found = self._block(unit, name)
        numbers = [self._value(e, known, 0) for e in ref.values]
        if found is None or len(numbers) != len(generic_constants(found.pou)):
            return
        values: list[int] = []
        for number, decl in zip(numbers, generic_constants(found.pou), strict=True):
            limits = self._limits(decl.type_ref)
            if number is None or limits is None or not limits[0] <= number <= limits[1]:
                return
            values.append(number)
        made = f"{found.pou.name}<{','.join(map(str, values))}>"
        if made not in found.made:
            depth = self.depths.get(id(unit), 0) + 1
            if depth > LIMIT:
                return
            found.made.add(made)
            before = len(self.new)
            self._make(found, made, values)
            self.depths |= dict.fromkeys(map(id, self.new[before:]), depth)
        ref.name = f"{path}.{made}" if path else made

    def _block(self, unit: ast.Unit, name: str) -> _Generic | None:
        known = self.blocks.get(name.upper(), [])
        own = [g for g in known if g.unit.source.library == unit.source.library]
        own.sort(key=lambda g: g.unit.source.scope is not unit.source.scope)
        return next(iter(own or known), None)

    def _limits(self, ref: ast.TypeRef) -> tuple[int, int] | None:
        if isinstance(ref, ast.SubrangeType):
            low, high = self._value(ref.low, {}, 0), self._value(ref.high, {}, 0)
            return None if low is None or high is None else (low, high)
        return RANGES.get(ref.name.upper()) if isinstance(ref, ast.NamedType) else None

    def _value(self, e: ast.Expr | None, known: Constants, depth: int) -> int | None:
        if isinstance(e, ast.Literal):
            return e.value if e.kind == "int" and isinstance(e.value, int) else None
        if isinstance(e, ast.Unary) and e.op in ("-", "+"):
            operand = self._value(e.operand, known, depth)
            return operand if operand is None or e.op == "+" else -operand
        if isinstance(e, ast.Binary) and e.op in _OPERATIONS:
            left, right = self._value(e.left, known, depth), self._value(e.right, known, depth)
            if left is None or right is None or (right == 0 and e.op in ("/", "MOD")):
                return None
            return _OPERATIONS[e.op](left, right)
        name = _path(e)
        if not name or depth >= _DEPTH:
            return None
        if name in known:
            return self._value(known[name], known, depth + 1)
        return self._value(self.globals.get(name), {}, depth + 1)

    # -- copies

    def _make(self, block: _Generic, name: str, values: list[int]) -> None:
        source = block.unit.source
        pou = copied(block.pou)
        pou.name = name
        for decl, value in zip(generic_constants(pou), values, strict=True):
            digits = ast.Literal(text=str(abs(value)), kind="int", value=abs(value), span=decl.span)
            decl.initial = digits if value >= 0 else ast.Unary(op="-", operand=digits, span=decl.span)
        self.new.append(ast.Unit(span=block.unit.span, source=source, declarations=[pou], copied=True))
        for unit in self.units:
            other = unit.source
            if other.owner is None or other.owner.upper() != block.pou.name.upper():
                continue
            if (other.scope, other.library) != (source.scope, source.library):
                continue
            below = replace(other, owner=name)
            parts = [copied(part) for part in unit.declarations]
            for part in parts:
                part.source = below
            self.new.append(ast.Unit(span=unit.span, source=below, declarations=parts, copied=True))


def _constants(blocks: Sequence[ast.VarBlock]) -> Constants:
    return {
        decl.name.upper(): decl.initial
        for block in blocks
        if "CONSTANT" in block.flags
        for decl in block.variables
        if decl.initial is not None
    }


def _path(e: ast.Expr | None) -> str:
    if isinstance(e, ast.Name):
        return e.name.upper()
    if isinstance(e, ast.Member):
        base = _path(e.base)
        return f"{base}.{e.name.upper()}" if base else ""
    return ""


def _inner_parts(part: ast.Declaration | ast.Accessor) -> Iterator[ast.Declaration | ast.Accessor]:
    if isinstance(part, ast.Property):
        yield from (accessor for accessor in (part.getter, part.setter) if accessor is not None)
    elif isinstance(part, (ast.Pou, ast.Interface)):
        yield from part.methods
        yield from part.properties
        if isinstance(part, ast.Pou):
            yield from part.actions


def _types_of(part: ast.Declaration | ast.Accessor) -> Iterator[ast.TypeRef]:
    """The types written in an object itself, without those of its parts."""
    if isinstance(part, (ast.Pou, ast.Accessor, ast.GlobalList)):
        yield from (decl.type_ref for block in part.blocks for decl in block.variables)
    if isinstance(part, ast.Pou) and part.return_type is not None:
        yield part.return_type
    elif isinstance(part, (ast.Property, ast.TypeDecl)) and part.type_ref is not None:
        yield part.type_ref


def _named_types(ref: ast.TypeRef) -> Iterator[ast.NamedType]:
    if isinstance(ref, ast.NamedType):
        yield ref
    elif isinstance(ref, ast.ArrayType):
        yield from _named_types(ref.element)
    elif isinstance(ref, (ast.PointerType, ast.ReferenceType)):
        yield from _named_types(ref.base)
    elif isinstance(ref, ast.StructType):
        for member in ref.members:
            yield from _named_types(member.type_ref)


def copied(node: Any) -> Any:
    """A tree as the parser made it: without what analysis has filled in."""
    return _copied(node, {})


def _copied(value: Any, known: dict[int, Any]) -> Any:
    if isinstance(value, list):
        return [_copied(item, known) for item in value]
    if isinstance(value, tuple) and type(value) is tuple:
        return tuple(_copied(item, known) for item in value)
    if isinstance(value, set):
        return set(value)
    if not isinstance(value, ast.Node):
        return value
    made = known.get(id(value))
    if made is None:
        made = known[id(value)] = object.__new__(type(value))
        filled = resolved_fields(type(value))
        for item in fields(value):
            resolved = item.name in filled
            if resolved and item.default is not MISSING:
                setattr(made, item.name, item.default)
            elif resolved and item.default_factory is not MISSING:
                setattr(made, item.name, item.default_factory())
            else:
                setattr(made, item.name, _copied(getattr(value, item.name), known))
    return made
