"""What a chain such as `a.b[1]^` means at a place, and which names can follow.

Works on the symbols of an analysis without running one: the expression is being typed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast, symbols
from tappet.lang import types as t
from tappet.lang.analysis.builtins import OPERATORS
from tappet.lang.attributes import attribute
from tappet.lang.services.documents import Position
from tappet.lang.services.workspace import Snapshot, View
from tappet.lang.source import Source, Span

_INSIDE_ONLY = frozenset({"VAR_IN_OUT", "VAR_TEMP", "VAR_STAT", "VAR_EXTERNAL"})
_LOCAL = frozenset({"VAR", "VAR_TEMP", "VAR_STAT", "VAR_INST"})


@dataclass(frozen=True, slots=True)
class Meaning:
    """What an expression denotes: a symbol, a value of a type, or both."""

    symbol: symbols.Symbol | None = None
    type: t.Type | None = None


@dataclass(slots=True)
class Scope:
    """The names seen at a place."""

    snapshot: Snapshot
    pou: symbols.PouSymbol | None
    """The POU, method, action or accessor around it."""
    locals: dict[str, symbols.Symbol] = field(default_factory=dict)

    @property
    def block(self) -> symbols.PouSymbol | None:
        """The function block or program around it."""
        if self.pou is None:
            return None
        return self.pou.owner or (self.pou if self.pou.instance is not None else None)

    def lookup(self, name: str) -> symbols.Symbol | None:
        """What a plain name means."""
        key = name.upper()
        found = self.locals.get(key)
        if found is None:
            members = block_members(self.block)
            found = members.get(key)
        return found or self.snapshot.analysis.scope.get(key)


def scope_at(view: View) -> Scope:
    """The names seen at the position of a view."""
    name = _pou_name(view.unit, view.position, view.source)
    pou = view.snapshot.pous.get(name.upper()) if name else None
    local: dict[str, symbols.Symbol] = {}
    if pou is not None:
        if pou.owner is not None:
            local.update(pou.owner.locals)
        local.update(pou.locals)
    return Scope(view.snapshot, pou, local)


def _pou_name(unit: ast.Unit, position: Position, source: Source) -> str:
    """`POU` or `POU.METHOD` around a position."""
    for declaration in unit.declarations:
        if not _contains(declaration.span, position, declaration is unit.declarations[-1]):
            continue
        if isinstance(declaration, ast.Pou):
            prefix = f"{source.owner}." if source.owner else ""
            for child in (*declaration.methods, *declaration.actions):
                if _contains(child.span, position, False):
                    return f"{declaration.name}.{child.name}"
            for property_ in declaration.properties:
                name = _accessor_name(property_, position)
                if name:
                    return f"{declaration.name}.{name}"
            return prefix + declaration.name
        if isinstance(declaration, ast.Property) and source.owner:
            name = _accessor_name(declaration, position)
            return f"{source.owner}.{name}" if name else source.owner
    return ""


def _accessor_name(property_: ast.Property, position: Position) -> str:
    for accessor, prefix in ((property_.getter, "__get"), (property_.setter, "__set")):
        if accessor is not None and _contains(accessor.span, position, False):
            return f"{prefix}{property_.name}"
    return ""


def _contains(span: Span, position: Position, last: bool) -> bool:
    return (span.line, span.column) <= position and (last or position <= (span.end_line, span.end_column))


def block_members(block: symbols.PouSymbol | None) -> dict[str, symbols.Symbol]:
    """Methods, actions and properties of a block and its bases, by upper-case name."""
    found: dict[str, symbols.Symbol] = {}
    seen: set[int] = set()
    while block is not None and id(block) not in seen:
        seen.add(id(block))
        for table in (block.methods, block.actions, block.properties):
            for key, symbol in table.items():
                found.setdefault(key, symbol)
        block = block.base
    return found


def block_of(type_: t.Type | None) -> symbols.PouSymbol | None:
    """The POU of an instance type."""
    if isinstance(type_, t.FunctionBlock) and type_.pou is not None:
        symbol = type_.pou.symbol
        return symbol if isinstance(symbol, symbols.PouSymbol) else None
    return None


def interface_of(type_: t.Type | None) -> symbols.InterfaceSymbol | None:
    """The interface of an interface type."""
    if isinstance(type_, t.Interface) and type_.pou is not None:
        symbol = type_.pou.symbol
        return symbol if isinstance(symbol, symbols.InterfaceSymbol) else None
    return None


def type_of(symbol: symbols.Symbol | None) -> t.Type | None:
    """The type of the value a symbol denotes."""
    type_: t.Type | None = None
    if isinstance(symbol, (symbols.VarSymbol, symbols.EnumValueSymbol, symbols.PropertySymbol)):
        type_ = symbol.type
    elif isinstance(symbol, symbols.PouSymbol) and symbol.kind == "PROGRAM":
        type_ = symbol.instance
    return type_.base if isinstance(type_, t.Reference) else type_


def resolve(scope: Scope, expression: ast.Expr | None) -> Meaning:
    """What an expression denotes; an empty meaning if it is unknown."""
    if isinstance(expression, ast.Name):
        symbol = (
            scope.snapshot.analysis.scope.get(expression.name.upper())
            if expression.leading_dot
            else scope.lookup(expression.name)
        )
        return Meaning(symbol, type_of(symbol))
    if isinstance(expression, ast.Member):
        member = members(resolve(scope, expression.base)).get(expression.name.upper())
        return Meaning(member, type_of(member))
    if isinstance(expression, ast.Index):
        base = resolve(scope, expression.base).type
        if isinstance(base, t.Array):
            return Meaning(None, base.element)
        if isinstance(base, t.Pointer):
            return Meaning(None, base.base)
        return Meaning(None, t.WORD if isinstance(base, t.String) and base.wide else t.BYTE)
    if isinstance(expression, ast.Deref):
        if isinstance(expression.base, (ast.This, ast.Super)):
            block = scope.block
            if isinstance(expression.base, ast.Super) and block is not None:
                block = block.base
            return Meaning(None, block.instance if block is not None else None)
        base = resolve(scope, expression.base).type
        return Meaning(None, base.base if isinstance(base, t.Pointer) else None)
    if isinstance(expression, ast.Call):
        callee = resolve(scope, expression.callee).symbol
        if isinstance(callee, symbols.PouSymbol):
            result = callee.return_type
            return Meaning(None, result.base if isinstance(result, t.Reference) else result)
        return Meaning()
    if isinstance(expression, ast.Literal):
        return Meaning(None, expression.type)
    return Meaning()


def members(meaning: Meaning) -> dict[str, symbols.Symbol]:
    """What can follow a dot, by upper-case name, in order of declaration."""
    symbol = meaning.symbol
    if isinstance(symbol, (symbols.NamespaceSymbol, symbols.GvlSymbol)):
        return dict(symbol.members)
    if isinstance(symbol, symbols.TypeSymbol):
        return enum_values(symbol.type) if isinstance(symbol.type, t.Enum) else {}
    if isinstance(symbol, symbols.PouSymbol) and symbol.kind not in ("PROGRAM", "FUNCTION_BLOCK"):
        return {}
    type_ = meaning.type.base if isinstance(meaning.type, t.Reference) else meaning.type
    if isinstance(type_, t.Struct):
        return {
            key: member.decl.symbol
            if member.decl is not None and member.decl.symbol is not None
            else _plain(member)
            for key, member in type_.members.items()
        }
    block = block_of(type_)
    if block is not None:
        found: dict[str, symbols.Symbol] = {
            key: variable
            for key, variable in block.locals.items()
            if variable.section not in _INSIDE_ONLY and variable.section != "RESULT"
        }
        return found | block_members(block)
    interface = interface_of(type_)
    if interface is not None:
        heads: dict[str, symbols.Symbol] = {
            k: m for k, m in interface.methods.items() if not k.startswith("__")
        }
        return heads | dict(interface.properties)
    return {}


def _plain(member: t.Member) -> symbols.VarSymbol:
    return symbols.VarSymbol(member.name, type=member.type, section=member.section, decl=member.decl)


def enum_values(type_: t.Enum) -> dict[str, symbols.Symbol]:
    """The values of an enumeration."""
    decl = type_.decl
    found: dict[str, symbols.Symbol] = {}
    comments: dict[str, tuple[str, Span]] = {}
    source = decl.source if decl is not None else None
    if decl is not None and isinstance(decl.type_ref, ast.EnumType):
        comments = {value.name.upper(): (value.comment, value.span) for value in decl.type_ref.values}
    for name, number in type_.values.items():
        comment, span = comments.get(name.upper(), ("", None))
        found[name.upper()] = symbols.EnumValueSymbol(name, source, span, comment, type=type_, number=number)
    return found


def is_hidden(symbol: symbols.Symbol) -> bool:
    """Whether an attribute keeps a symbol out of lists (LPRG-24, LPRG-25)."""
    if symbol.name.startswith("__"):
        return True
    if isinstance(symbol, symbols.VarSymbol):
        return symbol.decl is not None and attribute(symbol.decl.attributes, "hide") is not None
    if isinstance(symbol, symbols.PouSymbol) and symbol.pou is not None:
        return attribute(symbol.pou.attributes, "hide") is not None
    return False


def hides_locals(block: symbols.PouSymbol | None) -> bool:
    """Whether the block has the attribute 'hide_all_locals'."""
    return (
        block is not None
        and block.pou is not None
        and attribute(block.pou.attributes, "hide_all_locals") is not None
    )


def is_local(symbol: symbols.Symbol) -> bool:
    """Whether a member is neither input nor output of its block."""
    return isinstance(symbol, symbols.VarSymbol) and symbol.section in _LOCAL


def callable_pou(meaning: Meaning) -> symbols.PouSymbol | None:
    """The POU that a call of something reaches."""
    if isinstance(meaning.symbol, symbols.PouSymbol):
        return meaning.symbol
    return block_of(meaning.type)


def is_operator(name: str) -> bool:
    """Whether a name is an operator known without a library."""
    return name.upper() in OPERATORS
