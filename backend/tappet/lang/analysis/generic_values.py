"""Values of generic constants where a type is written: their number, and whether they suit."""

from __future__ import annotations

from tappet.lang import ast, walk
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import value
from tappet.lang.analysis.generic import generic_constants
from tappet.lang.symbols import PouSymbol, Symbol, VarSymbol


def check_base(body: Body, pou: PouSymbol, base: PouSymbol, block: Symbol | None) -> None:
    """The same for the base of a block."""
    node = pou.pou
    if node is not None and node.extends is not None:
        ref = node.extends_type or ast.NamedType(span=node.extends_span, name=node.extends)
        check_values(body, ref, base, block if ref.generic else base)


def check_values(body: Body, ref: ast.NamedType, symbol: Symbol | None, block: Symbol | None) -> None:
    """Reports values of a type other than its block requires; `symbol` is what its name denotes, and
    `block` what the name before the values denotes."""
    before = len(body.session.diagnostics)
    for e in ref.values:
        value(body, e)
    if isinstance(block, PouSymbol):
        body.session.called.add(id(block))
    pou = block.pou if isinstance(block, PouSymbol) else None
    expected = generic_constants(pou) if pou is not None else []
    if len(expected) != len(ref.values):
        name = ref.generic or ref.name
        body.report("E0449", ref.span, name=name, expected=len(expected), actual=len(ref.values))
    elif any(_is_faulty(e) for e in walk.expressions(*ref.values)):
        return
    elif symbol is block and ref.values and len(body.session.diagnostics) == before:
        names = ", ".join(decl.name for decl in expected)
        body.report("E0450", ref.span, name=ref.generic, constants=names)


def _is_faulty(e: ast.Expr) -> bool:
    """Whether a value names a constant whose own value has been reported."""
    symbol = e.symbol if isinstance(e, (ast.Name, ast.Member)) else None
    decl = symbol.decl if isinstance(symbol, VarSymbol) and "CONSTANT" in symbol.flags else None
    return decl is not None and decl.init is not None and decl.init.type is None
