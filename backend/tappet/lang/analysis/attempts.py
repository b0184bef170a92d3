"""The assignment attempt `target ?= source` of IEC 61131-3 (edition 3, 6.6.6.7).

The target gets the object that the source refers to, or NULL when that object does not implement the
interface, or is not of the function block, that the target is declared with. Function blocks alone know their
type at run time, and only variables that may hold NULL can be targets.
"""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.conversion import derives
from tappet.lang.analysis.expressions import place_or_name, value
from tappet.lang.analysis.places import is_place, mark_written, writable


def assignment_attempt(b: Body, target: ast.Expr, source: ast.Expr) -> None:
    """Checks `target ?= source`."""
    wanted, given = place_or_name(b, target), value(b, source)
    if wanted is None or given is None:
        return
    goal, own = referred(wanted), object_of(given)
    for side, type_, found in ((target, wanted, goal), (source, given, own)):
        if found is None:
            b.report("E0334", side.span, type=type_, hint=_hint(type_))
            return
    if isinstance(goal, t.FunctionBlock) and isinstance(own, t.FunctionBlock) and not _related(goal, own):
        b.report("E0335", source.span, source=own, target=goal)
        return
    if isinstance(given, t.FunctionBlock) and is_place(source):
        mark_written(b, source)  # through the reference
    writable(b, target)


def _related(one: t.FunctionBlock, other: t.FunctionBlock) -> bool:
    return derives(one, other) or derives(other, one)


def referred(type_: t.Type) -> t.FunctionBlock | t.Interface | None:
    """What an interface or a REF_TO of a function block refers to; None of any other type."""
    if isinstance(type_, t.Pointer) and type_.ref_to and isinstance(type_.base, t.FunctionBlock):
        return type_.base
    return type_ if isinstance(type_, t.Interface) else None


def object_of(type_: t.Type) -> t.FunctionBlock | t.Interface | None:
    """The same of a value; a function block is the object itself."""
    if isinstance(type_, t.Reference):
        type_ = type_.base
    return type_ if isinstance(type_, t.FunctionBlock) else referred(type_)


def _hint(type_: t.Type) -> str:
    if isinstance(type_, t.Pointer) and isinstance(type_.base, t.FunctionBlock):
        return f"Declare it as REF_TO {type_.base}."
    if isinstance(type_, t.FunctionBlock):
        return f"Assign to a REF_TO {type_}."
    return ""
