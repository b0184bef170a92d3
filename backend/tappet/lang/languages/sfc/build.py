"""Small pieces of tree for what a chart becomes; names that no text holds stand nowhere."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.source import NOWHERE, Span


def name(text: str, span: Span = NOWHERE) -> ast.Expr:
    """A variable, or members of it joined by dots; `span` is the place of the first name."""
    first, *rest = text.split(".")
    found: ast.Expr = ast.Name(name=first, span=span)
    for part in rest:
        found = ast.Member(base=found, name=part)
    return found


def literal(content: str) -> ast.Literal:
    """A STRING literal."""
    return ast.Literal(text=f"'{content}'", kind="string", value=content.encode("latin-1", "replace"))


def number(value: int) -> ast.Expr:
    """An integer literal."""
    return ast.Literal(text=str(value), kind="int", value=value)


def flag(value: bool) -> ast.Expr:
    """TRUE or FALSE."""
    return ast.Literal(text="TRUE" if value else "FALSE", kind="bool", value=value)


def put(target: str, value: ast.Expr | bool | str, span: Span, at: Span = NOWHERE) -> ast.Stmt:
    """`target := value;`; a str names a variable, `at` is the place of the target's name."""
    if isinstance(value, bool):
        value = flag(value)
    elif isinstance(value, str):
        value = name(value)
    return ast.Assign(op=":=", target=name(target, at), value=value, span=span)


def both(*conditions: ast.Expr) -> ast.Expr:
    """All of the conditions; the later ones are evaluated only where the earlier ones hold."""
    found = conditions[0]
    for condition in conditions[1:]:
        found = ast.Binary(op="AND_THEN", left=found, right=condition)
    return found


def negated(condition: ast.Expr) -> ast.Expr:
    """NOT condition."""
    return ast.Unary(op="NOT", operand=condition)


def when(condition: ast.Expr | str, body: list[ast.Stmt], span: Span) -> ast.Stmt:
    """`IF condition THEN body END_IF`."""
    test = name(condition) if isinstance(condition, str) else condition
    return ast.If(branches=[(test, body)], span=span)


def call(callee: str, span: Span, at: Span = NOWHERE, **inputs: str | bool) -> ast.Stmt:
    """`callee(input := value, ...);`"""
    args = [
        ast.Argument(name=key, value=flag(value) if isinstance(value, bool) else name(value))
        for key, value in inputs.items()
    ]
    return ast.CallStmt(call=ast.Call(callee=name(callee, at), args=args, span=span), span=span)


def declared(names: list[str], body: list[ast.Stmt], span: Span) -> ast.Stmt:
    """`body` where all of the variables are declared, nothing elsewhere."""
    return ast.WhenDeclared(names=names, body=body, otherwise=[], span=span)
