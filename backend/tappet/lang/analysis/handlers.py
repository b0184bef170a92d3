"""Which function resolves what: classes of expressions, and operators in functional form by name.

The one list of both. A handler fills in the `resolved` fields of its node and reports what is wrong; cost:
one look-up by class a node.
"""

from __future__ import annotations

from tappet.lang.analysis import (
    builtins,
    conditional_calls,
    expressions,
    intrinsics,
    members,
    position_operators,
    selection,
    statements,
)

EXPRESSIONS = (
    expressions.HANDLERS,
    members.HANDLERS,
    conditional_calls.HANDLERS,
    statements.HANDLERS,
)
OPERATIONS = (builtins.OPERATIONS, selection.OPERATIONS, intrinsics.OPERATIONS, position_operators.OPERATIONS)


def install() -> None:
    """Fill the tables that `expressions` and `builtins` look handlers up in; once is enough."""
    for handlers in EXPRESSIONS:
        expressions.EXPRESSIONS.update(handlers)
    for operations in OPERATIONS:
        builtins.OPERATORS.update(operations)
