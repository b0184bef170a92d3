"""Declarations, pins and values as text."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang import ast, symbols
from tappet.lang import types as t
from tappet.lang.attributes import attribute
from tappet.lang.services.results import ItemKind
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import Source, Span, split_lines
from tappet.translation.language import Language
from tappet.translation.library_comments import comment

_PINS = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT")
_MAX_LINES = 40
POU_KINDS = {
    "PROGRAM": ItemKind.PROGRAM,
    "FUNCTION": ItemKind.FUNCTION,
    "FUNCTION_BLOCK": ItemKind.FUNCTION_BLOCK,
    "METHOD": ItemKind.METHOD,
    "ACTION": ItemKind.ACTION,
    "TRANSITION": ItemKind.ACTION,
}
"""By the keyword of a POU."""


def kind_of(symbol: symbols.Symbol) -> ItemKind:
    """What a symbol is."""
    if isinstance(symbol, symbols.PouSymbol):
        return POU_KINDS.get(symbol.kind, ItemKind.FUNCTION)
    if isinstance(symbol, symbols.VarSymbol):
        if "CONSTANT" in symbol.flags:
            return ItemKind.CONSTANT
        return ItemKind.PARAMETER if symbol.section in _PINS else ItemKind.VARIABLE
    if isinstance(symbol, symbols.TypeSymbol):
        if isinstance(symbol.type, t.Enum):
            return ItemKind.ENUM
        if isinstance(symbol.type, t.Struct):
            return ItemKind.UNION if symbol.type.union else ItemKind.STRUCT
        return ItemKind.TYPE
    if isinstance(symbol, symbols.EnumValueSymbol):
        return ItemKind.ENUM_VALUE
    if isinstance(symbol, symbols.PropertySymbol):
        return ItemKind.PROPERTY
    if isinstance(symbol, symbols.InterfaceSymbol):
        return ItemKind.INTERFACE
    if isinstance(symbol, symbols.GvlSymbol):
        return ItemKind.GLOBAL_LIST
    if isinstance(symbol, symbols.NamespaceSymbol):
        return ItemKind.NAMESPACE
    return ItemKind.OPERATOR


def comment_of(symbol: symbols.Symbol) -> str:
    """The comment of a declaration as it is written now."""
    node: ast.VarDecl | ast.Pou | None = None
    if isinstance(symbol, symbols.VarSymbol):
        node = symbol.decl
    elif isinstance(symbol, symbols.PouSymbol):
        node = symbol.pou
    return node.comment if node is not None and node.comment else symbol.comment


def library_of(symbol: symbols.Symbol) -> str:
    """The library that declares a symbol; empty for what the project declares."""
    return (symbol.source.library or "") if symbol.source is not None else ""


def short(symbol: symbols.Symbol) -> str:
    """Type or head of a symbol on one line."""
    if isinstance(symbol, symbols.VarSymbol):
        return type_as_written(symbol)
    if isinstance(symbol, symbols.EnumValueSymbol):
        return f"{symbol.type} = {symbol.number}"
    if isinstance(symbol, symbols.PropertySymbol):
        return str(symbol.type or "")
    if isinstance(symbol, symbols.PouSymbol):
        result = f" : {symbol.return_type}" if symbol.return_type is not None else ""
        return f"{symbol.kind}{result}"
    if isinstance(symbol, symbols.TypeSymbol):
        return _type_kind(symbol.type)
    if isinstance(symbol, symbols.GvlSymbol):
        return "VAR_GLOBAL"
    return type(symbol).__name__.removesuffix("Symbol").upper()


def _type_kind(type_: t.Type | None) -> str:
    if isinstance(type_, t.Enum):
        return "ENUM"
    if isinstance(type_, t.Struct):
        return "UNION" if type_.union else "STRUCT"
    return str(type_ or "TYPE")


def type_as_written(symbol: symbols.VarSymbol) -> str:
    """The type of a variable; of an array without the text of its elements' members."""
    if symbol.type is not None:
        return str(symbol.type)
    decl = symbol.decl
    return decl.type_ref.name if decl is not None and isinstance(decl.type_ref, ast.NamedType) else ""


