"""The descriptors of the kinds of objects, and that nothing else lists kinds."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import tappet
from tappet.project.data import CodeData
from tappet.project.kind_registry import kinds
from tappet.project.object_kind import DEVICES_VIEW, POUS_VIEW, IecText, ObjectKind

PACKAGE = Path(tappet.__file__).parent
OTHER_WORDS = {
    "lang": "kinds of declarations, pragmas and types",
    "codegen": "kinds of types and of roots of the symbol map",
    "core": "kinds of types",
    "libraries/catalog.py": "kinds of items of the catalogue",
    "runtime": "kinds of types and of events",
    "iec/sections.py": "keywords of declarations",
    "project/exchange/declaration_sections.py": "qualifiers of sections of variables",
    "project/exchange/plcopen_declarations.py": "qualifiers of sections of variables",
    "project/store/migrations": "columns of the database",
    "project/store/tables.py": "columns of the database",
    "server/auth/tables.py": "columns of the database",
    "manual/words.py": "headings of pages",
    "cli/bench.py": "benchmarks",
}
"""Where the same words mean something else than a kind of object, and what."""


def listed(tree: ast.AST, names: frozenset[str]) -> Iterator[tuple[int, set[str]]]:
    """The collections that hold two kinds or more as texts, with their lines."""
    for node in ast.walk(tree):
        if isinstance(node, ast.List | ast.Tuple | ast.Set):
            members: list[ast.expr | None] = [*node.elts]
        elif isinstance(node, ast.Dict):
            members = [*node.keys, *node.values]
        else:
            continue
        found = {m.value for m in members if isinstance(m, ast.Constant) and isinstance(m.value, str)}
        if len(found & names) > 1:
            yield node.lineno, found & names


def test_no_other_file_lists_kinds() -> None:
    names = frozenset(kinds())
    faults = []
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE).as_posix()
        if place.startswith("project/kinds/") or any(place.startswith(other) for other in OTHER_WORDS):
            continue
        for line, found in listed(ast.parse(path.read_text(encoding="utf-8")), names):
            faults.append(f"{place}:{line} lists {', '.join(sorted(found))}")
    assert faults == []


def test_the_search_finds_lists() -> None:
    for text in (
        'x in ("pou", "dut")',
        '{"pou": 1, "gvl": 2}',
        'frozenset(["task", "scene"])',
        '{1: "pou", 2: "dut"}',
    ):
        assert list(listed(ast.parse(text), frozenset(kinds()))), text
    assert not list(listed(ast.parse('f("pou"); g("dut")'), frozenset(kinds())))


@pytest.mark.parametrize("kind", kinds().values(), ids=kinds().keys())
def test_a_descriptor_keeps_the_contract(kind: ObjectKind[Any]) -> None:
    assert set(kind.placement.parents) <= {*kinds(), DEVICES_VIEW, POUS_VIEW}
    assert {child.kind for child in kind.children} <= set(kinds())
    assert all(kind.name in kinds()[child.kind].placement.parents for child in kind.children)
    assert kind.compiled.source is None or issubclass(kind.data, CodeData)
    assert not (kind.templates and kind.new), "a kind has templates by subkind or one for all"
    for template in (*kind.templates.values(), kind.new):
        assert template is None or isinstance(template("Name"), kind.data)
    if isinstance(kind.folder, IecText):
        fields = kind.data.model_fields
        assert (kind.folder.declaration, kind.folder.implementation) == (
            "declaration" in fields,
            "implementation" in fields,
        )
