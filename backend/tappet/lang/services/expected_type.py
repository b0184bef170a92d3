"""Which type a name that is not declared should have, by the place where it is used and by its prefix."""

from __future__ import annotations

import re

from tappet.iec.words import TYPE_PREFIXES
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.scope import QualifiedSymbol
from tappet.lang.services import describe
from tappet.lang.services.fix_site import Site
from tappet.lang.services.resolution import callable_pou, resolve
from tappet.lang.symbols import PouSymbol

_PREFIX = re.compile(r"(?:g_|c_|gc_)?([a-z]+)(?=[A-Z_])")
_DEFAULT = "BOOL"
_COUNTING = "INT"


def type_for(site: Site, name: str) -> str:
    """The type as it is written in a declaration; '' for what is called like a function."""
    found = _by_place(site)
    if found:
        named = site.snapshot.analysis.scope.get(found.upper())
        return named.choice if isinstance(named, QualifiedSymbol) else found
    parent = site.path[-2] if len(site.path) > 1 else None
    if isinstance(parent, ast.Call) and parent.callee is site.path[-1]:
        return ""
    prefix = _PREFIX.match(name)
    return TYPE_PREFIXES.get(prefix[1], _DEFAULT) if prefix else _DEFAULT


def written_type(type_: t.Type | None, constant: ast.Constant = None, untyped: bool = False) -> str:
    """A type as text; '' for none. A plain number is INT, DINT or LREAL whatever its smallest type is."""
    if type_ is None:
        return ""
    if untyped and isinstance(constant, int) and not isinstance(constant, bool):
        return "INT" if -32_768 <= constant <= 32_767 else "DINT" if abs(constant) < 2**31 else "LINT"
    if isinstance(type_, t.Reference):
        type_ = type_.base
    if isinstance(type_, t.String):
        return "WSTRING" if type_.wide else "STRING"
    text = str(type_)
    return "" if text.startswith("__") else text


def _by_place(site: Site) -> str:
    """By what stands beside the name; '' when that says nothing."""
    if len(site.path) < 2:
        return ""
    own, parent = site.path[-1], site.path[-2]
    if not isinstance(own, ast.Name):
        return ""
    if isinstance(parent, (ast.Assign, ast.AssignExpr)):
        return _of(parent.value if own is parent.target else parent.target)
    if isinstance(parent, ast.Binary):
        other = parent.right if own is parent.left else parent.left
        return _of(other) or ("BOOL" if parent.op in ("AND", "OR", "XOR", "AND_THEN", "OR_ELSE") else "")
    if isinstance(parent, (ast.If, ast.While, ast.Repeat)) or (
        isinstance(parent, ast.Unary) and parent.op == "NOT"
    ):
        return "BOOL"
    if isinstance(parent, ast.For):
        return _COUNTING if own is parent.variable else _of(parent.variable) or _COUNTING
    if isinstance(parent, (ast.Case, ast.Index)):
        return _COUNTING
    if isinstance(parent, ast.Argument) and len(site.path) > 2 and isinstance(site.path[-3], ast.Call):
        return _of_parameter(site, parent, site.path[-3])
    if isinstance(parent, ast.Call) and own is parent.callee:
        return _block_with(site, parent)
    return ""


def _of(expression: ast.Expr) -> str:
    return written_type(expression.type, expression.constant, expression.untyped)


def _of_parameter(site: Site, argument: ast.Argument, call: ast.Call) -> str:
    pou = callable_pou(resolve(site.scope, call.callee))
    if pou is None:
        return ""
    pins = list(describe.pins(pou))
    if argument.name is None:
        at = call.args.index(argument)
        return written_type(pins[at].type) if at < len(pins) else ""
    named = (pin for pin in pins if argument.name is not None and pin.name.upper() == argument.name.upper())
    return next((written_type(pin.type) for pin in named), "")


def _block_with(site: Site, call: ast.Call) -> str:
    """A function block that has all the parameters a call names; one of the project first."""
    names = {item.name.upper() for item in call.args if item.name}
    if not names:
        return ""
    fitting: list[tuple[bool, int, str]] = []
    for symbol in site.snapshot.analysis.scope.values():
        block = symbol.target if isinstance(symbol, QualifiedSymbol) else symbol
        if isinstance(block, PouSymbol) and block.kind == "FUNCTION_BLOCK":
            pins = {pin.name.upper() for pin in describe.pins(block)}
            if names <= pins:
                library = block.source is not None and block.source.library is not None
                fitting.append((library, len(pins), block.name))
    return min(fitting)[2] if fitting else ""
