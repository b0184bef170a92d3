"""Names of pins in IEC 61131-3 where CODESYS has others: `CTU.R` is the RESET of the library's counter."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang.analysis.context import Body
from tappet.lang.attributes import attribute
from tappet.lang.source import Span
from tappet.lang.symbols import VarSymbol


def pin_of_iec(
    b: Body, name: str, parameters: Iterable[VarSymbol], callee: str, span: Span
) -> VarSymbol | None:
    """The parameter whose declaration gives `name` as its name in the standard, with a warning."""
    key = name.upper()
    for parameter in parameters:
        decl = parameter.decl
        if decl is not None and decl.attributes and attribute(decl.attributes, "iec_name") == key:
            b.report("W1151", span, name=name, callee=callee, choice=parameter.name)
            return parameter
    return None
