"""The pass between parser and analysis: bodies that are charts or drawings become statements.

It runs once for each text, right behind its parser (`parser.parse_tokens`); what has been made is never
rewritten.
"""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.languages import reader_of
from tappet.lang.languages.reader import GraphReader, Lowering
from tappet.lang.source import Source


def lower_bodies(source: Source, pous: Iterable[ast.Pou]) -> list[Diagnostic]:
    """Gives POUs whose body is a graph its variables and statements; what was wrong with the graphs."""
    context = Lowering(source)
    for pou in pous:
        if pou.graph is not None:
            reader = reader_of(pou.graph.language)
            assert isinstance(reader, GraphReader)
            reader.lower(pou, context)
            pou.graph = None
    return context.diagnostics
