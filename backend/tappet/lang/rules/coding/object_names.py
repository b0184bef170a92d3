"""Names of objects and types: their prefix.

The prefixes stand in `lang.coding_settings`.

Source: coding guidelines of PLCopen, N1 (naming conventions), N5, N8.

Passes:
    @static
    FUNCTION_BLOCK FB_Motor
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION_BLOCK Motor           (* S1001: FB_Motor *)
    END_FUNCTION_BLOCK
Fails:
    @static
    TYPE Point : STRUCT x : REAL; END_STRUCT END_TYPE   (* S1002: ST_Point *)
Fails:
    @static
    @source Drive
    VAR_GLOBAL nSpeed : INT; END_VAR   (* S1003: GVL_Drive *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("S1001", "S1002", "S1003")


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports names of objects without their prefix."""
    prefixes = session.options.static.settings.prefixes
    for d in unit.declarations:
        if isinstance(d, ast.Pou):
            prefix = prefixes.get(d.kind, "")
            _check(session, unit, d, prefix, "S1001", d.kind.lower().replace("_", " "))
        elif isinstance(d, ast.Interface):
            _check(session, unit, d, prefixes.get("INTERFACE", ""), "S1001", "interface")
        elif isinstance(d, ast.TypeDecl):
            what = _what(d.type_ref)
            _check(session, unit, d, prefixes.get(what.upper(), ""), "S1002", what)
        elif isinstance(d, ast.GlobalList) and d.blocks:
            _check(session, unit, d, prefixes.get("GVL", ""), "S1003", "global variable list")


def _what(ref: ast.TypeRef) -> str:
    if isinstance(ref, ast.StructType):
        return "union" if ref.union else "struct"
    return "enum" if isinstance(ref, ast.EnumType) else ""


def _check(session: Session, unit: ast.Unit, d: ast.Declaration, prefix: str, code: str, what: str) -> None:
    if prefix and d.name and not d.name.startswith(prefix) and code in session.options.static.codes:
        session.report(code, unit.source.uri, d.name_span, name=d.name, what=what, prefix=prefix)
