"""Builds the symbol map, and the lists of remanent variables, from a checked program."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass

from msgspec.structs import replace

from tappet.codegen.display import FLAG as DISPLAY_FLAG
from tappet.codegen.display import MODES
from tappet.codegen.layout import Signatures
from tappet.codegen.online import INIT, INIT_OTHER, NO_COPY
from tappet.codegen.package import DataObject, RemanentRange
from tappet.codegen.symbol_export import FLAG as SYMBOL_FLAG
from tappet.codegen.symbol_export import right_of
from tappet.codegen.symbol_map import Root, SymbolMap
from tappet.codegen.symbol_types import MemberInfo, TypeInfo
from tappet.core.lower import DataObject as ProgramData
from tappet.core.program import AREA_PREFIX, DATA_PREFIX, attribute_value, path_of
from tappet.core.templates import VFTABLE
from tappet.core.watched_properties import is_watchable
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import ConfiguredAddress
from tappet.lang.parts import Part, innermost, stored, types_holding, variables_of, walk
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage, VarSymbol
from tappet.lang.types import Kind

_KINDS = {
    "BOOL": "bool", "TIME": "time", "LTIME": "ltime", "DATE": "date", "TIME_OF_DAY": "tod",
    "DATE_AND_TIME": "dt", "LDATE": "ldate", "LTIME_OF_DAY": "ltod", "LDATE_AND_TIME": "ldt",
}  # fmt: skip
REMANENT = frozenset({"RETAIN", "PERSISTENT"})
_FAMILIES = {Kind.BITS: "bits", Kind.SIGNED: "int", Kind.UNSIGNED: "uint", Kind.REAL: "real"}


def elementary_kind(type_: t.Elementary) -> str:
    """Kind of a simple type in the symbol map."""
    return _KINDS.get(type_.name) or _FAMILIES[type_.kind]


class TypeTable:
    """Numbers types and describes them; may serve several builds, see `forget`."""

    def __init__(self, areas: Mapping[str, tuple[int, int]], statics: Mapping[int, int]) -> None:
        self.areas = areas
        """I, Q and M to (offset, size) in the image."""
        self.statics = statics
        """Offset in the image of each VAR_STAT variable, by id()."""
        self.types: list[TypeInfo] = []
        self.numbers: dict[object, int] = {}
        self.described: dict[int, t.Type] = {}
        """What the entries of `types` describe, those of variable lists apart."""
        self.lists: dict[str, int] = {}
        """Entries of variable lists, by the name of the root."""
        self.remanent = types_holding(_holds_remanent)
        self.with_path = types_holding(_holds_path)
        """Which types hold remanent variables, or texts that get the path of their instance."""
        self.limit = 0

    @property
    def is_full(self) -> bool:
        """Whether too many entries may be out of use."""
        return len(self.types) > self.limit

    def forget(self, entities: Set[int]) -> None:
        """Types given by id() look different now."""
        self.remanent.forget(entities)
        self.with_path.forget(entities)
        for number, type_ in list(self.described.items()):
            if id(innermost(type_)) in entities:
                self.types[number] = self._describe(type_)

    def number(self, type_: t.Type) -> int:
        """Index of a type in the table."""
        named = isinstance(type_, t.Struct | t.FunctionBlock | t.Enum | t.Interface)
        key: object = id(type_) if named else (type_.__class__.__name__, self._value_key(type_))
        number = self.numbers.get(key)
        if number is None:
            number = self.numbers[key] = len(self.types)
            self.described[number] = type_
            self.types.append(TypeInfo(str(type_), "bits", type_.size))
            self.types[number] = self._describe(type_)
        return number

    def _value_key(self, type_: t.Type) -> object:
        if isinstance(type_, t.Array):
            return (type_.bounds, type_.open_dims, self.number(type_.element))
        if isinstance(type_, t.Pointer | t.Reference):
            return (
                "" if type_.base is None else (type_.base.__class__.__name__, id(type_.base), str(type_.base))
            )
        if isinstance(type_, t.Subrange):
            return (type_.base.name, type_.low, type_.high, type_.name)
        return str(type_) if not isinstance(type_, t.String) else (type_.length, type_.wide)

    def _describe(self, type_: t.Type) -> TypeInfo:
        name = str(type_)
        if isinstance(type_, t.Elementary):
            return TypeInfo(name, elementary_kind(type_), type_.size)
        if isinstance(type_, t.String):
            return TypeInfo(name, "wstring" if type_.wide else "string", type_.size, length=type_.length)
        if isinstance(type_, t.Array):
            return TypeInfo(name, "array", type_.size, elem=self.number(type_.element), bounds=type_.bounds)
        if isinstance(type_, t.Enum):
            base = elementary_kind(type_.base)
            return TypeInfo(name, "enum", type_.size, values=tuple(type_.values.items()), base=base)
        if isinstance(type_, t.Subrange):
            kind = elementary_kind(type_.base)
            return TypeInfo(name, kind, type_.size, range=(type_.low, type_.high))
        if isinstance(type_, t.Pointer | t.Reference):
            kind = "pointer" if isinstance(type_, t.Pointer) else "reference"
            return TypeInfo(name, kind, type_.size, elem=self._target(type_.base))
        if isinstance(type_, t.Interface):
            return TypeInfo(name, "interface", type_.size)
        return self._composite(type_)

    def _target(self, base: t.Type | None) -> int | None:
        if base is None or (isinstance(base, t.Array) and base.open_dims):
            return None
        return self.number(base)

    def _composite(self, type_: t.Struct | t.FunctionBlock) -> TypeInfo:
        if isinstance(type_, t.Struct):
            kind = "union" if type_.union else "struct"
        else:
            kind = "program" if type_.program else "fb"
        pou = type_.pou if isinstance(type_, t.FunctionBlock) else None
        locals_hidden = pou is not None and attribute_value(pou.attributes, "hide_all_locals") is not None
        found = [self.member(m, locals_hidden and m.section == "VAR") for m in type_.members.values()]
        # a derived block watches its own property, not that of the base
        members = tuple({m.name.upper(): m for m in found}.values())
        if pou is not None and kind == "fb" and isinstance(pou.symbol, PouSymbol):
            members += tuple(shared(self, pou.symbol))
        return TypeInfo(str(type_), kind, type_.size, members=members)

    def member(self, m: t.Member, out_of_sight: bool = False) -> MemberInfo:
        """Description of a stored member; VAR_IN_OUT is the pointer it is stored as."""
        type_ = t.Pointer(m.type) if m.section == "VAR_IN_OUT" else m.type
        flags = set(m.flags) | marks(m.decl)
        if out_of_sight or m.name.upper() == VFTABLE:
            flags.add("HIDDEN")
        name = m.name
        monitored = m.decl.monitored if m.decl is not None else None
        if monitored is not None:
            if monitored.request is None or is_watchable(m.type):
                name = monitored.property_name
            else:
                flags.add("HIDDEN")
        return MemberInfo(name, self.number(type_), m.offset, m.section, tuple(sorted(flags)), m.bit)


def hidden(decl: ast.VarDecl | None) -> bool:
    """Whether a variable has the attribute hide."""
    return decl is not None and attribute_value(decl.attributes, "hide") is not None


def marks(decl: ast.VarDecl | None) -> set[str]:
    """Flags that the attributes of a variable give: HIDDEN, DISPLAY_HEX (LPRG-21), SYMBOL_READ (LPRG-44)."""
    found: set[str] = set()
    if decl is None or not decl.attributes:
        return found
    if hidden(decl):
        found.add("HIDDEN")
    mode = MODES.get((attribute_value(decl.attributes, "displaymode") or "").lower())
    if mode is not None:
        found.add(f"{DISPLAY_FLAG}{mode.upper()}")
    if attribute_value(decl.attributes, "no_copy") is not None:
        found.add(NO_COPY)
    initialised = attribute_value(decl.attributes, "init_on_onlchange")
    if initialised is not None:
        found.add(f"{INIT_OTHER}{initialised}" if initialised else INIT)
    right = right_of(attribute_value(decl.attributes, "symbol"))
    if right is not None:
        found.add(f"{SYMBOL_FLAG}{right.upper()}")
    return found


def _exported(owner: GvlSymbol | PouSymbol, members: tuple[MemberInfo, ...]) -> tuple[MemberInfo, ...]:
    """Members with the access right of their program or list, where they have none of their own (SYM-10)."""
    if isinstance(owner, PouSymbol):
        pragmas = owner.pou.attributes if owner.pou is not None else []
    else:
        blocks = owner.decl.blocks if owner.decl is not None else []
        own = owner.decl.attributes if owner.decl is not None else []
        pragmas = [*own, *(p for block in blocks for p in block.attributes)]
    right = right_of(attribute_value(pragmas, "symbol"))
    if right is None:
        return members
    return tuple(
        m
        if any(flag.startswith(SYMBOL_FLAG) for flag in m.flags)
        else replace(m, flags=tuple(sorted([*m.flags, f"{SYMBOL_FLAG}{right.upper()}"])))
        for m in members
    )


def build_symbol_map(
    data: list[ProgramData],
    objects: Mapping[str, DataObject],
    byte_addressing: bool,
    configured: Iterable[ConfiguredAddress] = (),
    known: TypeTable | None = None,
    entities: Set[int] = frozenset(),
    filled: Set[str] = frozenset(),
) -> tuple[SymbolMap, TypeTable]:
    """Symbol map of placed data objects, and of the variables that are copied from and to an address.

    `known`: the table of the build before, of which only the types in `entities`, given by id(), and the data
    objects with symbols in `filled` look different now.
    """
    areas = {
        area: (place.offset, place.size)
        for area in "IQM"
        if (place := objects.get(AREA_PREFIX + area)) is not None
    }
    statics = _statics(data, objects)
    if known is not None and (known.areas, known.statics) == (areas, statics) and not known.is_full:
        table = known
        table.forget(entities)
    else:
        known, table = None, TypeTable(areas, statics)
    symbols = SymbolMap([], byte_addressing=byte_addressing)
    symbols.areas.update(areas)
    for item in data:
        name = item.symbol.removeprefix(DATA_PREFIX)
        shown = path_of(item.owner)
        offset = objects[item.symbol].offset
        fresh = known is None or item.symbol in filled
        if isinstance(item.owner, PouSymbol):
            assert item.owner.instance is not None
            number = table.number(item.owner.instance)
            if fresh:
                _with_shared(table, number, item.owner)
            symbols.roots[name] = Root(shown, "program", offset, number)
            continue
        if fresh:
            _describe_list(table, name, item.owner)
        number = table.lists[name]
        members = table.types[number].members
        symbols.roots[name] = Root(shown, "gvl", offset, number)
        if not item.owner.qualified_only and not name.startswith("__") and "." not in name:
            for member in members:
                key = member.name.upper()
                symbols.globals[key] = "" if key in symbols.globals else name
    for entry in configured:
        symbols.mapped[entry.path.upper()] = (entry.area, entry.address, entry.bit)
    if known is None:
        table.limit = 2 * len(table.types) + 100
    symbols.types = list(table.types)
    return symbols, table


def _statics(data: list[ProgramData], objects: Mapping[str, DataObject]) -> dict[int, int]:
    """Offset in the image of each VAR_STAT variable, by id()."""
    found: dict[int, int] = {}
    for item in data:
        if isinstance(item.owner, GvlSymbol):
            start = objects[item.symbol].offset
            own = (v for v in item.owner.members.values() if v.section == "VAR_STAT")
            found |= {id(v): start + v.offset for v in own if _home(v) is Storage.GLOBAL}
    return found


def _with_shared(table: TypeTable, number: int, program: PouSymbol) -> None:
    """Describe a program with the variables that are not in its own data."""
    info = table.types[number]
    members = _exported(program, (*info.members, *shared(table, program)))
    if members != info.members:
        table.types[number] = TypeInfo(info.name, info.kind, info.size, members=members)


def _describe_list(table: TypeTable, name: str, gvl: GvlSymbol) -> None:
    members = _exported(gvl, (*_list_members(table, gvl), *shared(table, gvl)))
    number = table.lists.setdefault(name, len(table.types))
    if number == len(table.types):
        table.types.append(_NO_TYPE)
    table.types[number] = TypeInfo(gvl.name, "gvl", gvl.size, members=members)


_NO_TYPE = TypeInfo("", "gvl", 0)


def _list_members(table: TypeTable, gvl: GvlSymbol) -> Iterator[MemberInfo]:
    for member in gvl.members.values():
        if _home(member) is Storage.GLOBAL and member.type is not None:
            flags = tuple(sorted(member.flags | marks(member.decl)))
            number = table.number(member.type)
            yield MemberInfo(member.name, number, member.offset, member.section, flags, member.bit)


def _home(variable: VarSymbol) -> Storage:
    return variable.home if variable.storage is Storage.CONSTANT else variable.storage


def shared(table: TypeTable, owner: GvlSymbol | PouSymbol) -> Iterator[MemberInfo]:
    """Variables AT an address (LDEC-55) and VAR_STAT (LDEC-26): members with an absolute offset, the same in
    all instances.
    """
    variables = owner.members if isinstance(owner, GvlSymbol) else owner.locals
    for variable in variables.values():
        area = table.areas.get(variable.area or "")
        offset = None
        if variable.storage is Storage.DIRECT and area is not None:
            offset = area[0] + variable.offset
        elif isinstance(owner, PouSymbol):
            offset = table.statics.get(id(variable))
        if variable.type is not None and offset is not None:
            flags = tuple(sorted(variable.flags | marks(variable.decl)))
            number = table.number(variable.type)
            yield MemberInfo(variable.name, number, offset, variable.section, flags, variable.bit, True)


# -- remanence --------------------------------------------------------------------------------------


@dataclass(slots=True)
class Remanence:
    """Variables that outlive resets."""

    retain: list[RemanentRange]
    persistent: list[RemanentRange]
    no_init: list[tuple[int, int]]


def remanent_variables(
    data: list[ProgramData], objects: Mapping[str, DataObject], signatures: Signatures, table: TypeTable
) -> Remanence:
    """RETAIN and PERSISTENT variables over nested instances, by path (LDEC-70..LDEC-76)."""
    found = Remanence([], [], [])

    def visit(part: Part) -> bool:
        if part.decl is not None and _not_initialised(part.decl):
            found.no_init.append((part.offset, part.type.size))
        if part.flags & REMANENT:
            target = found.persistent if "PERSISTENT" in part.flags else found.retain
            size, signature = part.type.size, signatures.of(part.type)
            target.append(RemanentRange(part.path, part.offset, size, signature))
            return False
        return table.remanent.holds(part.type)

    for item in data:
        for part in variables_of(item.owner, item.owner.name, objects[item.symbol].offset):
            walk(part, visit)
    return found


def _holds_remanent(type_: t.Type) -> bool:
    return any(
        member.flags & REMANENT or (member.decl is not None and _not_initialised(member.decl))
        for member in stored(type_)
    )


def instance_paths(
    data: list[ProgramData], objects: Mapping[str, DataObject], prefix: str, table: TypeTable
) -> Iterator[tuple[int, t.String, str]]:
    """Offset, type and text of every STRING with attribute instance-path or init_namespace."""
    found: list[tuple[int, t.String, str]] = []

    def visit(part: Part) -> bool:
        if isinstance(part.type, t.FunctionBlock):
            for member in stored(part.type):
                name = _path_attribute(member)
                if name is not None and isinstance(member.type, t.String):
                    shown = part.path if name == "instance-path" else part.path.removeprefix(f"{prefix}.")
                    found.append((part.offset + member.offset, member.type, shown))
        return table.with_path.holds(part.type)

    for item in data:
        root = f"{prefix}.{item.owner.name}"
        for part in variables_of(item.owner, root, objects[item.symbol].offset):
            walk(part, visit)
    yield from found


def _holds_path(type_: t.Type) -> bool:
    return isinstance(type_, t.FunctionBlock) and any(_path_attribute(m) for m in stored(type_))


def _path_attribute(member: t.Member) -> str | None:
    """The attribute that gives a STRING the path of its instance: with the device in front or without
    (LPRG-27, LPRG-29)."""
    if member.decl is None:
        return None
    names = ("instance-path", "init_namespace")
    return next((n for n in names if attribute_value(member.decl.attributes, n) is not None), None)


def _not_initialised(decl: ast.VarDecl) -> bool:
    names = ("no_init", "noinit", "no-init")
    return any(attribute_value(decl.attributes, name) is not None for name in names)
