"""Analysis of short texts for the tests: what a program means, and what is reported about it."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis import Analysis, AnalysisOptions, analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Type

QUIET = frozenset({"W1103", "W1116", "W1121", "W1135", "W1140", "W1141", "W1204", "W1206", "W1209"})
"""Codes about unused and equally named entities, which short samples are full of."""


def analysed(*texts: str | Source, options: AnalysisOptions | None = None) -> Analysis:
    """The analysis of texts that parse without a message."""
    units = []
    for number, text in enumerate(texts):
        result = parse(text if isinstance(text, Source) else Source(f"text{number}", text))
        assert not result.diagnostics, [str(d) for d in result.diagnostics]
        units.append(result.unit)
    return analyse(units, options)


def program(
    declaration: str, body: str = "", *others: str | Source, options: AnalysisOptions | None = None
) -> Analysis:
    """The analysis of PROGRAM P with these variables and statements, and of other texts."""
    return analysed(f"PROGRAM P\n{declaration}\n{body}\nEND_PROGRAM", *others, options=options)


def codes(analysis: Analysis, *, quiet: frozenset[str] = QUIET) -> list[str]:
    """Codes of the messages in order, those about unused entities left out."""
    return [d.code for d in analysis.diagnostics if d.code not in quiet]


def messages(analysis: Analysis) -> list[str]:
    """Texts of the messages in order."""
    return [d.message for d in analysis.diagnostics if d.code not in QUIET]


def body_of(analysis: Analysis, name: str = "P") -> list[ast.Stmt]:
    """Statements of a POU."""
    pou = next(p for p in analysis.pous if p.name == name)
    assert pou.pou is not None
    return pou.pou.body


def value_of(analysis: Analysis, number: int = 0) -> ast.Expr:
    """Right side of the assignment that is statement `number` of P."""
    statement = body_of(analysis)[number]
    assert isinstance(statement, ast.Assign)
    return statement.value


def variable(analysis: Analysis, path: str) -> VarSymbol:
    """A variable by POU or list and name: `P.x`."""
    owner, _, name = path.partition(".")
    for pou in analysis.pous:
        if pou.name.upper() == owner.upper():
            return pou.locals[name.upper()]
    for gvl in analysis.gvls:
        if gvl.name.upper() == owner.upper():
            return gvl.members[name.upper()]
    raise KeyError(path)


def type_of(analysis: Analysis, name: str) -> Type:
    """A user type by name."""
    return analysis.types[name.upper()]


def constant(expression: str, declaration: str = "") -> ast.Constant:
    """Folded value of an expression, with the constants of `declaration`."""
    analysis = program(f"{declaration}\nVAR x : ARRAY[0..0] OF LREAL; END_VAR", f"x[0] := {expression};")
    return value_of(analysis).constant
