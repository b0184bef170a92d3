"""Second pass: types as written become types, structures and blocks get their layout, constants their value.

Everything is resolved on demand, because an array bound may need a constant whose type is an alias, and so on;
what is asked for while it is being resolved is a cycle and an error.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import addresses, conversion, folding, layout
from tappet.lang.analysis.collect import Collected
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.expressions import value
from tappet.lang.analysis.initial import initialise
from tappet.lang.analysis.scope import AmbiguousSymbol, describe
from tappet.lang.attributes import attribute
from tappet.lang.source import Span
from tappet.lang.symbols import (
    EnumValueSymbol,
    InterfaceSymbol,
    NamespaceSymbol,
    PouSymbol,
    Storage,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.types import Elementary, Type

STRING_LIMIT = 65535
"""Longest STRING in characters."""
_STORED = frozenset({"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"})
_SIMPLE = (Elementary, t.String, t.Enum, t.Subrange)
_POINTER_SIZE = 8


@dataclass(slots=True)
class Declarations:
    """What is still to be resolved, and what is being resolved."""

    session: Session
    found: Collected
    variables: dict[int, tuple[VarSymbol, Body]] = field(default_factory=dict)
    types: dict[int, tuple[TypeSymbol, ast.TypeDecl, Body]] = field(default_factory=dict)
    enums: dict[int, tuple[ast.EnumType, str, Body, ast.TypeDecl | None]] = field(default_factory=dict)
    structs: dict[int, tuple[t.Struct, ast.StructType, Body, ast.TypeDecl | None]] = field(
        default_factory=dict
    )
    blocks: dict[int, PouSymbol] = field(default_factory=dict)
    """Function blocks and programs without layout, by id() of their type."""
    bodies: dict[int, Body] = field(default_factory=dict)
    """The view of each POU, method and accessor, by id() of its symbol."""
    declared: dict[int, ast.TypeDecl] = field(default_factory=dict)
    """Declaration of each type symbol, by id()."""
    evaluating: set[int] = field(default_factory=set)
    resolving: list[str] = field(default_factory=list)
    """Names of types being resolved, for the message about a cycle."""
    incomplete: dict[int, int] = field(default_factory=dict)
    """Position in `completing` of the structures and blocks whose layout is under way."""
    completing: list[str] = field(default_factory=list)

    # -- variables

    def resolve(self, symbol: Symbol) -> None:
        """Gives a variable its type, and its value when it is a constant; an enumeration value its number."""
        if isinstance(symbol, EnumValueSymbol):
            enum = self.found.enum_of_value.get(id(symbol))
            if enum is not None:
                self.enum_type(enum)
            return
        entry = self.variables.pop(id(symbol), None)
        if entry is None:
            return
        variable, body = entry
        decl = variable.decl
        assert decl is not None
        type_ = self.type_of(body, decl.type_ref, f"{variable.owner or ''}_{variable.name}")
        variable.type = type_
        decl.init = decl.initial or self.alias_initial(body, decl.type_ref)
        if type_ is None:
            return
        self._check_variable(body, variable, decl, type_)
        if "CONSTANT" in variable.flags and variable.section != "VAR_IN_OUT":
            self._constant(body, variable, decl, type_)

    def _check_variable(self, body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> None:
        if decl.address is not None:
            self._place(body, variable, decl, type_)
        if isinstance(type_, t.Array) and type_.open_dims and variable.section != "VAR_IN_OUT":
            body.report("E0414", decl.span)
            variable.type = None
        if variable.section == "VAR_IN_OUT" and decl.initial is not None and "CONSTANT" not in variable.flags:
            body.report("E0430", decl.initial.span)

    def _place(self, body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> None:
        assert decl.address is not None
        if variable.section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"):
            body.report("E0401", decl.span)
        elif variable.flags & {"RETAIN", "PERSISTENT"}:
            body.report("E0402", decl.span)
        else:
            self.complete(type_)
            addresses.place_variable(body, variable, decl.address, decl.span, type_)

    def _constant(self, body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> None:
        if not isinstance(type_, _SIMPLE) and not isinstance(type_, t.Pointer):
            return
        if decl.initial is None:
            if decl.init is None and variable.section in ("VAR", "VAR_GLOBAL", "VAR_STAT"):
                body.report("E0406", decl.span, name=variable.name)
            if decl.init is None:
                return
        initial = decl.init
        assert initial is not None
        self.evaluating.add(id(variable))
        initialise(body, initial, type_)
        self.evaluating.discard(id(variable))
        if initial.is_constant and initial.constant is not None and initial.type is not None:
            content: ast.Constant = initial.constant
            base = t.value_type(type_)
            if isinstance(base, Elementary) and not isinstance(content, (str, bytes)):
                content = folding.wrap(content, base)
            elif isinstance(base, t.String) and isinstance(content, (str, bytes)):
                content = content[: base.length]
            variable.constant, variable.is_constant = content, True
            if isinstance(type_, _SIMPLE):
                variable.storage = Storage.CONSTANT
        elif initial.type is not None and self._depends_on_itself(initial):
            body.report("E0409", decl.span, name=variable.name)

    def _depends_on_itself(self, e: ast.Expr) -> bool:
        if isinstance(e, (ast.Name, ast.Member)):
            symbol = e.symbol
            if isinstance(symbol, VarSymbol):
                decl = symbol.decl
                return id(symbol) in self.evaluating or (decl is not None and decl.initial is e)
            return False
        if isinstance(e, ast.Binary):
            return self._depends_on_itself(e.left) or self._depends_on_itself(e.right)
        if isinstance(e, ast.Unary):
            return self._depends_on_itself(e.operand)
        if isinstance(e, ast.Call):
            return any(a.value is not None and self._depends_on_itself(a.value) for a in e.args)
        return False

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

    def type_of(self, body: Body, ref: ast.TypeRef, name: str, below_pointer: bool = False) -> Type | None:
        """The type that `ref` writes; None after an error. `name` is for structures and enumerations without one."""
        ref.type = None
        if isinstance(ref, ast.NamedType):
            ref.type = self._named(body, ref, below_pointer)
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

    def _named(self, body: Body, ref: ast.NamedType, below_pointer: bool) -> Type | None:
        name = ref.name
        if not name:
            return None
        key = name.upper()
        elementary = t.ELEMENTARY.get(key)
        if elementary is not None:
            return elementary
        symbol = self._named_symbol(body, name)
        if isinstance(symbol, TypeSymbol):
            type_ = self.symbol_type(symbol)
            declared = self.declared.get(id(symbol))
            if declared is not None and declared.attributes:
                _warn_obsolete(body, ref.span, declared.attributes)
            return type_
        if isinstance(symbol, PouSymbol):
            return self._instance(body, ref, symbol, below_pointer)
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
        self, body: Body, ref: ast.NamedType, symbol: PouSymbol, below_pointer: bool
    ) -> Type | None:
        if symbol.kind != "FUNCTION_BLOCK" and not (below_pointer and symbol.instance is not None):
            if not below_pointer:
                body.report("E0422", ref.span, name=symbol.name, what=describe(symbol))
            return None
        body.session.called.add(id(symbol))
        pou = symbol.pou
        if pou is not None:
            if pou.attributes:
                _warn_obsolete(body, ref.span, pou.attributes)
            if "ABSTRACT" in pou.modifiers and not below_pointer:
                body.report("E0425", ref.span, name=symbol.name)
        return symbol.instance

    def symbol_type(self, symbol: TypeSymbol) -> Type | None:
        """The type a user-defined name stands for."""
        entry = self.types.pop(id(symbol), None)
        if entry is None:
            if symbol.type is None and symbol.name in self.resolving:
                self._report_cycle(symbol)
            return symbol.type
        _, declaration, body = entry
        ref = declaration.type_ref
        self.resolving.append(symbol.name)
        if isinstance(ref, ast.StructType):
            symbol.type = self._struct(body, ref, symbol.name, declaration, symbol)
        elif isinstance(ref, ast.EnumType):
            self.enums.setdefault(id(ref), (ref, symbol.name, body, declaration))
            symbol.type = self.enum_type(ref)
        else:
            type_ = self.type_of(body, ref, symbol.name)
            if isinstance(type_, t.Subrange) and type_.name is None:
                type_ = t.Subrange(type_.base, type_.low, type_.high, symbol.name)
            symbol.type = type_
        declaration.type = symbol.type
        self.resolving.pop()
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
        if not 1 <= length <= STRING_LIMIT:
            body.report("E0410", ref.length.span, high=STRING_LIMIT, value=length, hint="")
            return t.String(80, ref.wide)
        return t.String(length, ref.wide)

    def _constant_integer(self, body: Body, e: ast.Expr) -> int | None:
        if value(body, e) is None:
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
            body.report("E0407", ref.span, what="POINTER TO REFERENCE")
            return None
        return t.Pointer(base)

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
            body.report("E0415", ref.span, type=ref.base)
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
                body.report("E0415", ref.span, type=ref.base)
            else:
                base = found
        enum = t.Enum(name, base, decl=declaration)
        ref.type = enum
        if declaration is not None:
            enum.qualified_only = attribute(declaration.attributes, "qualified_only") is not None
            enum.strict = attribute(declaration.attributes, "strict") is not None
        by_name = {s.name.upper(): s for s in self.found.enum_values.get(id(ref), ())}
        for symbol in by_name.values():
            symbol.type = enum
        low, high = conversion.RANGES[base.name]
        number = -1
        previous: int | None = None
        for entry_ in ref.values:
            if entry_.value is not None:
                given = self._enum_number(body, entry_.value, enum)
                number = number + 1 if given is None else given
            else:
                number += 1
            if not low <= number <= high:
                body.report("E0331", entry_.span, value=number, name=entry_.name, type=base)
                number = low
            elif previous is not None and number <= previous:
                body.report("E0332", entry_.span, value=number, name=entry_.name)
            previous = number
            entry_.number = number
            enum.values.setdefault(entry_.name, number)
            value_symbol = by_name.get(entry_.name.upper())
            if value_symbol is not None:
                value_symbol.number = number
        if enum.values:
            enum.default = next(iter(enum.values.values()))
        if declaration is not None and declaration.initial is not None:
            initialise(body, declaration.initial, enum)
            default = declaration.initial.constant
            if isinstance(default, int):
                enum.default = int(default)
        return enum

    def _enum_number(self, body: Body, e: ast.Expr, enum: t.Enum) -> int | None:
        """A value may name those before it: they are in `enum.values` already."""
        if isinstance(e, ast.Name):
            known = {k.upper(): n for k, n in enum.values.items()}.get(e.name.upper())
            if known is not None:
                e.type, e.constant, e.is_constant = enum, known, True
                return known
        return self._constant_integer(body, e)

    # -- structures and blocks

    def _struct(
        self,
        body: Body,
        ref: ast.StructType,
        name: str,
        declaration: ast.TypeDecl | None,
        symbol: TypeSymbol | None = None,
    ) -> t.Struct:
        struct = t.Struct(name, union=ref.union, decl=declaration)
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
                body.report("E0202", declaration.name_span, name=declaration.extends, hint=hint)
            else:
                body.report(
                    "E0417", declaration.name_span, name=name, base=declaration.extends, what="structure"
                )
        return struct

    def complete(self, type_: Type) -> bool:
        """Makes sure that size and members of a type are known; False when it contains itself."""
        while isinstance(type_, t.Array):
            type_ = type_.element
        if isinstance(type_, t.Struct):
            if id(type_) in self.incomplete:
                return False
            entry = self.structs.pop(id(type_), None)
            if entry is not None:
                self.incomplete[id(type_)] = len(self.completing)
                self.completing.append(type_.name)
                self._complete_struct(*entry)
                self.completing.pop()
                del self.incomplete[id(type_)]
        elif isinstance(type_, t.FunctionBlock):
            if id(type_) in self.incomplete:
                return False
            symbol = self.blocks.pop(id(type_), None)
            if symbol is not None:
                self.incomplete[id(type_)] = len(self.completing)
                self.completing.append(type_.name)
                self._complete_block(symbol, type_)
                self.completing.pop()
                del self.incomplete[id(type_)]
        return True

    def _member_complete(self, body: Body, span: Span, owner: str, type_: Type) -> bool:
        if self.complete(type_):
            return True
        inner = type_
        while isinstance(inner, t.Array):
            inner = inner.element
        chain = [*self.completing[self.incomplete[id(inner)] :], str(inner)]
        body.report("E0408", span, name=owner, chain=" -> ".join(chain))
        return False

    def _complete_struct(
        self, struct: t.Struct, ref: ast.StructType, body: Body, declaration: ast.TypeDecl | None
    ) -> None:
        placement = layout.Placement()
        if declaration is not None:
            placement.pack, faulty = layout.pack_of(declaration.attributes)
            if faulty is not None:
                body.report("E0609", declaration.name_span, value=faulty)
        if struct.base is not None:
            if self.complete(struct.base):
                struct.members.update(struct.base.members)
                placement.place(struct.base.size, struct.base.align)
            else:
                body.report("E0408", ref.span, name=struct.name, chain=f"{struct.name} -> {struct.base.name}")
                struct.base = None
        highest = 0
        for decl in ref.members:
            member = self._struct_member(body, struct, decl)
            if member is None:
                continue
            if struct.union:
                placement.offset = 0
            if _is_bit(decl) and not struct.union:
                member.offset, member.bit = placement.place_bit()
            else:
                member.offset = placement.place(*_stored_size(member.type))
            highest = max(highest, placement.offset)
            if placement.offset > layout.SIZE_LIMIT:
                body.report(
                    "E0611", decl.span, name=struct.name, size=placement.offset, limit=layout.SIZE_LIMIT
                )
                placement.offset = 0
            symbol = decl.symbol
            assert isinstance(symbol, VarSymbol)
            symbol.offset, symbol.bit = member.offset, member.bit
            struct.members[decl.name.upper()] = member
        placement.offset = highest if struct.union else placement.offset
        struct.size, struct.align = placement.size, placement.align

    def _struct_member(self, body: Body, struct: t.Struct, decl: ast.VarDecl) -> t.Member | None:
        symbol = VarSymbol(
            decl.name,
            body.source,
            decl.name_span,
            decl.comment,
            storage=Storage.INSTANCE,
            home=Storage.INSTANCE,
            owner=struct.name,
            decl=decl,
        )
        decl.symbol = symbol
        if decl.name.upper() in struct.members:
            body.report("E0205", decl.name_span, what="member", name=decl.name)
            return None
        if decl.address is not None:
            body.report("E0403", decl.span)
        symbol.type = self.type_of(body, decl.type_ref, f"{struct.name}_{decl.name}")
        decl.init = decl.initial or self.alias_initial(body, decl.type_ref)
        if symbol.type is None:
            return None
        if isinstance(symbol.type, t.Array) and symbol.type.open_dims:
            return None
        if not self._member_complete(body, decl.span, struct.name, symbol.type):
            symbol.type = None
            return None
        return t.Member(decl.name, symbol.type, decl=decl)

    def _complete_block(self, pou: PouSymbol, type_: t.FunctionBlock) -> None:
        body = self.bodies[id(pou)]
        placement = layout.Placement()
        attributes = pou.pou.attributes if pou.pou is not None else []
        placement.pack, faulty = layout.pack_of(attributes)
        if faulty is not None and pou.span is not None:
            body.report("E0609", pou.span, value=faulty)
        base = pou.base.instance if pou.base is not None else None
        if base is not None and self.complete(base):
            type_.base = base
            type_.members.update(base.members)
            placement.place(base.size, base.align)
        elif pou.vtable:
            vftable = t.Member("__VFTABLE", t.LWORD, section="VAR")
            vftable.offset = placement.place(_POINTER_SIZE, _POINTER_SIZE)
            type_.members["__VFTABLE"] = vftable
        for variable in self.found.own[id(pou)].variables.values():
            if variable.section in _STORED:
                self._block_member(body, type_, variable, placement, variable.name)
        for method in pou.methods.values():
            for variable in self.found.own[id(method)].variables.values():
                if variable.section == "VAR_INST":
                    inner = self.bodies[id(method)]
                    self._block_member(inner, type_, variable, placement, f"{method.name}.{variable.name}")
        type_.size, type_.align = placement.size, placement.align

    def _block_member(
        self, body: Body, type_: t.FunctionBlock, variable: VarSymbol, placement: layout.Placement, name: str
    ) -> None:
        self.resolve(variable)
        declared = variable.type
        if declared is None or variable.home is Storage.DIRECT:
            return
        span = variable.span
        assert span is not None
        if variable.section == "VAR_IN_OUT":
            size, align = _POINTER_SIZE, _POINTER_SIZE
        elif self._member_complete(body, span, type_.name, declared):
            size, align = _stored_size(declared)
        else:
            variable.type = None
            return
        variable.offset = placement.place(size, align)
        if placement.offset > layout.SIZE_LIMIT:
            body.report("E0611", span, name=type_.name, size=placement.offset, limit=layout.SIZE_LIMIT)
            placement.offset = 0
        type_.members[name.upper()] = t.Member(
            name, declared, variable.offset, variable.section, variable.flags, variable.decl
        )


def _stored_size(type_: Type) -> tuple[int, int]:
    return type_.size, type_.align


def _is_bit(decl: ast.VarDecl) -> bool:
    return isinstance(decl.type_ref, ast.NamedType) and decl.type_ref.name.upper() == "BIT"


def _warn_obsolete(body: Body, span: Span, attributes: list[ast.Pragma]) -> None:
    text = attribute(attributes, "obsolete")
    if text is not None:
        body.report("W1203", span, text=text or "The type is obsolete")