def code_of(snapshot: Snapshot, symbol: symbols.Symbol, language: Language = "en") -> str:
    """The declaration of a symbol as ST; comments of libraries are in the language."""
    if isinstance(symbol, symbols.VarSymbol):
        return variable_code(snapshot, symbol)
    if isinstance(symbol, symbols.EnumValueSymbol):
        return f"{symbol.type}.{symbol.name} := {symbol.number};"
    if isinstance(symbol, symbols.PouSymbol):
        return pou_code(snapshot, symbol, language)
    if isinstance(symbol, symbols.PropertySymbol):
        accessors = [
            word for word, found in (("GET", symbol.getter), ("SET", symbol.setter)) if found is not None
        ]
        return f"PROPERTY {symbol.name} : {symbol.type} ({', '.join(accessors) or 'no accessor'})"
    if isinstance(symbol, symbols.TypeSymbol):
        return type_code(symbol)
    if isinstance(symbol, symbols.InterfaceSymbol):
        heads = [head_line(method) for key, method in symbol.methods.items() if not key.startswith("__")]
        heads += [f"PROPERTY {p.name} : {p.type}" for p in symbol.properties.values()]
        return "\n".join([f"INTERFACE {symbol.name}", *(f"    {line}" for line in heads[:_MAX_LINES])])
    if isinstance(symbol, symbols.GvlSymbol):
        lines = [f"    {v.name} : {type_as_written(v)};" for v in list(symbol.members.values())[:_MAX_LINES]]
        return "\n".join([f"VAR_GLOBAL // {symbol.name}", *lines, "END_VAR"])
    if isinstance(symbol, symbols.NamespaceSymbol):
        return f"NAMESPACE {symbol.name}"
    return symbol.name


def variable_code(snapshot: Snapshot, symbol: symbols.VarSymbol) -> str:
    """`VAR_INPUT xOn : BOOL := TRUE;`."""
    decl = symbol.decl
    section = "" if symbol.section == "RESULT" else f"{symbol.section} "
    flags = "".join(f"{flag} " for flag in sorted(symbol.flags)) if section else ""
    address = f" AT {decl.address}" if decl is not None and decl.address else ""
    initial = initial_text(symbol)
    operator = "REF=" if decl is not None and decl.initial_ref else ":="
    value = f" {operator} {initial}" if initial else ""
    return f"{section}{flags}{symbol.name}{address} : {type_as_written(symbol)}{value};"


def initial_text(symbol: symbols.VarSymbol) -> str:
    """The initial value as written, '' without one; of a parameter the one that the reference gives."""
    decl = symbol.decl
    if decl is None or decl.initial is None or symbol.source is None:
        return ""
    if decl.given is not None:
        return decl.given.value
    return slice_of(symbol.source, decl.initial.span)


def slice_of(source: Source, span: Span) -> str:
    """The text of a span."""
    lines = split_lines(source.text)[span.line : span.end_line + 1]
    if not lines:
        return ""
    lines[-1] = lines[-1][: span.end_column] if span.end_line > span.line else lines[-1]
    if span.end_line == span.line:
        return lines[0][span.column : span.end_column]
    return "\n".join([lines[0][span.column :], *lines[1:]])


def pins(pou: symbols.PouSymbol) -> Iterator[symbols.VarSymbol]:
    """Inputs, outputs and in-outs that are not hidden, inherited ones first."""
    chain: list[symbols.PouSymbol] = []
    block: symbols.PouSymbol | None = pou
    while block is not None and block not in chain:
        chain.append(block)
        block = block.base
    seen: set[str] = set()
    for entry in reversed(chain):
        for variable in entry.parameters:
            hidden = variable.decl is not None and attribute(variable.decl.attributes, "hide") is not None
            if variable.section in _PINS and not hidden and variable.name.upper() not in seen:
                seen.add(variable.name.upper())
                yield variable


def head_line(pou: symbols.PouSymbol) -> str:
    """`FUNCTION F : INT` with what it extends."""
    text = f"{pou.kind} {pou.name}"
    node = pou.pou
    if pou.return_type is not None:
        text += f" : {pou.return_type}"
    if node is not None and node.extends:
        text += f" EXTENDS {node.extends}"
    if node is not None and node.implements:
        text += f" IMPLEMENTS {', '.join(node.implements)}"
    return text


