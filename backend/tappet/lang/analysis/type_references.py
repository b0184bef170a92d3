"""Types as written become types: names, arrays, pointers, subranges, enumerations, structures."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, layout
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.expressions import check_use, value
from tappet.lang.analysis.generic_values import check_values
from tappet.lang.analysis.initial import initialise
from tappet.lang.analysis.scope import AmbiguousSymbol, QualifiedSymbol, describe, is_type
from tappet.lang.any_type import ANY_TYPES
from tappet.lang.attributes import attribute
from tappet.lang.heritage import has_unknown_base
from tappet.lang.symbols import InterfaceSymbol, NamespaceSymbol, PouSymbol, Symbol, TypeSymbol
from tappet.lang.types import Elementary, Type

STRING_LIMIT = (layout.SIZE_LIMIT >> 1) - 1
"""Longest STRING in characters: as a WSTRING, it is as large as data may be."""
DEPTH_LIMIT = 100
"""Types inside types, names of names and constants from constants; deeper ones are an error (E0107)."""


@dataclass(slots=True)
class TypeReferences:
    """Types that are still to be resolved, and those being resolved."""

    session: Session
    found: Collected
    types: dict[int, tuple[TypeSymbol, ast.TypeDecl, Body]] = field(default_factory=dict)
    enums: dict[int, tuple[ast.EnumType, str, Body, ast.TypeDecl | None]] = field(default_factory=dict)
    structs: dict[int, tuple[t.Struct, ast.StructType, Body, ast.TypeDecl | None]] = field(
        default_factory=dict
    )
    declared: dict[int, ast.TypeDecl] = field(default_factory=dict)
    """Declaration of each type symbol, by id()."""
    resolving: list[str] = field(default_factory=list)
    """Names of types being resolved, for the message about a cycle."""

    def alias_initial(self, body: Body, ref: ast.TypeRef) -> ast.Expr | None:
        """Initial value of the alias type a variable is declared with."""
        for _ in range(100):
            if not isinstance(ref, ast.NamedType):
                return None
            symbol = self._named_symbol(body, ref.name)
            if not isinstance(symbol, TypeSymbol):
                return None
            entry = self.declared.get(id(symbol))
            if entry is None or isinstance(entry.type_ref, ast.EnumType):
                return None
            if entry.initial is not None:
                return entry.initial
            ref = entry.type_ref
        return None

    # -- types

    def type_of(
        self, body: Body, ref: ast.TypeRef, name: str, below_pointer: bool = False, by_address: bool = False
    ) -> Type | None:
        """The type that `ref` writes; None after an error. `name` is for structures and enumerations
        without one; `by_address`: the variable is no instance of its own, as VAR_IN_OUT."""
        ref.type = None
        if isinstance(ref, ast.NamedType):
            ref.type = self._named(body, ref, below_pointer, by_address)
        elif isinstance(ref, ast.StringType):
            ref.type = self._string(body, ref)
        elif isinstance(ref, ast.ArrayType):
            ref.type = self._array(body, ref, name)
        elif isinstance(ref, ast.PointerType):
            ref.type = self._pointer(body, ref, name)
        elif isinstance(ref, ast.ReferenceType):
            ref.type = self._reference(body, ref, name)
        elif isinstance(ref, ast.SubrangeType):
            ref.type = self._subrange(body, ref)
        elif isinstance(ref, ast.EnumType):
            self.enums.setdefault(id(ref), (ref, name, body, None))
            ref.type = self.enum_type(ref)
        elif isinstance(ref, ast.StructType):
            ref.type = self._struct(body, ref, name, None)
        return ref.type

    def _named_symbol(self, body: Body, name: str) -> Symbol | None:
        parts = name.split(".")
        symbol = body.names.get(parts[0].upper())
        for part in parts[1:]:
            if not isinstance(symbol, NamespaceSymbol):
                return None
            symbol = symbol.members.get(part.upper())
        return symbol

    def _named(
        self, body: Body, ref: ast.NamedType, below_pointer: bool, by_address: bool = False
    ) -> Type | None:
        name = ref.name
        if not name:
            return None
        key = name.upper()
        elementary = t.ELEMENTARY.get(key)
        if elementary is not None:
            return elementary
        symbol = self._named_symbol(body, name)
        if symbol is None and key in ANY_TYPES:
            return _any_group(body, ref, key)
        if isinstance(symbol, QualifiedSymbol) and symbol.target is not None and is_type(symbol.target):
            body.session.report_qualified(body.uri, ref.span, symbol)
            symbol = symbol.target
        if symbol is not None and symbol.access:
            check_use(body, ref, symbol)
        if isinstance(symbol, TypeSymbol):
            type_ = self.symbol_type(symbol)
            declared = self.declared.get(id(symbol))
            if declared is not None and declared.attributes:
                body.warn_obsolete(ref.span, declared.attributes)
            return type_
        if isinstance(symbol, PouSymbol):
            block = self._named_symbol(body, ref.generic) if ref.generic else symbol
            check_values(body, ref, symbol, block)
            return self._instance(body, ref, symbol, below_pointer, by_address)
        if isinstance(symbol, InterfaceSymbol):
            return symbol.type
        if isinstance(symbol, AmbiguousSymbol):
            body.report("E0203", ref.span, name=name, choices=", ".join(symbol.choices))
        elif symbol is not None:
            body.report("E0202", ref.span, name=name, hint=f"'{symbol.name}' is a {describe(symbol)}.")
        else:
            known = [
                (k, s)
                for k, s in body.names.items()
                if isinstance(s, (TypeSymbol, InterfaceSymbol))
                or (isinstance(s, PouSymbol) and s.kind == "FUNCTION_BLOCK")
            ]
            known += [(k, TypeSymbol(k)) for k in t.ELEMENTARY]
            body.report("E0202", ref.span, name=name, hint=body.suggest(name, known))
        return None

    def _instance(
        self, body: Body, ref: ast.NamedType, symbol: PouSymbol, below_pointer: bool, by_address: bool
    ) -> Type | None:
        if symbol.kind != "FUNCTION_BLOCK" and not (below_pointer and symbol.instance is not None):
            if not below_pointer:
                body.report("E0422", ref.span, name=symbol.name, what=describe(symbol))
            return None
        body.session.called.add(id(symbol))
        pou = symbol.pou
        if pou is not None:
            if pou.attributes:
                body.warn_obsolete(ref.span, pou.attributes)
            if "ABSTRACT" in pou.modifiers and not (below_pointer or by_address):
                body.report("E0425", ref.span, name=symbol.name)
        return symbol.instance

    def symbol_type(self, symbol: TypeSymbol) -> Type | None:
        """The type a user-defined name denotes."""
        entry = self.types.pop(id(symbol), None)
        if entry is None:
            if symbol.type is None and symbol.name in self.resolving:
                self._report_cycle(symbol)
            return symbol.type
        _, declaration, body = entry
        ref = declaration.type_ref
        if len(self.resolving) >= DEPTH_LIMIT:
            body.report("E0107", ref.span, what="type", limit=DEPTH_LIMIT)
            return None
        self.resolving.append(symbol.name)
        counted = self.session.account(body.uri)
        if isinstance(ref, ast.StructType):
            symbol.type = self._struct(body, ref, symbol.name, declaration, symbol)
        elif isinstance(ref, ast.EnumType):
            symbol.type = self.enum_type(ref)
        else:
            type_ = self.type_of(body, ref, symbol.name)
            if isinstance(type_, t.Subrange) and type_.name is None:
                type_ = t.Subrange(type_.base, type_.low, type_.high, symbol.name)
            symbol.type = type_
        declaration.type = symbol.type
        self.resolving.pop()
        self.session.resume(counted)
        return symbol.type

    def _report_cycle(self, symbol: TypeSymbol) -> None:
        chain = [*self.resolving[self.resolving.index(symbol.name) :], symbol.name]
        source, span = symbol.source, symbol.span
        if source is not None and span is not None:
            self.session.report("E0408", source.uri, span, name=symbol.name, chain=" -> ".join(chain))

    def _string(self, body: Body, ref: ast.StringType) -> Type | None:
        if ref.length is None:
            return t.String(80, ref.wide)
        length = self._constant_integer(body, ref.length)
        if length is None:
            return t.String(80, ref.wide)
        if not 0 <= length <= STRING_LIMIT:
            body.report("E0410", ref.length.span, high=STRING_LIMIT, value=length, hint="")
            return t.String(80, ref.wide)
        return t.String(length, ref.wide)

    def _constant_integer(self, body: Body, e: ast.Expr) -> int | None:
        messages = len(body.session.diagnostics)
        if value(body, e) is None:
            if len(body.session.diagnostics) == messages and not has_unknown_base(body.block):
                body.report("E0317", e.span)  # the function has no type yet
            return None
        if not e.is_constant:
            body.report("E0317", e.span)
            return None
        number = e.constant
        if not isinstance(number, int) or isinstance(number, bool):
            body.report("E0412", e.span)
            return None
        return number

    def _array(self, body: Body, ref: ast.ArrayType, name: str) -> Type | None:
        element = self.type_of(body, ref.element, name)
        bounds: list[tuple[int, int]] = []
        open_dims = 0
        for low_expr, high_expr in ref.bounds:
            if low_expr is None or high_expr is None:
                open_dims += 1
                continue
            low = self._constant_integer(body, low_expr)
            high = self._constant_integer(body, high_expr)
            if low is None or high is None:
                element = None
                continue
            if low > high:
                body.report("E0411", low_expr.span.to(high_expr.span), low=low, high=high)
                element = None
            bounds.append((low, high))
        if element is None or not (bounds or open_dims):
            return None
        if isinstance(element, t.Reference):
            body.report("E0407", ref.span, what="ARRAY OF REFERENCE")
            return None
        if isinstance(element, t.Array) and element.open_dims:
            body.report("E0414", ref.span)
            return None
        if open_dims:
            return t.Array(element, (), len(ref.bounds))
        array = t.Array(element, tuple(bounds))
        if array.count > layout.SIZE_LIMIT:
            body.report("E0413", ref.span, type=array, size=array.count, limit=layout.SIZE_LIMIT)
            return None
        return array

    def _pointer(self, body: Body, ref: ast.PointerType, name: str) -> Type | None:
        base = self.type_of(body, ref.base, name, below_pointer=True)
        if isinstance(base, t.Reference):
            body.report("E0407", ref.span, what=f"{'REF_TO' if ref.ref_to else 'POINTER TO'} REFERENCE")
            return None
        if base is None and not self._names_code(body, ref.base):
            return None
        return t.Pointer(base, ref_to=ref.ref_to and base is not None)

    def _names_code(self, body: Body, ref: ast.TypeRef) -> bool:
        """Whether a function or a method stands where a type should: something to point to without type."""
        return isinstance(ref, ast.NamedType) and isinstance(self._named_symbol(body, ref.name), PouSymbol)

    def _reference(self, body: Body, ref: ast.ReferenceType, name: str) -> Type | None:
        base = self.type_of(body, ref.base, name, below_pointer=True)
        if isinstance(base, t.Reference):
            body.report("E0407", ref.span, what="REFERENCE TO REFERENCE")
            return None
        return t.Reference(base) if base is not None else None

    def _subrange(self, body: Body, ref: ast.SubrangeType) -> Type | None:
        base = t.ELEMENTARY.get(ref.base.upper())
        if base is None:
            symbol = self._named_symbol(body, ref.base)
            type_ = self.symbol_type(symbol) if isinstance(symbol, TypeSymbol) else None
            found = t.value_type(type_) if type_ is not None else None
            base = found if isinstance(found, Elementary) else None
        low, high = self._constant_integer(body, ref.low), self._constant_integer(body, ref.high)
        if base is None or not base.is_integer:
            body.report("E0415", ref.span, what="A subrange", type=ref.base)
            return None
        if low is None or high is None:
            return base
        smallest, largest = conversion.RANGES[base.name]
        if not smallest <= low <= high <= largest:
            body.report("E0416", ref.span, low=low, high=high, type=base)
            return base
        return t.Subrange(base, low, high)

    # -- enumerations

    def enum_type(self, ref: ast.EnumType) -> t.Enum | None:
        """The enumeration that `ref` declares, with numbers for all values (LTYP-110..116)."""
        entry = self.enums.pop(id(ref), None)
        if entry is None:
            return ref.type if isinstance(ref.type, t.Enum) else None
        _, name, body, declaration = entry
        base: Elementary = t.INT
        if ref.base is not None:
            found = t.ELEMENTARY.get(ref.base.upper())
            if found is None or not found.is_integer:
                body.report("E0415", ref.span, what="An enumeration", type=ref.base)
            else:
                base = found
        counted = self.session.account(body.uri)
        enum = self.session.stand_for(t.Enum(name, base, decl=declaration), body.uri)
        ref.type = enum
        if declaration is not None:
            enum.qualified_only = attribute(declaration.attributes, "qualified_only") is not None
            enum.strict = attribute(declaration.attributes, "strict") is not None
            symbol = body.names.get(name.upper())
            if isinstance(symbol, TypeSymbol) and self.declared.get(id(symbol)) is declaration:
                symbol.type = enum  # so that its own text can name a value behind it
        by_name = {s.name.upper(): s for s in self.found.enum_values.get(id(ref), ())}
        for own in by_name.values():
            own.type = enum
        outer = body.locals
        # no value needs qualification in its own text, whatever others have the same name
        body.locals = dict(outer)
        low, high = conversion.RANGES[base.name]
        number = -1
        previous: int | None = None
        for entry_ in ref.values:
            if entry_.value is not None:
                given = self._constant_integer(body, entry_.value)
                number = number + 1 if given is None else given
            else:
                number += 1
            if not low <= number <= high:
                body.report("E0331", entry_.span, value=number, name=entry_.name, type=base)
                number = low
            elif previous is not None and number <= previous:
                body.report("W1222", entry_.span, value=number, name=entry_.name)
            previous = number
            entry_.number = number
            enum.values.setdefault(entry_.name, number)
            value_symbol = by_name.get(entry_.name.upper())
            if value_symbol is not None:
                value_symbol.number = number
                body.locals[entry_.name.upper()] = value_symbol
        if enum.values:
            enum.default = next(iter(enum.values.values()))
        if declaration is not None and declaration.initial is not None:
            initialise(body, declaration.initial, enum)
            default = declaration.initial.constant
            if isinstance(default, int):
                enum.default = int(default)
        body.locals = outer
        self.session.resume(counted)
        return enum

    # -- structures

    def _struct(
        self,
        body: Body,
        ref: ast.StructType,
        name: str,
        declaration: ast.TypeDecl | None,
        symbol: TypeSymbol | None = None,
    ) -> t.Struct:
        struct = self.session.stand_for(t.Struct(name, union=ref.union, decl=declaration), body.uri)
        ref.type = struct
        if symbol is not None:
            symbol.type = struct
        self.structs[id(struct)] = (struct, ref, body, declaration)
        if declaration is not None and declaration.extends:
            base_symbol = self._named_symbol(body, declaration.extends)
            base = self.symbol_type(base_symbol) if isinstance(base_symbol, TypeSymbol) else None
            if isinstance(base, t.Struct) and not base.union and not ref.union:
                struct.base = base
            elif base_symbol is None:
                hint = body.suggest(declaration.extends)
                body.report("E0202", declaration.extends_span, name=declaration.extends, hint=hint)
            else:
                body.report(
                    "E0417", declaration.name_span, name=name, base=declaration.extends, what="structure"
                )
        return struct


def _any_group(body: Body, ref: ast.NamedType, key: str) -> Type | None:
    if body.pou is not None and body.pou.kind in ("FUNCTION", "METHOD"):
        return ANY_TYPES[key]
    hint = f"'{key}' is for inputs of functions and methods."
    body.report("E0202", ref.span, name=key, hint=hint)
    return None
