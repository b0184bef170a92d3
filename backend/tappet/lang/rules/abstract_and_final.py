"""What is ABSTRACT is implemented, what is FINAL is not overridden, what says OVERRIDE overrides something.

Source: spec declaration.md, language_declarations.md (modifiers of methods).

Passes:
    FUNCTION_BLOCK ABSTRACT FB_Base
    METHOD ABSTRACT Start : BOOL
    END_METHOD
    END_FUNCTION_BLOCK
    FUNCTION_BLOCK FB EXTENDS FB_Base
    METHOD OVERRIDE Start : BOOL
    Start := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK ABSTRACT FB_Base
    METHOD ABSTRACT Start : BOOL
    END_METHOD
    END_FUNCTION_BLOCK
    FUNCTION_BLOCK FB EXTENDS FB_Base   (* E0436: Start is missing *)
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB_Base
    METHOD FINAL Start : BOOL
    Start := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
    FUNCTION_BLOCK FB EXTENDS FB_Base
    METHOD Start : BOOL            (* E0435: Start is FINAL in FB_Base *)
    Start := FALSE;
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    METHOD ABSTRACT Start : BOOL   (* E0437: FB is not ABSTRACT *)
    END_METHOD
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    METHOD OVERRIDE Start : BOOL   (* E0438: there is no method to override *)
    Start := TRUE;
    END_METHOD
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.heritage import has_unknown_heritage
from tappet.lang.symbols import PouSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("E0435", "E0436", "E0437", "E0438")
_LONGEST_CHAIN = 1000


def check_program(session: Session) -> None:
    """Checks the modifiers of all methods of function blocks."""
    for pou in session.analysis.pous:
        node, source = pou.pou, pou.source
        if pou.kind != "FUNCTION_BLOCK" or node is None or source is None:
            continue
        abstract = "ABSTRACT" in node.modifiers
        for key, method in pou.methods.items():
            _check_method(session, pou, key, method, abstract)
        if pou.base is not None and not abstract:
            _check_implemented(session, pou, node, source.uri)


def _check_method(session: Session, pou: PouSymbol, key: str, method: PouSymbol, abstract: bool) -> None:
    node, source = method.pou, method.source
    if node is None or source is None:
        return
    base = _inherited(pou, key)
    if base is not None and base.pou is not None and "FINAL" in base.pou.modifiers:
        related = [Related("FINAL here", base.source.uri, base.span)] if base.source and base.span else []
        owner = base.owner.name if base.owner is not None else ""
        session.report("E0435", source.uri, node.name_span, related, name=method.name, base=owner)
    if "ABSTRACT" in node.modifiers and not abstract:
        session.report("E0437", source.uri, node.name_span, name=method.name, block=pou.name)
    if "OVERRIDE" in node.modifiers and base is None and not _of_interface(pou, key):
        session.report("E0438", source.uri, node.name_span, name=method.name, block=pou.name)


def _of_interface(pou: PouSymbol, key: str) -> bool:
    if has_unknown_heritage(pou):
        return True  # it may be
    walk: PouSymbol | None = pou
    for _ in range(_LONGEST_CHAIN):
        if walk is None:
            return False
        if any(key in interface.methods for interface in walk.interfaces):
            return True
        walk = walk.base
    return False


def _inherited(pou: PouSymbol, key: str) -> PouSymbol | None:
    walk = pou.base
    for _ in range(_LONGEST_CHAIN):
        if walk is None:
            return None
        if key in walk.methods:
            return walk.methods[key]
        walk = walk.base
    return None


def _check_implemented(session: Session, pou: PouSymbol, node: ast.Pou, uri: str) -> None:
    seen = set(pou.methods)
    walk = pou.base
    for _ in range(_LONGEST_CHAIN):
        if walk is None:
            return
        for key, method in walk.methods.items():
            if key not in seen and method.pou is not None and "ABSTRACT" in method.pou.modifiers:
                place = (
                    [Related("ABSTRACT here", method.source.uri, method.span)]
                    if method.source and method.span
                    else []
                )
                session.report(
                    "E0436", uri, node.name_span, place, block=pou.name, name=method.name, base=walk.name
                )
            seen.add(key)
        walk = walk.base