def in_language(text: str, symbol: symbols.Symbol, language: Language) -> str:
    """A comment of a symbol; that of a library in the language, where there are words for it."""
    library = library_of(symbol)
    return comment(text, library, language) if library else text


def pou_code(snapshot: Snapshot, pou: symbols.PouSymbol, language: Language = "en") -> str:
    """Head and pins with their comments."""
    lines = [head_line(pou)]
    section = ""
    for variable in pins(pou):
        if variable.section != section:
            if section:
                lines.append("END_VAR")
            section = variable.section
            lines.append(section)
        initial = initial_text(variable)
        said = in_language(variable.comment, variable, language)
        remark = f"  // {said.splitlines()[0]}" if said else ""
        value = f" := {initial}" if initial else ""
        lines.append(f"    {variable.name} : {type_as_written(variable)}{value};{remark}")
    if section:
        lines.append("END_VAR")
    return "\n".join(lines)


def type_code(symbol: symbols.TypeSymbol) -> str:
    """The definition as written, shortened when it is long."""
    decl = getattr(symbol.type, "decl", None)
    if symbol.source is not None and isinstance(decl, ast.TypeDecl) and decl.source is symbol.source:
        lines = slice_of(symbol.source, decl.span).splitlines()
        if len(lines) > _MAX_LINES:
            lines = [*lines[:_MAX_LINES], "..."]
        text = "\n".join(lines)
        return (text if text.upper().startswith("TYPE") else f"TYPE {text}") + "\nEND_TYPE"
    return f"TYPE {symbol.name} : {symbol.type}; END_TYPE"


def constant_text(value: ast.Constant, type_: t.Type | None) -> str:
    """A folded value as an IEC literal."""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, bytes):
        return "'" + value.decode("latin-1").replace("$", "$$").replace("'", "$'") + "'"
    if isinstance(value, str):
        return '"' + value.replace("$", "$$").replace('"', '$"') + '"'
    if isinstance(type_, t.Enum) and isinstance(value, int):
        name = next((name for name, number in type_.values.items() if number == value), None)
        return f"{type_.name}.{name}" if name else str(value)
    base = t.value_type(type_) if type_ is not None else None
    if isinstance(value, int) and base in (t.TIME, t.LTIME):
        return duration_text(value * 1_000_000 if base is t.TIME else value, long=base is t.LTIME)
    if isinstance(value, int) and isinstance(base, t.Elementary) and base.kind is t.Kind.BOOL:
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return repr(value)
    return str(value)


def duration_text(ns: int, long: bool = False) -> str:
    """A duration in nanoseconds as TIME (or LTIME) literal."""
    prefix = "LTIME#" if long else "T#"
    parts = []
    rest = abs(ns)
    for unit, size in (
        ("d", 86_400_000_000_000),
        ("h", 3_600_000_000_000),
        ("m", 60_000_000_000),
        ("s", 1_000_000_000),
        ("ms", 1_000_000),
        ("us", 1000),
        ("ns", 1),
    ):
        number, rest = divmod(rest, size)
        if number:
            parts.append(f"{number}{unit}")
    return prefix + ("".join(parts) or "0s")


def value_facts(symbol: symbols.Symbol) -> str:
    """What is known about the value of a constant, in a sentence; '' otherwise."""
    if isinstance(symbol, symbols.VarSymbol) and symbol.is_constant and symbol.constant is not None:
        return f"Value: `{constant_text(symbol.constant, symbol.type)}`"
    return ""


def home_of(symbol: symbols.Symbol) -> str:
    """Where something is declared, in a phrase; '' if that says nothing."""
    if isinstance(symbol, symbols.VarSymbol):
        if symbol.section in ("VAR_GLOBAL", "RESULT") or symbol.owner:
            return f"{symbol.owner}" if symbol.owner else ""
        return ""
    source = symbol.source
    if source is not None and source.library:
        return f"library {source.library}"
    return ""
