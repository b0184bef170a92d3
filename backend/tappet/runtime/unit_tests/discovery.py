"""Which blocks are suites, and which programs run them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass

from tappet.lang import ast

TEST_LIBRARY = "TappetUnit"
BASE = "FB_TESTSUITE"
RUNNERS = frozenset({"RUN", "RUN_IN_SEQUENCE"})
PROGRAM = "TappetTests"
"""Program that is made when none calls RUN."""


@dataclass(frozen=True, slots=True)
class Found:
    """The suites of an application."""

    suites: tuple[str, ...]
    """Blocks that can be instantiated, in the order of the texts."""
    programs: tuple[str, ...]
    """Programs that call RUN or RUN_IN_SEQUENCE."""


def discover(units: Iterable[ast.Unit]) -> Found:
    """Finds suites and programs by their texts; nothing needs to compile."""
    pous = [d for unit in units for d in unit.declarations if isinstance(d, ast.Pou)]
    base_of = {p.name.upper(): _last(p.extends) for p in pous if p.kind == "FUNCTION_BLOCK" and p.extends}
    suites = tuple(
        p.name
        for p in pous
        if p.kind == "FUNCTION_BLOCK" and "ABSTRACT" not in p.modifiers and _is_suite(p.name, base_of)
    )
    programs = tuple(p.name for p in pous if p.kind == "PROGRAM" and _calls_runner(p))
    return Found(suites, programs)


def has_suites(texts: Iterable[str]) -> bool:
    """Whether texts speak of test suites at all."""
    return any(BASE in text.upper() for text in texts)


def program_text(suites: Sequence[str]) -> str:
    """A program with an instance of every suite that runs them."""
    instances = "\n".join(f"    suite{number} : {name};" for number, name in enumerate(suites, 1))
    return f"PROGRAM {PROGRAM}\nVAR\n{instances}\nEND_VAR\nRUN();\nEND_PROGRAM\n"


def calls(node: object) -> Iterator[ast.Call]:
    """All calls in a tree of statements and expressions."""
    if isinstance(node, ast.Call):
        yield node
    if isinstance(node, list | tuple):
        for item in node:
            yield from calls(item)
    elif is_dataclass(node) and isinstance(node, ast.Stmt | ast.Expr | ast.Argument | ast.CaseBranch):
        for part in fields(node):
            yield from calls(getattr(node, part.name))


def callee_name(call: ast.Call) -> str:
    """Last part of the name that is called, upper case."""
    callee = call.callee
    return callee.name.upper() if isinstance(callee, ast.Name | ast.Member) else ""


def _calls_runner(pou: ast.Pou) -> bool:
    return any(callee_name(call) in RUNNERS for call in calls(pou.body))


def _is_suite(name: str, base_of: dict[str, str]) -> bool:
    seen: set[str] = set()
    key = name.upper()
    while key in base_of and key not in seen:
        seen.add(key)
        key = base_of[key]
        if key == BASE:
            return True
    return False


def _last(name: str) -> str:
    return name.rpartition(".")[2].upper()
