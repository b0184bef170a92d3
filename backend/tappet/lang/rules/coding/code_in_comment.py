"""Statements that are not wanted are removed, not put into a comment; comments end with their line.

Source: coding guidelines of PLCopen, C3 (no nested comments), C4 (no code in comments), C5 (single lines);
CODESYS Static Analysis SA0140, SA0163, SA0164.

Passes:
    @static
    // Counts; see the manual (chapter 3).
    VAR n1 : INT; END_VAR
    n1 := n1 + 1; // up
Fails:
    @static
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    // n1 := n1 + 2;
    (* S1114: a statement that is switched off stands above *)
Fails:
    @static
    VAR n1 : INT; END_VAR
    n1 := n1 + 1; (* up (* S1115: a comment in a comment *) *)
Fails:
    @static
    VAR n1 : INT; END_VAR
    n1 := n1 + 1; (* up, S1120: does not end with its line *)
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.lexer import COMMENT, lex

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("S1114", "S1115", "S1120")
_STATEMENT = re.compile(
    r"^\s*(?:[A-Za-z_][\w.\[\]^]*\s*(?::=[^;]+|\([^;]*\))\s*;|(?:IF|WHILE|FOR|CASE)\b.+\b(?:THEN|DO|OF)\s*$"
    r"|END_(?:IF|WHILE|FOR|CASE|REPEAT)\s*;?\s*$)",
    re.MULTILINE | re.IGNORECASE,
)


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports the comments of a text."""
    chosen = session.options.static.codes
    source = unit.source
    found = (entry for before in lex(source.text, source.uri).trivia.values() for entry in before)
    for comment in found:
        if comment.kind != COMMENT:
            continue
        if comment.text.startswith("//"):
            inner = comment.text[2:]
        else:
            inner = comment.text[2:-2]
            if "S1120" in chosen:
                session.report("S1120", source.uri, comment.span)
            if "S1115" in chosen and comment.text.startswith("(*") and "(*" in inner:
                session.report("S1115", source.uri, comment.span)
        if "S1114" in chosen and _STATEMENT.search(inner):
            session.report("S1114", source.uri, comment.span)
