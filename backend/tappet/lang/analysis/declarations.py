"""Second pass: types as written become types, structures and blocks get their layout, constants their value.

Everything is resolved on demand, because an array bound may need a constant whose type is an alias, and so
on;
what is asked for while it is being resolved is a cycle and an error.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import addresses, folding, layout
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.generic_values import check_base
from tappet.lang.analysis.given_values import initialise_parameter
from tappet.lang.analysis.initial import initialise
from tappet.lang.analysis.type_references import DEPTH_LIMIT, TypeReferences
from tappet.lang.parts import innermost
from tappet.lang.source import Span
from tappet.lang.symbols import EnumValueSymbol, PouSymbol, Storage, Symbol, TypeSymbol, VarSymbol
from tappet.lang.types import Elementary, Type

_STORED = frozenset({"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"})
_SIMPLE = (Elementary, t.String, t.Enum, t.Subrange)
_PINS = ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT")
_HANDED_OVER = ("VAR_INPUT", "VAR_IN_OUT")
"""CONSTANT here says that the body cannot write; the value comes from the caller."""
_POINTER_SIZE = 8


@dataclass(slots=True)
class Declarations(TypeReferences):
    """Variables without type, structures and blocks without layout, and those being worked on."""

    variables: dict[int, tuple[VarSymbol, Body]] = field(default_factory=dict)
    blocks: dict[int, PouSymbol] = field(default_factory=dict)
    """Function blocks and programs without layout, by id() of their type."""
    bodies: dict[int, Body] = field(default_factory=dict)
    """The view of each POU, method and accessor, by id() of its symbol."""
    evaluating: set[int] = field(default_factory=set)
    incomplete: dict[int, int] = field(default_factory=dict)
    """Position in `completing` of the structures and blocks whose layout is under way."""
    completing: list[str] = field(default_factory=list)
    laid_again: set[int] = field(default_factory=set)
    """id() of structures that are laid out again: their members are as they were."""

    # -- variables

    def __post_init__(self) -> None:
        self.session.resolve = self.resolve
        self.session.type_of = self.type_of
        self.session.complete = self.complete

    def resolve(self, symbol: Symbol) -> None:
        """Gives a variable its type, and its value when it is a constant; an enumeration value its number; a
        type name its type."""
        if isinstance(symbol, EnumValueSymbol):
            enum = self.found.enum_of_value.get(id(symbol))
            if enum is not None:
                self.enum_type(enum)
            return
        if isinstance(symbol, TypeSymbol):
            self.symbol_type(symbol)
            return
        entry = self.variables.pop(id(symbol), None)
        if entry is None:
            return
        counted = self.session.account(entry[1].uri)
        self._resolve(*entry)
        self.session.resume(counted)

    def _resolve(self, variable: VarSymbol, body: Body) -> None:
        decl = variable.decl
        assert decl is not None
        name = f"{variable.owner or ''}_{variable.name}"
        type_ = self.type_of(body, decl.type_ref, name, by_address=variable.section == "VAR_IN_OUT")
        variable.type = type_
        decl.init = decl.initial or self.alias_initial(body, decl.type_ref)
        if type_ is None:
            return
        self._check_variable(body, variable, decl, type_)
        if "CONSTANT" in variable.flags and variable.section not in _HANDED_OVER:
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
        pins = ("VAR_IN_OUT",) if decl.address.endswith("*") and self._stored(body) else _PINS
        if variable.section in pins:
            body.report("E0401", decl.span)
        elif variable.flags & {"RETAIN", "PERSISTENT"}:
            body.report("E0402", decl.span)
        else:
            self.complete(type_)
            addresses.place_variable(body, variable, decl.address, decl.span, type_)

    def _stored(self, body: Body) -> bool:
        """Whether the variables of a text are kept from call to call."""
        return body.pou is not None and body.pou.kind in ("PROGRAM", "FUNCTION_BLOCK")

    def _constant(self, body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> None:
        if not isinstance(type_, _SIMPLE) and not isinstance(type_, t.Pointer):
            return
        if decl.initial is None:
            if decl.init is None and variable.section in ("VAR", "VAR_GLOBAL", "VAR_STAT"):
                body.report("W1223", decl.span, name=variable.name)
            if decl.init is None:
                return
        initial = decl.init
        assert initial is not None
        if len(self.evaluating) >= DEPTH_LIMIT:
            body.report("E0107", decl.span, what="constant", limit=DEPTH_LIMIT)
            return
        self.evaluating.add(id(variable))
        if decl.given is None:
            initialise(body, initial, type_)
        else:
            decl.init = initialise_parameter(body, variable, decl, type_)
        self.evaluating.discard(id(variable))
        if decl.init is None:
            return
        initial = decl.init
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

    # -- layout

    def complete(self, type_: Type) -> bool:
        """Makes sure that size and members of a type are known; False when it contains itself or too much."""
        type_ = innermost(type_)
        if isinstance(type_, t.Struct):
            if id(type_) in self.incomplete:
                return False
            if id(type_) in self.structs and len(self.completing) >= DEPTH_LIMIT:
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
            if id(type_) in self.blocks and len(self.completing) >= DEPTH_LIMIT:
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
        inner = innermost(type_)
        if id(inner) not in self.incomplete:
            body.report("E0107", span, what="type", limit=DEPTH_LIMIT)
            return False
        chain = [*self.completing[self.incomplete[id(inner)] :], str(inner)]
        body.report("E0408", span, name=owner, chain=" -> ".join(chain))
        return False

    def _complete_struct(
        self, struct: t.Struct, ref: ast.StructType, body: Body, declaration: ast.TypeDecl | None
    ) -> None:
        counted = self.session.account(body.uri)
        placement = layout.Placement()
        if declaration is not None:
            placement.pack, faulty = layout.pack_of(declaration.attributes)
            if faulty is not None:
                body.report("E0609", declaration.name_span, value=faulty)
        if struct.base is not None:
            if self.complete(struct.base):
                struct.members.update(struct.base.members)
                struct.unknown |= struct.base.unknown
                placement.place(struct.base.size, struct.base.align)
            else:
                body.report("E0408", ref.span, name=struct.name, chain=f"{struct.name} -> {struct.base.name}")
                struct.base = None
        highest = 0
        for decl in ref.members:
            member = self._struct_member(body, struct, decl)
            if member is None:
                struct.unknown.add(decl.name.upper())
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
        self.session.resume(counted)

    def _struct_member(self, body: Body, struct: t.Struct, decl: ast.VarDecl) -> t.Member | None:
        if id(struct) in self.laid_again:
            known = decl.symbol
            if not isinstance(known, VarSymbol) or known.type is None:
                return None
            complete = self._member_complete(body, decl.span, struct.name, known.type)
            return t.Member(decl.name, known.type, decl=decl) if complete else None
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
        symbol = self.session.stand_for(symbol, body.uri, struct.name)
        decl.symbol = symbol
        if decl.name.upper() in struct.members:
            body.report("E0205", decl.name_span, what="member", name=decl.name)
            decl.type_ref.type = None
            return None
        if decl.address is not None:
            place = addresses.locate(body, decl.address, decl.span)
            if isinstance(place, addresses.IncompleteAddress):
                addresses.leave_incomplete(body, symbol, place)
            elif place is not None:
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
        if pou.base is not None and pou.pou is not None:
            written = pou.pou.extends_type
            check_base(body, pou, pou.base, self._named_symbol(body, written.generic) if written else None)
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
        for name, part in _parts(pou):
            for variable in self.found.own[id(part)].variables.values():
                if variable.section == "VAR_INST":
                    inner = self.bodies[id(part)]
                    self._block_member(inner, type_, variable, placement, f"{name}.{variable.name}")
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


def _parts(pou: PouSymbol) -> Iterator[tuple[str, PouSymbol]]:
    """What a block has below it, with the name that its variables are watched under."""
    for child in (*pou.methods.values(), *pou.actions.values()):
        yield child.name, child
    for property_ in pou.properties.values():
        for accessor in property_.accessors():
            yield f"{property_.name}.{'Get' if accessor is property_.getter else 'Set'}", accessor


def _stored_size(type_: Type) -> tuple[int, int]:
    return type_.size, type_.align


def _is_bit(decl: ast.VarDecl) -> bool:
    return isinstance(decl.type_ref, ast.NamedType) and decl.type_ref.name.upper() == "BIT"
