"""From the elements of a chain to assignments.

A body is `{"chain": [element, ...]}`. An element has an `id`, an `op`, the operands `in` and the variable `out`; one
with `op` `ST` has statements in `text`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from tappet.iec.listing import Element
from tappet.lang import ast
from tappet.lang.languages.drawn import DrawnBody, DrawnReader
from tappet.lang.languages.reader import GraphReader
from tappet.lang.languages.reader import Lowering

OPERATORS = {"ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "GT": ">", "LT": "<", "EQ": "="}


@dataclass(slots=True, kw_only=True)
class Chain(ast.Graph):
    """The elements in order."""

    language: str = "CHAIN"
    links: list[Link] = field(default_factory=list)


@dataclass(slots=True, kw_only=True)
class Link(ast.Node):
    """One element: what it computes and where that goes, or statements."""

    op: str
    operands: list[ast.Expr] = field(default_factory=list)
    out: ast.Expr | None = None
    statements: list[ast.Stmt] = field(default_factory=list)


class ChainReader(DrawnReader, GraphReader):
    """Reads chains."""

    name: ClassVar[str] = "CHAIN"

    def read_elements(self, body: DrawnBody, pou: ast.Pou) -> None:
        """A link for every element."""
        links = [_link(body, element) for element in body.elements]
        pou.graph = Chain(links=[link for link in links if link is not None])

    def lower(self, pou: ast.Pou, context: Lowering) -> None:
        """An assignment for every element."""
        assert isinstance(pou.graph, Chain)
        for link in pou.graph.links:
            pou.body += link.statements or [_assignment(link)]


def _link(body: DrawnBody, element: Element) -> Link | None:
    op = element.value.get("op")
    span = body.span(element)
    if op == "ST":
        return Link(op="ST", span=span, statements=body.statements(element, "text"))
    if op != "MOVE" and op not in OPERATORS:
        known = ", ".join(["MOVE", "ST", *OPERATORS])
        body.report("E0132", element, id=element.id, what=f"an operator of {known}")
        return None
    operands = [body.expression(element, "in", number) for number in range(1 if op == "MOVE" else 2)]
    return Link(op=op, span=span, operands=operands, out=body.expression(element, "out"))


def _assignment(link: Link) -> ast.Stmt:
    value, *others = link.operands
    for other in others:
        value = ast.Binary(op=OPERATORS[link.op], left=value, right=other, span=link.span)
    assert link.out is not None
    return ast.Assign(op=":=", target=link.out, value=value, span=link.span)


READER = ChainReader()
