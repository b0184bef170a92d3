"""Ways through a tree: the expressions below one, the statements inside one, in the order of the text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from tappet.lang import ast
from tappet.lang.ast.fields import source_fields

_Children = Callable[[Any], Iterable[ast.Expr | None]]
_CHILDREN: dict[type, _Children] = {
    ast.Member: lambda e: (e.base,),
    ast.Index: lambda e: (e.base, *e.indices),
    ast.Deref: lambda e: (e.base,),
    ast.Unary: lambda e: (e.operand,),
    ast.Binary: lambda e: (e.left, e.right),
    ast.Call: lambda e: (e.callee, *(a.value for a in e.args)),
    ast.ArrayInit: lambda e: e.elements,
    ast.Repeat: lambda e: (e.count, *e.values),
    ast.StructInit: lambda e: (a.value for a in e.fields),
    ast.AssignExpr: lambda e: (e.value, e.target),
}
_OWN: dict[type, _Children] = {
    ast.Assign: lambda s: (s.value, s.target),
    ast.CallStmt: lambda s: (s.call,),
    ast.ExprStmt: lambda s: (s.call or s.expr,),
    ast.If: lambda s: (condition for condition, _ in s.branches),
    ast.Case: lambda s: (s.selector,),
    ast.For: lambda s: (s.start, s.stop, s.step, s.variable),
    ast.While: lambda s: (s.condition,),
    ast.RepeatUntil: lambda s: (s.condition,),
    ast.Hold: lambda s: (s.value,),
    ast.Try: lambda s: (s.exception,),
}
_BODIES: dict[type, Callable[[Any], list[list[ast.Stmt]]]] = {
    ast.If: lambda s: [body for _, body in s.branches] + ([s.otherwise] if s.otherwise else []),
    ast.Case: lambda s: [branch.body for branch in s.branches] + ([s.otherwise] if s.otherwise else []),
    ast.For: lambda s: [s.body],
    ast.While: lambda s: [s.body],
    ast.RepeatUntil: lambda s: [s.body],
    ast.Try: lambda s: [s.body, s.handler, s.final],
}


def expressions(*roots: ast.Expr | None) -> Iterator[ast.Expr]:
    """The expressions and all below them, outer ones first."""
    todo = [root for root in reversed(roots) if root is not None]
    while todo:
        e = todo.pop()
        yield e
        children = _CHILDREN.get(e.__class__)
        if children is not None:
            todo += [child for child in reversed(list(children(e))) if child is not None]


def own_expressions(s: ast.Stmt) -> Iterator[ast.Expr]:
    """The expressions of a statement and all below them, without those of the statements inside it."""
    own = _OWN.get(s.__class__)
    if own is not None:
        yield from expressions(*own(s))


def bodies(s: ast.Stmt) -> list[list[ast.Stmt]]:
    """The lists of statements directly inside a statement."""
    found = _BODIES.get(s.__class__)
    return found(s) if found is not None else []


def statements(body: Iterable[ast.Stmt]) -> Iterator[ast.Stmt]:
    """The statements of a list and all inside them, in the order of the text."""
    for s in body:
        yield s
        found = _BODIES.get(s.__class__)
        if found is not None:
            for inner in found(s):
                yield from statements(inner)


def all_expressions(body: Iterable[ast.Stmt]) -> Iterator[ast.Expr]:
    """Every expression of a list of statements, those of the statements inside them included."""
    for s in statements(body):
        yield from own_expressions(s)


def root(e: ast.Expr) -> ast.Expr:
    """The variable a place begins with: `a` of `a.b[3].c`; what a pointer points to begins at the `^`."""
    while e.__class__ is ast.Member or (e.__class__ is ast.Index and not _through_pointer(e)):
        e = e.base
    return e


def _through_pointer(e: Any) -> bool:
    return e.base.type is not None and e.base.type.__class__.__name__ == "Pointer"


def targets(s: ast.Stmt) -> Iterator[ast.Expr]:
    """What a statement may write by assignment, output, VAR_IN_OUT, or call of an instance."""
    if isinstance(s, (ast.Assign, ast.For)):
        yield s.target if isinstance(s, ast.Assign) else s.variable
    for e in own_expressions(s):
        if isinstance(e, ast.AssignExpr):
            yield e.target
        elif isinstance(e, ast.Call):
            yield e.callee
            for arg in e.args:
                section = getattr(arg.parameter, "section", "VAR_IN_OUT")
                if arg.value is not None and section != "VAR_INPUT":
                    yield arg.value


def same(one: object, other: object) -> bool:
    """Whether two expressions or statements say the same, places left out; False for very long ones."""
    try:
        return _same(one, other)
    except RecursionError:
        return False


def _same(one: object, other: object) -> bool:
    if one.__class__ is not other.__class__:
        return False
    if isinstance(one, list):
        assert isinstance(other, list)
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, tuple):
        assert isinstance(other, tuple)
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, ast.Node):
        for name in source_fields(one.__class__):
            mine, its = getattr(one, name), getattr(other, name)
            if name == "name" and isinstance(mine, str) and isinstance(its, str):
                if mine.upper() != its.upper():
                    return False
            elif not _same(mine, its):
                return False
        return True
    return one == other


def variables(unit: ast.Unit) -> Iterator[ast.VarDecl]:
    """Every variable, parameter and member of a text, in order; methods, actions and accessors included."""
    for declaration in unit.declarations:
        yield from _variables_of(declaration)


def _variables_of(declaration: ast.Declaration) -> Iterator[ast.VarDecl]:
    if isinstance(declaration, ast.TypeDecl):
        if isinstance(declaration.type_ref, ast.StructType):
            yield from declaration.type_ref.members
        return
    if isinstance(declaration, ast.Property):
        for accessor in (declaration.getter, declaration.setter):
            if accessor is not None:
                yield from _in_blocks(accessor.blocks)
        return
    if isinstance(declaration, (ast.Pou, ast.GlobalList)):
        yield from _in_blocks(declaration.blocks)
    if isinstance(declaration, (ast.Pou, ast.Interface)):
        parts = [*declaration.methods, *declaration.properties]
        for part in [*parts, *declaration.actions] if isinstance(declaration, ast.Pou) else parts:
            yield from _variables_of(part)


def _in_blocks(blocks: list[ast.VarBlock]) -> Iterator[ast.VarDecl]:
    for block in blocks:
        yield from block.variables
