"""Checks of good practice: a module checks one topic and opens with what it checks, its source, and samples.

Imports only `lang`. `STATEMENT_RULES` run while a body is resolved, the others after it; `RULES` lists all;
`coding` holds the optional ones. Every module has CODES; analyses that rules share lie in `lang.dataflow`.
Samples of the docstrings are run by a test and shown in the manual.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Any

from tappet.lang.diagnostics import CODING_RULES
from tappet.lang.rules import coding


def _modules_of(package: ModuleType) -> tuple[ModuleType, ...]:
    names = sorted(m.name for m in iter_modules(package.__path__) if not m.ispkg)
    return tuple(import_module(f"{package.__name__}.{name}") for name in names)


RULES = _modules_of(import_module(__name__))
"""Every rule has CODES, and the function of its kind: `check_statement` with NODES (or VALUES: an assignment
of these classes of values), `check_expression` with NODES (or OPERATORS: a Binary of these), `check_list`
(statements that follow each other), `check_pou`, `check_program`, or `check_variables`: that looks at a POU
with its methods, at the types of their variables and at whether any code names or writes these variables, at
nothing else of the program. A `check_pou` with OWN_CODE_ONLY leaves libraries out."""


@cache
def coding_rules() -> tuple[ModuleType, ...]:
    """The optional coding rules: they run when `AnalysisOptions.static` names one of their codes, on what the
    project itself declares. They have `check_pou`, `check_program`, `check_unit` (one text) or `check_tasks`.

    They are imported at the first call: most programs are checked without them.
    """
    return _modules_of(coding)


def all_rules() -> tuple[ModuleType, ...]:
    """The rules that always run, and the optional ones."""
    return RULES + coding_rules()


Check = Callable[[Any, Any], Any]


def _by_node(name: str) -> dict[type, tuple[Check, ...]]:
    table: dict[type, list[Check]] = {}
    for rule in RULES:
        check = getattr(rule, name, None)
        if check is not None:
            for node in getattr(rule, "NODES", ()):
                table.setdefault(node, []).append(check)
    return {node: tuple(checks) for node, checks in table.items()}


def _by_key(name: str) -> dict[Any, tuple[Check, ...]]:
    table: dict[Any, list[Check]] = {}
    for rule in RULES:
        check = getattr(rule, "check_statement" if name == "VALUES" else "check_expression", None)
        for key in getattr(rule, name, ()):
            table.setdefault(key, []).append(check)  # type: ignore[arg-type]
    return {key: tuple(checks) for key, checks in table.items()}


STATEMENT_RULES = _by_node("check_statement")
EXPRESSION_RULES = _by_node("check_expression")
ASSIGN_RULES = _by_key("VALUES")
"""Rules of assignments that look at values of certain classes only, by class."""
BINARY_RULES = _by_key("OPERATORS")
"""Rules of certain operators, by operator."""
LIST_RULES: tuple[Check, ...] = tuple(r.check_list for r in RULES if hasattr(r, "check_list"))
POU_RULES: tuple[Callable[[Any], None], ...] = tuple(r.check_pou for r in RULES if hasattr(r, "check_pou"))
LIBRARY_POU_RULES: tuple[Callable[[Any], None], ...] = tuple(
    r.check_pou for r in RULES if hasattr(r, "check_pou") and not getattr(r, "OWN_CODE_ONLY", False)
)
PROGRAM_RULES: tuple[Callable[[Any], None], ...] = tuple(
    r.check_program for r in RULES if hasattr(r, "check_program")
)
VARIABLE_RULES: tuple[Check, ...] = tuple(r.check_variables for r in RULES if hasattr(r, "check_variables"))


def coding_checks(name: str, chosen: frozenset[str]) -> tuple[Check, ...]:
    """The functions `name` of the coding rules of which a code is switched on."""
    if not chosen:
        return ()
    return tuple(
        getattr(rule, name)
        for rule in coding_rules()
        if hasattr(rule, name) and chosen.intersection(rule.CODES)
    )


def chosen_codes(text: str) -> frozenset[str]:
    """The codes of the coding rules that a list such as `S12,S1301`, `all` or `none` names.

    A part of a code names all that begin with it.

    Raises ValueError for a part that names none.
    """
    known = sorted(CODING_RULES)
    chosen: set[str] = set()
    for part in text.replace(",", " ").split():
        if part.lower() == "none":
            continue
        found = [code for code in known if part.lower() == "all" or code.startswith(part.upper())]
        if not found:
            raise ValueError(
                f"no coding rule begins with '{part}'; there are {known[0]} to {known[-1]}, 'all' and 'none'"
            )
        chosen.update(found)
    return frozenset(chosen)
