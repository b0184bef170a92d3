"""The sentences that the code of the product says: its string literals and f-strings that read like one."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import islice, product
from pathlib import Path
from typing import NamedTuple

import tappet

ROOT = Path(tappet.__file__).parent
PLACE = "\N{REPLACEMENT CHARACTER}"
"""Stands for a fact of a template."""
_SENTENCE = re.compile(rf"[a-z'{PLACE}>)]{{2,}},? [a-z(<'{PLACE}]")
_INSIDE = ("log", "logging", "log_limited", "Field", "re", "Query", "File", "Form", "Path", "Body", "text")
"""Functions whose texts are for the log of the server, for the API document or for the database."""
_TEXT = ast.IfExp | ast.JoinedStr | ast.Constant
_MOST = 64
"""Variants of one literal."""


class Said(NamedTuple):
    """A template, and where it stands."""

    where: str
    template: str


def templates(part: str) -> Iterator[Said]:
    """Of a file or folder of the product, given from its root."""
    path = ROOT / part
    for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
        tree = ast.parse(file.read_text("utf-8"))
        left_out = _left_out(tree)
        for function in ast.walk(tree):
            if isinstance(function, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef):
                names = _texts_by_name(function)
                left_out |= _said_elsewhere(function, names)
                for node in _own(function):
                    if id(node) not in left_out:
                        for text in _variants(node, names):
                            if _SENTENCE.search(text):
                                where = f"{file.relative_to(ROOT).as_posix()}:{getattr(node, 'lineno', 0)}"
                                yield Said(where, re.sub(f"{PLACE}+", PLACE, text))


def _own(function: ast.AST) -> Iterator[ast.expr]:
    """Expressions of a function without those of functions in it."""
    waiting = list(ast.iter_child_nodes(function))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        if isinstance(node, ast.expr):
            yield node
        waiting += ast.iter_child_nodes(node)


def _left_out(tree: ast.AST) -> set[int]:
    """Docstrings, descriptions, the parts of f-strings, names of literals in types."""
    found: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            found.add(id(node.value))
        elif isinstance(node, ast.Call):
            name = ast.unparse(node.func)
            if (
                name.partition(".")[0] in _INSIDE and name != "log.add"
            ):  # that of the runtime is read by users
                found |= {id(part) for part in ast.walk(node)}
        elif isinstance(node, ast.JoinedStr):
            found |= {id(part) for part in ast.walk(node) if part is not node}
        elif isinstance(node, ast.Subscript | ast.AnnAssign | ast.Assert | ast.arg):
            inner = (
                node.slice
                if isinstance(node, ast.Subscript)
                else (node.msg if isinstance(node, ast.Assert) else node.annotation)
            )
            found |= {id(part) for part in ast.walk(inner)} if inner is not None else set()
        elif isinstance(node, ast.keyword) and node.arg in ("description", "help", "metavar", "name"):
            found |= {id(part) for part in ast.walk(node.value)}
    return found


def _texts_by_name(function: ast.AST) -> dict[str, list[ast.expr]]:
    """What is assigned to local names."""
    found: dict[str, list[ast.expr]] = {}
    for node in ast.walk(function):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    found.setdefault(target.id, []).append(node.value)
    if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
        arguments = function.args
        for argument in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs):
            found.pop(argument.arg, None)
    return {name: given for name, given in found.items() if len(given) == 1 and isinstance(given[0], _TEXT)}


def _said_elsewhere(function: ast.AST, names: dict[str, list[ast.expr]]) -> set[int]:
    """Literals with a name that f-strings of the function have in them."""
    found: set[int] = set()
    for node in ast.walk(function):
        if isinstance(node, ast.FormattedValue) and isinstance(node.value, ast.Name):
            for given in names.get(node.value.id, ()):
                found |= {id(part) for part in ast.walk(given)}
    return found


def _variants(node: ast.expr, names: dict[str, list[ast.expr]], depth: int = 0) -> list[str]:
    """The texts that an expression can be; nothing for one that is no literal."""
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if isinstance(node, ast.IfExp):
        return [*_variants(node.body, names, depth), *_variants(node.orelse, names, depth)]
    if isinstance(node, ast.JoinedStr):
        parts = [_part(value, names, depth) for value in node.values]
        return ["".join(chosen) for chosen in islice(product(*parts), _MOST)]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        sides = [_variants(side, names, depth) or [PLACE] for side in (node.left, node.right)]
        if sides != [[PLACE], [PLACE]]:
            return ["".join(chosen) for chosen in islice(product(*sides), _MOST)]
    return []


def _part(value: ast.expr, names: dict[str, list[ast.expr]], depth: int) -> list[str]:
    if isinstance(value, ast.Constant):
        return [str(value.value)]
    assert isinstance(value, ast.FormattedValue)
    inner = value.value
    if isinstance(inner, ast.BoolOp) and isinstance(inner.op, ast.Or):
        return [found for side in inner.values for found in _side(side, names, depth)]
    if isinstance(inner, ast.IfExp):
        return [found or "" for side in (inner.body, inner.orelse) for found in _side(side, names, depth)]
    if isinstance(inner, ast.Name) and depth < 3:
        for given in names.get(inner.id, ()):
            return _variants(given, names, depth + 1) or [PLACE]
    return [PLACE]


def _side(side: ast.expr, names: dict[str, list[ast.expr]], depth: int) -> list[str]:
    return _variants(side, names, depth + 1) or [PLACE]


def texts(part: str) -> set[str]:
    """All string literals of a file or folder, also those that are no sentences."""
    path = ROOT / part
    return {
        node.value
        for file in (path.rglob("*.py") if path.is_dir() else [path])
        for node in ast.walk(ast.parse(file.read_text("utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
