"""The identifiers of a text: all that its declarations and bodies can name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from tappet.iec.identifiers import identifiers
from tappet.iec.tokens import NAME, code_of
from tappet.lang import ast
from tappet.lang.source import Source, Span, split_lines
from tappet.lang.walk import variables


@dataclass(slots=True)
class Identifiers:
    """Upper-case identifiers of one text, comments and strings included."""

    unit: ast.Unit
    all: frozenset[str]
    declared: frozenset[str]
    """Of its declarations alone, where they can be separated from the bodies."""
    global_names: frozenset[str] = field(default_factory=frozenset)
    """What the text makes known to other texts by plain name: objects, global variables, enumeration
    values."""
    plain_types: frozenset[str] = field(default_factory=frozenset)
    """Names that its declarations hold as types of variables without initial value and nowhere else: of what
    they denote, such variables need no more than the size."""


def identifiers_of(unit: ast.Unit) -> Identifiers:
    """The identifiers of the text of a unit."""
    text = unit.source.text
    every = frozenset(identifiers(text))
    head = _head(unit)
    declared = every if head is None else frozenset(identifiers(head))
    names = frozenset(name.upper() for name in _global_names(unit))
    return Identifiers(unit, every, declared, names, _plain_types(unit, text if head is None else head))


def _plain_types(unit: ast.Unit, text: str) -> frozenset[str]:
    found = Counter(name.upper() for name in _types_of_variables(unit))
    every = Counter(NAME.findall(code_of(text).upper()))
    return frozenset(name for name, count in found.items() if every[name] == count)


def _types_of_variables(unit: ast.Unit) -> Iterator[str]:
    """The names of the types of variables that have no more than a type; one of `a, b : T`."""
    seen: set[Span] = set()
    for decl in variables(unit):
        if decl.initial is not None or decl.address is not None:
            continue
        ref = decl.type_ref
        while isinstance(ref, (ast.ArrayType, ast.PointerType, ast.ReferenceType)):
            ref = ref.element if isinstance(ref, ast.ArrayType) else ref.base
        if isinstance(ref, ast.NamedType) and ref.args is None and not ref.elements and ref.span not in seen:
            seen.add(ref.span)
            yield ref.name


def _head(unit: ast.Unit) -> str | None:
    """The text above the only body; None where bodies and declarations mix."""
    source: Source = unit.source
    if len(unit.declarations) != 1 or not isinstance(unit.declarations[0], ast.Pou):
        return None
    pou = unit.declarations[0]
    if pou.methods or pou.actions or pou.properties:
        return None
    if source.body_line:
        return "\n".join(split_lines(source.text)[: source.body_line])
    end = source.text.upper().rfind("END_VAR")
    return source.text[:end] if end >= 0 else None


def _global_names(unit: ast.Unit) -> Iterator[str]:
    for declaration in unit.declarations:
        if unit.source.owner is None:
            yield declaration.name
        if isinstance(declaration, ast.GlobalList):
            for block in declaration.blocks:
                for decl in block.variables:
                    yield decl.name
                    yield from _values(decl.type_ref)
        elif isinstance(declaration, ast.TypeDecl):
            yield from _values(declaration.type_ref)
        elif isinstance(declaration, ast.Pou):
            yield from _local_values(declaration)
            for child in (*declaration.methods, *declaration.actions):
                yield from _local_values(child)
            for property_ in declaration.properties:
                yield from _accessor_values(property_)
        elif isinstance(declaration, ast.Property):
            yield from _accessor_values(declaration)
        elif isinstance(declaration, ast.Interface):
            for head in declaration.methods:
                yield from _local_values(head)


def _local_values(pou: ast.Pou | ast.Accessor) -> Iterator[str]:
    for block in pou.blocks:
        for decl in block.variables:
            yield from _values(decl.type_ref)


def _accessor_values(property_: ast.Property) -> Iterator[str]:
    for accessor in (property_.getter, property_.setter):
        if accessor is not None:
            yield from _local_values(accessor)


def _values(ref: ast.TypeRef) -> Iterator[str]:
    """Values of an enumeration that a type reference declares."""
    while isinstance(ref, ast.ArrayType):
        ref = ref.element
    if isinstance(ref, ast.EnumType):
        for value in ref.values:
            yield value.name
    elif isinstance(ref, ast.StructType):
        for member in ref.members:
            yield from _values(member.type_ref)
