"""An interface does not extend itself, and is named once after IMPLEMENTS.

Source: spec gvl_dut_symbols.md, declaration.md.

Passes:
    INTERFACE I_Base
    END_INTERFACE
    INTERFACE I_Motor EXTENDS I_Base
    END_INTERFACE
    FUNCTION_BLOCK FB IMPLEMENTS I_Motor, I_Base
    END_FUNCTION_BLOCK
Fails:
    INTERFACE I_Motor EXTENDS I_Motor   (* E0439: extends itself *)
    END_INTERFACE
Fails:
    INTERFACE I_Motor
    END_INTERFACE
    FUNCTION_BLOCK FB IMPLEMENTS I_Motor, I_Motor   (* W1220: named twice *)
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.symbols import InterfaceSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("E0439", "W1220")


def _names_of_bases(interface: InterfaceSymbol) -> list[str]:
    node = interface.type.pou if interface.type is not None else None
    return [name.upper() for name in node.extends] if node is not None else []


def check_program(session: Session) -> None:
    """Reports interfaces among their own bases, and interfaces named twice by a block."""
    for interface in session.analysis.interfaces.values():
        todo, seen = _names_of_bases(interface), set[str]()
        while todo:
            key = todo.pop()
            if key == interface.name.upper():
                if interface.source is not None and interface.span is not None:
                    session.report("E0439", interface.source.uri, interface.span, name=interface.name)
                break
            base = session.analysis.interfaces.get(key)
            if base is not None and key not in seen:
                seen.add(key)
                todo += _names_of_bases(base)
    for pou in session.analysis.pous:
        if len(pou.interfaces) < 2 or pou.pou is None or pou.source is None:
            continue
        named: set[str] = set()
        for name, span in zip(pou.pou.implements, pou.pou.implements_spans, strict=False):
            if name.upper() in named:
                session.report("W1220", pou.source.uri, span, name=name)
            named.add(name.upper())
