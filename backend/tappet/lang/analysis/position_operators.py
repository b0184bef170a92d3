"""`__POUNAME()` and `__POSITION()`: texts that say where they stand, for logs and error messages.

Extensions of the standard that CODESYS and TwinCAT have; both are constants.
"""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis.builtins import Resolve, count_fits, take
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import evaluate
from tappet.lang.source import Span


def _text(b: Body, e: ast.Call, name: str, text: str) -> None:
    if not count_fits(b, e, name, 0, 0):
        return
    written = text.replace("$", "$$").replace("'", "$'")
    literal = ast.Literal(
        text=f"'{written}'", kind="string", value=text.encode("latin-1", "replace"), span=e.span
    )
    evaluate(b, literal)
    take(e, literal, name)


def _pou_name(b: Body, e: ast.Call, name: str) -> None:
    """The POU; of a method with its block, of an accessor as `Block.Property.Get`; else the list or type."""
    pou = b.pou
    text = pou.qualified_name if pou is not None else b.source.name or ""
    owner, _, own = text.rpartition(".")
    if own[:5].upper() in ("__GET", "__SET"):
        text = f"{owner}.{own[5:]}.{own[2:5].capitalize()}"
    _text(b, e, name, text)


def _position(b: Body, e: ast.Call, name: str) -> None:
    """`Line 3 (Decl)` in a declaration, `Line 3, Column 7 (Impl)` in a body, both counted from 1."""
    line, body_line = e.span.line, b.source.body_line
    pou = b.pou.pou if b.pou is not None else None
    if pou is None or any(_holds(block.span, e.span) for block in pou.blocks):
        _text(b, e, name, f"Line {line + 1} (Decl)")
    else:
        _text(b, e, name, f"Line {line - body_line + 1}, Column {e.span.column + 1} (Impl)")


def _holds(outer: Span, inner: Span) -> bool:
    return (outer.line, outer.column) <= (inner.line, inner.column) < (outer.end_line, outer.end_column)


OPERATIONS: dict[str, Resolve] = {"__POUNAME": _pou_name, "__POSITION": _position}
