"""What a library offers: its POUs, types and parameter lists, read off the sources.

An item has pins, types, defaults and comments, in the shape of the specification's catalogs.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.parameter_lists import ATTRIBUTE, is_parameter_list, parameters
from tappet.lang.parser import parse
from tappet.lang.source import Source, text_at

if TYPE_CHECKING:
    from tappet.libraries.library import Library

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
    """function, function_block, program, struct, union, enum, alias, interface or parameter_list."""
    summary: str
    inputs: tuple[Pin, ...] = ()
    outputs: tuple[Pin, ...] = ()
    in_out: tuple[Pin, ...] = ()
    members: tuple[Pin, ...] = ()
    values: tuple[NamedValue, ...] = ()
    returns: str | None = None
    methods: tuple[Item, ...] = field(default=())


def items(library: Library) -> list[Item]:
    """Everything the library offers, by name; what is INTERNAL in it is no business of others."""
    found: list[Item] = []
    units = [(source, parse(source).unit) for source in library.sources]
    bases = {
        pou.name.upper(): (source, pou)
        for source, unit in units
        for pou in unit.declarations
        if isinstance(pou, ast.Pou) and pou.access == "INTERNAL"
    }
    for source, unit in units:
        found += parameter_lists(source)
        for declaration in unit.declarations:
            if declaration.access == "INTERNAL":
                continue
            if isinstance(declaration, ast.Pou):
                found.append(_with_hidden_bases(_pou(source, declaration), declaration, bases))
            elif isinstance(declaration, ast.TypeDecl):
                found.append(_type(source, declaration))
            elif isinstance(declaration, ast.Interface):
                methods = tuple(_pou(source, method) for method in declaration.methods)
                found.append(Item(declaration.name, "interface", declaration.comment, methods=methods))
    return sorted(found, key=lambda item: item.name.upper())


def parameter_lists(source: Source) -> list[Item]:
    """The parameter lists in a text of a library, with the values of the library as defaults."""
    if ATTRIBUTE not in source.text.lower():
        return []
    return [
        Item(
            declaration.name,
            "parameter_list",
            declaration.comment,
            members=tuple(_pin(source, parameter) for parameter in parameters(declaration)),
        )
        for declaration in parse(source).unit.declarations
        if isinstance(declaration, ast.GlobalList) and is_parameter_list(declaration)
    ]


def _with_hidden_bases(item: Item, pou: ast.Pou, bases: dict[str, tuple[Source, ast.Pou]]) -> Item:
    """The item with the pins that it has from INTERNAL base blocks, which are listed nowhere else."""
    left = dict(bases)
    while pou.extends and pou.extends.upper() in left:
        source, pou = left.pop(pou.extends.upper())
        base = _pou(source, pou)
        item = replace(
            item,
            inputs=base.inputs + item.inputs,
            outputs=base.outputs + item.outputs,
            in_out=base.in_out + item.in_out,
        )
    return item


def _pou(source: Source, pou: ast.Pou) -> Item:
    return Item(
        name=pou.name,
        kind=KINDS.get(pou.kind, pou.kind.lower()),
        summary=pou.comment,
        inputs=_pins(source, pou, "VAR_INPUT"),
        outputs=_pins(source, pou, "VAR_OUTPUT"),
        in_out=_pins(source, pou, "VAR_IN_OUT"),
        returns=text_at(source, pou.return_type.span) if pou.return_type else None,
        methods=tuple(_pou(source, method) for method in pou.methods),
    )


def _pins(source: Source, pou: ast.Pou, section: str) -> tuple[Pin, ...]:
    return tuple(_pin(source, v) for block in pou.blocks if block.section == section for v in block.variables)


def _pin(source: Source, variable: ast.VarDecl) -> Pin:
    default = text_at(source, variable.initial.span) if variable.initial else ""
    return Pin(variable.name, text_at(source, variable.type_ref.span), default, variable.comment)


def _type(source: Source, declaration: ast.TypeDecl) -> Item:
    reference = declaration.type_ref
    if isinstance(reference, ast.StructType):
        kind = "union" if reference.union else "struct"
        members = tuple(_pin(source, member) for member in reference.members)
        return Item(declaration.name, kind, declaration.comment, members=members)
    if isinstance(reference, ast.EnumType):
        values = tuple(
            NamedValue(value.name, text_at(source, value.value.span) if value.value else "", value.comment)
            for value in reference.values
        )
        return Item(declaration.name, "enum", declaration.comment, values=values, returns=reference.base)
    return Item(declaration.name, "alias", declaration.comment, returns=text_at(source, reference.span))
