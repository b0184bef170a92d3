"""Checks of good practice, one per file: each opens with what it checks, its source, and samples.

Imports only `lang`. `STATEMENT_RULES` run while a body is resolved, the others after it; `RULES` lists all.
The Passes and Fails samples of the docstrings are run by a test and shown in the manual.
"""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from tappet.lang.rules import (
    address_overlap,
    assignment_to_itself,
    case_covers_enum,
    comparison_always,
    constant_condition,
    endless_for,
    init_order,
    loop_variable_written,
    missing_return_value,
    no_effect,
    output_never_written,
    pragma_messages,
    reserved_name,
    retain_no_effect,
    shift_width,
    string_argument_cut,
    unreachable,
    unused_variable,
)

RULES: tuple[ModuleType, ...] = (
    address_overlap,
    assignment_to_itself,
    case_covers_enum,
    comparison_always,
    constant_condition,
    endless_for,
    init_order,
    loop_variable_written,
    missing_return_value,
    no_effect,
    output_never_written,
    pragma_messages,
    reserved_name,
    retain_no_effect,
    shift_width,
    string_argument_cut,
    unreachable,
    unused_variable,
)
"""Every rule has CODES, and the function of its kind: `check_statement` with NODES, `check_expression` with
NODES, `check_list` (statements that follow each other), `check_pou`, or `check_program`."""

CODING_RULES: tuple[ModuleType, ...] = ()
"""The optional coding rules: they run when `AnalysisOptions.static` names one of their codes."""

ALL_RULES = RULES + CODING_RULES

Check = Callable[[Any, Any], None]


def _by_node(name: str) -> dict[type, tuple[Check, ...]]:
    table: dict[type, list[Check]] = {}
    for rule in RULES:
        check = getattr(rule, name, None)
        if check is not None:
            for node in rule.NODES:
                table.setdefault(node, []).append(check)
    return {node: tuple(checks) for node, checks in table.items()}


STATEMENT_RULES = _by_node("check_statement")
EXPRESSION_RULES = _by_node("check_expression")
LIST_RULES: tuple[Check, ...] = tuple(r.check_list for r in RULES if hasattr(r, "check_list"))
POU_RULES: tuple[Callable[[Any], None], ...] = tuple(r.check_pou for r in RULES if hasattr(r, "check_pou"))
PROGRAM_RULES: tuple[Callable[[Any], None], ...] = tuple(
    r.check_program for r in RULES if hasattr(r, "check_program")
)
