"""First pass: variables, and the values of enumerations."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.iec.words import ACCESS_SPECIFIERS
from tappet.lang import ast
from tappet.lang.analysis.collected import Collected, OwnVariables
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.same_names import report_twice
from tappet.lang.analysis.scope import describe
from tappet.lang.analysis.type_conversions import is_conversion
from tappet.lang.source import Scope, Source, Span
from tappet.lang.symbols import EnumValueSymbol, PouSymbol, Storage, VarSymbol


def check_name(session: Session, name: str, source: Source, span: Span, what: str = "") -> None:
    """Names of the user's own hold no two underscores in a row; what is named without an owner is not called
    like a conversion, which could not be used any more (LDEC-07, LDEC-10)."""
    if "__" in name and not session.options.system:
        session.report("E0206", source.uri, span, name=name)
    if what and source.scope is not Scope.LIBRARY and is_conversion(name.upper()):
        session.report("E0105", source.uri, span, name=name, what=what)


def add_variable(session: Session, table: dict[str, VarSymbol], variable: VarSymbol, source: Source) -> None:
    """Put a variable into the table of its owner, unless its name is taken there (E0205)."""
    key = variable.name.upper()
    if not key:
        return
    span = variable.span
    assert span is not None
    check_name(session, variable.name, source, span, "variable")
    old = table.get(key)
    if old is None:
        table[key] = variable
        return
    report_twice(session, describe(variable), variable.name, source, span, old)


_SECTIONS: dict[str, frozenset[str]] = {
    "PROGRAM": frozenset(
        {"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_STAT", "VAR_EXTERNAL", "VAR_ACCESS"}
    ),
    "FUNCTION": frozenset({"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_STAT", "VAR_EXTERNAL"}),
}
_SECTIONS["FUNCTION_BLOCK"] = _SECTIONS["PROGRAM"]
_SECTIONS["METHOD"] = _SECTIONS["FUNCTION"] | {"VAR_INST"}
_SECTIONS["TRANSITION"] = _SECTIONS["METHOD"]
_SECTIONS["ACTION"] = frozenset({"VAR", "VAR_STAT", "VAR_INST"})
_STORAGE = {"PROGRAM": Storage.PROGRAM, "FUNCTION_BLOCK": Storage.INSTANCE}


def collect_variables(
    session: Session, found: Collected, pou: PouSymbol, blocks: Iterable[ast.VarBlock], source: Source
) -> OwnVariables:
    """The variables a POU declares itself."""
    own = OwnVariables()
    kind = pou.kind
    legal = _SECTIONS[kind]
    owner = pou.qualified_name
    base_storage = _STORAGE.get(kind, Storage.LOCAL)
    for block in blocks:
        section = block.section
        if section not in legal:
            if section == "VAR_TEMP":
                session.report("E0404", source.uri, block.span)
            else:
                what = f"a {kind.lower().replace('_', ' ')}"
                hint = "Use VAR or an own object."
                session.report("E0405", source.uri, block.span, section=section, what=what, hint=hint)
        access = next(iter(block.flags.intersection(ACCESS_SPECIFIERS)), "")
        if access and (section != "VAR" or kind not in ("PROGRAM", "FUNCTION_BLOCK")):
            what = f"a {kind.lower().replace('_', ' ')}"
            hint = "Access specifiers belong to VAR of a program or function block."
            session.report(
                "E0405", source.uri, block.span, section=f"{section} {access}", what=what, hint=hint
            )
        flags = frozenset(block.flags.difference(ACCESS_SPECIFIERS))
        storage = base_storage
        if section == "VAR_TEMP":
            storage = Storage.LOCAL
        elif section == "VAR_STAT":
            storage = Storage.GLOBAL
        elif section == "VAR_INST":
            storage = Storage.INSTANCE
        elif storage is Storage.LOCAL and section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"):
            storage = Storage.PARAMETER
        for decl in block.variables:
            variable = VarSymbol(
                decl.name,
                source,
                decl.name_span,
                decl.comment,
                access,
                storage=storage,
                home=storage,
                section=section,
                flags=flags,
                owner=f"__STAT_{owner}" if section == "VAR_STAT" else owner,
                decl=decl,
            )
            variable = session.stand_for(variable, source.uri, owner)
            decl.symbol = variable
            add_variable(session, own.variables, variable, source)
            if section == "VAR_STAT":
                own.statics.append(variable)
            elif section == "VAR_EXTERNAL":
                own.externals.append(variable)
            collect_local_enum(session, found, decl.type_ref, f"{pou.name}_{decl.name}", source)
    return own


def collect_enum_values(
    session: Session, found: Collected, enum: ast.EnumType, name: str, qualified: bool, source: Source
) -> None:
    """The values of an enumeration, known in the level of its source."""
    level = session.levels.of(source)
    values: list[EnumValueSymbol] = []
    seen: set[str] = set()
    for entry in enum.values:
        key = entry.name.upper()
        if key in seen:
            session.report("E0205", source.uri, entry.span, what="enumeration value", name=entry.name)
            continue
        seen.add(key)
        check_name(session, entry.name, source, entry.span)
        value = EnumValueSymbol(entry.name, source, entry.span, entry.comment)
        value = session.stand_for(value, source.uri, name)
        values.append(value)
        found.enum_of_value[id(value)] = enum
        level.enum_values.append((name, qualified, value))
    found.enum_values[id(enum)] = values


def collect_local_enum(
    session: Session, found: Collected, ref: ast.TypeRef, name: str, source: Source
) -> None:
    """An enumeration written where a variable is declared gets the name made for it."""
    if isinstance(ref, ast.ArrayType):
        collect_local_enum(session, found, ref.element, name, source)
    elif isinstance(ref, ast.EnumType):
        collect_enum_values(session, found, ref, name, False, source)
        found.local_enums.append((ref, source, name))
