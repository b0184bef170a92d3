"""Parameter lists of libraries: constants that a reference to the library may give other values.

A parameter list is a global variable list with `{attribute 'parameter_list'}`. The values that a reference
gives travel with the text of the list (`Source.given`); here they take the place of its initial values, so
that everything behind the parser knows no others.
"""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.attributes import attribute
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.lexer import END, lex
from tappet.lang.parser_declarations import Parser
from tappet.lang.source import NOWHERE, GivenValue, Source, text_at

ATTRIBUTE = "parameter_list"
_SHOWN = 80
"""Characters of a value in a message."""


def is_parameter_list(declaration: ast.GlobalList) -> bool:
    """Whether a global variable list is one of parameters."""
    pragmas = [*declaration.attributes, *(p for block in declaration.blocks for p in block.attributes)]
    return attribute(pragmas, ATTRIBUTE) is not None


def parameters(declaration: ast.GlobalList) -> Iterator[ast.VarDecl]:
    """The constants of a parameter list."""
    for block in declaration.blocks:
        if block.section == "VAR_GLOBAL" and "CONSTANT" in block.flags:
            yield from block.variables


def take_given_values(unit: ast.Unit) -> list[Diagnostic]:
    """Puts the values that a library reference gives in place of the initial values; what is no value."""
    if not unit.source.given:
        return []
    given = {item.name.upper(): item for item in unit.source.given}
    found: list[Diagnostic] = []
    for declaration in unit.declarations:
        if isinstance(declaration, ast.GlobalList) and is_parameter_list(declaration):
            for variable in parameters(declaration):
                item = given.get(variable.name.upper())
                if item is not None:
                    found += _take(variable, declaration, unit.source, item)
    return found


def _take(
    variable: ast.VarDecl, declaration: ast.GlobalList, source: Source, item: GivenValue
) -> list[Diagnostic]:
    lexed = lex(item.value, item.place)
    parser = Parser(Source(item.place, item.value), lexed)
    value = parser.bounded(parser.initial_value_of(variable.type_ref), 0)
    if parser.kinds[parser.i] is not END:
        parser.expected("The end of the value", "Remove the rest.")
    faults = lexed.diagnostics + parser.diagnostics
    if faults:  # the value of the library stays, so that nothing else is reported
        type_ = text_at(source, variable.type_ref.span)
        return [reported_at_reference("E0904", source, declaration.name, item, type_, faults[0].message)]
    variable.given, variable.own_initial = item, variable.initial
    variable.initial, variable.initial_ref = value, False
    return []


def reported_at_reference(
    code: str, source: Source, list_name: str, item: GivenValue, type_: object, reason: str
) -> Diagnostic:
    """A message about the value of a parameter, at the reference that gives it."""
    about = {"library": source.library or "", "list": list_name, "name": item.name, "type": type_}
    value = item.value if len(item.value) <= _SHOWN else f"{item.value[:_SHOWN]}..."
    return report(code, item.place, NOWHERE, **about, value=value, reason=reason)
