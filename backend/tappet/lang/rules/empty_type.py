"""A structure or union has members.

Source: spec LTYP-100.

Passes:
    TYPE ST_Point : STRUCT x : REAL; END_STRUCT END_TYPE
Fails:
    TYPE ST_Point : STRUCT END_STRUCT END_TYPE   (* W1219: no member *)
    TYPE U_Value : UNION END_UNION END_TYPE   (* W1219: no member *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.source import Scope
from tappet.lang.types import Struct

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1219",)


def check_program(session: Session) -> None:
    """Reports structures and unions of the project without any member."""
    for type_ in session.analysis.types.values():
        if isinstance(type_, Struct) and not type_.members and type_.decl is not None:
            source = type_.decl.source
            if source is not None and source.scope is not Scope.LIBRARY:
                what = "union" if type_.union else "structure"
                session.report("W1219", source.uri, type_.decl.name_span, what=what, name=type_.name)
