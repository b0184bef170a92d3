"""What a library offers: its POUs and types with pins, types, defaults and comments, read off the sources.

The shape of an item is that of the specification's catalogs.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Source, Span
from tappet.libraries import Library

KINDS = {"PROGRAM": "program", "FUNCTION": "function", "FUNCTION_BLOCK": "function_block", "METHOD": "method"}


@dataclass(frozen=True, slots=True)
class Pin:
    """A parameter of a POU, or a member of a structure."""

    name: str
    type: str
    default: str
    comment: str


@dataclass(frozen=True, slots=True)
class NamedValue:
    """A value of an enumeration; `value` is empty where it counts on from the one before."""

    name: str
    value: str
    comment: str


@dataclass(frozen=True, slots=True)
class Item:
    """A POU or a type of a library."""

    name: str
    kind: str
    """function, function_block, program, struct, union, enum, alias or interface."""
    summary: str
    inputs: tuple[Pin, ...] = ()
    outputs: tuple[Pin, ...] = ()
    in_out: tuple[Pin, ...] = ()
    members: tuple[Pin, ...] = ()
    values: tuple[NamedValue, ...] = ()
    returns: str | None = None
    methods: tuple[Item, ...] = field(default=())


def items(library: Library) -> list[Item]:
    """Everything the library declares, by name."""
    found: list[Item] = []
    for source in library.sources:
        for declaration in parse(source).unit.declarations:
            if isinstance(declaration, ast.Pou):
                found.append(_pou(source, declaration))
            elif isinstance(declaration, ast.TypeDecl):
                found.append(_type(source, declaration))
            elif isinstance(declaration, ast.Interface):
                methods = tuple(_pou(source, method) for method in declaration.methods)
                found.append(Item(declaration.name, "interface", declaration.comment, methods=methods))
    return sorted(found, key=lambda item: item.name.upper())


def _pou(source: Source, pou: ast.Pou) -> Item:
    return Item(
        name=pou.name,
        kind=KINDS.get(pou.kind, pou.kind.lower()),
        summary=pou.comment,
        inputs=_pins(source, pou, "VAR_INPUT"),
        outputs=_pins(source, pou, "VAR_OUTPUT"),
        in_out=_pins(source, pou, "VAR_IN_OUT"),
        returns=text_of(source, pou.return_type.span) if pou.return_type else None,
        methods=tuple(_pou(source, method) for method in pou.methods),
    )


def _pins(source: Source, pou: ast.Pou, section: str) -> tuple[Pin, ...]:
    return tuple(_pin(source, v) for block in pou.blocks if block.section == section for v in block.variables)


def _pin(source: Source, variable: ast.VarDecl) -> Pin:
    default = text_of(source, variable.initial.span) if variable.initial else ""
    return Pin(variable.name, text_of(source, variable.type_ref.span), default, variable.comment)


def _type(source: Source, declaration: ast.TypeDecl) -> Item:
    reference = declaration.type_ref
    if isinstance(reference, ast.StructType):
        kind = "union" if reference.union else "struct"
        members = tuple(_pin(source, member) for member in reference.members)
        return Item(declaration.name, kind, declaration.comment, members=members)
    if isinstance(reference, ast.EnumType):
        values = tuple(
            NamedValue(value.name, text_of(source, value.value.span) if value.value else "", value.comment)
            for value in reference.values
        )
        return Item(declaration.name, "enum", declaration.comment, values=values, returns=reference.base)
    return Item(declaration.name, "alias", declaration.comment, returns=text_of(source, reference.span))


def text_of(source: Source, span: Span) -> str:
    """The text of a span on one line, with single spaces."""
    lines = source.text.split("\n")[span.line : span.end_line + 1]
    if not lines:
        return ""
    lines[-1] = lines[-1][: span.end_column]
    lines[0] = lines[0][span.column :]
    return " ".join(" ".join(lines).split())
